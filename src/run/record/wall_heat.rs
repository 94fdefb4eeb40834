//! The heat that a wall gets, and its temperature: on a fixed radial grid, and the highest.

use coupler::CommonRefinement;
use serde::{Deserialize, Serialize};

use super::wall_peak::WallPeak;
use crate::run::side::wall_faces::WallFaces;

/// The heat flux into the wall and its temperature in the last step; and the highest temperature so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WallHeat {
    /// In the cells of the grid, W/m².
    fluxes: Vec<f64>,
    /// Likewise, K.
    temperatures: Vec<f64>,
    /// The highest temperature, K; NaN before the first step.
    pub peak: WallPeak,
}

impl WallHeat {
    /// Nothing yet, on a grid of so many cells.
    pub fn new(cells: usize) -> Self {
        let none = vec![f64::NAN; cells];
        Self { fluxes: vec![0.0; cells], temperatures: none, peak: WallPeak::of(f64::NAN) }
    }

    /// Temperatures (K) and heat fluxes (W/m²) in the cells of the grid.
    pub fn rows(&self) -> impl Iterator<Item = &f64> {
        self.temperatures.iter().chain(&self.fluxes)
    }

    /// Takes notice of a step that ended at `time` with these means on the faces; `map` leads from them to the grid.
    pub fn after_step(
        &mut self,
        faces: &WallFaces,
        map: &CommonRefinement,
        [fluxes, temperatures]: [&[f64]; 2],
        time: f64,
    ) {
        map.means(true, |k| fluxes[map.sub_faces()[k].first], |cell, mean| self.fluxes[cell] = mean);
        let put = |cell: usize, mean| self.temperatures[cell] = mean;
        map.means(true, |k| temperatures[map.sub_faces()[k].first], put);
        self.peak.after_step(faces, temperatures, time, |temperature, peak| !(temperature <= peak));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_is_the_highest_with_its_place() {
        let (faces, map) = WallFaces::two_on_three();
        let mut heat = WallHeat::new(3);
        heat.after_step(&faces, &map, [&[5.0, 7.0], &[300.0, 350.0]], 0.1);
        assert_eq!(heat.rows().copied().collect::<Vec<_>>(), [300.0, 300.0, 350.0, 5.0, 5.0, 7.0]);
        heat.after_step(&faces, &map, [&[5.0, 7.0], &[320.0, 340.0]], 0.2);
        assert_eq!(heat.peak, WallPeak { value: 350.0, position: 1.5, time: 0.1 });
    }
}
