//! What the stages have left for the step of a block.

use mesh::{Mesh, Neighbour, Offset, Padded};

use super::block::ghosts;
use super::stages::Spread;

/// The mean fluxes that the stages have found in a block and in those around it.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    spread: &'a Spread,
    slot: usize,
    around: [Option<usize>; 8],
    put: fn(&Self, usize, &mut [&mut [f64]], &[usize]),
}

impl<'a> View<'a> {
    /// Momentum, by viscosity.
    pub const MOMENTUM: usize = 0;
    /// Heat, by conduction.
    pub const HEAT: usize = 1;

    /// `None` where nothing was found in stages.
    pub fn of<const N: usize>(spread: &'a Spread, mesh: &Mesh<N>, slot: usize) -> Option<Self> {
        if spread.is_empty() {
            return None;
        }
        let neighbours = mesh.tree().neighbours(slot);
        let around = std::array::from_fn(|k| match neighbours[k] {
            Neighbour::Same(slot) => Some(slot),
            _ => None,
        });
        Some(Self { spread, slot, around, put: Self::put_all::<N> })
    }

    /// Puts the mean fluxes in the place of others on all faces of cells of a block and its first ghosts that were in stages.
    ///
    /// - `rows`: padded, indexed by the cell below the face; `axes`: of each.
    pub fn put(&self, kind: usize, rows: &mut [&mut [f64]], axes: &[usize]) {
        (self.put)(self, kind, rows, axes);
    }

    fn put_all<const N: usize>(&self, kind: usize, rows: &mut [&mut [f64]], axes: &[usize]) {
        let len = Padded::<N>::LEN;
        let mut put = |fluxes: &[f64], [i, j]: [isize; 2], [x, y]: [isize; 2]| {
            for ((row, axis), fluxes) in rows.iter_mut().zip(axes).zip(fluxes.chunks_exact(len)) {
                let below = if *axis == 0 { [1, 0] } else { [0, 1] };
                for back in [0, 1] {
                    let [p, q] = below.map(|step| back * step);
                    row[Padded::<N>::index(i - p, j - q)] = fluxes[Padded::<N>::index(x - p, y - q)];
                }
            }
        };
        for (offset, other) in Offset::ALL.iter().zip(self.around) {
            let Some(fluxes) = other.and_then(|other| self.spread.fluxes(kind, other)) else { continue };
            ghosts::<N>(*offset, 1).for_each(|(here, there)| put(fluxes, here, there));
        }
        if let Some(fluxes) = self.spread.fluxes(kind, self.slot) {
            let n = N as isize;
            (0..n).for_each(|j| (0..n).for_each(|i| put(fluxes, [i, j], [i, j])));
        }
    }
}
