//! The exact Riemann problem between two stiffened gases, with covolumes or without.
//!
//! In the free volume v − b a Noble–Abel stiffened gas is a stiffened gas, and the jumps v_K − v* of its waves are those of the free
//! volumes. So pressure and velocity of the star state are those of stiffened gases of the densities ρ/(1 − bρ), of which
//! this file speaks; densities and the speeds of waves, which cross the whole volume, follow.
//!
//! The star pressure is the zero of G(p) = f_L(p) + f_R(p) + u_R − u_L, of the wave curves f_K of `wave_curve.rs` in
//! P = p + min(π_L, π_R), which vanishes in the vacuum; `curve_root` finds it.

mod sample;

pub use sample::sample;

use crate::thermodynamics::noble_abel::NobleAbelStiffenedGas;
use crate::thermodynamics::wave_curve::{
    CurvePoint, VACUUM_PRESSURE, WaveCurve, curve_root, ln_pressure_ratio,
};

/// The state on one side of the initial jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Density ρ > 0, kg/m³.
    pub rho: f64,
    /// Velocity along the normal, m/s.
    pub u: f64,
    /// Pressure p > −π, Pa.
    pub p: f64,
    /// Adiabatic exponent γ > 1.
    pub gamma: f64,
    /// Stiffness π ≥ 0, Pa.
    pub pi: f64,
    /// Covolume b ≥ 0, m³/kg, with bρ < 1.
    pub covolume: f64,
}

impl Side {
    /// The equation of state.
    #[inline]
    #[must_use]
    pub fn law(&self) -> NobleAbelStiffenedGas {
        NobleAbelStiffenedGas { gamma: self.gamma, pi: self.pi, covolume: self.covolume, heat: None }
    }

    /// Density where that in the free volume has grown by the factor `squeezing`: 1 gives back the side's own, to the last bit.
    #[inline]
    fn density_of(&self, squeezing: f64) -> f64 {
        self.rho * (squeezing / (1.0 + (squeezing - 1.0) * (self.covolume * self.rho)))
    }

    /// The stiffened gas in the free volume.
    #[inline]
    fn free(&self) -> Self {
        Self { rho: self.law().free_density(self.rho), covolume: 0.0, ..*self }
    }

    /// Sound speed, m/s.
    #[inline]
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        self.law().sound_speed(self.rho, self.p)
    }

    /// The wave curve; in the free volume.
    #[inline]
    fn wave_curve(&self) -> WaveCurve {
        WaveCurve { pressure: self.p, gamma: self.gamma, pi: self.pi, sound_speed: self.sound_speed() }
    }

    /// The same state looked at from the other end: u changes sign.
    #[inline]
    fn mirrored(&self) -> Self {
        Self { u: -self.u, ..*self }
    }
}

/// The states between the two outer waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Pressure on both sides of the contact, Pa. In a vacuum −min(π_L, π_R).
    pub p: f64,
    /// Velocity of the contact, m/s. In a vacuum the mean of `u_left` and `u_right`.
    pub u: f64,
    /// Density left of the contact, kg/m³.
    pub rho_left: f64,
    /// Density right of the contact, kg/m³.
    pub rho_right: f64,
    /// Velocity of the left fluid at the contact: `u`, but in a vacuum that of its edge, m/s.
    pub u_left: f64,
    /// Velocity of the right fluid at the contact: `u`, but in a vacuum that of its edge, m/s.
    pub u_right: f64,
    /// P = p + min(π_L, π_R) in full relative precision, Pa.
    pub shifted: f64,
    /// Newton steps that it took.
    pub iterations: u32,
    /// The fluids part: no pressure above −min(π_L, π_R) holds them together.
    pub vacuum: bool,
}

/// What is found at one speed x/t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Density, kg/m³; 0 in a vacuum.
    pub rho: f64,
    /// Velocity, m/s; x/t in a vacuum.
    pub u: f64,
    /// Pressure, Pa; −min(π_L, π_R) in a vacuum.
    pub p: f64,
    /// Of which side the fluid is: true left of the contact, that is for x/t < u*.
    pub of_left: bool,
    /// Inside a rarefaction fan.
    pub in_fan: bool,
}

