//! The states on the faces of a mixed cell.

use mesh::Limiter;

use super::cells::Cells;
use super::closure::{Compression, PURE};
use super::face_states::{Bounded, FaceStates};
use super::thinc;
use super::traces::closed;
use super::windows::{LANES, Lane, Window, bits, lanes};
use crate::Mixture;
use crate::options::TwoPhaseOptions;
use crate::state::{PrimitiveCell, primitive};
use crate::step::rows::Prediction;

/// ρ_g, ρ_l, v_z, v_r, p, φ of the cells.
type Phases = [Lane; 6];

const RHO_G: usize = 0;
const RHO_L: usize = 1;
const V_Z: usize = 2;
const V_R: usize = 3;
const PRESSURE: usize = 4;
const PHI: usize = 5;

const ZERO: Phases = [[0.0; LANES]; 6];

/// What the reconstruction needs to know of the block and the step.
#[derive(Clone, Copy)]
pub(crate) struct CellRule<'a> {
    pub limiter: Limiter,
    pub inverse_h: [f64; 2],
    pub inverse_r: &'a [f64],
    pub dt: f64,
    pub mixture: &'a Mixture,
    pub options: TwoPhaseOptions,
    /// Whether jumps of the velocity on their faces are bounded, see [`crate::riemann::low_mach::kept_of_jump`].
    pub is_low_mach: bool,
    /// What v_z and v_r gain in half the step by a uniform acceleration, m/s.
    pub velocity_gain: Option<[f64; 2]>,
    /// How much higher the pressure is above the faces along z and r than below by surface tension, Pa.
    pub jumps: Option<[&'a [f64]; 2]>,
    /// By how much the pressure of the cells' gas exceeds that of the cells by surface tension, Pa.
    pub excess: Option<&'a [f64]>,
}

impl CellRule<'_> {
    /// What the pressure of the gas in some cells is, by which it gives way, Pa.
    ///
    /// The liquid is so stiff that it does not matter which of the two pressures it has.
    #[inline(always)]
    pub fn of_gas(&self, at: Window, pressure: &Lane) -> Lane {
        let mut of_gas = *pressure;
        if let Some(excess) = self.excess {
            let excess = at.load(excess, 0);
            of_gas.iter_mut().zip(excess).for_each(|(p, excess)| *p += excess);
        }
        of_gas
    }
}

/// States on the four faces of mixed cells, in the order of [`mesh::Side::ALL`]: z−, z+, r−, r+.
///
/// MUSCL-Hancock on phase densities, velocities, pressure and gas fraction, with the predictor
///
/// ρ_k,t = −v·∇ρ_k − ρ_k (K/K_k) ∇·v,  p_t = −v·∇p − K ∇·v,  φ_t = −v·∇φ + (1 − φ)(1 − K/K_l) ∇·v
///
/// and the momentum's of [`crate::step::rows::rates`]. Phase densities are flat across an interface where partial ones are not. Where
/// THINC finds a step, the gas fraction is its mean over what crosses the face and the phase densities are the cell's.
///
/// - `windows`: the cells; `states`: those of their lanes, one after the other, written. They do not depend on each other.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn face_states(
    cells: &Cells<'_>,
    windows: &[Window],
    rule: &CellRule<'_>,
    states: &mut FaceStates,
) {
    let mc = |a, b| Limiter::Mc.difference(a, b);
    let minmod = |a, b| Limiter::Minmod.difference(a, b);
    let eno = |a, b| Limiter::Eno.difference(a, b);
    let none = |a, b| Limiter::None.difference(a, b);
    match (rule.limiter, rule.options.fraction_limiter(rule.limiter)) {
        (Limiter::Mc, _) => states_of(mc, mc, cells, windows, rule, states),
        (Limiter::Minmod, Limiter::Mc) => states_of(minmod, mc, cells, windows, rule, states),
        (Limiter::Minmod, _) => states_of(minmod, minmod, cells, windows, rule, states),
        (Limiter::Eno, _) => states_of(eno, eno, cells, windows, rule, states),
        (Limiter::None, _) => states_of(none, none, cells, windows, rule, states),
    }
}

