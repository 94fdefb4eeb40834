//! The equilibrium of a cell: one pressure, one temperature, one Gibbs energy (pTg).

use super::holding::{Changed, Holding};
use super::root::falling_root;
use super::saturation::Saturation;

/// A cell of both phases at one pressure and one temperature.
struct Mixed {
    pressure: f64,
    temperature: f64,
    phi: f64,
}

/// The least mass of vapour, and of liquid, that is left, relative to that of the cell.
const LEAST: f64 = 1e-14;

/// What brings a cell to equilibrium at its mass and energy: Saurel, Petitpas & Abgrall (2008) with Noble–Abel stiffened gases.
///
/// For a mass of vapour, both phases have one pressure and one temperature ([`mixed`]); that mass is then found for which the
/// vapour's partial pressure is [`Saturation::vapour_pressure`]. More vapour is colder and under more pressure, so that the difference of the
/// logarithms falls, and a bracketed root is the only one. Where there is none, all but a 10⁻¹⁴ of the cell's mass has changed.
///
/// - returns: `None` where nothing changes, nothing makes sense, or the liquid is above the critical point.  errors: none.
/// - tested by: `tests.rs` (an independent solution, random states).
pub(super) fn to_equilibrium(cell: &Holding, saturation: &Saturation) -> Option<Changed> {
    let pressure = cell.pressure(saturation);
    if pressure >= Saturation::CRITICAL[1]
        || cell.liquid_temperature(pressure, saturation) >= Saturation::CRITICAL[0]
    {
        return None;
    }
    let rest = cell.gas - cell.vapour;
    let [least, most] = [LEAST * cell.density, cell.liquid() + cell.vapour - LEAST * cell.density];
    if !(cell.liquid() > least && least < most) {
        return None;
    }
    let of = |vapour: f64| {
        let changed = Changed { evaporated: vapour - cell.vapour, phi: cell.phi };
        mixed(&cell.with(changed, saturation), saturation)
    };
    let excess = |logarithm: f64| {
        let vapour = logarithm.exp();
        // Without energy for that much vapour there is too much of it.
        of(vapour).map_or(-1e3, |state| {
            let partial = state.pressure * (vapour / (vapour + rest));
            (saturation.vapour_pressure(state.temperature, state.pressure) / partial).ln()
        })
    };
    let vapour = falling_root(least.ln(), most.ln(), 1e-14, excess).exp();
    let state = of(vapour).filter(|state| state.temperature < Saturation::CRITICAL[0])?;
    Some(Changed { evaporated: vapour - cell.vapour, phi: state.phi })
}

/// Both phases of a cell at one pressure and one temperature.
///
/// With A_k = m_k (γ_k − 1) c_k, C_k = m_k c_k and V = 1 − b_l m_l the volumes and energies are T (A_g/p + A_l/(p + π)) = V and
/// T (C_g + C_l (p + γ_l π)/(p + π)) = ρe; without T that is
///
/// V (C_g + C_l) p² + [V π (C_g + γ_l C_l) − ρe (A_g + A_l)] p − ρe A_g π = 0,
///
/// of which one root is positive. `None` without energy or volume.
fn mixed(cell: &Holding, saturation: &Saturation) -> Option<Mixed> {
    let (liquid, gas) = (saturation.mixture.liquid, saturation.mixture.gas);
    let heat_g = cell.gas * saturation.gas_heat.capacity;
    let heat_l = cell.liquid() * saturation.liquid_heat.capacity;
    let (work_g, work_l) = (heat_g * (gas.gamma - 1.0), heat_l * (liquid.gamma - 1.0));
    let volume = 1.0 - liquid.covolume * cell.liquid();
    let (energy, pi) = (cell.internal, liquid.pi);
    if !(energy > 0.0 && volume > 0.0) {
        return None;
    }
    let a = volume * (heat_g + heat_l);
    let b = volume * pi * (heat_g + liquid.gamma * heat_l) - energy * (work_g + work_l);
    let c = -energy * work_g * pi;
    let root = (b * b - 4.0 * a * c).sqrt();
    // Without a difference of numbers that are nearly equal.
    let pressure = if b > 0.0 { -2.0 * c / (b + root) } else { (root - b) / (2.0 * a) };
    let temperature = volume / (work_g / pressure + work_l / (pressure + pi));
    let phi = work_g * temperature / pressure;
    (pressure > 0.0 && temperature > 0.0 && phi.is_finite()).then_some(Mixed { pressure, temperature, phi })
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