/// The speeds that bound an outer wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Speed of the edge at the undisturbed state, m/s.
    pub head: f64,
    /// Speed of the edge at the star state, m/s; that of the head if it is a shock.
    pub tail: f64,
    /// A shock, or a rarefaction (that of no strength included).
    pub shock: bool,
}

/// Density at pressure p on the wave curve of `side` in its free volume, kg/m³: Toro (2009) eqs. 4.50 and 4.53.
#[inline]
fn curve_density(side: &Side, p: f64, shifted: f64, offset: f64) -> f64 {
    side.rho * side.wave_curve().density_ratio(p, shifted + offset)
}

/// The star state of the Riemann problem between two stiffened gases, each with a covolume or without.
///
/// Toro (2009) ch. 4 in P = p + π; Menikoff & Plohr (1989); Saurel & Abgrall (1999); Le Métayer & Saurel (2016). Paper: sect.
/// 3.1, the exact solver of the Godunov flux. The iteration is `curve_root`'s.
///
/// - `left`, `right`: the two states, SI (rho kg/m³, u m/s, p and pi Pa).
/// - returns: pressure, velocity, both densities. Equal pressures and velocities come back as they are,
///   bitwise, whatever densities and gases meet; exchanging the sides with the sign of u gives the mirror
///   image, bitwise.
/// - valid for: rho > 0, gamma > 1, pi ≥ 0, p + pi > 0, bρ < 1 (debug-asserted), and any velocities. p may be
///   negative (tension). Otherwise NaN.
/// - errors: none. If the sides move apart faster than both can expand (G(−min π) ≥ 0), `vacuum` is set, p is
///   −min(π_L, π_R) and `u_left`, `u_right` are the speeds at which the fluids recede from each other there.
///   Of two different stiffnesses only the softer fluid's density vanishes: the stiffer one would bear more
///   tension.
/// - exactness: p to the round-off of the data, |δp| ≈ ε (|p| + |u|ρc + max |p_K|).
/// - cost: `iterations` evaluations of the curves and one more; 2.9 iterations on average over random states,
///   1 to 4 in common ones, 12 next to the vacuum of two different gases.
/// - tested by: reference star states, residual and mirror symmetry of random states, Rankine-Hugoniot
///   conditions, Galilean invariance, contacts bitwise, vacuum limit.
#[must_use]
pub fn star_state(left: &Side, right: &Side) -> Star {
    debug_assert!(left.rho > 0.0 && left.gamma > 1.0 && left.p + left.pi > 0.0, "{left:?}");
    debug_assert!(right.rho > 0.0 && right.gamma > 1.0 && right.p + right.pi > 0.0, "{right:?}");
    debug_assert!(left.covolume * left.rho < 1.0 && right.covolume * right.rho < 1.0, "{left:?} {right:?}");
    let free = [left.free(), right.free()];
    let star = free_star_state(&free[0], &free[1]);
    Star {
        rho_left: left.density_of(star.rho_left / free[0].rho),
        rho_right: right.density_of(star.rho_right / free[1].rho),
        ..star
    }
}

