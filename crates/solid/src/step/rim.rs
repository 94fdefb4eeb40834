//! Star states on the outer faces of a tile: what is registered and reported of a step.

use mesh::{Frame, GHOSTS, Side, Tile};

use crate::step::rows::FaceRows;

/// v_n, v_t, σ_nn, σ_nt along each side of a tile, in the order of [`Side::ALL`].
#[derive(Clone, Debug)]
pub(crate) struct Rim([[[f64; Tile::MOST_CELLS]; 4]; 4]);

impl Rim {
    pub const fn zeros() -> Self {
        Self([[[0.0; Tile::MOST_CELLS]; 4]; 4])
    }

    /// Along a side of a tile that is one of a block's, too: of those N faces.
    ///
    /// - `place`: of the block in the tile.
    pub fn of_block<const N: usize>(&self, side: Side, place: [usize; 2]) -> [&[f64; N]; 4] {
        let first = place[1 - side.axis_across()] * N;
        self.0[side as usize].each_ref().map(|row| row[first..].first_chunk().expect("tiles are no longer"))
    }

    /// Takes what rows of a whole block hold.
    pub fn take_block(&mut self, frame: Frame, z_faces: &FaceRows, r_faces: &FaceRows) {
        let last = frame.cells() as isize - 1;
        for side in Side::ALL {
            let faces = if side.axis_across() == 0 { z_faces } else { r_faces };
            for along in 0..=last {
                let k = match side {
                    Side::ZMin => frame.index(-1, along),
                    Side::ZMax => frame.index(last, along),
                    Side::RMin => frame.index(along, -1),
                    Side::RMax => frame.index(along, last),
                };
                let rows = [&faces.v_n, &faces.v_t, &faces.s_nn, &faces.s_nt];
                for (own, row) in self.0[side as usize].iter_mut().zip(rows) {
                    own[along as usize] = row[k];
                }
            }
        }
    }

    /// Takes what two rows of a tile of n × n cells hold, the ghosts below the first row of cells and that one, and so on.
    ///
    /// - `z_faces`: of both rows; `r_faces`: between them.
    #[inline(always)]
    pub fn take_strip<const L: usize>(
        &mut self,
        n: usize,
        strip: usize,
        z_faces: &[[f64; L]; 4],
        r_faces: &[[f64; Tile::MOST_CELLS]; 4],
    ) {
        let [low, high, bottom, top] = &mut self.0;
        let mut take = |at: usize, along: usize| {
            for (quantity, faces) in z_faces.iter().enumerate() {
                low[quantity][along] = faces[at + GHOSTS - 1];
                high[quantity][along] = faces[at + GHOSTS + n - 1];
            }
        };
        if strip > 0 {
            take(0, 2 * strip - 1);
        }
        if 2 * strip < n {
            take(n + 2 * GHOSTS, 2 * strip);
        }
        if strip == 0 {
            *bottom = *r_faces;
        }
        if 2 * strip == n {
            *top = *r_faces;
        }
    }
}
