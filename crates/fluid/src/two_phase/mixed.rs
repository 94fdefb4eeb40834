//! The mixed cells of one block: found, reconstructed, and their faces solved.
//!
//! Nearly all cells are pure, and the kernels of `rows.rs` and `update.rs` serve them row by row. What is here walks
//! lists of the others and puts their fluxes in the place of the kernels'.

use crate::state::primitive::VELOCITY;
use mesh::{Frame, GHOSTS, Side, Tile};

use super::cells::{Cells, FaceState, RowKinds, find_interface};
use super::closure::{Compression, is_mixed, phase_densities};
use super::face_states::FaceStates;
use super::reconstruction::{CellRule, face_states};
use super::traces::is_closed;
use super::windows::{LANES, Window, lanes, windows};
use crate::boundary::beside;
use crate::capillarity::FaceJumps;
use crate::reconstruction::Reconstruction;
use crate::riemann::exact_rows::{ListedFaces, exact_fluxes};
use crate::riemann::hllc::Face;
use crate::riemann::low_mach::brought_together;
use crate::step::clips::Clips;
use crate::step::face_rows::{FaceRows, set_face, used_face};

/// No mixed cell.
const NONE: u32 = u32::MAX;

/// The mixed cells of a tile and of the first layer around it.
#[derive(Clone, Debug)]
pub(crate) struct MixedCells {
    /// Place of each padded cell among the states.
    index: Vec<u32>,
    /// The listed cells and their places.
    cells: Vec<(usize, u32)>,
    states: FaceStates,
    /// Faces along z and r whose fluid comes from a mixed cell, with the gas's part of its mass.
    shares: [Vec<(usize, f64)>; 2],
    /// What the cells of each padded row are.
    kinds: Vec<RowKinds>,
    /// The listed cells but for those beyond the sides of the domain.
    windows: Vec<Window>,
    /// Each block's own cells that hold both phases, in windows along z.
    mixed: [Vec<Window>; 4],
    problems: Vec<Problem>,
    /// What was bounded in the block's own cells, and how many of them kept none of their slopes.
    clips: Clips,
    dropped: u32,
    /// Whether the faces above the padded cells bound cells of the block: bit 0 along z, bit 1 along r.
    is_used: Vec<u8>,
}

/// A face of a listed cell: the places of the cells on both sides among the states, or [`NONE`].
#[derive(Clone, Copy, Debug)]
struct Problem {
    face: usize,
    lower: u32,
    upper: u32,
}

impl MixedCells {
    /// For rows of a frame.
    pub fn new(frame: Frame) -> Self {
        let (len, stride) = (frame.len(), frame.stride());
        let is_used = |k: usize, step: usize| u8::from(used_face(frame, k, step));
        Self {
            is_used: (0..len).map(|k| is_used(k, 1) | is_used(k, stride) << 1).collect(),
            index: vec![NONE; len],
            cells: Vec::with_capacity(len),
            states: FaceStates::default(),
            shares: [Vec::with_capacity(len), Vec::with_capacity(len)],
            kinds: vec![RowKinds::default(); len / stride],
            windows: Vec::with_capacity(len),
            mixed: std::array::from_fn(|_| Vec::new()),
            problems: Vec::with_capacity(len),
            clips: Clips::default(),
            dropped: 0,
        }
    }

    /// Forgets the last block.
    pub fn clear(&mut self) {
        for (k, _) in self.cells.drain(..) {
            self.index[k] = NONE;
        }
        self.shares.iter_mut().for_each(Vec::clear);
        (self.clips, self.dropped) = (Clips::default(), 0);
    }

    /// What was bounded in the block's own cells and on their faces, and how many of the cells kept none of their slopes.
    pub fn clips(&self) -> (Clips, u32) {
        (self.clips, self.dropped)
    }

    /// The own cells of a block that hold both phases, listed or not, in windows along z; `number`: of the block in the tile.
    pub fn mixed(&self, number: usize) -> &[Window] {
        &self.mixed[number]
    }

    /// The padded cells on the list with the states on their lower faces along z.
    pub fn listed(&self) -> impl Iterator<Item = (usize, FaceState)> {
        self.cells.iter().map(|(k, place)| (*k, self.states.of(*place as usize, 0)))
    }

    fn list(&mut self, k: usize, place: usize) {
        self.index[k] = place as u32;
        self.cells.push((k, place as u32));
    }

