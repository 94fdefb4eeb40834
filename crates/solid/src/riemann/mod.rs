//! The exact Riemann solution of linear elasticity at a face, and its halves at a boundary.
//!
//! Across a face with normal n (z or r) the system splits into two pairs, each a pair of linear acoustics
//! ρ̄ ∂t v = ∂n σ, ∂t σ = ρ̄c² ∂n v: (v_n, σ_nn) with Z₁ = ρ̄c₁ and (v_t, σ_nt) with Z₂ = ρ̄c₂. Only these
//! four enter the fluxes of eq. (20); the hoop stress and the other normal stress jump at the face and stay
//! there.

#[cfg(test)]
mod eigen;

/// What the waves of an isotropic elastic material depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveSpeeds {
    /// Density ρ̄, kg/m³.
    pub density: f64,
    /// Speed of dilatational waves c₁, m/s.
    pub c1: f64,
    /// Speed of shear waves c₂ < c₁ √3/2, m/s.
    pub c2: f64,
}

impl WaveSpeeds {
    /// Impedance of dilatational waves Z₁ = ρ̄c₁, Pa s/m.
    #[inline]
    #[must_use]
    pub fn z1(self) -> f64 {
        self.density * self.c1
    }

    /// Impedance of shear waves Z₂ = ρ̄c₂, Pa s/m.
    #[inline]
    #[must_use]
    pub fn z2(self) -> f64 {
        self.density * self.c2
    }

    /// P-wave modulus λ + 2μ = ρ̄c₁², Pa.
    #[inline]
    #[must_use]
    pub fn p_modulus(self) -> f64 {
        self.density * self.c1 * self.c1
    }

    /// Shear modulus μ = ρ̄c₂², Pa.
    #[inline]
    #[must_use]
    pub fn shear_modulus(self) -> f64 {
        self.density * self.c2 * self.c2
    }

    /// Lamé's first parameter λ = ρ̄(c₁² − 2c₂²), Pa.
    #[inline]
    #[must_use]
    pub fn lambda(self) -> f64 {
        self.p_modulus() - 2.0 * self.shear_modulus()
    }

    /// α = λ/(λ + 2μ) = 1 − 2c₂²/c₁², the transverse stress per normal stress of a plane wave; paper: with
    /// eq. (20).
    #[inline]
    #[must_use]
    pub fn alpha(self) -> f64 {
        let ratio = self.c2 / self.c1;
        1.0 - 2.0 * ratio * ratio
    }
}

/// Velocities and tractions at a face: n is the axis across it, t the one along it.
///
/// At a z-face (v_z, σ_zz, v_r, σ_zr), at an r-face (v_r, σ_rr, v_z, σ_zr); all along the axes, never
/// outward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceState {
    /// Velocity along n, m/s.
    pub v_n: f64,
    /// Normal stress σ_nn, Pa, positive in tension.
    pub sigma_nn: f64,
    /// Velocity along t, m/s.
    pub v_t: f64,
    /// Shear stress σ_nt, Pa.
    pub sigma_nt: f64,
}

/// At which end of its axis a boundary lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outward {
    /// The solid lies above the boundary: z_min or r_min.
    Low,
    /// The solid lies below the boundary: z_max or r_max.
    High,
}

impl Outward {
    /// −1 or 1: the outward normal along the axis.
    #[inline]
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Low => -1.0,
            Self::High => 1.0,
        }
    }
}

/// One pair of linear acoustics: v* = ½(v_L + v_R) + (σ_R − σ_L)/2Z, σ* = ½(σ_L + σ_R) + ½Z(v_R − v_L).
#[inline(always)]
fn pair(v: [f64; 2], sigma: [f64; 2], z: f64) -> (f64, f64) {
    let [v_left, v_right] = v;
    let [sigma_left, sigma_right] = sigma;
    (
        // In rows of faces the quotient is the same for all of them.
        0.5 * (v_left + v_right) + (0.5 / z) * (sigma_right - sigma_left),
        0.5 * (sigma_left + sigma_right) + 0.5 * z * (v_right - v_left),
    )
}

/// The state on a face between two states of one material.
///
/// The exact solution of the linear Riemann problem at x/t = 0, which is Roe's; LeVeque (2002) sect. 22.5.
/// Paper: eqs. (19) and (20), corrected in scaling.
///
/// - `left`, `right`: states below and above the face along its normal, SI.
/// - `z1`, `z2`: impedances ρ̄c₁ and ρ̄c₂, Pa s/m.
/// - returns: the four quantities the flux needs. Equal states come back as they are, bitwise; mirrored
///   states give the mirrored result, bitwise.
/// - valid for: positive impedances.
/// - errors: none.
/// - tested by: the Roe solution from the eigenvectors in both directions, equal states, mirror symmetry.
#[inline(always)]
#[must_use]
pub fn star(left: FaceState, right: FaceState, z1: f64, z2: f64) -> FaceState {
    let (v_n, sigma_nn) = pair([left.v_n, right.v_n], [left.sigma_nn, right.sigma_nn], z1);
    let (v_t, sigma_nt) = pair([left.v_t, right.v_t], [left.sigma_nt, right.sigma_nt], z2);
    FaceState { v_n, sigma_nn, v_t, sigma_nt }
}

/// Velocity at a boundary whose traction is given: v* = v ± (σ* − σ)/Z along the outgoing characteristic.
#[inline(always)]
fn velocity_at(outward: Outward, v: f64, sigma: f64, sigma_star: f64, z: f64) -> f64 {
    v + outward.sign() * (sigma_star - sigma) / z
}

