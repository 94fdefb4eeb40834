//! What an open side holds: the initial state on its faces, and in the cells within.

use mesh::{Mesh, Side, SideStates};

use crate::ElasticState;
use crate::initial::InitialState;

/// How many cells within a side know their initial state.
const DEPTH: usize = 4;

/// The initial state at a cell along a side.
///
/// A stress at rest may change towards the side, as the solid's own weight and what presses on its surface make it. What leaves over the
/// side is what has changed in each cell; what is beyond is the state on the face. What is not at rest does not count: a
/// gradient that nothing balances, held for ever, would push the solid for ever.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Held {
    /// On the face: that of the cell, and half of how what rests differs from the next one within.
    pub face: ElasticState,
    /// In the cell and those behind it: that of the cell, and how what rests differs from it.
    pub cells: [ElasticState; DEPTH],
}

impl Held {
    /// Along all sides.
    ///
    /// - `initial`: the state at a cell's centre (z, r); `at_rest`: what of its stresses is in equilibrium with weight and surface, and
    ///   may differ from cell to cell.
    pub fn along_sides<const N: usize>(
        mesh: &Mesh<N>,
        initial: &InitialState<'_>,
        at_rest: &InitialState<'_>,
    ) -> SideStates<Self> {
        const { assert!(N >= DEPTH) };
        SideStates::new(mesh, |side, centre, widths| {
            let axis = side.axis_across();
            let inwards = if matches!(side, Side::ZMin | Side::RMin) { widths[axis] } else { -widths[axis] };
            let rest: [[f64; 6]; DEPTH] = std::array::from_fn(|depth| {
                let mut point = centre;
                point[axis] += depth as f64 * inwards;
                at_rest(point).to_array()
            });
            let own = initial(centre).to_array();
            let with = |part: f64, other: usize| {
                ElasticState::from_array(std::array::from_fn(|c| {
                    own[c] + part * (rest[other][c] - rest[0][c])
                }))
            };
            Self { face: with(-0.5, 1), cells: std::array::from_fn(|depth| with(1.0, depth)) }
        })
    }
}
