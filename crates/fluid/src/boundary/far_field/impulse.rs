//! What the far field remembers: the impulse of the pressure on each face of the open sides.

use mesh::{Mesh, Side, SideFaces};
use serde::{Deserialize, Serialize};

/// J = ∫p' dt on the faces of the finest level along the four sides, Pa s; none along sides that have no far field.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SideImpulses([SideFaces<f64>; 4]);

impl SideImpulses {
    /// Filled with what `initial` says of the faces of the finest level (side, number along it, centre).
    pub fn new<const N: usize>(
        mesh: &Mesh<N>,
        has_far_field: impl Fn(Side) -> bool,
        initial: impl Fn(Side, usize, [f64; 2]) -> f64,
    ) -> Self {
        let finest = mesh.tree().finest();
        let of = |side, along| initial(side, along, face_centre(mesh, side, finest, along));
        Self(SideFaces::along_sides(mesh, has_far_field, of))
    }

    /// Whether it is of the same faces as another one.
    pub fn fits(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(own, other)| own.has_shape_of(other))
    }

    /// Of the face number `along` of a level on a side.
    pub fn at(&self, side: Side, level: u8, along: usize) -> f64 {
        let faces = self.0[side as usize].of(level, along);
        faces.iter().sum::<f64>() / faces.len() as f64
    }

    /// Adds what a face has gained.
    pub fn add(&mut self, side: Side, level: u8, along: usize, gain: f64) {
        self.0[side as usize].of_mut(level, along).iter_mut().for_each(|value| *value += gain);
    }
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