/// Stress at a boundary whose velocity is given: σ* = σ ± Z(v* − v) along the outgoing characteristic.
#[inline(always)]
fn stress_at(outward: Outward, v: f64, sigma: f64, v_star: f64, z: f64) -> f64 {
    sigma + outward.sign() * z * (v_star - v)
}

/// The state on a boundary of prescribed traction.
///
/// The outgoing characteristics of both pairs; LeVeque (2002) sect. 22.5. Paper: eqs. (19) and (20).
///
/// - `inner`: state of the solid at the boundary. `outward`: at which end it lies.
/// - `sigma_nn`, `sigma_nt`: the traction's components σ_nn* and σ_nt*, Pa (as stresses: not turned outward).
/// - `z1`, `z2`: impedances, Pa s/m.
/// - returns: the prescribed stresses and the velocities they cause.
/// - valid for: positive impedances.
/// - errors: none.
/// - tested by: against [`star`] with the outer state that has this traction, return of the inner state.
#[inline(always)]
#[must_use]
pub fn star_traction(
    inner: FaceState,
    outward: Outward,
    sigma_nn: f64,
    sigma_nt: f64,
    z1: f64,
    z2: f64,
) -> FaceState {
    FaceState {
        v_n: velocity_at(outward, inner.v_n, inner.sigma_nn, sigma_nn, z1),
        sigma_nn,
        v_t: velocity_at(outward, inner.v_t, inner.sigma_nt, sigma_nt, z2),
        sigma_nt,
    }
}

/// The state on a boundary free of traction.
///
/// [`star_traction`] with no stresses. Paper: none.
///
/// - `inner`, `outward`, `z1`, `z2`: as there.
/// - returns: σ_nn* = σ_nt* = 0 and the velocities.
/// - valid for: positive impedances.
/// - errors: none.
/// - tested by: against [`star`] with the state of opposite stresses outside.
#[inline(always)]
#[must_use]
pub fn star_free(inner: FaceState, outward: Outward, z1: f64, z2: f64) -> FaceState {
    star_traction(inner, outward, 0.0, 0.0, z1, z2)
}

/// The state on a boundary of prescribed velocity; at rest it is clamped.
///
/// The outgoing characteristics of both pairs; LeVeque (2002) sect. 22.5. Paper: eqs. (19) and (20).
///
/// - `inner`: state of the solid at the boundary. `outward`: at which end it lies.
/// - `v_n`, `v_t`: velocity of the boundary along the axes, m/s.
/// - `z1`, `z2`: impedances, Pa s/m.
/// - returns: the prescribed velocities and the stresses they cause.
/// - valid for: positive impedances.
/// - errors: none.
/// - tested by: against [`star`] with the state of opposite velocities outside, return of the inner state.
#[inline(always)]
#[must_use]
pub fn star_velocity(inner: FaceState, outward: Outward, v_n: f64, v_t: f64, z1: f64, z2: f64) -> FaceState {
    FaceState {
        v_n,
        sigma_nn: stress_at(outward, inner.v_n, inner.sigma_nn, v_n, z1),
        v_t,
        sigma_nt: stress_at(outward, inner.v_t, inner.sigma_nt, v_t, z2),
    }
}

/// The state on a plane of symmetry, which is also that on a rigid wall without friction, and on the axis.
///
/// v_n* = 0 and σ_nt* = 0, the rest along the outgoing characteristics. Paper: the axis of eq. (19).
///
/// - `inner`: state of the solid at the boundary. `outward`: at which end it lies.
/// - `z1`, `z2`: impedances, Pa s/m.
/// - returns: the four quantities the flux needs.
/// - valid for: positive impedances.
/// - errors: none.
/// - tested by: against [`star`] with the mirrored state outside.
#[inline(always)]
#[must_use]
pub fn star_symmetry(inner: FaceState, outward: Outward, z1: f64, z2: f64) -> FaceState {
    FaceState {
        v_n: 0.0,
        sigma_nn: stress_at(outward, inner.v_n, inner.sigma_nn, 0.0, z1),
        v_t: velocity_at(outward, inner.v_t, inner.sigma_nt, 0.0, z2),
        sigma_nt: 0.0,
    }
}

/// The state on the interface to the fluid.
///
/// v_n* and σ_nn* = −p* come from the Riemann problem between the two media; σ_nt* is what a viscous fluid drags the wall with, else 0,
/// and v_t* follows along the solid's own outgoing shear characteristic. Paper: conditions (22).
///
/// - `inner`: state of the solid at the interface. `outward`: at which end of the solid it lies.
/// - `v_n`, `sigma_nn`, `sigma_nt`: the star state, m/s and Pa. `z2`: impedance ρ̄c₂, Pa s/m.
/// - returns: the four quantities the flux needs.
/// - valid for: positive impedance.
/// - errors: none.
/// - tested by: equality with the traction boundary, return of the inner state.
#[inline(always)]
#[must_use]
pub fn star_interface(
    inner: FaceState,
    outward: Outward,
    v_n: f64,
    [sigma_nn, sigma_nt]: [f64; 2],
    z2: f64,
) -> FaceState {
    FaceState { v_n, sigma_nn, v_t: velocity_at(outward, inner.v_t, inner.sigma_nt, sigma_nt, z2), sigma_nt }
}

#[cfg(test)]
mod tests;