#[inline(always)]
fn states_of(
    limit: impl Fn(f64, f64) -> f64 + Copy,
    limit_fraction: impl Fn(f64, f64) -> f64 + Copy,
    cells: &Cells<'_>,
    windows: &[Window],
    rule: &CellRule<'_>,
    states: &mut FaceStates,
) {
    for (window, (faces, bounded)) in windows.iter().zip(states.of_windows(windows.len())) {
        *bounded = window_states(limit, limit_fraction, cells, *window, rule, faces);
    }
}

#[inline(always)]
fn window_states(
    limit: impl Fn(f64, f64) -> f64 + Copy,
    limit_fraction: impl Fn(f64, f64) -> f64 + Copy,
    cells: &Cells<'_>,
    at: Window,
    rule: &CellRule<'_>,
    faces: &mut [[Lane; 6]; 4],
) -> Bounded {
    let w = phases(cells, at, 0, [&[0.0; LANES]; 2]);
    let own = [&w[RHO_G], &w[RHO_L]];
    let along_r = cells.stride as isize;
    let mut around = [
        [phases(cells, at, -1, own), phases(cells, at, 1, own)],
        [phases(cells, at, -along_r, own), phases(cells, at, along_r, own)],
    ];
    if let Some(jumps) = rule.jumps {
        level(jumps, at, along_r, &mut around);
    }
    let mut differences = [ZERO; 2];
    for (differences, [below, above]) in differences.iter_mut().zip(&around) {
        // Lane by lane: of a loop over the components around one over the lanes LLVM makes gathers.
        for k in 0..LANES {
            for c in 0..PHI {
                differences[c][k] = limit(w[c][k] - below[c][k], above[c][k] - w[c][k]);
            }
            differences[PHI][k] = limit_fraction(w[PHI][k] - below[PHI][k], above[PHI][k] - w[PHI][k]);
        }
    }
    let of_gas = rule.of_gas(at, &w[PRESSURE]);
    let padded = [primitive::PRESSURE, primitive::PHI].map(|row| cells.rows[row]);
    let is_closed = closed(at, padded, cells.stride, rule.mixture);
    let mut half = half_step(&w, (&of_gas, &is_closed), &differences, &at.load(rule.inverse_r, 0), rule);
    let mut shares = [1.0; LANES];
    if !rule.options.has_closure {
        for (lane, k) in lanes(at.listed).zip(at.cells()) {
            shares[lane] = kept_share(cells, k, rule);
        }
        for k in 0..LANES {
            for c in 0..6 {
                differences[0][c][k] *= shares[k];
                differences[1][c][k] *= shares[k];
                half[c][k] = w[c][k] + shares[k] * (half[c][k] - w[c][k]);
            }
        }
    }
    if let Some([gain_z, gain_r]) = rule.velocity_gain {
        half[V_Z].iter_mut().for_each(|v| *v += gain_z);
        half[V_R].iter_mut().for_each(|v| *v += gain_r);
    }
    let mut ends = [[ZERO; 2]; 2];
    for (axis, ends) in ends.iter_mut().enumerate() {
        for k in 0..LANES {
            for c in 0..6 {
                ends[0][c][k] = half[c][k] - 0.5 * differences[axis][c][k];
                ends[1][c][k] = half[c][k] + 0.5 * differences[axis][c][k];
            }
        }
    }
    if rule.options.is_sharp {
        let normals = normals(&around, rule.inverse_h);
        sharpen(&w, &around, &normals, rule.inverse_h.map(|inverse_h| rule.dt * inverse_h), &mut ends);
    }
    let mut is_bounded = [[0; LANES]; 3];
    for (phases, face) in ends.as_flattened().iter().zip(faces) {
        admissible(phases, &w, &of_gas, face, &mut is_bounded);
    }
    let [densities, pressures, fractions] = is_bounded.map(|lanes| bits(lanes.map(|lane| lane != 0)));
    let [halved, dropped] = [0.5, 0.0].map(|kept| bits(shares.map(|share| share == kept)));
    [densities, pressures, fractions, halved, dropped]
}

