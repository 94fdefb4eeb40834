//! The states on the faces of a mixed cell.

use mesh::Limiter;

use super::closure::{Compression, PURE, is_mixed};
use super::thinc::Step;
use crate::Mixture;
use crate::options::TwoPhaseOptions;

/// ρ_g, ρ_l, v_z, v_r, p, φ.
type Phases = [f64; 6];

const V_Z: usize = 2;
const V_R: usize = 3;
const PRESSURE: usize = 4;
const PHI: usize = 5;

/// A state on a face: ρ, v_z, v_r, p, φ and the gas's part of the mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FaceState {
    pub w: [f64; 5],
    /// m_g/ρ.
    pub gas_share: f64,
}

/// The cells of a padded block: ρ, v_z, v_r, p, φ, m_g.
#[derive(Clone, Copy)]
pub(crate) struct Cells<'a> {
    pub rows: [&'a [f64]; 6],
    /// Distance between cells that neighbour each other along r.
    pub stride: usize,
}

impl Cells<'_> {
    /// The cell's own state, as a face of a cell at first order has it.
    pub fn mean(&self, k: usize) -> FaceState {
        let w = [0, 1, 2, 3, 4].map(|c: usize| self.rows[c][k]);
        FaceState { w, gas_share: self.rows[5][k] / w[0] }
    }

    /// Whether a cell is mixed, or pure beside one of the other phase.
    pub fn is_at_interface(&self, k: usize) -> bool {
        let phi = self.rows[4];
        let is_other = |other: usize| (phi[other] - phi[k]).abs() > 0.5;
        is_mixed(phi[k]) || [k - 1, k + 1, k - self.stride, k + self.stride].into_iter().any(is_other)
    }

    /// The cell by phases; one that is as good as absent has the density `else_densities`.
    fn phases(&self, k: usize, else_densities: [f64; 2]) -> Phases {
        let [rho, v_z, v_r, p, phi, gas] = self.rows.map(|row| row[k]);
        // A phase's mass may lie below zero by what prediction may take the gas fraction below.
        let rho_g = if phi > PURE { gas.max(0.0) / phi } else { else_densities[0] };
        let rho_l = if 1.0 - phi > PURE { (rho - gas).max(0.0) / (1.0 - phi) } else { else_densities[1] };
        [rho_g, rho_l, v_z, v_r, p, phi]
    }
}

/// What the reconstruction needs to know of the block and the step.
#[derive(Clone, Copy)]
pub(crate) struct Stencil<'a> {
    pub limiter: Limiter,
    pub inverse_h: [f64; 2],
    pub inverse_r: &'a [f64],
    pub dt: f64,
    pub mixture: &'a Mixture,
    pub options: TwoPhaseOptions,
}

/// States on the four faces of mixed cell `k`, in the order of [`mesh::Side::ALL`]: z−, z+, r−, r+.
///
/// MUSCL-Hancock on phase densities, velocities, pressure and gas fraction, with the predictor
///
/// ρ_k,t = −v·∇ρ_k − ρ_k (K/K_k) ∇·v,  p_t = −v·∇p − K ∇·v,  φ_t = −v·∇φ + (1 − φ)(1 − K/K_l) ∇·v
///
/// and the momentum's of [`crate::rows::rates`]. Phase densities are flat across an interface where partial ones are not. Where
/// THINC finds a step, the gas fraction is its mean over what crosses the face and the phase densities are the cell's.
pub(crate) fn face_states(cells: &Cells<'_>, k: usize, stencil: &Stencil<'_>) -> [FaceState; 4] {
    let w = cells.phases(k, [0.0; 2]);
    let neighbour = |at: usize| cells.phases(at, [w[0], w[1]]);
    let around = [[k - 1, k + 1], [k - cells.stride, k + cells.stride]].map(|pair| pair.map(neighbour));
    let limited = |[below, above]: [Phases; 2]| -> Phases {
        std::array::from_fn(|c| stencil.limiter.difference(w[c] - below[c], above[c] - w[c]))
    };
    let mut differences = around.map(limited);
    let mut half = half_step(w, differences, stencil.inverse_r[k], stencil);
    let share = kept_share(cells, k, stencil);
    if share < 1.0 {
        differences = differences.map(|axis| axis.map(|d| share * d));
        half = std::array::from_fn(|c| w[c] + share * (half[c] - w[c]));
    }
    let normal = normal(around, stencil.inverse_h);
    let mut states = [FaceState::default(); 4];
    for axis in 0..2 {
        let step = if stencil.options.is_sharp {
            let [below, above] = around[axis];
            Step::through(below[PHI], w[PHI], above[PHI], normal[axis])
        } else {
            None
        };
        let courant = w[V_Z + axis] * stencil.dt * stencil.inverse_h[axis];
        for (end, sign) in [-0.5, 0.5].into_iter().enumerate() {
            let mut face: Phases = std::array::from_fn(|c| half[c] + sign * differences[axis][c]);
            if let Some(step) = step {
                face[PHI] = if end == 0 { step.lower(courant) } else { step.upper(courant) };
                [face[0], face[1]] = [w[0], w[1]];
            }
            states[2 * axis + end] = admissible(face, &w);
        }
    }
    states
}

