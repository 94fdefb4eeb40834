//! A side's faces on the interface, which change with its mesh.

/// The faces on the interface by their outer radii, brought up to date when the mesh has changed.
#[derive(Debug)]
pub struct WallFaces {
    generation: u64,
    begin: f64,
    edges: Vec<f64>,
}

impl WallFaces {
    /// The faces that begin at `begin` and have the outer radii `edges`, of a mesh of this generation.
    pub fn new(generation: u64, begin: f64, edges: Vec<f64>) -> Self {
        Self { generation, begin, edges }
    }

    /// Two faces of 1 m, with the sub-faces that they have with three others.
    #[cfg(test)]
    pub fn two_on_three() -> (Self, coupler::CommonRefinement) {
        let faces = Self::new(0, 0.0, vec![1.0, 2.0]);
        let mut map = coupler::CommonRefinement::default();
        map.update(0.0, faces.edges(), &[0.5, 1.0, 2.0], false);
        (faces, map)
    }

    /// Asks for the radii again if the mesh is another one; says whether it was.
    pub fn update(&mut self, generation: u64, edges: impl FnOnce() -> Vec<f64>) -> bool {
        let changed = self.generation != generation;
        if changed {
            self.generation = generation;
            self.edges = edges();
        }
        changed
    }

    /// The radius at which the first face begins, m.
    pub fn begin(&self) -> f64 {
        self.begin
    }

    /// The outer radius of each face, ascending, m.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// The face that radius `r` lies in, or the last one.
    pub fn nearest(&self, r: f64) -> usize {
        self.edges.partition_point(|edge| *edge < r).min(self.edges.len() - 1)
    }

    /// Of values on the faces that on the axis: on the face that begins at r = 0, or on the one nearest to it.
    pub fn on_axis<T: Copy>(&self, values: &[T]) -> Option<T> {
        // Where round-off has moved an edge off the axis.
        let nudge = 1e-9 * self.edges.last().map_or(0.0, |end| end - self.begin);
        let face = self.edges.partition_point(|edge| *edge <= nudge).min(self.edges.len().saturating_sub(1));
        values.get(face).copied()
    }

    /// A value at radius `r` between those on the faces, linear between their centres, constant beyond the first and the
    /// last one.
    pub fn at(&self, r: f64, value: impl Fn(usize) -> f64) -> f64 {
        let edges = &self.edges;
        let centre = |k: usize| 0.5 * (edges[k] + if k == 0 { self.begin } else { edges[k - 1] });
        let last = edges.len() - 1;
        let face = self.nearest(r);
        let above = if centre(face) >= r { face } else { face + 1 };
        if above == 0 || above > last {
            return value(above.min(last));
        }
        let share = (r - centre(above - 1)) / (centre(above) - centre(above - 1));
        value(above - 1) + share * (value(above) - value(above - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_between_faces_are_linear() {
        let faces = WallFaces::new(0, 0.0, vec![1.0, 2.0, 3.0]);
        let value = |k: usize| 10.0 * (k as f64 + 0.5);
        for (r, expected) in [(1.5, 15.0), (2.0, 20.0), (0.1, 5.0), (3.0, 25.0), (1.0, 10.0), (2.75, 25.0)] {
            assert_eq!(faces.at(r, value), expected, "at {r}");
        }
        // Coarse faces next to fine ones.
        let faces = WallFaces::new(0, 0.0, vec![0.5, 1.0, 2.0]);
        assert_eq!(faces.at(1.125, |k| [0.25, 0.75, 1.5][k]), 1.125);
    }

    #[test]
    fn the_axis_is_the_face_that_begins_there() {
        let of = |begin: f64, edges: &[f64]| {
            WallFaces::new(0, begin, edges.to_vec()).on_axis(&(0..edges.len()).collect::<Vec<_>>())
        };
        assert_eq!(of(0.0, &[1.0, 2.0]), Some(0));
        assert_eq!(of(-2.0, &[-1.0, -1e-17, 1.0, 2.0]), Some(2));
        assert_eq!(of(-2.0, &[-1.0, 0.5, 2.0]), Some(1));
        assert_eq!(of(3.0, &[4.0, 5.0]), Some(0));
        assert_eq!(of(-3.0, &[-2.0, -1.0]), Some(1));
        assert_eq!(of(0.0, &[]), None);
    }

    #[test]
    fn radii_are_asked_for_when_the_mesh_has_changed() {
        let mut faces = WallFaces::new(7, 0.0, vec![1.0]);
        assert!(!faces.update(7, || unreachable!("the same mesh")));
        assert!(faces.update(8, || vec![0.5, 1.0]));
        assert_eq!(faces.edges(), [0.5, 1.0]);
    }
}
