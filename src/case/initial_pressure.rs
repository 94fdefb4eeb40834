//! `fluid.initial_pressure`: whether the case has the field that it asks for.

use fluid::{Boundary, InitialCondition, InitialPressure, RayleighError, RayleighField};
use mesh::Side;

use super::reader::{Faults, Given};
use super::shared::Context;
use super::{GridCase, index};

/// Records why the case cannot begin with Rayleigh's pressure, if that is what it asks for.
pub(super) fn check(
    given: Option<&Given<InitialPressure>>,
    initial: &InitialCondition,
    grid: &GridCase,
    boundary: [Boundary; 4],
    context: Context,
    faults: &mut Faults,
) {
    let Some(given) = given.filter(|given| given.value == InitialPressure::Rayleigh) else { return };
    // A faulty scheme has been told of; what is at z_min is unknown then.
    if context.scheme.is_none() {
        return;
    }
    let side = boundary[index(Side::ZMin)];
    if let Err(error) = RayleighField::of(initial, context.geometry, grid.z[0], side) {
        faults.of(given, format!("\"rayleigh\" does not go with this case: {error}"), remedy(error));
    }
}

fn remedy(error: RayleighError) -> String {
    let otherwise = |what: &str| format!("{what}, or take initial_pressure = \"uniform\"");
    match error {
        RayleighError::Planar => otherwise("take geometry = \"axisymmetric\""),
        RayleighError::GasAmbient => otherwise("make the ambient phase \"liquid\""),
        RayleighError::NoGas => {
            otherwise("add a [[fluid.region]] with shape = \"sphere\" and phase = \"gas\"")
        }
        RayleighError::NotASphere { region } => {
            otherwise(&format!("make fluid.region.{region} a \"sphere\" with its centre at r = 0"))
        }
        RayleighError::MeetsWall { region, .. } => otherwise(&format!("move fluid.region.{region} up")),
        RayleighError::Overlap { first, second } => {
            otherwise(&format!("move fluid.region.{first} and fluid.region.{second} apart"))
        }
        RayleighError::TooNear { .. } => {
            otherwise("leave more space between the bubbles (fluid.region) and to the wall")
        }
    }
}
