//! Kernels over the cells of one padded block; see the fluid's for how such rows are walked.

use mesh::{AlignedRow, whole_lines};

use crate::riemann::{FaceState, WaveSpeeds};

/// Constants of an isotropic material as the kernels need them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elasticity {
    /// 1/ρ̄, m³/kg.
    pub inverse_density: f64,
    /// ρ̄c₁², Pa.
    pub p_modulus: f64,
    /// α ρ̄c₁² = ρ̄(c₁² − 2c₂²), Pa (Lamé's λ).
    pub lambda: f64,
    /// ρ̄c₂², Pa (Lamé's μ).
    pub mu: f64,
    /// ρ̄c₁, Pa s/m.
    pub z1: f64,
    /// ρ̄c₂, Pa s/m.
    pub z2: f64,
}

impl Elasticity {
    pub fn new(speeds: WaveSpeeds) -> Self {
        Self {
            inverse_density: 1.0 / speeds.density,
            p_modulus: speeds.p_modulus(),
            lambda: speeds.lambda(),
            mu: speeds.shear_modulus(),
            z1: speeds.z1(),
            z2: speeds.z2(),
        }
    }
}

/// Slices of the six components.
pub(crate) type Rows<'a> = [&'a [f64]; 6];

/// Time derivatives of velocity and stress.
///
/// Paper eqs. (19), (20) unscaled and as corrected: ρ̄∂t v_z = ∂z σ_zz + ∂r σ_zr + σ_zr/r and so on.
///
/// - `w`: v_z, v_r, σ_zz, σ_zr, σ_rr, σ_φφ; `d_z`, `d_r`: derivatives, per m (those not needed are ignored);
///   `inverse_r`: 1/r, or 0 in planar geometry.
/// - returns ∂w/∂t.  errors: none.
#[inline(always)]
pub(crate) fn rates(w: [f64; 6], d_z: [f64; 6], d_r: [f64; 6], inverse_r: f64, e: &Elasticity) -> [f64; 6] {
    let axial = d_z[0];
    let radial = d_r[1];
    let hoop = w[1] * inverse_r;
    [
        e.inverse_density * (d_z[2] + d_r[3] + w[3] * inverse_r),
        e.inverse_density * (d_z[3] + d_r[4] + (w[4] - w[5]) * inverse_r),
        e.p_modulus * axial + e.lambda * (radial + hoop),
        e.mu * (d_z[1] + d_r[0]),
        e.p_modulus * radial + e.lambda * (axial + hoop),
        e.p_modulus * hoop + e.lambda * (axial + radial),
    ]
}

/// Rows of star states at faces, indexed by the cell on the lower side of the face.
#[derive(Clone, Debug)]
pub(crate) struct FaceRows {
    /// Normal velocity.
    pub v_n: AlignedRow,
    /// Tangential velocity.
    pub v_t: AlignedRow,
    /// Normal stress.
    pub s_nn: AlignedRow,
    /// Shear stress.
    pub s_nt: AlignedRow,
}

impl FaceRows {
    /// For padded rows of `len` cells, `stride` apart along r.
    pub fn zeros(len: usize, stride: usize) -> Self {
        let row = || AlignedRow::zeros(len, stride);
        Self { v_n: row(), v_t: row(), s_nn: row(), s_nt: row() }
    }
}

/// What a face state is made of: v_n, v_t, σ_nn, σ_nt at mid-step and their differences across the cell.
#[derive(Clone, Copy)]
pub(crate) struct Reconstruction<'a> {
    pub half: [&'a [f64]; 4],
    pub differences: [&'a [f64]; 4],
    /// What face states get besides, see [`mesh::dispersion_share`]: of the pairs (v_n, σ_nn) and (v_t, σ_nt).
    pub dispersion: [f64; 2],
}

impl<'a> Reconstruction<'a> {
    /// `n` cells from `at` on.
    #[inline(always)]
    pub fn cut(&self, at: usize, n: usize) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.half, self.differences);
        Self {
            half: [&a[at..][..n], &b[at..][..n], &c[at..][..n], &d[at..][..n]],
            differences: [&e[at..][..n], &f[at..][..n], &g[at..][..n], &h[at..][..n]],
            dispersion: self.dispersion,
        }
    }

    /// The state on the lower (`sign` = −1) or upper (+1) face of cell `k`.
    #[inline(always)]
    pub fn face_state(&self, k: usize, sign: f64) -> FaceState {
        let at = |c: usize| self.half[c][k] + 0.5 * sign * self.differences[c][k];
        FaceState { v_n: at(0), v_t: at(1), sigma_nn: at(2), sigma_nt: at(3) }
    }

    /// The state on the upper face of cell `k`, beyond which there is no cell, with the tangential velocity and the shear
    /// to third order.
    ///
    /// Under a load that stays all waves have gone and no Courant number counts: what the trace of the shear lacks then
    /// lets the surface creep.
    pub fn shear_at_surface(&self, k: usize) -> FaceState {
        let more =
            |c: usize| mesh::dispersion_share(0.0) * (self.differences[c][k] - self.differences[c][k - 1]);
        let state = self.face_state(k, 1.0);
        FaceState { v_t: state.v_t + more(1), sigma_nt: state.sigma_nt + more(3), ..state }
    }
}

