//! What a case's numbers are measured by: cells over the bubble, and the time over which the wall pressure is averaged.

use std::f64::consts::PI;

use fluid::{BubbleCuts, Phase, Shape};
use mesh::Geometry;

use super::Case;

/// The part of R/c, the time that sound takes along the radius, over which the wall pressure is averaged where a case does not say.
const MEAN_SHARE: f64 = 1.0 / 12.0;

impl Case {
    /// Finest fluid cells along the radius of the first region at the start, by their larger width; `None` unless that is a ball of gas.
    pub fn cells_per_radius(&self) -> Option<f64> {
        let fluid = self.fluid.as_ref()?;
        let region = fluid.initial.regions.first().filter(|region| region.state.phase == Phase::Gas)?;
        let Shape::Sphere { radius, .. } = region.shape else { return None };
        Some(radius / fluid.first_cell())
    }

    /// The same where the bubble is smallest, on the level that the grid has about it then; `None` also where several are in the fluid.
    ///
    /// - `first`, `smallest`: equivalent radius of all gas at the start and then, m.
    pub fn cells_per_smallest_radius(&self, first: f64, smallest: f64) -> Option<f64> {
        let fluid = self.fluid.as_ref().filter(|fluid| BubbleCuts::of(&fluid.initial).bubbles() < 2)?;
        let finer = fluid.level_about(smallest) as f64 - fluid.first_level() as f64;
        Some(self.cells_per_radius()? * smallest / first * finer.exp2())
    }

    /// Over how long the wall pressure's running mean is taken, s: `output.mean_time`, else R/(12 c) with the equivalent radius R of the
    /// first gas region and the sound speed c of the ambient liquid; `None` where there is neither.
    pub fn mean_time(&self) -> Option<f64> {
        self.output.mean_time.or_else(|| {
            let fluid = self.fluid.as_ref()?;
            let ambient = &fluid.initial.ambient;
            let mut gas = fluid.initial.regions.iter().filter(|region| region.state.phase == Phase::Gas);
            let radius = equivalent_radius(self.geometry, gas.next()?.shape);
            let sound = fluid.ambient_sound();
            (ambient.phase == Phase::Liquid).then_some(MEAN_SHARE * radius / sound)
        })
    }
}

/// (3V/4π)^(1/3) of a region as it is painted, m; in the plane (A/π)^(1/2).
fn equivalent_radius(geometry: Geometry, shape: Shape) -> f64 {
    match (shape, geometry) {
        (Shape::Sphere { radius, .. }, _) => radius,
        (Shape::Box { z, r }, Geometry::Axisymmetric) => {
            (0.75 * (z[1] - z[0]) * (r[1] * r[1] - r[0] * r[0])).cbrt()
        }
        (Shape::Box { z, r }, Geometry::Planar) => ((z[1] - z[0]) * (r[1] - r[0]) / PI).sqrt(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use crate::case::fixture::of_two_levels as case;

    #[test]
    fn cells_are_counted_along_the_radius_of_a_ball_of_gas() {
        assert!((case(&[]).cells_per_radius().unwrap() - 12.8).abs() < 1e-12);
        // The wider of two widths counts.
        assert!((case(&["fluid.cells=[16, 8]"]).cells_per_radius().unwrap() - 6.4).abs() < 1e-12);
        assert_eq!(
            case(&["fluid.region.0.phase=liquid", "fluid.region.0.density=1000"]).cells_per_radius(),
            None
        );
        assert_eq!(case(&["fluid.region=[]"]).cells_per_radius(), None);
    }

    #[test]
    fn the_wall_pressure_is_averaged_over_a_twelfth_of_the_time_that_sound_takes_over_a_radius() {
        // c = 1581.929 m/s.
        let expected = 0.002 / (12.0 * 1581.929);
        assert!((case(&[]).mean_time().unwrap() / expected - 1.0).abs() < 1e-6);
        assert_eq!(case(&["output.mean_time=3e-7"]).mean_time(), Some(3e-7));
        assert_eq!(case(&["fluid.region=[]"]).mean_time(), None);
        let flat = "fluid.region=[{ shape = \"box\", z = [0.002, 0.004], r = [0, 0.001], phase = \"gas\", density = 1, pressure = 1e5 }]";
        let ratio = case(&[flat]).mean_time().unwrap() / expected * 2.0;
        assert!((ratio - 1.5_f64.cbrt()).abs() < 1e-5, "{ratio}: V = 2π, in cubic millimetres");
    }
}