    /// Finds and reconstructs the cells of a tile and of those of its ghosts that share a face with it.
    ///
    /// - `outer`: what lies beyond each side, see [`Outer`].
    /// - `is_marked`: padded cells that fall back to first order, if there are any; they are on the list also when pure.
    pub fn collect<const N: usize>(
        &mut self,
        tile: Tile,
        cells: &Cells<'_>,
        rule: &CellRule<'_>,
        outer: [Outer; 4],
        is_marked: Option<&[bool]>,
    ) {
        self.windows.clear();
        self.mixed.iter_mut().for_each(Vec::clear);
        let frame = tile.frame::<N>();
        let (cells_along, stride) = (frame.cells(), frame.stride());
        if !find_interface(cells, rule.mixture, &mut self.kinds) && is_marked.is_none() {
            return;
        }
        if let Some(is_marked) = is_marked {
            for (k, _) in is_marked.iter().enumerate().filter(|(_, is_marked)| **is_marked) {
                self.kinds[k / stride].at_interface |= 1 << (k % stride);
            }
        }
        let bits_of = |n: usize| u64::MAX >> (64 - n);
        for (j, kinds) in self.kinds[GHOSTS..][..cells_along].iter().enumerate() {
            let listed = kinds.at_interface >> GHOSTS & bits_of(cells_along);
            let first = frame.index(0, j as isize);
            windows(cells_along, first, 1, listed, |window| self.windows.push(window));
        }
        for (number, of_block) in self.mixed.iter_mut().enumerate().take(tile.blocks()) {
            let ([before, below], at) =
                (tile.place(number).map(|place| place * N), tile.frame_of::<N>(number));
            for (j, kinds) in self.kinds[GHOSTS + below..][..N].iter().enumerate() {
                let mixed = kinds.mixed >> (GHOSTS + before) & bits_of(N);
                windows(N, at.index(0, j as isize), 1, mixed, |window| of_block.push(window));
            }
        }
        let own_windows = self.windows.len();
        for side in Side::ALL.into_iter().filter(|side| outer[*side as usize] == Outer::Block) {
            let ghost = |along: usize| {
                let [_, ghost] = beside(side, frame, along as isize);
                ghost
            };
            let bit = |k: usize| self.kinds[k / stride].at_interface >> (k % stride) & 1;
            let listed = (0..cells_along).fold(0, |listed, along| listed | bit(ghost(along)) << along);
            let step = ghost(1) - ghost(0);
            windows(cells_along, ghost(0), step, listed, |window| self.windows.push(window));
        }
        let windows = std::mem::take(&mut self.windows);
        for (window, first) in windows.iter().zip((0..).step_by(LANES)) {
            lanes(window.listed).for_each(|lane| self.list(window.cell(lane), first + lane));
        }
        self.windows = windows;
        face_states(cells, &self.windows, rule, &mut self.states);
        self.count_bounded(own_windows, is_marked);
        if let Some(is_marked) = is_marked {
            for (k, place) in self.cells.iter().filter(|(k, _)| is_marked[*k]) {
                (0..4).for_each(|face| self.states.set(*place as usize, face, cells.mean(*k)));
            }
        }
        for side in Side::ALL.into_iter().filter(|side| outer[*side as usize] == Outer::Mirror) {
            for along in 0..cells_along {
                let [inner, ghost] = beside(side, frame, along as isize);
                if self.index[inner] != NONE {
                    let states = [0, 1, 2, 3].map(|face| self.states.of(self.index[inner] as usize, face));
                    let place = self.states.push(mirrored(states, side));
                    self.list(ghost, place);
                }
            }
        }
    }

    /// Counts what was bounded in the cells of the first windows, which are the block's own; marked ones have other states.
    fn count_bounded(&mut self, own_windows: usize, is_marked: Option<&[bool]>) {
        for (window, bounded) in self.windows.iter().zip(self.states.bounded()).take(own_windows) {
            if bounded.iter().all(|lanes| lanes & window.listed == 0) {
                continue;
            }
            let is_own = |lane: &usize| is_marked.is_none_or(|is_marked| !is_marked[window.cell(*lane)]);
            let own = lanes(window.listed).filter(is_own).fold(0, |own, lane| own | 1 << lane);
            let [densities, pressures, fractions, halved, dropped] =
                bounded.map(|lanes| (lanes & own).count_ones());
            self.clips.bounded_densities += u64::from(densities);
            self.clips.bounded_pressures += u64::from(pressures);
            self.clips.bounded_fractions += u64::from(fractions);
            self.clips.halved_slopes += u64::from(halved);
            self.dropped += dropped;
        }
    }

    /// Solves the faces of the listed cells along one axis (0: z, 1: r); `cells` are the tile's others, their rows `stride` apart.
    ///
    /// By the frozen mixtures' exact flux whatever solver serves the other faces: HLLC takes the liquid's rarefaction for
    /// one jump, and at 5e7 Pa against a thin gas leaves it 4 MPa behind the wave. In the soft mixed cells that stays, as
    /// heat of the gas. The gas fraction follows the density behind the wave.
    pub fn solve_faces(
        &mut self,
        axis: usize,
        stride: usize,
        cells: &Reconstruction<'_>,
        rule: &CellRule<'_>,
        jumps: Option<FaceJumps<'_>>,
        faces: &mut FaceRows,
    ) {
        if axis == 0 {
            self.solve_along::<0>(1, cells, rule, jumps, faces);
        } else {
            self.solve_along::<1>(stride, cells, rule, jumps, faces);
        }
    }

