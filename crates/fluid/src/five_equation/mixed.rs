//! The mixed cells of one block: found, reconstructed, and their faces solved.
//!
//! Nearly all cells are pure, and the kernels of `rows.rs` and `update.rs` serve them row by row. What is here walks
//! lists of the others and puts their fluxes in the place of the kernels'.

use mesh::{Padded, Side};

use super::closure::{Compression, is_mixed};
use super::reconstruction::{Cells, FaceState, Stencil, face_states};
use crate::block::used_face;
use crate::boundary::beside;
use crate::exact_rows::exact_fluxes;
use crate::hllc::Face;
use crate::rows::{FaceRows, Reconstruction};

/// No mixed cell.
const NONE: u32 = u32::MAX;

/// The mixed cells of a block and of the first layer around it.
#[derive(Clone, Debug)]
pub(crate) struct MixedCells {
    /// Index into the lists of each padded cell.
    index: Vec<u32>,
    cells: Vec<usize>,
    states: Vec<[FaceState; 4]>,
    /// Faces along z and r whose fluid comes from a mixed cell, with the gas's part of its mass.
    shares: [Vec<(usize, f64)>; 2],
    problems: Problems,
}

/// Riemann problems at listed faces.
#[derive(Clone, Debug, Default)]
struct Problems {
    faces: Vec<usize>,
    /// The states on both sides.
    lower: Vec<[f64; 5]>,
    upper: Vec<[f64; 5]>,
    /// m_g/ρ on both sides; NaN beside a cell that is not listed.
    gas_shares: Vec<[f64; 2]>,
    fluxes: Vec<Face>,
}

impl Problems {
    fn clear(&mut self) {
        self.faces.clear();
        self.lower.clear();
        self.upper.clear();
        self.gas_shares.clear();
    }

    fn put(&mut self, face: usize, lower: FaceState, upper: FaceState) {
        self.faces.push(face);
        self.lower.push(lower.w);
        self.upper.push(upper.w);
        self.gas_shares.push([lower.gas_share, upper.gas_share]);
    }
}

impl MixedCells {
    pub fn new(len: usize) -> Self {
        Self {
            index: vec![NONE; len],
            cells: Vec::with_capacity(len),
            states: Vec::with_capacity(len),
            shares: [Vec::with_capacity(len), Vec::with_capacity(len)],
            problems: Problems::default(),
        }
    }

    /// Forgets the last block.
    pub fn clear(&mut self) {
        for k in self.cells.drain(..) {
            self.index[k] = NONE;
        }
        self.states.clear();
        self.shares.iter_mut().for_each(Vec::clear);
    }

    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The padded cells on the list.
    pub fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// The same with the states on their faces.
    pub fn listed(&self) -> impl Iterator<Item = (usize, &[FaceState; 4])> {
        self.cells.iter().copied().zip(&self.states)
    }

    fn list(&mut self, k: usize) {
        self.index[k] = self.cells.len() as u32;
        self.cells.push(k);
    }

    fn of(&self, k: usize) -> Option<&[FaceState; 4]> {
        self.states.get(self.index[k] as usize)
    }

    /// Finds and reconstructs the cells of a block and of those of its ghosts that share a face with it.
    ///
    /// - `outer`: what lies beyond each side, see [`Outer`].
    /// - `is_marked`: cells that fall back to first order; they are on the list also when pure.
    pub fn collect<const N: usize>(
        &mut self,
        cells: &Cells<'_>,
        stencil: &Stencil<'_>,
        outer: [Outer; 4],
        is_marked: impl Fn(usize) -> bool,
    ) {
        let is_listed = |k: usize| is_marked(k) || cells.is_at_interface(k);
        for j in 0..N as isize {
            let first = Padded::<N>::index(0, j);
            for (i, is_at_interface) in cells.are_at_interface::<N>(first).into_iter().enumerate() {
                if is_at_interface || is_marked(first + i) {
                    self.list(first + i);
                }
            }
        }
        for side in Side::ALL.into_iter().filter(|side| outer[*side as usize] == Outer::Block) {
            for along in 0..N {
                let [_, ghost] = beside(side, N, along as isize).map(|(i, j)| Padded::<N>::index(i, j));
                if is_listed(ghost) {
                    self.list(ghost);
                }
            }
        }
        self.states.resize(self.cells.len(), [FaceState::default(); 4]);
        face_states(cells, &self.cells, stencil, &mut self.states);
        for (k, states) in self.cells.iter().zip(&mut self.states) {
            if is_marked(*k) {
                *states = [cells.mean(*k); 4];
            }
        }
        for side in Side::ALL.into_iter().filter(|side| outer[*side as usize] == Outer::Mirror) {
            for along in 0..N {
                let [inner, ghost] = beside(side, N, along as isize).map(|(i, j)| Padded::<N>::index(i, j));
                if let Some(states) = self.of(inner).copied() {
                    self.list(ghost);
                    self.states.push(mirrored(states, side));
                }
            }
        }
    }

