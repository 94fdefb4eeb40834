//! Components that the mass carries with it, beyond those of the two-phase models.
//!
//! One is a line in [`of`]: its name and unit in snapshots, and what it is at t = 0. The field holds ρY, conserved; what is
//! reconstructed, predicted and passed on by the mass flux is the mass fraction Y. Flux registers, prolongation, subcycling and
//! checkpoints take it from the table.

pub(crate) mod carried;
pub(crate) mod initial;

use mesh::Geometry;

use crate::initial::shapes::share_within;
use crate::{FluidSetup, Shape, Snapshot};

/// A component that the mass carries with it.
#[derive(Clone, Debug)]
pub(crate) struct Component {
    /// Its numbers in a snapshot, with name and unit: a line of [`crate::CELL_FIELDS`].
    pub field: fn(&mut Snapshot) -> &mut Vec<f64>,
    /// Where its mass fraction is 1 at t = 0; else 0.
    pub shape: Shape,
}

impl Component {
    /// Its mean mass fraction in a cell at t = 0.
    pub fn initial(&self, geometry: Geometry, centre: [f64; 2], widths: [f64; 2]) -> f64 {
        share_within(&self.shape, geometry, centre, widths)
    }
}

/// Those of a setup, in the order in which fields hold them after the model's own.
pub(crate) fn of(setup: &FluidSetup) -> Vec<Component> {
    let all = [setup.tracer.map(|shape| Component { field: |snapshot| &mut snapshot.tracer, shape })];
    all.into_iter().flatten().collect()
}