/// [`star_state`] in free volumes.
fn free_star_state(left: &Side, right: &Side) -> Star {
    let pi = left.pi.min(right.pi);
    let (offset_left, offset_right) = (left.pi - pi, right.pi - pi);
    let du = right.u - left.u;
    let (curve_left, curve_right) = (left.wave_curve(), right.wave_curve());

    // Only sides that part, or a tension the softer fluid cannot bear, may leave a vacuum.
    if du > 0.0 || left.p.min(right.p) <= -pi {
        let at_left = curve_left.at(VACUUM_PRESSURE - pi, VACUUM_PRESSURE, offset_left);
        let at_right = curve_right.at(VACUUM_PRESSURE - pi, VACUUM_PRESSURE, offset_right);
        if at_left.f + at_right.f + du >= 0.0 {
            let (u_left, u_right) = (left.u - at_left.f, right.u + at_right.f);
            return Star {
                p: -pi,
                u: 0.5 * (u_left + u_right),
                rho_left: curve_density(left, -pi, 0.0, offset_left),
                rho_right: curve_density(right, -pi, 0.0, offset_right),
                u_left,
                u_right,
                shifted: 0.0,
                iterations: 1,
                vacuum: true,
            };
        }
    }

    let root = curve_root(first_guess(left, right, du), pi, |p, shifted| {
        let at_left = curve_left.at(p, shifted, offset_left);
        let at_right = curve_right.at(p, shifted, offset_right);
        CurvePoint {
            f: at_left.f + at_right.f + du,
            slope: at_left.slope + at_right.slope,
            curvature: at_left.curvature + at_right.curvature,
        }
    });
    let (p, shifted) = (root.p, root.shifted);
    let u_left = left.u - curve_left.at(p, shifted, offset_left).f;
    let u_right = right.u + curve_right.at(p, shifted, offset_right).f;
    let u = 0.5 * (u_left + u_right);
    Star {
        p,
        u,
        rho_left: curve_density(left, p, shifted, offset_left),
        rho_right: curve_density(right, p, shifted, offset_right),
        u_left: u,
        u_right: u,
        shifted,
        iterations: root.iterations,
        vacuum: false,
    }
}

/// The acoustic star pressure if it is admissible, or else the lower of the pressures that is.
#[inline]
fn first_guess(left: &Side, right: &Side, du: f64) -> f64 {
    let (low, high) = if right.p < left.p { (right, left) } else { (left, right) };
    let z_low = low.rho * low.sound_speed();
    let z_high = high.rho * high.sound_speed();
    let floor = -left.pi.min(right.pi);
    // Linear solution (Toro 2009, sect. 9.3) in increments on the lower pressure: equal states return it.
    let acoustic = low.p + (z_low * (high.p - low.p) - (z_low * z_high) * du) / (z_low + z_high);
    let fallback = if low.p > floor { low.p } else { high.p };
    // Far below both states the tangent says nothing.
    if acoustic - floor > 0.1 * (fallback - floor) { acoustic } else { fallback }
}

/// Speeds of the left and the right wave.
///
/// Toro (2009) eqs. 4.52, 4.55 (left) and 4.59, 4.62 (right), in P = p + π.
///
/// - `left`, `right`, `star`: a Riemann problem and its star state.
/// - returns: the left and the right wave, m/s.
/// - valid for: as [`star_state`].
/// - errors: none.
/// - tested by: reference heads, tails and shock speeds.
#[must_use]
pub fn waves(left: &Side, right: &Side, star: &Star) -> [Wave; 2] {
    let pi = left.pi.min(right.pi);
    let towards_left = wave(left, star, [star.u_left, star.rho_left], left.pi - pi);
    // A right wave is a left wave seen from behind.
    let mirrored = wave(&right.mirrored(), star, [-star.u_right, star.rho_right], right.pi - pi);
    [towards_left, Wave { head: -mirrored.head, tail: -mirrored.tail, shock: mirrored.shock }]
}

/// The left wave of `side`, behind which the fluid moves at `u_star` and has the density `rho_star`.
#[inline]
fn wave(side: &Side, star: &Star, [u_star, rho_star]: [f64; 2], offset: f64) -> Wave {
    let c = side.sound_speed();
    let increment = star.p - side.p;
    let base = side.p + side.pi;
    let x = increment / base;
    if x > 0.0 {
        let speed = side.u - c * (1.0 + (side.gamma + 1.0) / (2.0 * side.gamma) * x).sqrt();
        Wave { head: speed, tail: speed, shock: true }
    } else {
        let m = (side.gamma - 1.0) / (2.0 * side.gamma);
        // The sound speed in the free volume goes with the pressure; c is that over the free share.
        let free = side.law().free_share(side.rho) / side.law().free_share(rho_star);
        let c_star = c * (m * ln_pressure_ratio(star.shifted + offset, increment, base)).exp() * free;
        Wave { head: side.u - c, tail: u_star - c_star, shock: false }
    }
}

#[cfg(test)]
pub(crate) mod tests;
