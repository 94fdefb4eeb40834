//! HLLC at rows of faces; written as the kernels of `step/rows.rs`.

use std::ops::Range;

use mesh::whole_lines;

use crate::Mixture;
use crate::reconstruction::{Reconstruction, states_at_face};
use crate::riemann::hllc::{Waves, flux_and_roots};
use crate::state::primitive::PHI;
use crate::state::{COUNT, PrimitiveCell};
use crate::step::face_rows::FaceRows;

/// HLLC at the faces between cells `k` and `k + step`, for `k` in `range` and in whatever completes its lines;
/// `stride` is that of the rows. Without gas the gas fractions on the faces are left alone.
///
/// - `is_low_mach`: by [`crate::flux_hllc_low_mach`].
/// - returns: whether all of them have sound speeds on both sides, also those of which nothing is used.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn hllc_faces(
    cells: &Reconstruction<'_>,
    step: usize,
    stride: usize,
    range: Range<usize>,
    mixture: &Mixture,
    is_low_mach: bool,
    faces: &mut FaceRows,
) -> bool {
    let range = whole_lines(range, cells.lines(step, stride));
    let (first, n) = (range.start, range.len());
    let mixture = *mixture;
    let (low, high) = (cells.cut(first, n), cells.cut(first + step, n));
    let [mass, velocity, pressure, shear, energy, phi] = faces.fluxes_mut();
    let (mass, velocity, pressure) =
        (&mut mass[first..][..n], &mut velocity[first..][..n], &mut pressure[first..][..n]);
    let (shear, energy, phi) = (&mut shear[first..][..n], &mut energy[first..][..n], &mut phi[first..][..n]);
    let m = &mixture;
    // Called by name: a pointer to one of them would not be inlined.
    macro_rules! body {
        ($gas:literal, $covolume:literal, $slow:literal) => {
            hllc_body::<$gas, $covolume, $slow>(n, low, high, m, mass, velocity, pressure, shear, energy, phi)
        };
    }
    match (cells.with_gas, mixture.has_covolume(), is_low_mach) {
        (true, true, true) => body!(true, true, true),
        (true, true, false) => body!(true, true, false),
        (true, false, true) => body!(true, false, true),
        (true, false, false) => body!(true, false, false),
        (false, true, true) => body!(false, true, true),
        (false, true, false) => body!(false, true, false),
        (false, false, true) => body!(false, false, true),
        (false, false, false) => body!(false, false, false),
    }
}

/// Faces whose waves are made before any of their fluxes.
const FACES: usize = 32;

type Faces = [f64; FACES];

/// Some faces between their states and their fluxes.
struct HalfSolved {
    left: [Faces; COUNT],
    right: [Faces; COUNT],
    s_l: Faces,
    s_r: Faces,
    s_m: Faces,
    p_star: Faces,
}

impl HalfSolved {
    const ZERO: Self = {
        let zero = [0.0; FACES];
        Self { left: [zero; COUNT], right: [zero; COUNT], s_l: zero, s_r: zero, s_m: zero, p_star: zero }
    };

    /// The states on both sides of face `k`.
    #[inline(always)]
    fn states<const WITH_GAS: bool>(&self, k: usize) -> [PrimitiveCell; 2] {
        let of = |[rho, u, v, p, phi]: &[Faces; COUNT]| {
            [rho[k], u[k], v[k], p[k], if WITH_GAS { phi[k] } else { 0.0 }]
        };
        [of(&self.left), of(&self.right)]
    }
}

