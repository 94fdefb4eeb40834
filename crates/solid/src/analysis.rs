//! What multiresolution analysis must know of a solid: which details matter, how fields meet the sides.

use mesh::{ComponentsOfCell, MOST_COMPONENTS, Multiresolution, Side};

use crate::Boundary;
use crate::boundary::mirrored;
use crate::components::PLASTIC_STRAIN;
use crate::state::component::{S_NORMAL, S_ZR, V_R, V_Z};

/// The solid's part in multiresolution analysis.
#[derive(Clone, Debug)]
pub struct Analysis {
    pub(crate) boundaries: [Boundary; 4],
    /// Reference value of the stresses, Pa.
    pub(crate) stress_scale: f64,
    /// ρ̄c₁, with which velocities count as stresses, and ρ̄c₂, Pa s/m.
    pub(crate) impedances: [f64; 2],
    /// What details of plastic strain count as stresses, Pa; 0 where nothing can yield.
    pub(crate) strain_modulus: f64,
    /// The only direction (z, r) in which waves count, if there is one.
    pub(crate) direction: Option<[f64; 2]>,
}

impl Multiresolution for Analysis {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        match self.boundaries[side as usize] {
            Boundary::Periodic => None,
            kind => mirrored(kind, side, component),
        }
    }

    fn counts_beside(&self, side: Side) -> bool {
        self.boundaries[side as usize] != Boundary::NonReflecting
    }

    fn towards(&self, direction: [f64; 2]) -> Option<Self> {
        Some(Self { direction: Some(direction), ..self.clone() })
    }

    /// All states are admissible: ghosts beyond level jumps may lie outside the yield surface, as the states at mid-step are
    /// returned. Of cells that stay see [`crate::components::admissible::Admissible`].
    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    /// The largest of |δσ|/σ_ref over the stresses, ρ̄c₁|δv|/σ_ref, and 3μ|δε_p|/σ_ref.
    ///
    /// Where only waves in the direction n count, with t across it: ½|n·δσ·n − ρ̄c₁ n·δv|/σ_ref and ½|t·δσ·n − ρ̄c₂ t·δv|/σ_ref
    /// instead of stresses and velocities, the Riemann invariants that longitudinal and shear waves along n change and those
    /// against it do not.
    #[inline(always)]
    fn significance(&self, _: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        let strain = self.strain_modulus * detail[PLASTIC_STRAIN].abs();
        let [longitudinal, shear] = self.impedances;
        let Some([n_z, n_r]) = self.direction else {
            let velocity = longitudinal * detail[0].abs().max(detail[1].abs());
            let slow = velocity.max(strain);
            return detail[2..6].iter().fold(slow, |largest, stress| stress.abs().max(largest))
                / self.stress_scale;
        };
        let [v_z, v_r] = [detail[V_Z], detail[V_R]];
        let [zz, rr] = S_NORMAL.map(|component| detail[component]);
        let [traction_z, traction_r] = [zz * n_z + detail[S_ZR] * n_r, detail[S_ZR] * n_z + rr * n_r];
        let along = traction_z * n_z + traction_r * n_r - longitudinal * (v_z * n_z + v_r * n_r);
        let across = traction_r * n_z - traction_z * n_r - shear * (v_r * n_z - v_z * n_r);
        (0.5 * along.abs().max(across.abs())).max(strain) / self.stress_scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WaveSpeeds;

    const NOTHING: ComponentsOfCell = [0.0; MOST_COMPONENTS];
    const SPEEDS: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };

    /// A plane wave of this traction (Pa) that runs along `to`: longitudinal, or of shear across it.
    fn wave(to: [f64; 2], is_shear: bool, traction: f64) -> [f64; MOST_COMPONENTS] {
        let [z, r] = to;
        let mut detail = [0.0; MOST_COMPONENTS];
        if is_shear {
            // v across, σ·n = traction t.
            (detail[V_Z], detail[V_R]) = (r * traction / SPEEDS.z2(), -z * traction / SPEEDS.z2());
            detail[S_NORMAL[0]] = -2.0 * z * r * traction;
            detail[S_NORMAL[1]] = 2.0 * z * r * traction;
            detail[S_ZR] = (z * z - r * r) * traction;
        } else {
            (detail[V_Z], detail[V_R]) = (-z * traction / SPEEDS.z1(), -r * traction / SPEEDS.z1());
            let across = traction * (1.0 - 2.0 * (SPEEDS.c2 / SPEEDS.c1).powi(2));
            detail[S_NORMAL[0]] = traction * z * z + across * r * r;
            detail[S_NORMAL[1]] = traction * r * r + across * z * z;
            detail[S_ZR] = (traction - across) * z * r;
        }
        detail
    }

    #[test]
    fn towards_a_region_only_waves_count_that_run_there() {
        let all = Analysis {
            boundaries: [Boundary::Free; 4],
            stress_scale: 1e8,
            impedances: [SPEEDS.z1(), SPEEDS.z2()],
            strain_modulus: 3.0 * SPEEDS.shear_modulus(),
            direction: None,
        };
        let direction = [0.6, -0.8];
        let directed = all.towards(direction).expect("it has directions");
        for is_shear in [false, true] {
            let size = |to: [f64; 2], rule: &Analysis| rule.significance(&NOTHING, &wave(to, is_shear, 1e6));
            approx::assert_relative_eq!(size(direction, &directed), 1e-2, max_relative = 1e-12);
            approx::assert_abs_diff_eq!(size([-0.6, 0.8], &directed), 0.0, epsilon = 1e-15);
            assert!(size([-0.6, 0.8], &all) > 5e-3);
            // Across it both kinds count: half of them runs there, as far as one can say.
            assert!(size([0.8, 0.6], &directed) > 1e-3);
        }
        let mut strained = [0.0; MOST_COMPONENTS];
        strained[PLASTIC_STRAIN] = 1e-4;
        assert_eq!(directed.significance(&NOTHING, &strained), all.significance(&NOTHING, &strained));
    }
}