fn half_step(w: Phases, differences: [Phases; 2], inverse_r: f64, stencil: &Stencil<'_>) -> Phases {
    let [d_z, d_r] = [0, 1].map(|axis: usize| differences[axis].map(|d| d * stencil.inverse_h[axis]));
    let phi = w[PHI];
    let compression = Compression::at(w[PRESSURE], phi, stencil.mixture, stencil.options.has_closure);
    let rho = phi * w[0] + (1.0 - phi) * w[1];
    let divergence = d_z[V_Z] + d_r[V_R] + w[V_R] * inverse_r;
    let source = [
        -w[0] * compression.gas * divergence,
        -w[1] * compression.liquid * divergence,
        -d_z[PRESSURE] / rho,
        -d_r[PRESSURE] / rho,
        -compression.modulus * divergence,
        compression.expansion(phi) * divergence,
    ];
    std::array::from_fn(|c| w[c] + 0.5 * stencil.dt * (source[c] - (w[V_Z] * d_z[c] + w[V_R] * d_r[c])))
}

/// The share of its slopes that a cell keeps. Without the closure a mixed cell is nearly as stiff as liquid, and face
/// states of gas would let round-off grow, see [`crate::rows::half_step`]; with it the cell gives way.
fn kept_share(cells: &Cells<'_>, k: usize, stencil: &Stencil<'_>) -> f64 {
    if stencil.options.has_closure {
        return 1.0;
    }
    let [w, west, east, south, north] =
        [k, k - 1, k + 1, k - cells.stride, k + cells.stride].map(|k| cells.mean(k).w);
    let limited = |below: [f64; 5], above: [f64; 5]| -> [f64; 5] {
        std::array::from_fn(|c| stencil.limiter.difference(w[c] - below[c], above[c] - w[c]))
    };
    let (s_z, s_r) = (limited(west, east), limited(south, north));
    let half_dt = 0.5 * stencil.dt;
    let (_, share) = crate::rows::half_step(
        w,
        s_z,
        s_r,
        stencil.inverse_h,
        stencil.inverse_r[k],
        half_dt,
        stencil.mixture,
    );
    share
}

/// The unit normal ∇φ/|∇φ| from central differences; NaN where φ is uniform.
fn normal([[west, east], [south, north]]: [[Phases; 2]; 2], inverse_h: [f64; 2]) -> [f64; 2] {
    let gradient = [(east[PHI] - west[PHI]) * inverse_h[0], (north[PHI] - south[PHI]) * inverse_h[1]];
    let size = gradient[0].hypot(gradient[1]);
    gradient.map(|d| d / size)
}

/// Bounds of what a face may have relative to its cell: phase densities within a factor of five, a tenth of the pressure.
const DENSITIES: [f64; 2] = [0.2, 5.0];
const LEAST_PRESSURE: f64 = 0.1;