/// One pair of linear acoustics at the face between two cells: mean plus half the jump of the other over (or times) Z.
///
/// [`crate::riemann::star`] of the states h ± d/2 + s(d_R − d_L) on both sides, with the sums taken together: the mean is
/// (h_L + h_R)/2 + (s − ¼)(d_R − d_L), and in the jump (h_R − h_L) − (d_L + d_R)/2 the share s has no say.
///
/// - `half`, `differences`: of the cells below and above.
#[derive(Clone, Copy)]
struct AtFace {
    mean: f64,
    jump: f64,
}

impl AtFace {
    #[inline(always)]
    fn of(half: [f64; 2], differences: [f64; 2], share_less_quarter: f64) -> Self {
        let ([h_l, h_r], [d_l, d_r]) = (half, differences);
        Self {
            mean: 0.5 * (h_l + h_r) + share_less_quarter * (d_r - d_l),
            jump: (h_r - h_l) - 0.5 * (d_l + d_r),
        }
    }
}

/// The solution at the face between cells `k` of `lower` and of `upper`.
#[inline(always)]
fn face_between(lower: &Reconstruction<'_>, upper: &Reconstruction<'_>, k: usize, z: [f64; 2]) -> FaceState {
    let at = |c: usize| {
        // `map` of both stays a call where a crate is several units of code: faces then take ten times as long.
        let half = [lower.half[c][k], upper.half[c][k]];
        let differences = [lower.differences[c][k], upper.differences[c][k]];
        AtFace::of(half, differences, lower.dispersion[c % 2] - 0.25)
    };
    let [v_n, v_t, s_nn, s_nt] = [at(0), at(1), at(2), at(3)];
    // In rows of faces the quotients are the same for all of them.
    let velocity = |v: AtFace, s: AtFace, z: f64| v.mean + (0.5 / z) * s.jump;
    let stress = |v: AtFace, s: AtFace, z: f64| s.mean + 0.5 * z * v.jump;
    FaceState {
        v_n: velocity(v_n, s_nn, z[0]),
        v_t: velocity(v_t, s_nt, z[1]),
        sigma_nn: stress(v_n, s_nn, z[0]),
        sigma_nt: stress(v_t, s_nt, z[1]),
    }
}

/// The exact linear Riemann solution at the faces between cells `k` and `k + step`, for `k` in `range` and in whatever
/// completes its lines; `stride` is that of the rows.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn faces(
    cells: &Reconstruction<'_>,
    step: usize,
    stride: usize,
    range: std::ops::Range<usize>,
    elasticity: &Elasticity,
    faces: &mut FaceRows,
) {
    let range = whole_lines(range, stride..cells.half[0].len() - step);
    let (first, n) = (range.start, range.len());
    faces_body(
        n,
        cells.cut(first, n),
        cells.cut(first + step, n),
        elasticity,
        &mut faces.v_n[first..][..n],
        &mut faces.v_t[first..][..n],
        &mut faces.s_nn[first..][..n],
        &mut faces.s_nt[first..][..n],
    );
}

/// The exact linear Riemann solution at `n` faces, the cells below and above which are in `lower` and `upper`.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
#[inline(always)]
pub(crate) fn faces_body(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    elasticity: &Elasticity,
    v_n: &mut [f64],
    v_t: &mut [f64],
    s_nn: &mut [f64],
    s_nt: &mut [f64],
) {
    for k in 0..n {
        let face = face_between(&lower, &upper, k, [elasticity.z1, elasticity.z2]);
        v_n[k] = face.v_n;
        v_t[k] = face.v_t;
        s_nn[k] = face.sigma_nn;
        s_nt[k] = face.sigma_nt;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::riemann::star;

    /// Cells as different as they may be, and what both kernels of faces make of them.
    #[test]
    fn rows_of_faces_are_the_riemann_solutions_of_their_states() {
        let n = 40;
        let row = |rate: f64| -> Vec<f64> { (0..=n).map(|k| ((k * k) as f64 * rate).sin()).collect() };
        let (half, differences) = ([0.37, 0.21, 0.53, 0.71].map(row), [0.11, 0.93, 0.83, 0.47].map(row));
        let cells = Reconstruction {
            half: half.each_ref().map(|row| &row[..]),
            differences: differences.each_ref().map(|row| &row[..]),
            dispersion: [0.03, 0.05],
        };
        let e = Elasticity::new(WaveSpeeds { density: 1.1, c1: 1.7, c2: 0.9 });
        for k in 0..n {
            let more = |c: usize| cells.dispersion[c % 2] * (differences[c][k + 1] - differences[c][k]);
            let [left, right] =
                [cells.face_state(k, 1.0), cells.face_state(k + 1, -1.0)].map(|state| FaceState {
                    v_n: state.v_n + more(0),
                    v_t: state.v_t + more(1),
                    sigma_nn: state.sigma_nn + more(2),
                    sigma_nt: state.sigma_nt + more(3),
                });
            let wanted = star(left, right, e.z1, e.z2);
            let found = face_between(&cells.cut(0, n), &cells.cut(1, n), k, [e.z1, e.z2]);
            let numbers = |face: FaceState| [face.v_n, face.v_t, face.sigma_nn, face.sigma_nt];
            for (found, wanted) in numbers(found).into_iter().zip(numbers(wanted)) {
                assert!((found - wanted).abs() < 1e-14, "{k}: {found} {wanted}");
            }
        }
    }
}
