//! What the far field remembers: the impulse of the pressure on each face of the open sides.

use mesh::{BlockId, Mesh, Side};
use serde::{Deserialize, Serialize};

/// J = ∫p' dt on the faces of the finest level along the four sides, Pa s; none along sides that have no far field.
///
/// A coarser face sees the mean of those that it consists of and adds to all of them alike: a grid that adapts has nothing to
/// do here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SideImpulses {
    finest: u8,
    values: [Vec<f64>; 4],
}

impl SideImpulses {
    /// Filled with what `initial` says of the faces of the finest level (side, centre), or none of it.
    pub fn new<const N: usize>(
        mesh: &Mesh<N>,
        has_far_field: impl Fn(Side) -> bool,
        initial: impl Fn(Side, usize, [f64; 2]) -> f64,
    ) -> Self {
        let finest = mesh.tree().finest();
        let values = Side::ALL.map(|side| {
            let faces = if has_far_field(side) { faces_along(mesh, side) } else { 0 };
            (0..faces).map(|along| initial(side, along, face_centre(mesh, side, finest, along))).collect()
        });
        Self { finest, values }
    }

    /// Whether it is that of a mesh whose sides have these far fields.
    pub fn fits<const N: usize>(&self, mesh: &Mesh<N>, has_far_field: impl Fn(Side) -> bool) -> bool {
        let faces = |side: Side| if has_far_field(side) { faces_along(mesh, side) } else { 0 };
        self.finest == mesh.tree().finest()
            && Side::ALL.into_iter().all(|side| self.values[side as usize].len() == faces(side))
    }

    /// Of the face number `along` of a level on a side.
    pub fn at(&self, side: Side, level: u8, along: usize) -> f64 {
        let faces = self.faces(level, along);
        let count = faces.len() as f64;
        self.values[side as usize][faces].iter().sum::<f64>() / count
    }

    /// Adds what a face has gained.
    pub fn add(&mut self, side: Side, level: u8, along: usize, gain: f64) {
        let faces = self.faces(level, along);
        self.values[side as usize][faces].iter_mut().for_each(|value| *value += gain);
    }

    fn faces(&self, level: u8, along: usize) -> std::ops::Range<usize> {
        let halvings = self.finest - level;
        along << halvings..(along + 1) << halvings
    }
}

/// Faces of the finest level along a side.
fn faces_along<const N: usize>(mesh: &Mesh<N>, side: Side) -> usize {
    let blocks = mesh.tree().blocks_on(mesh.tree().finest());
    let axis = usize::from(matches!(side, Side::ZMin | Side::ZMax));
    blocks[axis] as usize * N
}

/// The number along a side of the first face of a block.
pub(crate) fn first_face<const N: usize>(id: BlockId, side: Side) -> usize {
    (if matches!(side, Side::ZMin | Side::ZMax) { id.j } else { id.i }) as usize * N
}

/// The centre (z, r) of the face number `along` of a level on a side, m.
pub(crate) fn face_centre<const N: usize>(mesh: &Mesh<N>, side: Side, level: u8, along: usize) -> [f64; 2] {
    let (domain, widths) = (mesh.domain(), mesh.widths(level));
    let at = |low: f64, axis: usize| low + (along as f64 + 0.5) * widths[axis];
    match side {
        Side::ZMin => [domain.z[0], at(domain.r[0], 1)],
        Side::ZMax => [domain.z[1], at(domain.r[0], 1)],
        Side::RMin => [at(domain.z[0], 0), domain.r[0]],
        Side::RMax => [at(domain.z[0], 0), domain.r[1]],
    }
}
