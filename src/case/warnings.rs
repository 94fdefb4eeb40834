//! What is allowed but probably not meant.

use fluid::{Phase, Shape};
use mesh::Geometry;

use super::{Case, FluidCase};

/// Fewer cells than this along a radius or a width resolve nothing.
const RESOLVED: f64 = 4.0;
/// The unsplit step takes the fluxes of both directions at once: with square cells the sum of the two CFL numbers
/// must stay below one.
pub(super) const SAFE_CFL: f64 = 0.5;

impl Case {
    /// What was left aside in reading, and what is allowed but probably not meant.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = self.notes.clone();
        if self.time.cfl > SAFE_CFL {
            warnings.push(format!(
                "time.cfl = {:?} is above {SAFE_CFL}: both directions add up in the unsplit step, \
                 which may become unstable",
                self.time.cfl
            ));
        }
        if let Some(fluid) = &self.fluid {
            fluid_warnings(fluid, self.geometry, &mut warnings);
        }
        if let Some(solid) = &self.solid {
            let [h_z, h_r] = solid.grid.cell_size();
            for (number, pulse) in solid.pulses.iter().enumerate() {
                unresolved(
                    &format!("solid.pulse.{number}"),
                    "width",
                    pulse.width / h_z.max(h_r),
                    &mut warnings,
                );
            }
        }
        warnings
    }
}

fn fluid_warnings(fluid: &FluidCase, geometry: Geometry, warnings: &mut Vec<String>) {
    let [h_z, h_r] = fluid.grid.cell_size();
    let widest = h_z.max(h_r);
    let initial = &fluid.initial;
    for (number, region) in initial.regions.iter().enumerate() {
        if let Shape::Sphere { radius, .. } = region.shape {
            unresolved(&format!("fluid.region.{number}"), "radius", radius / widest, warnings);
        }
    }
    for (number, pulse) in initial.pulses.iter().enumerate() {
        unresolved(&format!("fluid.pulse.{number}"), "width", pulse.width / widest, warnings);
        if initial.ambient.phase == Phase::Gas {
            warnings
                .push(format!("fluid.pulse.{number}: pulses act on liquid, but the ambient phase is gas"));
        }
    }
    if geometry == Geometry::Axisymmetric && initial.ambient.velocity[1] != 0.0 {
        warnings.push("fluid.ambient.velocity has a radial part, which is singular at the axis".to_owned());
    }
}

fn unresolved(what: &str, length: &str, cells: f64, warnings: &mut Vec<String>) {
    if cells < RESOLVED {
        warnings.push(format!("{what}: only {cells:.1} cells per {length}; raise `levels` or `cells`"));
    }
}
