//! Mixed cells that a step leaves in tension: their gas expands.

use crate::Mixture;
use crate::state::ConservedCell;
use crate::state::conserved::{ENERGY, MOMENTUM_R, MOMENTUM_Z, PHI, RHO};
use crate::state::finished::{FinishedCell, finish_corrected};

/// The cell with as much more gas fraction as takes the tension from it; `None` where no gas fraction does.
///
/// The closure follows the gas's expansion through one step to first order. Where a wave of tension meets a cell of little gas that is not enough,
/// and ρe = β₁(φ) p + β₂(φ) has p < 0 at the closure's φ. Mass, momentum and energy are right; what is not is φ. The gas
/// expands, isentropically from what it was, until the liquid bears what is left: ρe is linear in φ, so
///
/// φ(p) = (ρe − β₁(0) p − β₂(0))/(β₁(1) p − β₁(0) p + β₂(1) − β₂(0)),   p + π_g = (p₀ + π_g)(φ₀/φ)^γ_g.
///
/// One turn of the two from p = the floor is enough: the fraction hardly hangs on a pressure that is small against π of the liquid. Nothing is
/// added, where the pressure floor adds energy. With a covolume φ − b m_g takes the place of φ on the isentrope.
///
/// - `u`: ρ, ρv, ρE (per volume) and φ after the step, p below the floor of cells with gas; `gas`: m_g, kg/m³; `before`: the cell's gas
///   before the step.
pub(crate) fn expanded(u: ConservedCell, gas: f64, before: Gas, mixture: &Mixture) -> Option<FinishedCell> {
    let (law, floor) = (mixture.gas, mixture.pressure_floor(1.0));
    let internal = u[ENERGY] - 0.5 * (u[MOMENTUM_Z] * u[MOMENTUM_Z] + u[MOMENTUM_R] * u[MOMENTUM_R]) / u[RHO];
    let at_floor = mixture.fraction_of(internal, floor, u[RHO], gas);
    let Gas { pressure, phi, .. } = before;
    let free = |phi: f64, mass: f64| phi - law.covolume * mass;
    let ratio = free(phi, before.mass) / free(at_floor, gas);
    let after = (pressure + law.pi) * ratio.powf(law.gamma) - law.pi;
    let found = mixture.fraction_of(internal, after.min(pressure).max(floor + CLEAR), u[RHO], gas);
    let grows = found > u[PHI] && found < MOST;
    let cell = grows
        .then(|| finish_corrected([u[RHO], u[MOMENTUM_Z], u[MOMENTUM_R], u[ENERGY], found], gas, mixture));
    cell.filter(|cell| cell.floor == 0.0 && cell.is_admissible())
}

/// The gas of a mixed cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gas {
    /// Pa.
    pub pressure: f64,
    pub phi: f64,
    /// m_g, kg/m³.
    pub mass: f64,
}

/// How far above the floor a cell ends at least, Pa: a thousand times the round-off of its pressure, p = (ρe − β₂)/β₁.
const CLEAR: f64 = 1e-2;

/// A cell that would be all gas has not the energy of its liquid.
const MOST: f64 = 0.999;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Primitive;

    #[test]
    fn gas_expands_until_the_tension_is_gone_and_nothing_is_added() {
        let mixture = Mixture::water_and_air();
        for (phi, tension) in [(2e-3, 1e4), (2e-3, 5e6), (0.05, 5e6), (0.3, 1e5)] {
            let before = Primitive { density: 900.0, v_z: 30.0, v_r: -4.0, pressure: -tension, phi };
            let u = before.to_conserved(0.0, &mixture);
            let cell =
                expanded(u, 0.0, Gas { pressure: 2118.0, phi, mass: 0.0 }, &mixture).expect("it expands");
            let after = Primitive::from_conserved(cell.conserved, 0.0, &mixture);
            assert_eq!(cell.conserved[..4], u[..4], "mass, momentum and energy");
            assert!(after.phi > phi && after.pressure > 0.0 && after.pressure <= 2118.0, "{after:?}");
            // Its gas is on its isentrope, to what a turn more would change.
            let own = 2118.0 * (phi / after.phi).powf(1.4);
            assert!((after.pressure / own - 1.0).abs() < 1e-2, "{after:?}, {own} Pa");
        }
    }

    #[test]
    fn a_cell_without_energy_is_left_to_the_floor() {
        let mixture = Mixture::water_and_air();
        let thin = Primitive { density: 0.1, v_z: 0.0, v_r: 0.0, pressure: -1e3, phi: 0.9999 };
        let before = Gas { pressure: 2118.0, phi: 0.9999, mass: 0.1 };
        assert!(expanded(thin.to_conserved(0.1, &mixture), 0.1, before, &mixture).is_none());
    }
}
