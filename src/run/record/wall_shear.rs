//! The shear stress on the wall under a viscous fluid: on a fixed radial grid, and its peak.

use coupler::CommonRefinement;
use serde::{Deserialize, Serialize};

use super::wall_peak::WallPeak;
use crate::run::side::wall_faces::WallFaces;

/// The shear stress of the last step, σ_zr, positive where the fluid drags the wall along +r; and the largest so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WallShear {
    /// In the cells of the grid, Pa.
    means: Vec<f64>,
    /// The one of the largest magnitude, Pa.
    pub peak: WallPeak,
}

impl WallShear {
    /// Nothing yet, on a grid of so many cells.
    pub fn new(cells: usize) -> Self {
        Self { means: vec![0.0; cells], peak: WallPeak::of(0.0) }
    }

    /// Takes notice of a step that ended at `time` with these mean stresses on the faces; `map` leads from them to the grid.
    pub fn after_step(&mut self, faces: &WallFaces, map: &CommonRefinement, stresses: &[f64], time: f64) {
        map.means(true, |k| stresses[map.sub_faces()[k].first], |cell, mean| self.means[cell] = mean);
        self.peak.after_step(faces, stresses, time, |stress, peak| stress.abs() > peak.abs());
    }

    /// In the cells of the grid, Pa.
    pub fn means(&self) -> &[f64] {
        &self.means
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_is_the_largest_magnitude_with_its_sign_and_place() {
        let (faces, map) = WallFaces::two_on_three();
        let mut shear = WallShear::new(3);
        shear.after_step(&faces, &map, &[2.0, -3.0], 0.1);
        assert_eq!(shear.means(), [2.0, 2.0, -3.0]);
        shear.after_step(&faces, &map, &[2.5, 1.0], 0.2);
        assert_eq!(shear.peak, WallPeak { value: -3.0, position: 1.5, time: 0.1 });
    }
}