/// Takes the jumps of pressure between cells and those around them from the pressures of these.
#[inline(never)]
fn level(jumps: [&[f64]; 2], at: Window, along_r: isize, around: &mut [[Phases; 2]; 2]) {
    for ((jumps, step), [below, above]) in jumps.iter().zip([1, along_r]).zip(around) {
        let (lower, upper) = (at.load(jumps, -step), at.load(jumps, 0));
        for k in 0..LANES {
            below[PRESSURE][k] += lower[k];
            above[PRESSURE][k] -= upper[k];
        }
    }
}

/// The cells `by` after some by phases; a phase that is as good as absent has the density `else_densities`.
#[inline(always)]
fn phases(cells: &Cells<'_>, at: Window, by: isize, else_densities: [&Lane; 2]) -> Phases {
    let [rho, v_z, v_r, p, phi, gas] = cells.rows;
    let (rho, v_z, v_r) = (at.load(rho, by), at.load(v_z, by), at.load(v_r, by));
    let (p, phi, gas) = (at.load(p, by), at.load(phi, by), at.load(gas, by));
    let mut phases = [[0.0; LANES], [0.0; LANES], v_z, v_r, p, phi];
    for k in 0..LANES {
        // A phase's mass may lie below zero by what prediction may take the gas fraction below.
        let above_zero = |mass: f64| if mass > 0.0 { mass } else { 0.0 };
        let (has_gas, has_liquid) = (phi[k] > PURE, 1.0 - phi[k] > PURE);
        let gas_volume = if has_gas { phi[k] } else { 1.0 };
        let liquid_volume = if has_liquid { 1.0 - phi[k] } else { 1.0 };
        // One division for both.
        let inverse = 1.0 / (gas_volume * liquid_volume);
        let rho_g = above_zero(gas[k]) * (inverse * liquid_volume);
        let rho_l = above_zero(rho[k] - gas[k]) * (inverse * gas_volume);
        phases[RHO_G][k] = if has_gas { rho_g } else { else_densities[0][k] };
        phases[RHO_L][k] = if has_liquid { rho_l } else { else_densities[1][k] };
    }
    phases
}

/// - `of_gas`: the gas's pressure, Pa; `is_closed`: whether it does not give way, see [`closed`].
#[inline(always)]
fn half_step(
    w: &Phases,
    (of_gas, is_closed): (&Lane, &[bool; LANES]),
    [s_z, s_r]: &[Phases; 2],
    inverse_r: &Lane,
    rule: &CellRule<'_>,
) -> Phases {
    let [inverse_hz, inverse_hr] = rule.inverse_h;
    let half_dt = 0.5 * rule.dt;
    let mut half = ZERO;
    for k in 0..LANES {
        let of =
            |[rho_g, rho_l, v_z, v_r, p, phi]: &Phases| [rho_g[k], rho_l[k], v_z[k], v_r[k], p[k], phi[k]];
        let per_width = |[a, b, c, d, e, f]: [f64; 6], inverse_h: f64| {
            [a * inverse_h, b * inverse_h, c * inverse_h, d * inverse_h, e * inverse_h, f * inverse_h]
        };
        let cell = of(w);
        let (d_z, d_r) = (per_width(of(s_z), inverse_hz), per_width(of(s_r), inverse_hr));
        let phi = cell[PHI];
        let densities = [cell[RHO_G], cell[RHO_L]];
        let within = if is_closed[k] { 0.0 } else { phi };
        let mut c = Compression::at(of_gas[k], within, densities, rule.mixture, rule.options.has_closure);
        c.gas = if is_closed[k] { 1.0 } else { c.gas };
        let per_rho = 1.0 / (phi * cell[RHO_G] + (1.0 - phi) * cell[RHO_L]);
        let divergence = d_z[V_Z] + d_r[V_R] + cell[V_R] * inverse_r[k];
        let source = [
            -cell[RHO_G] * c.gas * divergence,
            -cell[RHO_L] * c.liquid * divergence,
            -d_z[PRESSURE] * per_rho,
            -d_r[PRESSURE] * per_rho,
            -c.modulus * divergence,
            c.expansion(within) * divergence,
        ];
        for c in 0..6 {
            half[c][k] = cell[c] + half_dt * (source[c] - (cell[V_Z] * d_z[c] + cell[V_R] * d_r[c]));
        }
    }
    half
}

