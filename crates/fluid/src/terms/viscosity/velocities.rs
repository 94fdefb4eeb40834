//! The velocities that viscous stresses are made of, with what the sides of the domain make of them.

use mesh::{FaceState, GHOSTS, Side};

use crate::Boundary;
use crate::boundary::axis;
use crate::state::primitive::{V_R, V_Z};
use crate::terms::{TermBlock, for_cells_without_mid_step};

/// Padded rows of v_z and v_r, m/s.
pub(super) struct Velocities<'a> {
    pub v_z: &'a mut [f64],
    pub v_r: &'a mut [f64],
}

/// The sides of the domain that a block touches, and where its padded cells are.
pub(super) struct Sides<'a> {
    pub cells: usize,
    pub origin: usize,
    pub stride: usize,
    pub kinds: [Option<Boundary>; 4],
    /// See [`TermBlock::wall`].
    pub wall: Option<&'a [FaceState]>,
}

impl Velocities<'_> {
    /// Takes the velocities of a block; beyond the sides of the domain those with which the face between has the side's own:
    ///
    /// - on the axis and planes of symmetry the mirror images;
    /// - at walls the opposite ones, so that the fluid sticks to them; at the wall to the solid about that one's velocity;
    /// - on open sides those of the cells within: no gradient.
    pub fn gather(mut self, block: &TermBlock<'_>) {
        let rows = [(&mut *self.v_z, V_Z), (&mut *self.v_r, V_R)];
        for (row, component) in rows {
            row.copy_from_slice(block.state[component]);
        }
        for_cells_without_mid_step(block, |k| {
            (self.v_z[k], self.v_r[k]) = (block.before[V_Z][k], block.before[V_R][k]);
        });
        let sides = Sides {
            cells: block.cells,
            origin: block.metric.origin,
            stride: block.metric.stride,
            kinds: block.sides,
            wall: block.wall,
        };
        self.complete_all(&sides);
    }

    /// Makes the velocities beyond the sides of the domain.
    pub fn complete_all(&mut self, sides: &Sides<'_>) {
        // r first, as where ghosts are filled: the z sides complete the corners.
        for side in Side::FOR_GHOSTS {
            if let Some(kind) = sides.kinds[side as usize] {
                self.complete(side, kind, sides);
            }
        }
    }

    fn complete(&mut self, side: Side, kind: Boundary, sides: &Sides<'_>) {
        let n = sides.cells as isize;
        let (stride, ghosts) = (sides.stride as isize, GHOSTS as isize);
        let at = |depth: isize, along: isize| {
            let [i, j] = match side {
                Side::ZMin => [depth, along],
                Side::ZMax => [n - 1 - depth, along],
                Side::RMin => [along, depth],
                Side::RMax => [along, n - 1 - depth],
            };
            (sides.origin as isize + j * stride + i) as usize
        };
        let rows = [&mut *self.v_z, &mut *self.v_r];
        for (component, row) in rows.into_iter().enumerate() {
            let is_normal = component == axis(side);
            for along in -ghosts..n + ghosts {
                // The wall's own velocity, twice.
                let wall = sides.wall.filter(|_| kind == Boundary::Interface).map_or(0.0, |wall| {
                    let state = &wall[(along + ghosts) as usize];
                    2.0 * if is_normal { state.velocity } else { state.tangential_velocity }
                });
                for depth in 0..ghosts {
                    let inner = row[at(depth, along)];
                    row[at(-1 - depth, along)] = match kind {
                        Boundary::Axis | Boundary::Symmetry => {
                            if is_normal {
                                -inner
                            } else {
                                inner
                            }
                        }
                        Boundary::Wall => -inner,
                        Boundary::Interface => wall - inner,
                        Boundary::NonReflecting | Boundary::FarField | Boundary::Inflow => row[at(0, along)],
                        Boundary::Periodic => unreachable!("a periodic side has neighbours"),
                    };
                }
            }
        }
    }
}
