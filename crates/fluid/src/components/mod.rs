//! Components that the mass carries with it, beyond those of the two-phase models.
//!
//! One is a line in [`ALL`]: its name, that of its field in snapshots, and where the setup says that it is at t = 0. The field holds
//! ρY, conserved; what is reconstructed, predicted and passed on by the mass flux is the mass fraction Y. Flux registers, prolongation,
//! subcycling, checkpoints, snapshots and the summary take it from the table.

pub(crate) mod carried;
pub(crate) mod initial;

use mesh::Geometry;

use crate::initial::shapes::share_within;
use crate::{CELL_FIELDS, FluidSetup, Shape, Snapshot};

/// Where a setup has a component at t = 0, if it has it.
type Place = fn(&FluidSetup) -> Option<Shape>;

/// All that there may be, by the names of their fields.
const ALL: [(&str, Place); 1] = [("tracer", |setup| setup.tracer)];

/// A component that the mass carries with it.
#[derive(Clone, Debug)]
pub(crate) struct Component {
    pub name: &'static str,
    /// Where its mass fraction is 1 at t = 0; else 0.
    shape: Shape,
}

impl Component {
    /// Its mean mass fraction in a cell at t = 0.
    pub fn initial(&self, geometry: Geometry, centre: [f64; 2], widths: [f64; 2]) -> f64 {
        share_within(&self.shape, geometry, centre, widths)
    }

    /// Its numbers in a snapshot.
    pub fn values<'a>(&self, snapshot: &'a mut Snapshot) -> &'a mut Vec<f64> {
        let field = CELL_FIELDS.iter().find(|field| field.name == self.name);
        (field.expect("a component has a field of its name").values)(snapshot)
    }
}

/// Those of a setup, in the order in which fields hold them after the model's own.
pub(crate) fn of(setup: &FluidSetup) -> Vec<Component> {
    let has = |(name, place): (&'static str, Place)| Some(Component { name, shape: place(setup)? });
    ALL.into_iter().filter_map(has).collect()
}

/// Whether a field of snapshots is that of a component, which not all fluids have.
pub(crate) fn is_component(field: &str) -> bool {
    ALL.iter().any(|(name, _)| *name == field)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_component_has_a_field() {
        for (name, _) in ALL {
            let shape = Shape::Sphere { centre: [0.0, 0.0], radius: 1.0 };
            assert!(Component { name, shape }.values(&mut Snapshot::default()).is_empty());
        }
    }
}
