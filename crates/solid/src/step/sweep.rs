//! A step of a tile in one sweep over its rows: what lies between the cells before and after it is never longer than some rows.
//!
//! The stages in passes of their own write slopes, states at mid-step and faces of a whole block, two numbers for each one of a cell,
//! and read them again: more than fits the first-level cache. Here all stages are made of two rows at a time, by the same loops over
//! cells, so the results are the same to the last bit.

use std::ops::ControlFlow;

use mesh::{Blend, GHOSTS, Tile, fetch_lines, maximum};

use crate::boundary::outer_states::MidStep;
use crate::reconstruction::predictor::{Predicted, Predictor, predict_from};
use crate::state::component::COUNT;
use crate::step::rim::Rim;
use crate::step::rows::{Elasticity, Reconstruction, Rows, faces_body};
use crate::step::update::{FaceSlices, row, row_mut, split_block, update_row};

/// Rows that are made at a time. Together they are whole cache lines: rows have four numbers more than such.
const ROWS: usize = 2;
/// Numbers of so many of the widest rows, and a line more: there is a neighbour beyond the last one.
const MOST: usize = ROWS * (Tile::MOST_CELLS + 2 * GHOSTS) + 8;

/// What a tile's step has between the predictor and the update.
#[derive(Debug)]
pub(crate) struct SweepScratch {
    strips: [Strip; 2],
    r_faces: [RFaces; 3],
    /// Star states on the outer faces.
    pub rim: Rim,
}

/// Two rows of cells.
#[derive(Debug)]
#[repr(align(64))]
struct Strip {
    half: [[f64; MOST]; COUNT],
    along_z: [[f64; MOST]; 4],
    along_r: [[f64; MOST]; 4],
    /// v_n, v_t, σ_nn, σ_nt on the face above each cell along z.
    z_faces: [[f64; MOST]; 4],
}

/// The same between two rows of cells, without ghosts.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct RFaces([[f64; Tile::MOST_CELLS]; 4]);

impl SweepScratch {
    pub fn zeros() -> Box<Self> {
        let strip = || {
            let (zero, four) = ([0.0; MOST], [[0.0; MOST]; 4]);
            Strip { half: [zero; COUNT], along_z: four, along_r: four, z_faces: four }
        };
        let r_faces = [RFaces([[0.0; Tile::MOST_CELLS]; 4]); 3];
        Box::new(Self { strips: [strip(), strip()], r_faces, rim: Rim::zeros() })
    }
}

impl Strip {
    /// Its states at mid-step, the first of `len` cells number `first` of the padded ones.
    fn mid_step(&mut self, first: usize, len: usize) -> MidStep<'_> {
        let Self { half, along_z, along_r, .. } = self;
        let half = half.each_mut().map(|row| &mut row[..len]);
        let differences = [along_z, along_r].map(|rows| rows.each_mut().map(|row| &mut row[..len]));
        MidStep { first, half, differences }
    }
}

/// What a sweep needs to know of a tile and its step.
#[derive(Clone, Copy)]
pub(crate) struct Sweep<'a> {
    pub predictor: Predictor<'a>,
    /// See [`Reconstruction::dispersion`]; of the faces along z and along r.
    pub dispersion: [[f64; 2]; 2],
    pub elasticity: Elasticity,
    /// Length of the step, s.
    pub dt: f64,
    /// Whether the cells come from far away, so that it is worth while to ask for memory before it is needed.
    pub is_far: bool,
}

/// What else has a say between the predictor and the faces: gets the number of two rows, the first of which are those of the ghosts below
/// the cells and of the first cells, and their states at mid-step; tells whether the sweep goes on.
pub(crate) type Between<'a> = &'a mut dyn FnMut(usize, MidStep<'_>) -> ControlFlow<()>;

/// Advances the blocks of a tile, `ALONG` along each side.
///
/// - `cells`: the padded cells; `new`: block after block, written.
/// - returns: the largest squared von Mises stress of each block, infinite if one is not finite; `None` where it did not go
///   on, nothing that was written counts then.
/// - tested by: equality with the stages one after the other.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn sweep<const N: usize, const ALONG: usize>(
    cells: Rows<'_>,
    s: &Sweep<'_>,
    scratch: &mut SweepScratch,
    new: &mut [f64],
    between: Between<'_>,
) -> Option<[f64; 4]> {
    let (n, stride) = (ALONG * N, ALONG * N + 2 * GHOSTS);
    let SweepScratch { strips: [one, other], r_faces: [below, middle, above], rim } = scratch;
    let (mut before, mut here) = (one, other);
    let (mut south, mut north) = (below, above);
    let (mut largest, blend) = ([[0.0; N]; 4], Blend::new());
    let strips = n / ROWS + 1;
    for strip in 0..strips {
        // Counted from the first row of ghosts, the first of which nothing is made of.
        let j = ROWS * strip + 1;
        let len = ROWS * stride;
        if s.is_far && strip > 0 {
            [j - 1, j].into_iter().for_each(|j| ask_for_row::<N, ALONG>(j, new));
        }
        predict_strip(j * stride, len, cells, s, here);
        if between(strip, here.mid_step(j * stride, len)).is_break() {
            return None;
        }
        z_faces_of(len, s, here);
        r_faces_between(n, s, [(&*here, 0), (&*here, stride)], north);
        rim.take_strip(n, strip, &here.z_faces, &north.0);
        if strip > 0 {
            r_faces_between(n, s, [(&*before, stride), (&*here, 0)], middle);
            let faces = [&*south, &*middle];
            update_row_of::<N, ALONG>(j - 1, cells, s, (&*before, stride), faces, blend, &mut largest, new);
            let faces = [&*middle, &*north];
            update_row_of::<N, ALONG>(j, cells, s, (&*here, 0), faces, blend, &mut largest, new);
        }
        std::mem::swap(&mut before, &mut here);
        std::mem::swap(&mut south, &mut north);
    }
    Some(largest.map(|row| maximum(&row)))
}