    /// Solves the faces of the listed cells along one axis (0: z, 1: r); `cells` are the block's others.
    ///
    /// By the frozen mixtures' exact flux whatever solver serves the other faces: HLLC takes the liquid's rarefaction for
    /// one jump, and at 5e7 Pa against a thin gas leaves it 4 MPa behind the wave. In the soft mixed cells that stays, as
    /// heat of the gas. The gas fraction follows the density behind the wave.
    pub fn solve_faces<const N: usize>(
        &mut self,
        axis: usize,
        cells: &Reconstruction<'_>,
        stencil: &Stencil<'_>,
        faces: &mut FaceRows,
    ) {
        let step = if axis == 0 { 1 } else { Padded::<N>::STRIDE };
        let mut problems = std::mem::take(&mut self.problems);
        problems.clear();
        let pure = |k: usize, sign: f64| FaceState { w: cells.face_state(k, sign), gas_share: f64::NAN };
        for (k, states) in self.cells.iter().zip(&self.states) {
            // The face below is the upper one of a listed neighbour.
            if self.of(k - step).is_none() && used_face::<N>(k - step, step) {
                problems.put(k - step, pure(k - step, 1.0), turned(states[2 * axis], axis));
            }
            if used_face::<N>(*k, step) {
                let upper = match self.of(k + step) {
                    Some(states) => turned(states[2 * axis], axis),
                    None => pure(k + step, -1.0),
                };
                problems.put(*k, turned(states[2 * axis + 1], axis), upper);
            }
        }
        let Problems { faces: at, lower, upper, gas_shares, fluxes } = &mut problems;
        exact_fluxes(lower, upper, stencil.mixture, fluxes);
        for (index, face) in fluxes.iter_mut().enumerate() {
            let is_upper = usize::from(face.velocity < 0.0);
            let [_, _, _, p, phi] = [&*lower, &*upper][is_upper][index];
            if is_mixed(phi) {
                let compression = Compression::at(p, phi, stencil.mixture, stencil.options.has_closure);
                face.phi = compression.star_fraction(phi, face.compression);
            }
            faces.set(at[index], *face);
            let gas_share = gas_shares[index][is_upper];
            if !gas_share.is_nan() {
                self.shares[axis].push((at[index], gas_share));
            }
        }
        self.problems = problems;
    }

    /// Puts the mixed cells' part into the gas's mass fluxes along one axis.
    pub fn put_gas_fluxes(&self, axis: usize, faces: &mut FaceRows) {
        let (gas, mass) = faces.gas_mut();
        for &(k, share) in &self.shares[axis] {
            gas[k] = mass[k] * share;
        }
    }
}

/// What lies beyond a side of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outer {
    /// Other blocks, whose cells are the ghosts.
    Block,
    /// The mirror image.
    Mirror,
    /// States or fluxes that the boundary gives.
    Given,
}

/// Normal and tangential velocity in the places of the axial and the radial one.
fn turned(state: FaceState, axis: usize) -> FaceState {
    let [rho, v_z, v_r, p, phi] = state.w;
    if axis == 0 { state } else { FaceState { w: [rho, v_r, v_z, p, phi], ..state } }
}

fn mirrored(states: [FaceState; 4], side: Side) -> [FaceState; 4] {
    let axis = if matches!(side, Side::ZMin | Side::ZMax) { 0 } else { 1 };
    let mut images = states.map(|mut state| {
        state.w[1 + axis] = -state.w[1 + axis];
        state
    });
    images.swap(2 * axis, 2 * axis + 1);
    images
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_beyond_a_side_has_the_face_on_it_in_common() {
        let state = |phi: f64| FaceState { w: [1.0, 2.0, 3.0, 4.0, phi], gas_share: 0.5 };
        let states = [state(0.1), state(0.2), state(0.3), state(0.4)];
        let image = mirrored(states, Side::ZMin);
        // Its upper face is the cell's lower one, with the normal velocity turned.
        assert_eq!(image[1].w, [1.0, -2.0, 3.0, 4.0, 0.1]);
        assert_eq!(image[2].w, [1.0, -2.0, 3.0, 4.0, 0.3]);
        let image = mirrored(states, Side::RMax);
        assert_eq!(image[2].w, [1.0, 2.0, -3.0, 4.0, 0.4]);
    }
}