/// Puts THINC's step in the place of the linear gas fraction, and the cells' own phase densities, where there is one.
///
/// - `around`: the neighbours on both sides along z and r; `per_cell`: Δt/h along both.
/// - `ends`: along z and r the states on the lower and the upper face.
#[inline(always)]
fn sharpen(
    w: &Phases,
    around: &[[Phases; 2]; 2],
    normals: &[Lane; 2],
    per_cell: [f64; 2],
    ends: &mut [[Phases; 2]; 2],
) {
    let mut steps = 0;
    for (axis, [below, above]) in around.iter().enumerate() {
        for k in 0..LANES {
            steps += u64::from(thinc::is_step(below[PHI][k], w[PHI][k], above[PHI][k], normals[axis][k]));
        }
    }
    if steps == 0 {
        return;
    }
    let [[west, east], [south, north]] = around;
    let [mut along_z, mut along_r] = [[[0.0; LANES]; 3]; 2];
    for k in 0..LANES {
        // Both axes in one pass: neither waits for the other's exponentials.
        let phi = w[PHI][k];
        let z = thinc::faces(west[PHI][k], phi, east[PHI][k], normals[0][k], w[V_Z][k] * per_cell[0]);
        let r = thinc::faces(south[PHI][k], phi, north[PHI][k], normals[1][k], w[V_R][k] * per_cell[1]);
        (along_z[0][k], along_z[1][k]) = (z.lower, z.upper);
        (along_r[0][k], along_r[1][k]) = (r.lower, r.upper);
        along_z[2][k] = if z.is_step { 1.0 } else { 0.0 };
        along_r[2][k] = if r.is_step { 1.0 } else { 0.0 };
    }
    for (steps, ends) in [along_z, along_r].iter().zip(ends) {
        for (fractions, end) in steps.iter().zip(ends) {
            for k in 0..LANES {
                let pick = |sharp: f64, smooth: f64| if steps[2][k] != 0.0 { sharp } else { smooth };
                end[PHI][k] = pick(fractions[k], end[PHI][k]);
                end[RHO_G][k] = pick(w[RHO_G][k], end[RHO_G][k]);
                end[RHO_L][k] = pick(w[RHO_L][k], end[RHO_L][k]);
            }
        }
    }
}

/// The unit normals ∇φ/|∇φ| from central differences; NaN where φ is uniform.
#[inline(always)]
fn normals([[west, east], [south, north]]: &[[Phases; 2]; 2], inverse_h: [f64; 2]) -> [Lane; 2] {
    let mut normals = [[0.0; LANES]; 2];
    for k in 0..LANES {
        let along_z = (east[PHI][k] - west[PHI][k]) * inverse_h[0];
        let along_r = (north[PHI][k] - south[PHI][k]) * inverse_h[1];
        let per_size = 1.0 / (along_z * along_z + along_r * along_r).sqrt();
        normals[0][k] = along_z * per_size;
        normals[1][k] = along_r * per_size;
    }
    normals
}