// A flat list of what is written: of slices in a struct or an array the compiler does not know that they are apart. With
// an array here a step of 512 x 512 cells takes 114 instead of 43 ns per cell (2.7 times).
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn hllc_body<const WITH_GAS: bool, const B: bool, const LOW_MACH: bool>(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    mixture: &Mixture,
    mass: &mut [f64],
    velocity: &mut [f64],
    pressure: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
) -> bool {
    let mut half_solved = HalfSolved::ZERO;
    let (mut at, mut without) = (0, 0);
    while at < n {
        let some = FACES.min(n - at);
        without += hllc_some::<WITH_GAS, B, LOW_MACH>(
            some,
            lower.cut(at, some),
            upper.cut(at, some),
            mixture,
            &mut half_solved,
            &mut mass[at..][..some],
            &mut velocity[at..][..some],
            &mut pressure[at..][..some],
            &mut shear[at..][..some],
            &mut energy[at..][..some],
            &mut phi[at..][..some],
        );
        at += some;
    }
    without == 0
}

/// At most [`FACES`] faces in three loops: their states, their waves, their fluxes. In one loop the processor does not see the next
/// faces before these have got through three divisions and two roots, of which each waits for the one before.
///
/// - returns: how many have no sound speed on a side.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn hllc_some<const WITH_GAS: bool, const B: bool, const LOW_MACH: bool>(
    n: usize,
    lower: Reconstruction<'_>,
    upper: Reconstruction<'_>,
    mixture: &Mixture,
    half_solved: &mut HalfSolved,
    mass: &mut [f64],
    velocity: &mut [f64],
    pressure: &mut [f64],
    shear: &mut [f64],
    energy: &mut [f64],
    phi: &mut [f64],
) -> u64 {
    let n = n.min(FACES);
    for k in 0..n {
        let [left, right] = states_at_face::<WITH_GAS>(&lower, &upper, k);
        let ([rho, u, v, p, phi_l], [rho_r, u_r, v_r, p_r, phi_r]) =
            (&mut half_solved.left, &mut half_solved.right);
        [rho[k], u[k], v[k], p[k], _] = left;
        [rho_r[k], u_r[k], v_r[k], p_r[k], _] = right;
        if WITH_GAS {
            (phi_l[k], phi_r[k]) = (left[PHI], right[PHI]);
        }
    }
    let shares = |k: usize| {
        if B { [lower.gas_share::<WITH_GAS>(k), upper.gas_share::<WITH_GAS>(k)] } else { [0.0; 2] }
    };
    let mut without = 0;
    for k in 0..n {
        let [left, right] = half_solved.states::<WITH_GAS>(k);
        let (waves, has_roots) = Waves::between::<B, LOW_MACH>(left, right, shares(k), mixture);
        without += u64::from(!has_roots);
        let HalfSolved { s_l, s_r, s_m, p_star, .. } = &mut *half_solved;
        (s_l[k], s_r[k], s_m[k], p_star[k]) = (waves.s_l, waves.s_r, waves.s_m, waves.p_star);
    }
    for k in 0..n {
        let [left, right] = half_solved.states::<WITH_GAS>(k);
        let HalfSolved { s_l, s_r, s_m, p_star, .. } = &*half_solved;
        let waves = Waves { s_l: s_l[k], s_r: s_r[k], s_m: s_m[k], p_star: p_star[k] };
        let face = waves.flux::<B>(left, right, shares(k), mixture);
        mass[k] = face.mass;
        velocity[k] = face.velocity;
        pressure[k] = face.pressure;
        shear[k] = face.shear;
        energy[k] = face.energy;
        if WITH_GAS {
            phi[k] = face.phi;
        }
    }
    without
}

/// Whether both sides of the face above cell `k` have a sound speed, see [`flux_and_roots`].
pub(crate) fn has_roots(cells: &Reconstruction<'_>, k: usize, step: usize, mixture: &Mixture) -> bool {
    let (lower, upper) = (cells.cut(k, 1), cells.cut(k + step, 1));
    let [left, right] = states_at_face::<true>(&lower, &upper, 0);
    let share = |side: &Reconstruction<'_>| if cells.with_gas { side.gas_shares[0] } else { 0.0 };
    flux_and_roots::<true, false>(left, right, [share(&lower), share(&upper)], mixture).1
}
