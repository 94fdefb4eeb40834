//! Where interfaces meet walls.

use mesh::{Mesh, Side};

use crate::Boundary;
use crate::state::conserved::PHI;

/// Gas fractions between which a cell beside a wall is taken to be in the interface: every interface that comes to the wall leaves such
/// cells on its way.
const WITHIN: std::ops::Range<f64> = 0.1..0.9;

/// The first cell of a block, j N + i, where an interface is at a wall.
///
/// - `kinds`: what bounds the domain; `block`: its components without ghosts.
pub(crate) fn cell_at_wall<const N: usize>(
    mesh: &Mesh<N>,
    slot: usize,
    kinds: [Boundary; 4],
    block: &[f64],
) -> Option<usize> {
    let phi = &block[PHI * N * N..(PHI + 1) * N * N];
    Side::ALL
        .into_iter()
        .filter(|side| kinds[*side as usize].is_wall() && mesh.touches(slot, *side))
        .flat_map(|side| {
            (0..N).map(move |along| match side {
                Side::ZMin => along * N,
                Side::ZMax => along * N + N - 1,
                Side::RMin => along,
                Side::RMax => (N - 1) * N + along,
            })
        })
        .find(|cell| WITHIN.contains(&phi[*cell]))
}
