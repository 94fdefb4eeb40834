//! Components that the mass, or the gas's, carries with it, beyond those of the two-phase models.
//!
//! One is a line in [`ALL`]: its name, that of its field in snapshots, and where the setup says that it is at t = 0. The field holds
//! ρY, conserved; what is reconstructed, predicted and passed on by the mass flux is the mass fraction Y. Flux registers, prolongation,
//! subcycling, checkpoints, snapshots and the summary take it from the table.

pub(crate) mod carried;
pub(crate) mod initial;

use mesh::Geometry;

use crate::initial::shapes::share_within;
use crate::{FluidSetup, Shape, Snapshot};

/// Where a component is at t = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Start {
    /// Its mass fraction is 1 within and 0 beyond.
    Within(Shape),
    /// It is this part of the gas's mass, and the gas carries it.
    PartOfGas(f64),
}

/// Where a setup has a component at t = 0, if it has it.
type Place = fn(&FluidSetup) -> Option<Start>;

/// Its numbers in a snapshot.
type Values = fn(&mut Snapshot) -> &mut Vec<f64>;

/// All that there may be, by the names of their fields.
const ALL: [(&str, Place, Values); 2] = [
    ("tracer", |setup| setup.tracer.map(Start::Within), |snapshot| &mut snapshot.tracer),
    (VAPOUR, vapour, |snapshot| &mut snapshot.vapour),
];

/// The name of the vapour's component.
const VAPOUR: &str = "vapour";

/// Where the gas changes phase its vapour has a mass of its own.
fn vapour(setup: &FluidSetup) -> Option<Start> {
    setup.phase_change.map(|change| Start::PartOfGas(change.vapour_fraction))
}

/// A component that the mass, or the gas's, carries with it.
#[derive(Clone, Debug)]
pub(crate) struct Component {
    pub name: &'static str,
    /// Where it is at t = 0.
    start: Start,
    pub values: Values,
}

impl Component {
    /// Its mean mass per volume in a cell at t = 0, kg/m³.
    ///
    /// - `masses`: ρ and m_g, kg/m³.
    pub fn initial(
        &self,
        geometry: Geometry,
        (centre, widths): ([f64; 2], [f64; 2]),
        [density, gas]: [f64; 2],
    ) -> f64 {
        match &self.start {
            Start::Within(shape) => share_within(shape, geometry, centre, widths) * density,
            Start::PartOfGas(part) => part * gas,
        }
    }

    /// Whether the gas carries it, as a part of it.
    pub fn is_of_gas(&self) -> bool {
        matches!(self.start, Start::PartOfGas(_))
    }
}

/// Those of a setup, in the order in which fields hold them after the model's own.
pub(crate) fn of(setup: &FluidSetup) -> Vec<Component> {
    let has = |(name, place, values): (&'static str, Place, Values)| {
        Some(Component { name, start: place(setup)?, values })
    };
    ALL.into_iter().filter_map(has).collect()
}

/// The number of the vapour among them.
pub(crate) fn vapour_among(carried: &[Component]) -> Option<usize> {
    carried.iter().position(|component| component.name == VAPOUR)
}

/// Whether a field of snapshots is that of a component, which not all fluids have.
pub(crate) fn is_component(field: &str) -> bool {
    ALL.iter().any(|(name, ..)| *name == field)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CELL_FIELDS;

    #[test]
    fn the_field_of_a_component_has_its_numbers() {
        for (name, _, values) in ALL {
            let mut snapshot = Snapshot::default();
            values(&mut snapshot).extend([0.25, 0.75]);
            let field = CELL_FIELDS.iter().find(|field| field.name == name).expect(name);
            let mut list = Vec::new();
            field.add(&snapshot, 0..2, &mut list);
            assert_eq!(list, [0.25, 0.75], "{name}");
        }
    }
}
