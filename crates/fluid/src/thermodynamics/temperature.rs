//! Temperatures of cells.

use crate::two_phase::is_mixed;
use crate::{Mixture, NobleAbelStiffenedGas};

/// The temperature of a cell, K.
///
/// Of one phase [`NobleAbelStiffenedGas::temperature`]. Phases of a mixed cell share the pressure and have temperatures of their own; the
/// cell's is their mean by heat capacities, Σ m_k c_k T_k/Σ m_k c_k.
///
/// - `density`, `pressure`, `phi`: the cell's, kg/m³, Pa, 1; `gas`: m_g, kg/m³, where phases have masses of their own.
/// - returns: T; NaN where a phase has no heat capacity, and in mixed cells of the paper's mixture, whose phases have no densities.
/// - errors: none.
/// - tested by: pure cells, a mixed cell of one temperature.
pub(crate) fn cell_temperature(
    mixture: &Mixture,
    [density, pressure, phi]: [f64; 3],
    gas: Option<f64>,
) -> f64 {
    let of =
        |law: &NobleAbelStiffenedGas, density: f64| law.temperature(density, pressure).unwrap_or(f64::NAN);
    if !is_mixed(phi) {
        return of(if phi > 0.5 { &mixture.gas } else { &mixture.liquid }, density);
    }
    let (Some(mass), Some(heat_g), Some(heat_l)) = (gas, mixture.gas.heat, mixture.liquid.heat) else {
        return f64::NAN;
    };
    let (gas_heat, liquid_heat) = (mass * heat_g.capacity, (density - mass) * heat_l.capacity);
    let gas_part = gas_heat * of(&mixture.gas, mass / phi);
    let liquid_part = liquid_heat * of(&mixture.liquid, (density - mass) / (1.0 - phi));
    (gas_part + liquid_part) / (gas_heat + liquid_heat)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NamedFluid;

    #[test]
    fn cells_of_one_temperature_have_it_whatever_they_hold() {
        let of = |name| NamedFluid::of(name).expect("it is in the library").law;
        let (liquid, gas) = (of("water-nasg"), of("air"));
        let mixture = Mixture::new(liquid, gas);
        let (p, temperature) = (2e5, 320.0);
        let density = |law: NobleAbelStiffenedGas| law.density_at(p, temperature).expect("it has c_v");
        for phi in [0.0, 1e-7, 0.3, 1.0] {
            let mass = phi * density(gas);
            let rho = mass + (1.0 - phi) * density(liquid);
            let got = cell_temperature(&mixture, [rho, p, phi], Some(mass));
            approx::assert_relative_eq!(got, temperature, max_relative = 1e-5);
        }
        let mixed = [1.0, p, 0.3];
        assert!(cell_temperature(&mixture, mixed, None).is_nan());
        let without = Mixture::new(of("water"), gas);
        assert!(cell_temperature(&without, [1000.0, p, 0.0], None).is_nan());
    }
}