fn admissible([rho_g, rho_l, v_z, v_r, p, phi]: Phases, w: &Phases) -> FaceState {
    let within = |rho: f64, own: f64| rho.max(DENSITIES[0] * own).min(DENSITIES[1] * own);
    let phi = phi.clamp(0.0, 1.0);
    let p = if w[PRESSURE] > 0.0 { p.max(LEAST_PRESSURE * w[PRESSURE]) } else { p };
    let gas = phi * within(rho_g, w[0]);
    let rho = gas + (1.0 - phi) * within(rho_l, w[1]);
    FaceState { w: [rho, v_z, v_r, p, phi], gas_share: gas / rho }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StiffenedGas;

    const STRIDE: usize = 5;

    fn rows(cell: impl Fn(f64, f64) -> [f64; 6]) -> [Vec<f64>; 6] {
        let at = |k: usize| cell((k % STRIDE) as f64 - 2.0, (k / STRIDE) as f64 - 2.0);
        std::array::from_fn(|c| (0..STRIDE * STRIDE).map(|k| at(k)[c]).collect())
    }

    fn states(rows: &[Vec<f64>; 6], options: TwoPhaseOptions, dt: f64) -> [FaceState; 4] {
        let mixture =
            Mixture::new(StiffenedGas { gamma: 7.15, pi: 3e8 }, StiffenedGas { gamma: 1.4, pi: 0.0 });
        let inverse_r = [0.0; STRIDE * STRIDE];
        let cells = Cells { rows: rows.each_ref().map(|row| &row[..]), stride: STRIDE };
        let stencil = Stencil {
            limiter: Limiter::Mc,
            inverse_h: [1e4, 1e4],
            inverse_r: &inverse_r,
            dt,
            mixture: &mixture,
            options,
        };
        face_states(&cells, 2 * STRIDE + 2, &stencil)
    }

    /// Gas on the left of water at one pressure and velocity, with a mixed cell in between.
    fn contact(z: f64, _: f64) -> [f64; 6] {
        let phi = if z < 0.0 {
            1.0
        } else if z == 0.0 {
            0.4
        } else {
            0.0
        };
        [phi * 1.2 + (1.0 - phi) * 1000.0, 200.0, 3.0, 1e5, phi, phi * 1.2]
    }

    #[test]
    fn at_uniform_pressure_and_velocity_only_the_gas_fraction_differs() {
        for is_sharp in [true, false] {
            let options = TwoPhaseOptions { has_closure: true, is_sharp };
            for state in states(&rows(contact), options, 1e-7) {
                let [rho, v_z, v_r, p, phi] = state.w;
                assert_eq!((v_z, v_r), (200.0, 3.0));
                approx::assert_relative_eq!(p, 1e5, max_relative = 1e-14);
                approx::assert_relative_eq!(rho, phi * 1.2 + (1.0 - phi) * 1000.0, max_relative = 1e-13);
                approx::assert_relative_eq!(state.gas_share, phi * 1.2 / rho, max_relative = 1e-13);
            }
        }
    }

    #[test]
    fn thinc_is_steeper_than_the_limiter() {
        let of = |is_sharp| states(&rows(contact), TwoPhaseOptions { has_closure: true, is_sharp }, 1e-12);
        let (sharp, smooth) = (of(true), of(false));
        assert!(sharp[0].w[4] > smooth[0].w[4] && sharp[1].w[4] < smooth[1].w[4], "{sharp:?} {smooth:?}");
        // Along the interface there is nothing to sharpen.
        for state in [sharp[2], sharp[3]] {
            approx::assert_relative_eq!(state.w[4], 0.4, max_relative = 1e-5);
        }
    }

    #[test]
    fn compression_goes_into_the_gas() {
        let squeezed = |z: f64, r: f64| {
            let mut cell = contact(0.0, r);
            cell[1] = -10.0 * z;
            cell
        };
        let options = TwoPhaseOptions { has_closure: true, is_sharp: false };
        let dt = 1e-9;
        let state = states(&rows(squeezed), options, dt)[2];
        // ∇·v = −1e5/s: the gas takes nearly all of it, φ̇ ≈ ∇·v (1 − φ) and ṗ = γ p/φ · 1e5.
        approx::assert_relative_eq!(state.w[4] - 0.4, -0.6 * 1e5 * 0.5 * dt, max_relative = 1e-3);
        approx::assert_relative_eq!(state.w[3] - 1e5, 1.4e5 / 0.4 * 1e5 * 0.5 * dt, max_relative = 1e-3);
        let frozen = states(&rows(squeezed), TwoPhaseOptions { has_closure: false, is_sharp: false }, dt)[2];
        assert_eq!(frozen.w[4], 0.4);
        assert!(frozen.w[3] - 1e5 > 100.0 * (state.w[3] - 1e5));
    }
}
