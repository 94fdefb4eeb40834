//! The interface when what is on its other side is given: a wall that moves, or a load that presses.

use crate::star::{FluidTrace, InterfaceStar, SolidTrace, exact_star, wave_velocity};

/// Impedance of a wall that no pressure moves, Pa s/m: far above all media, far below where products overflow.
const RIGID: f64 = 1e60;

/// The fluid against a wall that moves with a given velocity (along +z, m/s), on the exact curve of [`exact_star`].
///
/// - `floored`: the wall recedes faster than the liquid expands; p* is then −π.
#[must_use]
pub fn fluid_at_moving_wall(fluid: &FluidTrace, velocity: f64) -> InterfaceStar {
    let star = exact_star(fluid, &SolidTrace { pressure: fluid.pressure, velocity, impedance: RIGID });
    InterfaceStar { velocity, ..star }
}

/// The fluid under a given pressure (Pa): v* = v_f + f(p), Toro (2009) eq. 4.7 in p + π. `floored` as for p < −π, with
/// the velocity at −π.
#[must_use]
pub fn fluid_under_pressure(fluid: &FluidTrace, pressure: f64) -> InterfaceStar {
    let floored = pressure <= -fluid.pi;
    let pressure = pressure.max(-fluid.pi);
    InterfaceStar {
        pressure,
        velocity: fluid.velocity + wave_velocity(fluid, pressure),
        iterations: 0,
        floored,
    }
}

/// The solid's surface that is moved with a given velocity (along +z, m/s): p* = P_s + Z_s (v_s − v).
#[must_use]
pub fn solid_moved(solid: &SolidTrace, velocity: f64) -> InterfaceStar {
    let pressure = solid.pressure + solid.impedance * (solid.velocity - velocity);
    InterfaceStar { pressure, velocity, iterations: 0, floored: false }
}

/// The solid's surface under a given pressure −σ_zz (Pa): v* = v_s + (P_s − p)/Z_s.
#[must_use]
pub fn solid_under_pressure(solid: &SolidTrace, pressure: f64) -> InterfaceStar {
    let velocity = solid.velocity + (solid.pressure - pressure) / solid.impedance;
    InterfaceStar { pressure, velocity, iterations: 0, floored: false }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Both halves of an exact problem between the two media give its star state back, compressed or torn.
    #[test]
    fn halves_of_a_star_state_agree_with_the_whole() {
        for (speed, pressure) in [(-200.0, 1e5), (-1.0, 5e7), (30.0, 5e7)] {
            let fluid = FluidTrace { pressure, velocity: speed, density: 1000.0, gamma: 7.15, pi: 3e8 };
            let solid = SolidTrace { pressure, velocity: 0.0, impedance: 7800.0 * 5990.0 };
            let star = exact_star(&fluid, &solid);
            let scale = fluid.impedance() * speed.abs();
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-11 * scale, "{a} {b}");
            close(fluid_at_moving_wall(&fluid, star.velocity).pressure, star.pressure);
            assert_relative_eq!(
                fluid_under_pressure(&fluid, star.pressure).velocity,
                star.velocity,
                max_relative = 1e-9
            );
            close(solid_moved(&solid, star.velocity).pressure, star.pressure);
            assert_relative_eq!(
                solid_under_pressure(&solid, star.pressure).velocity,
                star.velocity,
                max_relative = 1e-9
            );
        }
    }

    #[test]
    fn rest_stays_rest_to_the_last_bit() {
        let fluid = FluidTrace { pressure: 5e7, velocity: 0.0, density: 1000.0, gamma: 7.15, pi: 3e8 };
        let star = fluid_at_moving_wall(&fluid, 0.0);
        assert_eq!((star.pressure, star.velocity, star.floored), (5e7, 0.0, false));
        assert_eq!(fluid_under_pressure(&fluid, 5e7).velocity, 0.0);
    }

    #[test]
    fn a_wall_that_runs_away_tears_the_liquid() {
        let fluid = FluidTrace { pressure: 1e5, velocity: 0.0, density: 1000.0, gamma: 1.4, pi: 1e5 };
        let star = fluid_at_moving_wall(&fluid, -1e5);
        assert_eq!((star.pressure, star.velocity, star.floored), (-1e5, -1e5, true));
        assert!(fluid_under_pressure(&fluid, -2e5).floored);
    }
}