/// Asks for the memory that a row of new cells is written to.
#[inline(always)]
fn ask_for_row<const N: usize, const ALONG: usize>(j: usize, new: &[f64]) {
    let (in_tile, len) = (j - GHOSTS, new.len() / (ALONG * ALONG));
    for part in 0..ALONG {
        let block = &new[(in_tile / N * ALONG + part) * len..];
        let first = in_tile % N * N;
        (0..COUNT).for_each(|c| fetch_lines(row::<N>(block, c * N * N + first)));
    }
}

/// Differences and states at mid-step of `len` cells from number `first` on.
#[inline(always)]
fn predict_strip(first: usize, len: usize, cells: Rows<'_>, s: &Sweep<'_>, strip: &mut Strip) {
    let Strip { half, along_z, along_r, .. } = strip;
    let [z0, z1, z2, z3] = along_z;
    let [r0, r1, r2, r3] = along_r;
    let [h0, h1, h2, h3, h4, h5] = half;
    let out = Predicted { s_z: [z0, z1, z2, z3], s_r: [r0, r1, r2, r3], half: [h0, h1, h2, h3, h4, h5] };
    predict_from(first, len, cells, s.predictor, s.elasticity, out);
}

/// Star states on the faces along z.
#[inline(always)]
fn z_faces_of(len: usize, s: &Sweep<'_>, strip: &mut Strip) {
    let Strip { half: [v_z, v_r, zz, zr, _, _], along_z: [a, b, c, d], z_faces, .. } = strip;
    let cells =
        Reconstruction { half: [v_z, v_r, zz, zr], differences: [a, b, c, d], dispersion: s.dispersion[0] };
    let [v_n, v_t, s_nn, s_nt] = z_faces;
    faces_body(
        len,
        cells.cut(0, len),
        cells.cut(1, len),
        &s.elasticity,
        &mut v_n[..len],
        &mut v_t[..len],
        &mut s_nn[..len],
        &mut s_nt[..len],
    );
}

/// Star states on the faces between two rows of `n` cells, each given by a strip and where it begins there.
#[inline(always)]
fn r_faces_between(n: usize, s: &Sweep<'_>, cells: [(&Strip, usize); 2], faces: &mut RFaces) {
    let [lower, upper] = cells.map(|(strip, at)| {
        let Strip { half: [v_z, v_r, _, zr, rr, _], along_r: [d_vz, d_vr, d_zr, d_rr], .. } = strip;
        let half: [&[f64]; 4] = [v_r, v_z, rr, zr];
        Reconstruction { half, differences: [d_vr, d_vz, d_rr, d_zr], dispersion: s.dispersion[1] }
            .cut(at + GHOSTS, n)
    });
    let [v_n, v_t, s_nn, s_nt] = &mut faces.0;
    faces_body(n, lower, upper, &s.elasticity, &mut v_n[..n], &mut v_t[..n], &mut s_nn[..n], &mut s_nt[..n]);
}

/// The new cells of a row.
///
/// - `j`: its number, counted from the first row of ghosts; `strip`: where it is at mid-step; `faces`: along r, below and above.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
#[inline(always)]
fn update_row_of<const N: usize, const ALONG: usize>(
    j: usize,
    cells: Rows<'_>,
    s: &Sweep<'_>,
    (strip, at): (&Strip, usize),
    [south, north]: [&RFaces; 2],
    blend: Blend,
    largest: &mut [[f64; N]; 4],
    new: &mut [f64],
) {
    let k = j * (ALONG * N + 2 * GHOSTS) + GHOSTS;
    let len = new.len() / (ALONG * ALONG);
    let in_tile = j - GHOSTS;
    let Predictor { inverse_h, inverse_r, .. } = s.predictor;
    let factors = [s.dt * inverse_h[0], s.dt * inverse_h[1], s.dt * inverse_r[k]];
    let z_faces = strip.z_faces.each_ref().map(|row| &row[..]);
    let r_faces = [south, north].map(|faces| faces.0.each_ref().map(|row| &row[..]));
    for part in 0..ALONG {
        let number = in_tile / N * ALONG + part;
        let [v_z, v_r, zz, zr, rr, phiphi] = split_block::<N>(&mut new[number * len..][..len]);
        let (to, i) = (in_tile % N * N, part * N);
        let first = at + GHOSTS + i;
        update_row::<N>(
            [
                row(cells[0], k + i),
                row(cells[1], k + i),
                row(cells[2], k + i),
                row(cells[3], k + i),
                row(cells[4], k + i),
                row(cells[5], k + i),
            ],
            FaceSlices::of(z_faces, first - 1),
            FaceSlices::of(z_faces, first),
            FaceSlices::of(r_faces[0], i),
            FaceSlices::of(r_faces[1], i),
            [row(&strip.half[1], first), row(&strip.half[4], first), row(&strip.half[5], first)],
            factors,
            s.elasticity,
            blend,
            row_mut(v_z, to),
            row_mut(v_r, to),
            row_mut(zz, to),
            row_mut(zr, to),
            row_mut(rr, to),
            row_mut(phiphi, to),
            &mut largest[number],
        );
    }
}