    fn solve_along<const AXIS: usize>(
        &mut self,
        step: usize,
        cells: &Reconstruction<'_>,
        rule: &CellRule<'_>,
        jumps: Option<FaceJumps<'_>>,
        faces: &mut FaceRows,
    ) {
        let mut problems = std::mem::take(&mut self.problems);
        problems.clear();
        for &(k, own) in &self.cells {
            // The face below is the upper one of a listed neighbour.
            if self.is_used[k - step] >> AXIS & 1 == 1 && self.index[k - step] == NONE {
                problems.push(Problem { face: k - step, lower: NONE, upper: own });
            }
            if self.is_used[k] >> AXIS & 1 == 1 {
                problems.push(Problem { face: k, lower: own, upper: self.index[k + step] });
            }
        }
        let shares = &mut self.shares[AXIS];
        let fluxes = faces.fluxes_mut();
        let states = &self.states;
        let mut listed = Along::<AXIS> { states, cells, rule, jumps, step, shares, fluxes, emptied: 0 };
        exact_fluxes(&problems, &mut listed, rule.mixture);
        self.clips.emptied_faces += listed.emptied;
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

/// Faces of listed cells along one axis (0: z, 1: r).
struct Along<'a, const AXIS: usize> {
    states: &'a FaceStates,
    /// The other cells.
    cells: &'a Reconstruction<'a>,
    rule: &'a CellRule<'a>,
    /// Jumps of pressure by surface tension.
    jumps: Option<FaceJumps<'a>>,
    step: usize,
    shares: &'a mut Vec<(usize, f64)>,
    fluxes: [&'a mut [f64]; 6],
    /// Faces behind whose wave the liquid takes all the volume, though gas crosses.
    emptied: u64,
}

impl<const AXIS: usize> Along<'_, AXIS> {
    /// What a cell has on its lower (0) or upper (1) face.
    #[inline(always)]
    fn side(&self, index: u32, k: usize, side: usize) -> FaceState {
        if index == NONE {
            return FaceState {
                w: self.cells.face_state(k, [-1.0, 1.0][side]),
                gas_share: self.cells.gas_shares[k],
            };
        }
        normal_first(self.states.of(index as usize, 2 * AXIS + side), AXIS)
    }

    /// What both cells have on a face.
    #[inline(always)]
    fn sides(&self, face: &Problem) -> [FaceState; 2] {
        [self.side(face.lower, face.face, 1), self.side(face.upper, face.face + self.step, 0)]
    }
}

impl<const AXIS: usize> ListedFaces for Along<'_, AXIS> {
    type Face = Problem;

    #[inline(always)]
    fn states(&self, face: &Problem) -> [FaceState; 2] {
        let states = self.sides(face);
        let [mut lower, mut upper] = match self.jumps {
            Some(jumps) if jumps.has(face.face) => jumps.level(face.face, states, self.rule.mixture),
            _ => states,
        };
        if self.rule.is_low_mach {
            let shares = [lower.gas_share, upper.gas_share];
            [lower.w, upper.w] = brought_together(lower.w, upper.w, shares, self.rule.mixture);
        }
        [lower, upper]
    }

    #[inline(always)]
    fn star_fraction(&self, [rho, p, phi]: [f64; 3], share: f64, compression: f64) -> f64 {
        let CellRule { mixture, options, .. } = self.rule;
        let densities = phase_densities(rho, share, phi, mixture);
        let closure = Compression::at(p, phi, densities, mixture, options.has_closure);
        let behind = closure.star_fraction(phi, compression);
        if is_mixed(phi) & !is_closed(p, phi, mixture) { behind } else { phi }
    }

    #[inline(always)]
    fn put(&mut self, face: &Problem, mut solution: Face, gas_share: f64) {
        if let Some(jumps) = self.jumps
            && jumps.has(face.face)
        {
            solution = jumps.settle(face.face, &self.sides(face), solution, self.rule.mixture);
        }
        set_face(&mut self.fluxes, face.face, solution);
        let from = if solution.velocity < 0.0 { face.upper } else { face.lower };
        // What comes from other cells has the gas's part that all of theirs has.
        if from != NONE {
            self.emptied += u64::from((solution.phi == 0.0) & (gas_share > 0.0));
            self.shares.push((face.face, gas_share));
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
#[inline(always)]
fn normal_first(state: FaceState, axis: usize) -> FaceState {
    let [rho, v_z, v_r, p, phi] = state.w;
    if axis == 0 { state } else { FaceState { w: [rho, v_r, v_z, p, phi], ..state } }
}

fn mirrored(states: [FaceState; 4], side: Side) -> [FaceState; 4] {
    let axis = if matches!(side, Side::ZMin | Side::ZMax) { 0 } else { 1 };
    let mut images = states.map(|mut state| {
        state.w[VELOCITY[axis]] = -state.w[VELOCITY[axis]];
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
        // Its upper face is the cell's lower one, with the normal velocity reversed.
        assert_eq!(image[1].w, [1.0, -2.0, 3.0, 4.0, 0.1]);
        assert_eq!(image[2].w, [1.0, -2.0, 3.0, 4.0, 0.3]);
        let image = mirrored(states, Side::RMax);
        assert_eq!(image[2].w, [1.0, 2.0, -3.0, 4.0, 0.4]);
    }
}
