//! The velocities that viscous stresses are made of, with what the sides of the domain make of them.

use mesh::{GHOSTS, Side};

use crate::Boundary;
use crate::boundary::axis;
use crate::state::primitive::{PHI, V_R, V_Z};
use crate::terms::TermBlock;

/// Cells of which so much is of one phase are not mixed.
const ONE_PHASE: f64 = 1e-6;

/// Padded rows of v_z and v_r, m/s.
pub(super) struct Velocities<'a> {
    pub v_z: &'a mut [f64],
    pub v_r: &'a mut [f64],
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
        let stride = block.metric.stride;
        let phi = block.before[PHI];
        if phi.iter().any(|phi| *phi != 0.0) {
            // Mixed cells of the five-equation model have no state at mid-step, but on their faces. Whether a cell is one must not depend
            // on the block that sees it.
            let is_beside_another = |k: usize| {
                [k - 1, k + 1, k - stride, k + stride].iter().any(|n| (phi[*n] - phi[k]).abs() > 0.5)
            };
            for k in stride + 1..phi.len() - stride - 1 {
                if (phi[k] > ONE_PHASE && phi[k] < 1.0 - ONE_PHASE) || is_beside_another(k) {
                    (self.v_z[k], self.v_r[k]) = (block.before[V_Z][k], block.before[V_R][k]);
                }
            }
        }
        // r first, as where ghosts are filled: the z sides complete the corners.
        for side in [Side::RMin, Side::RMax, Side::ZMin, Side::ZMax] {
            if let Some(kind) = block.sides[side as usize] {
                self.complete(side, kind, block);
            }
        }
    }

    fn complete(&mut self, side: Side, kind: Boundary, block: &TermBlock<'_>) {
        let n = block.cells as isize;
        let (stride, ghosts) = (block.metric.stride as isize, GHOSTS as isize);
        let at = |depth: isize, along: isize| {
            let [i, j] = match side {
                Side::ZMin => [depth, along],
                Side::ZMax => [n - 1 - depth, along],
                Side::RMin => [along, depth],
                Side::RMax => [along, n - 1 - depth],
            };
            (block.metric.origin as isize + j * stride + i) as usize
        };
        let rows = [&mut *self.v_z, &mut *self.v_r];
        for (component, row) in rows.into_iter().enumerate() {
            let is_normal = component == axis(side);
            for along in -ghosts..n + ghosts {
                // The wall's own velocity, twice.
                let wall = block.wall.filter(|_| kind == Boundary::Interface).map_or(0.0, |wall| {
                    let state = &wall[along.clamp(0, n - 1) as usize];
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
