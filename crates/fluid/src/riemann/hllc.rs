//! The HLLC Riemann solver at one face.

use crate::Mixture;
use crate::riemann::low_mach::kept_of_jump;
use crate::state::PrimitiveCell;
use crate::state::primitive::PHI;

/// What one face passes on, per unit area. Normal velocity, pressure and gas fraction stand beside the
/// fluxes because the geometric source and the gas fraction's update need them by themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Mass flux, kg/(m² s).
    pub mass: f64,
    /// Normal velocity, m/s.
    pub velocity: f64,
    /// Pressure, Pa.
    pub pressure: f64,
    /// Flux of tangential momentum, Pa.
    pub shear: f64,
    /// Energy flux, W/m².
    pub energy: f64,
    /// Gas fraction of the fluid that crosses.
    pub phi: f64,
    /// ρ*/ρ: how much denser what crosses is on the face than on the side it comes from.
    pub compression: f64,
}

/// HLLC flux for two-phase flow with an advected gas fraction.
///
/// Toro, Spruce & Speares (1994); Toro (2009) eqs. 10.37–10.39 with wave speeds of Davis (1988),
/// s_L = min(u − c), s_R = max(u + c). Paper: fluxes (8). The star velocity is formed from the mean of both
/// sides plus a difference, so that equal velocities and pressures give exactly themselves and mirrored
/// states give exactly zero.
///
/// - `left`, `right`: (ρ kg/m³, u normal m/s, v tangential m/s, p Pa, φ) on the two sides of the face. Where a phase has a covolume
///   they are of one phase, whose part of the mass is φ.
/// - returns: the [`Face`] per unit area.
/// - valid for: ρ > 0 and ρc² > 0 on both sides, otherwise not finite. errors: none.
/// - exact for isolated contacts; tested by: consistency, mirror symmetry, supersonic upwinding, contact at rest.
#[inline(always)]
pub fn flux_hllc(left: PrimitiveCell, right: PrimitiveCell, mixture: &Mixture) -> Face {
    flux_and_roots::<true, false>(left, right, [left[PHI], right[PHI]], mixture).0
}

/// [`flux_hllc`] for flow that is slow against sound.
///
/// The star pressure has less from the jump of the velocity, see `riemann/low_mach.rs`: at most half of the pressure's own jump, but
/// where streams meet.
///
/// - all else: as [`flux_hllc`]. tested by: waves, walls and shocks, which have that one's flux bitwise; slow flow.
#[inline(always)]
pub fn flux_hllc_low_mach(left: PrimitiveCell, right: PrimitiveCell, mixture: &Mixture) -> Face {
    flux_and_roots::<true, true>(left, right, [left[PHI], right[PHI]], mixture).0
}

/// [`flux_hllc`], or [`flux_hllc_low_mach`], and whether both sides have a sound speed; one that has none counts as if it were 0.
/// Of what has no density either, as beyond the corners of a block, that is not said.
///
/// - `B`: whether there may be a covolume; `shares`: the gas's part of the mass on both sides, without a say if not.
#[inline(always)]
pub(crate) fn flux_and_roots<const B: bool, const LOW_MACH: bool>(
    left: PrimitiveCell,
    right: PrimitiveCell,
    shares: [f64; 2],
    mixture: &Mixture,
) -> (Face, bool) {
    let (waves, has_roots) = Waves::between::<B, LOW_MACH>(left, right, shares, mixture);
    (waves.flux::<B>(left, right, shares, mixture), has_roots)
}

/// The waves between two states: the first half of the solver. Kernels make it of many faces before they make the second one of any, so that
/// no face waits for its own divisions and roots.
#[derive(Clone, Copy)]
pub(crate) struct Waves {
    /// Speeds of the outer waves, m/s.
    pub s_l: f64,
    pub s_r: f64,
    /// Star velocity, m/s, and pressure, Pa.
    pub s_m: f64,
    pub p_star: f64,
}

