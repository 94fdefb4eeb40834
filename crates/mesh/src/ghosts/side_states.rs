//! A state for every cell that may ever lie along a side of the domain.

use crate::{Mesh, Side};

/// What a function of position says along the four sides of the domain, for the cells of every level: what an open
/// boundary holds outside while the mesh changes.
#[derive(Clone, Debug)]
pub struct SideStates<S> {
    root_level: u8,
    /// By side, level from the roots' on, and number along the side.
    states: [Vec<Vec<S>>; 4],
}

impl<S> SideStates<S> {
    /// Evaluates `state` (side, centre and widths of a cell along it) along all sides on all levels.
    pub fn new<const N: usize>(mesh: &Mesh<N>, state: impl Fn(Side, [f64; 2], [f64; 2]) -> S) -> Self {
        let (root_level, finest) = (mesh.tree().root_level(), mesh.tree().finest());
        let domain = *mesh.domain();
        let along = |side: Side, level: u8| -> Vec<S> {
            let widths = mesh.widths(level);
            let cells = mesh.tree().blocks_on(level).map(|blocks| blocks as usize * N);
            let at = |axis: usize, k: usize| {
                let low = if axis == 0 { domain.z[0] } else { domain.r[0] };
                low + (k as f64 + 0.5) * widths[axis]
            };
            let count = if matches!(side, Side::ZMin | Side::ZMax) { cells[1] } else { cells[0] };
            (0..count)
                .map(|k| match side {
                    Side::ZMin => [at(0, 0), at(1, k)],
                    Side::ZMax => [at(0, cells[0] - 1), at(1, k)],
                    Side::RMin => [at(0, k), at(1, 0)],
                    Side::RMax => [at(0, k), at(1, cells[1] - 1)],
                })
                .map(|centre| state(side, centre, widths))
                .collect()
        };
        let states = Side::ALL.map(|side| (root_level..=finest).map(|level| along(side, level)).collect());
        Self { root_level, states }
    }

    /// The states of all cells on a side, level by level.
    pub fn along(&self, side: Side) -> impl Iterator<Item = &S> {
        self.states[side as usize].iter().flatten()
    }

    /// The state of the cell number `along` of a level on a side.
    pub fn at(&self, side: Side, level: u8, along: usize) -> &S {
        &self.states[side as usize][usize::from(level - self.root_level)][along]
    }
}
