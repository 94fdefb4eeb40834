//! Evaporation at a finite rate.

use super::holding::{Changed, Holding};
use super::root::falling_root;
use super::saturation::Saturation;
use crate::two_phase::isentropic_fraction;

/// The part of a phase's mass that may change phase in a step.
const MOST: f64 = 0.5;

/// What evaporates in a step at the rate of Hertz and Knudsen, j = α (p_v,eq(T_l, p) − p_v)/√(2π R T_l).
///
/// The step is implicit, Δm = Δt a j(state after Δm), by a bracketed root: however fast the rate, the cell does not go beyond
/// equilibrium. At most half of a phase changes in a step.
///
/// - `evaporating`, `condensing`: α Δt times the area of the interface per volume for either, s/m.
/// - returns: `None` where nothing changes or the liquid is above the critical point.  errors: none.
/// - tested by: `tests.rs` (the ordinary differential equation, a step of any length).
pub(super) fn at_finite_rate(
    cell: &Holding,
    [evaporating, condensing]: [f64; 2],
    saturation: &Saturation,
) -> Option<Changed> {
    let pressure = cell.pressure(saturation);
    let temperature = cell.liquid_temperature(pressure, saturation);
    let makes_sense = pressure > 0.0 && temperature > 0.0 && cell.gas > 0.0 && cell.liquid() > 0.0;
    if !makes_sense || pressure >= Saturation::CRITICAL[1] || temperature >= Saturation::CRITICAL[0] {
        return None;
    }
    let driving_now = driving(cell, pressure, temperature, saturation);
    let (sign, rate) = if driving_now > 0.0 { (1.0, evaporating) } else { (-1.0, condensing) };
    let explicit = rate * driving_now;
    let most = MOST * if sign > 0.0 { cell.liquid() } else { cell.vapour };
    let bound = explicit.abs().min(most);
    if !(bound > 0.0) {
        return None;
    }
    let left = |amount: f64| {
        let Some(changed) = after(cell, sign * amount, saturation) else { return -amount };
        let new = cell.with(changed, saturation);
        let pressure = new.pressure(saturation);
        let temperature = new.liquid_temperature(pressure, saturation);
        let driving = driving(&new, pressure, temperature, saturation);
        if driving.is_finite() { sign * rate * driving - amount } else { -amount }
    };
    let amount = falling_root(0.0, bound, 1e-13 * bound, left);
    after(cell, sign * amount, saturation).filter(|changed| changed.evaporated != 0.0)
}

/// (p_v,eq − p_v)/√(2π R T_l), kg/(m² s).
fn driving(cell: &Holding, pressure: f64, temperature: f64, saturation: &Saturation) -> f64 {
    let difference = saturation.vapour_pressure(temperature, pressure) - pressure * cell.vapour / cell.gas;
    difference / saturation.kinetic_speed(temperature)
}

/// A cell after a mass has gone from one phase to the other.
///
/// At first at constant pressure: the mass takes the vapour's enthalpy h_v = γ_v c_v T + q_v with it, at the temperature of the phase it
/// comes from; what evaporates takes its latent heat from the liquid, and what condenses leaves it there. Then both phases come to the
/// cell's volume isentropically. `None` where the liquid has no heat left for it.
fn after(cell: &Holding, evaporated: f64, saturation: &Saturation) -> Option<Changed> {
    let Saturation { mixture, liquid_heat, gas_heat } = *saturation;
    let (liquid, gas) = (mixture.liquid, mixture.gas);
    let pressure = cell.pressure(saturation);
    let temperature = cell.liquid_temperature(pressure, saturation);
    let passing = if evaporated > 0.0 { temperature } else { cell.gas_temperature(pressure, saturation) };
    let gas_volume = cell.phi + evaporated * (gas.gamma - 1.0) * gas_heat.capacity * passing / pressure;
    let mass = cell.liquid() - evaporated;
    let enthalpy =
        |temperature: f64| liquid.gamma * liquid_heat.capacity * temperature + liquid.covolume * pressure;
    let taken = gas.gamma * gas_heat.capacity * passing - saturation.reference_difference();
    let left = (cell.liquid() * enthalpy(temperature) - evaporated * taken) / mass;
    let colder = (left - liquid.covolume * pressure) / (liquid.gamma * liquid_heat.capacity);
    let density = liquid.density_at(pressure, colder)?;
    if !(mass > 0.0 && colder > 0.0 && gas_volume > 0.0) {
        return None;
    }
    let phi =
        isentropic_fraction([gas_volume, mass / density], [0.0, liquid.covolume * mass], pressure, &mixture);
    (phi > 0.0 && phi < 1.0).then_some(Changed { evaporated, phi })
}

#[cfg(test)]
#[path = "rate_tests.rs"]
mod tests;
