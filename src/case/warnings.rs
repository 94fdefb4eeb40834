//! What is allowed but probably not meant.

use fluid::{Boundary, Phase, Shape};
use mesh::{Geometry, Side};

use super::{Case, FluidCase, LoadCase, implausible};

/// Fewer cells than this along a radius or a width resolve nothing.
const RESOLVED: f64 = 4.0;
/// The unsplit step takes the fluxes of both directions at once: with square cells the sum of the two CFL numbers
/// must stay below one.
pub(super) const SAFE_CFL: f64 = 0.5;

/// Sides with a far field nearer than so many radii of the bubble are too near, see docs/verification/distant-sides.md.
const FAR_FIELD_RADII: f64 = 3.0;
/// A side that holds the incoming characteristic lacks a pressure of ρc times the velocity there. Against what drives the
/// collapse that is about c/√(Δp/ρ) (R/s)²; beyond this share it matters.
const HELD_UP: f64 = 0.02;
/// How much later a bubble collapses than in unbounded liquid, of that share: 0.08 to 0.14 from 1e5 to 5e6 Pa.
const LATE: f64 = 0.1;

impl Case {
    /// What was left aside in reading, and what is allowed but probably not meant.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = self.notes.clone();
        if self.time.cfl > SAFE_CFL {
            warnings.push(format!(
                "time.cfl = {:?} is above {SAFE_CFL}: both directions add up in the unsplit step, so with \
                 square cells it is {SAFE_CFL}",
                self.time.cfl
            ));
        }
        if let Some(LoadCase::Recorded(load)) = self.coupling.load.as_ref().filter(|_| self.fluid.is_none())
            && !load.is_whole()
        {
            warnings.push(format!(
                "coupling.load.run: the run in {} has not reached its end; its load ends at {:?} s, and the last pressure stays",
                load.run().display(),
                load.end()
            ));
        }
        if let Some(fluid) = &self.fluid {
            fluid_warnings(fluid, self.geometry, &mut warnings);
            near_sides(fluid, self.geometry, &mut warnings);
            across_periodic_sides(fluid, &mut warnings);
            implausible::fluid(fluid, &mut warnings);
            if fluid.boundary[Side::ZMax as usize] == Boundary::Wall
                && !fluid.boundary[Side::ZMin as usize].is_wall()
            {
                warnings.push(
                    "fluid.boundary.z_max is a wall and z_min is none: pressures on a wall and jets towards it are \
                     recorded at z_min alone; turn the case over"
                        .to_owned(),
                );
            }
        }
        if let Some(solid) = &self.solid {
            implausible::solid(solid, self.ambient_pressure(), &mut warnings);
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
    let widest = fluid.first_cell();
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

/// Regions that reach across a periodic side: nothing of them comes in at the other one.
fn across_periodic_sides(fluid: &FluidCase, warnings: &mut Vec<String>) {
    for (number, region) in fluid.initial.regions.iter().enumerate() {
        let reach = match region.shape {
            Shape::Sphere { centre, radius } => centre.map(|middle| [middle - radius, middle + radius]),
            Shape::Box { z, r } => [z, r],
        };
        for (key, side) in Side::NAMES {
            let axis = side.axis_across();
            let [begin, end] = [fluid.grid.z, fluid.grid.r][axis];
            let across = [reach[axis][0] < begin, reach[axis][1] > end];
            let here = usize::from(matches!(side, Side::ZMax | Side::RMax));
            // What reaches across both fills the width.
            if fluid.boundary[side as usize] == Boundary::Periodic && across[here] && !across[1 - here] {
                warnings.push(format!(
                    "fluid.region.{number} reaches across fluid.boundary.{key}, which is periodic, and is cut off there: give it again as \
                     another region, {:?} m away, for what comes in on the other side",
                    end - begin
                ));
            }
        }
    }
}

/// Sides that are too near for what they hold while bubbles collapse.
fn near_sides(fluid: &FluidCase, geometry: Geometry, warnings: &mut Vec<String>) {
    let ambient = &fluid.initial.ambient;
    if ambient.phase != Phase::Liquid {
        return;
    }
    let sound = fluid.ambient_sound();
    for (number, region) in fluid.initial.regions.iter().enumerate() {
        let Shape::Sphere { centre: [z, r], radius } = region.shape else { continue };
        if region.state.phase != Phase::Gas {
            continue;
        }
        let driving = (fluid.ambient_at(z).pressure - region.state.pressure).abs();
        for (key, side) in Side::NAMES {
            let distance = match side {
                Side::ZMin => z - fluid.grid.z[0],
                Side::ZMax => fluid.grid.z[1] - z,
                Side::RMin => r - fluid.grid.r[0],
                Side::RMax => fluid.grid.r[1] - r,
            };
            let radii = distance / radius;
            let where_it_is = format!("fluid.boundary.{key} is {radii:.1} radii from fluid.region.{number}");
            match fluid.boundary[side as usize] {
                Boundary::FarField if radii < FAR_FIELD_RADII => warnings.push(format!(
                    "{where_it_is}: nearer than {FAR_FIELD_RADII} radii its far field is a point source's, and \
                     pressures on the wall are off by some per cent"
                )),
                // Gas at the ambient pressure draws nothing.
                Boundary::NonReflecting if driving > 0.0 => {
                    let held = sound / (driving / ambient.density).sqrt() / (radii * radii);
                    if held > HELD_UP {
                        let enough = radii * (held / HELD_UP).sqrt();
                        // A far field knows of no gravity.
                        let otherwise = match geometry {
                            Geometry::Axisymmetric if fluid.gravity.is_none() => {
                                "make it \"far-field\", or move it"
                            }
                            _ => "move it",
                        };
                        // How late a cylinder is follows another law.
                        let late = match geometry {
                            Geometry::Axisymmetric => format!("about {:.0} % late", (100.0 * LATE * held).ceil()),
                            Geometry::Planar => "late".to_owned(),
                        };
                        warnings.push(format!(
                            "{where_it_is} and \"non-reflecting\": it holds the flow to the bubble up, which collapses \
                             {late}; {otherwise} to {enough:.0} radii"
                        ));
                    }
                }
                _ => {}
            }
        }
    }
}

fn unresolved(what: &str, length: &str, cells: f64, warnings: &mut Vec<String>) {
    if cells < RESOLVED {
        warnings.push(format!("{what}: only {cells:.1} cells per {length}; raise `levels` or `cells`"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_reaches_across_a_periodic_side_is_warned_of_unless_it_fills_the_width() {
        let case = |region: &str| {
            let text = format!(
                "geometry = \"planar\"\n[time]\nend = 1e-7\n[coupling]\nscheme = \"none\"\n[fluid]\nz = [0.0, 1e-3]\nr = [-5e-4, 5e-4]\ncells = [32, 32]\n\
                 [fluid.liquid]\ngamma = 7.15\npi = 3e8\n[fluid.gas]\ngamma = 1.4\npi = 0.0\n\
                 [fluid.ambient]\ndensity = 1000.0\npressure = 1e5\n\
                 [fluid.boundary]\nr_min = \"periodic\"\nr_max = \"periodic\"\n\
                 [[fluid.region]]\nphase = \"gas\"\ndensity = 1.2\npressure = 1e5\n{region}\n"
            );
            Case::from_toml(&text, "periodic", &[]).unwrap_or_else(|errors| panic!("{errors}")).warnings()
        };
        let said = |warnings: Vec<String>| {
            warnings.iter().filter(|words| words.contains("is cut off there")).count()
        };
        let across = case("shape = \"sphere\"\ncentre = [5e-4, 4e-4]\nradius = 2e-4");
        assert!(
            across
                .iter()
                .any(|words| words.contains("fluid.boundary.r_max") && words.contains("0.001 m away")),
            "{across:?}"
        );
        assert_eq!(said(across), 1);
        assert_eq!(said(case("shape = \"sphere\"\ncentre = [5e-4, 1e-4]\nradius = 2e-4")), 0);
        assert_eq!(said(case("shape = \"box\"\nz = [5e-4, 1e-3]\nr = [-1.0, 1.0]")), 0);
        assert_eq!(said(case("shape = \"box\"\nz = [5e-4, 1e-3]\nr = [-1.0, 0.0]")), 1);
    }
}