impl Waves {
    /// The waves, and whether both sides have a sound speed, see [`flux_and_roots`].
    #[inline(always)]
    pub fn between<const B: bool, const LOW_MACH: bool>(
        [rho_l, u_l, _, p_l, phi_l]: PrimitiveCell,
        [rho_r, u_r, _, p_r, phi_r]: PrimitiveCell,
        [share_l, share_r]: [f64; 2],
        mixture: &Mixture,
    ) -> (Self, bool) {
        // c² = ((1 + β₁) p + β₂)/(β₁ρ), below the line with β₁ of the free volume: one division serves both sides, and two square
        // roots wait for it.
        let law = |rho: f64, p: f64, phi: f64, share: f64| {
            let beta1 = mixture.beta1(phi);
            let [free, _] = mixture.free_betas::<B>(phi, rho, rho * share);
            ((1.0 + beta1) * p + mixture.beta2(phi), free * rho)
        };
        let (over_l, under_l) = law(rho_l, p_l, phi_l, share_l);
        let (over_r, under_r) = law(rho_r, p_r, phi_r, share_r);
        let inverse = 1.0 / (under_l * under_r);
        let root = |squared: f64| (if squared > 0.0 { squared } else { 0.0 }).sqrt();
        let (squared_l, squared_r) = ((over_l * under_r) * inverse, (over_r * under_l) * inverse);
        let (c_l, c_r) = (root(squared_l), root(squared_r));
        let s_l = smaller(u_l - c_l, u_r - c_r);
        let s_r = larger(u_l + c_l, u_r + c_r);
        // Mass swept by the outer waves: m_l < 0 < m_r.
        let (m_l, m_r) = (rho_l * (s_l - u_l), rho_r * (s_r - u_r));
        let mean = 0.5 * (u_l + u_r);
        let half_jump = 0.5 * (u_l - u_r);
        let s_m = mean + ((p_r - p_l) + half_jump * (m_l + m_r)) / (m_l - m_r);
        let mut p_star = 0.5 * ((p_l + m_l * (s_m - u_l)) + (p_r + m_r * (s_m - u_r)));
        if LOW_MACH {
            let jump = 2.0 * (m_l * m_r) / (m_l - m_r) * half_jump;
            let whole = 2.0 * jump.abs();
            let kept = kept_of_jump(whole, (p_r - p_l).abs(), 2.0 * half_jump.abs(), u_l.abs() + u_r.abs());
            let lost = 0.5 * (whole - kept);
            p_star -= if jump > 0.0 { lost } else { -lost };
        }
        let are_dense = (rho_l > 0.0) & (rho_r > 0.0);
        (Self { s_l, s_r, s_m, p_star }, !are_dense | ((squared_l > 0.0) & (squared_r > 0.0)))
    }

    /// The flux between the waves: the second half.
    ///
    /// - arguments: those that the waves were made of.
    #[inline(always)]
    pub fn flux<const B: bool>(
        self,
        [rho_l, u_l, v_l, p_l, phi_l]: PrimitiveCell,
        [rho_r, u_r, v_r, p_r, phi_r]: PrimitiveCell,
        [share_l, share_r]: [f64; 2],
        mixture: &Mixture,
    ) -> Face {
        let Self { s_l, s_r, s_m, p_star } = self;
        let from_left = s_m >= 0.0;
        let pick = |l: f64, r: f64| if from_left { l } else { r };
        let (rho, u, v, p, phi) =
            (pick(rho_l, rho_r), pick(u_l, u_r), pick(v_l, v_r), pick(p_l, p_r), pick(phi_l, phi_r));
        let s = pick(s_l, s_r);
        let supersonic = if from_left { s_l >= 0.0 } else { s_r <= 0.0 };

        let [beta1, beta2] = mixture.free_betas::<B>(phi, rho, rho * pick(share_l, share_r));
        let energy = beta1 * p + beta2 + 0.5 * rho * (u * u + v * v);
        let inverse = 1.0 / (s - s_m);
        let compression = (s - u) * inverse;
        let energy_star = compression * (energy + (s_m - u) * (rho * s_m)) + (s_m - u) * p * inverse;

        let velocity = if supersonic { u } else { s_m };
        let pressure = if supersonic { p } else { p_star };
        let density = if supersonic { rho } else { rho * compression };
        let total = if supersonic { energy } else { energy_star };
        let compression = if supersonic { 1.0 } else { compression };
        let mass = density * velocity;
        Face {
            mass,
            velocity,
            pressure,
            shear: mass * v,
            energy: velocity * (total + pressure),
            phi,
            compression,
        }
    }
}

