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
    let wave = wave(side, star, [u_star, rho_star], offset);
    if xi <= wave.head {
        Sample { rho: side.rho, u: side.u, p: side.p, of_left: true, in_fan: false }
    } else if xi >= wave.tail {
        Sample { rho: rho_star, u: u_star, p: star.p, of_left: true, in_fan: false }
    } else {
        let gamma = side.gamma;
        let ahead = xi - wave.head;
        let (ln_c, faster) = if side.covolume == 0.0 {
            // Toro (2009) eq. 4.56: behind the head the sound speed falls by (gamma - 1)/(gamma + 1) of xi - head.
            let ln_c = (-(gamma - 1.0) / (gamma + 1.0) * ahead / side.sound_speed()).ln_1p();
            (ln_c, 2.0 / (gamma + 1.0) * ahead)
        } else {
            fan_with_covolume(side, ahead)
        };
        let base = side.p + side.pi;
        let exponent = 2.0 * gamma / (gamma - 1.0) * ln_c;
        let shifted = base * exponent.exp();
        let increment = base * exponent.exp_m1();
        // p from the head or from P: whichever sum has the smaller terms.
        let from_head = side.p.abs() + increment.abs() < shifted + side.pi;
        Sample {
            rho: if side.covolume == 0.0 {
                side.rho * (2.0 / (gamma - 1.0) * ln_c).exp()
            } else {
                let law = side.law();
                law.density_of_free(law.free_density(side.rho) * (2.0 / (gamma - 1.0) * ln_c).exp())
            },
            u: side.u + faster,
            p: if from_head { side.p + increment } else { shifted - side.pi },
            of_left: true,
            in_fan: true,
        }
    }
}

/// Inside the fan of a left wave: ln of the sound speed in the free volume over that at the head, and by how much the fluid is faster.
///
/// With x = c̃/c̃_K of the free volume u − u_K = 2c̃_K/(γ − 1) (1 − x) and c = x c̃_K (1 + bρ̃_K x^(2/(γ − 1))), of which u − c is
/// ξ. Newton's steps from the head, x = 1: F(x) = u − c − ξ falls with x and is concave, so they do not pass the root twice.
///
/// - `ahead`: ξ − (u_K − c_K) > 0, m/s.
fn fan_with_covolume(side: &Side, ahead: f64) -> (f64, f64) {
    const STEPS: usize = 50;
    let law = side.law();
    let free = law.free_share(side.rho);
    let (sound, power) = (side.sound_speed() * free, 2.0 / (side.gamma - 1.0));
    let bound = law.covolume * law.free_density(side.rho);
    let mut x = 1.0_f64;
    for _ in 0..STEPS {
        let taken = bound * x.powf(power);
        let excess = sound * (power * (1.0 - x) + (1.0 + bound) - x * (1.0 + taken)) - ahead;
        let slope = -sound * (power + 1.0 + taken * (1.0 + power));
        let next = (x - excess / slope).max(0.5 * x);
        let is_done = (next - x).abs() <= 2.0 * f64::EPSILON * x;
        x = next;
        if is_done {
            break;
        }
    }
    (x.ln(), sound * power * (1.0 - x))
}