/// Bounds of what a face may have relative to its cell: phase densities within a factor of five, a tenth of the pressure.
const DENSITIES: [f64; 2] = [0.2, 5.0];
const LEAST_PRESSURE: f64 = 0.1;

/// From phases to ρ, v_z, v_r, p, φ and the gas's part of the mass, within the bounds.
///
/// - `of_gas`: the gas's pressure in the cells, Pa; `is_bounded`: becomes 1 in lanes where the bounds of densities, pressure or gas fraction act; of the last by more than what
///   counts as pure.
#[inline(always)]
fn admissible(
    phases: &Phases,
    w: &Phases,
    of_gas: &Lane,
    face: &mut [Lane; 6],
    is_bounded: &mut [[u64; LANES]; 3],
) {
    let lower = |a: f64, b: f64| if a < b { a } else { b };
    let upper = |a: f64, b: f64| if a > b { a } else { b };
    for k in 0..LANES {
        let within = |rho: f64, own: f64| lower(upper(rho, DENSITIES[0] * own), DENSITIES[1] * own);
        let phi = lower(upper(phases[PHI][k], 0.0), 1.0);
        let (unbounded, own) = (phases[PRESSURE][k], of_gas[k]);
        // What the cell's pressure is below its gas's is so on the face.
        let lowest = LEAST_PRESSURE * own - (own - w[PRESSURE][k]);
        let p = if own > 0.0 { upper(unbounded, lowest) } else { unbounded };
        let (rho_g, rho_l) = (phases[RHO_G][k], phases[RHO_L][k]);
        let (within_g, within_l) = (within(rho_g, w[RHO_G][k]), within(rho_l, w[RHO_L][k]));
        is_bounded[0][k] |= u64::from((within_g != rho_g) | (within_l != rho_l));
        is_bounded[1][k] |= u64::from(p != unbounded);
        is_bounded[2][k] |= u64::from((phases[PHI][k] - phi).abs() > PURE);
        let gas = phi * within_g;
        let rho = gas + (1.0 - phi) * within_l;
        face[primitive::RHO][k] = rho;
        face[primitive::V_Z][k] = phases[V_Z][k];
        face[primitive::V_R][k] = phases[V_R][k];
        face[primitive::PRESSURE][k] = p;
        face[primitive::PHI][k] = phi;
        face[primitive::GAS][k] = gas / rho;
    }
}

/// The share of its slopes that a cell keeps. Without the closure a mixed cell is nearly as stiff as liquid, and face
/// states of gas would let round-off grow, see [`crate::step::rows::half_step`]; with it the cell gives way.
fn kept_share(cells: &Cells<'_>, k: usize, rule: &CellRule<'_>) -> f64 {
    if rule.options.has_closure {
        return 1.0;
    }
    let [w, west, east, south, north] =
        [k, k - 1, k + 1, k - cells.stride, k + cells.stride].map(|k| cells.mean(k).w);
    let fraction_limiter = rule.options.fraction_limiter(rule.limiter);
    let limited = |below: PrimitiveCell, above: PrimitiveCell| -> PrimitiveCell {
        let limiter = |c: usize| if c == primitive::PHI { fraction_limiter } else { rule.limiter };
        std::array::from_fn(|c| limiter(c).difference(w[c] - below[c], above[c] - w[c]))
    };
    let (s_z, s_r) = (limited(west, east), limited(south, north));
    let half_dt = 0.5 * rule.dt;
    let bound = rule.mixture.bound_beta1::<true>(cells.mean(k).gas_share);
    let (inverse_h, inverse_r) = (rule.inverse_h, rule.inverse_r[k]);
    let (_, share) =
        Prediction::<true>::new(w, s_z, s_r, inverse_h, inverse_r, half_dt, bound, rule.mixture).half_step();
    share
}

#[cfg(test)]
mod tests;
