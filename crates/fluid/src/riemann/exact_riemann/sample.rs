//! The exact solution along a ray.

use super::{Sample, Side, Star, wave};

/// The solution at the speed x/t = `xi`; `xi` = 0 is the state of the Godunov flux.
///
/// Toro (2009) sect. 4.5, in P = p + π. Paper: sect. 3.1.
///
/// - `left`, `right`, `star`: a Riemann problem and its star state. `xi`: speed, m/s.
/// - returns: density, velocity, pressure, whose fluid it is and whether inside a fan. In the vacuum between
///   two receding fluids density 0, velocity `xi`, pressure −min(π_L, π_R): at `xi` = 0 no mass and no energy
///   pass.
/// - valid for: as [`super::star_state`].
/// - errors: none.
/// - tested by: reference profiles, invariants through a fan, mirror symmetry.
#[must_use]
pub fn sample(left: &Side, right: &Side, star: &Star, xi: f64) -> Sample {
    let pi = left.pi.min(right.pi);
    if star.vacuum && xi >= star.u_left && xi <= star.u_right {
        return Sample { rho: 0.0, u: xi, p: star.p, of_left: xi < star.u, in_fan: false };
    }
    if xi < star.u {
        let at = sample_left(left, star, star.u_left, star.rho_left, left.pi - pi, xi);
        Sample { of_left: true, ..at }
    } else {
        let at = sample_left(&right.mirrored(), star, -star.u_right, star.rho_right, right.pi - pi, -xi);
        Sample { u: -at.u, of_left: false, ..at }
    }
}

/// The solution left of the contact.
#[inline]
fn sample_left(side: &Side, star: &Star, u_star: f64, rho_star: f64, offset: f64, xi: f64) -> Sample {
    let wave = wave(side, star, u_star, offset);
    if xi <= wave.head {
        Sample { rho: side.rho, u: side.u, p: side.p, of_left: true, in_fan: false }
    } else if xi >= wave.tail {
        Sample { rho: rho_star, u: u_star, p: star.p, of_left: true, in_fan: false }
    } else {
        // Toro (2009) eq. 4.56: behind the head the sound speed falls by (gamma - 1)/(gamma + 1) of xi -
        // head.
        let gamma = side.gamma;
        let ahead = xi - wave.head;
        let ln_c = (-(gamma - 1.0) / (gamma + 1.0) * ahead / side.sound_speed()).ln_1p();
        let base = side.p + side.pi;
        let exponent = 2.0 * gamma / (gamma - 1.0) * ln_c;
        let shifted = base * exponent.exp();
        let increment = base * exponent.exp_m1();
        // p from the head or from P: whichever sum has the smaller terms.
        let from_head = side.p.abs() + increment.abs() < shifted + side.pi;
        Sample {
            rho: side.rho * (2.0 / (gamma - 1.0) * ln_c).exp(),
            u: side.u + 2.0 / (gamma + 1.0) * ahead,
            p: if from_head { side.p + increment } else { shifted - side.pi },
            of_left: true,
            in_fan: true,
        }
    }
}