/// By comparison, without the NaN rules of `f64::min`, so that a row of faces vectorises.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::primitive::{PRESSURE, RHO, V_N, V_T};

    fn physical(w: PrimitiveCell) -> Face {
        let [rho, u, v, p, phi] = w;
        let m = Mixture::water_and_air();
        let energy = m.beta1(phi) * p + m.beta2(phi) + 0.5 * rho * (u * u + v * v);
        Face {
            mass: rho * u,
            velocity: u,
            pressure: p,
            shear: rho * u * v,
            energy: u * (energy + p),
            phi,
            compression: 1.0,
        }
    }

    #[test]
    fn equal_states_give_the_physical_flux() {
        for u in [-2000.0, -3.0, 0.0, 200.0, 2000.0] {
            let w = [1000.0, u, 7.0, 5e6, 0.2];
            let (got, want) = (flux_hllc(w, w, &Mixture::water_and_air()), physical(w));
            assert_eq!((got.velocity, got.pressure, got.phi), (want.velocity, want.pressure, want.phi));
            approx::assert_relative_eq!(got.mass, want.mass, max_relative = 1e-15);
            approx::assert_relative_eq!(got.energy, want.energy, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_contact_at_rest_stays_at_rest() {
        let face =
            flux_hllc([1000.0, 0.0, 1.0, 1e5, 0.0], [1.2, 0.0, 4.0, 1e5, 1.0], &Mixture::water_and_air());
        assert_eq!((face.mass, face.velocity, face.pressure, face.energy), (0.0, 0.0, 1e5, 0.0));
    }

    #[test]
    fn uniform_pressure_and_velocity_pass_a_contact_exactly() {
        for u in [200.0, -200.0] {
            let (l, r) = ([1000.0, u, 0.0, 1e5, 0.0], [1.2, u, 0.0, 1e5, 1.0]);
            let face = flux_hllc(l, r, &Mixture::water_and_air());
            assert_eq!((face.velocity, face.pressure), (u, 1e5));
            let want = physical(if u > 0.0 { l } else { r });
            approx::assert_relative_eq!(face.energy, want.energy, max_relative = 1e-15);
        }
    }

    #[test]
    fn mirrored_states_give_the_mirrored_flux_bitwise() {
        let (l, r) = ([998.0, 13.0, 5.0, 3e6, 0.01], [700.0, -41.0, 2.0, 8e5, 0.4]);
        let mirror = |w: PrimitiveCell| [w[RHO], -w[V_N], w[V_T], w[PRESSURE], w[PHI]];
        let (a, b) = (
            flux_hllc(l, r, &Mixture::water_and_air()),
            flux_hllc(mirror(r), mirror(l), &Mixture::water_and_air()),
        );
        assert_eq!((a.mass, a.velocity, a.energy, a.shear), (-b.mass, -b.velocity, -b.energy, -b.shear));
        assert_eq!((a.pressure, a.phi), (b.pressure, b.phi));
        let wall = flux_hllc(l, mirror(l), &Mixture::water_and_air());
        assert_eq!((wall.mass, wall.velocity, wall.energy), (0.0, 0.0, 0.0));
        assert!(wall.pressure > l[PRESSURE]);
    }

    #[test]
    fn a_side_without_a_sound_speed_is_told() {
        let (state, no_state) = ([1000.0, 1.0, 0.0, 1e5, 0.0], [1000.0, 1.0, 0.0, -3.1e8, 0.0]);
        for (left, right, is) in [(state, state, true), (no_state, state, false), (state, no_state, false)] {
            let (face, has_roots) =
                flux_and_roots::<false, false>(left, right, [0.0; 2], &Mixture::water_and_air());
            assert_eq!(has_roots, is);
            assert!(face.energy.is_finite(), "{face:?}");
        }
    }

    #[test]
    fn supersonic_flow_is_upwind() {
        let (l, r) = ([1.2, 900.0, 1.0, 1e5, 1.0], [1.0, 950.0, 2.0, 0.9e5, 1.0]);
        assert_eq!(flux_hllc(l, r, &Mixture::water_and_air()), physical(l));
    }
}
