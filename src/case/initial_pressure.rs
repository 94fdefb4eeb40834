//! `fluid.initial_pressure`: whether the case has the field that it asks for.

use fluid::{Boundary, Gravity, InitialCondition, InitialPressure, RayleighError, RayleighField};
use mesh::Domain;

use super::GridCase;
use super::reader::{Faults, Given};
use super::shared::Context;

/// Records why the case cannot begin with Rayleigh's pressure, if that is what it asks for.
pub(super) fn check(
    given: Option<&Given<InitialPressure>>,
    (initial, gravity): (&InitialCondition, Option<Gravity>),
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
    let domain = Domain { geometry: context.geometry, z: grid.z, r: grid.r };
    if let Err(error) = RayleighField::of(initial, gravity, &domain, boundary) {
        faults.of(given, format!("\"rayleigh\" does not go with this case: {error}"), remedy(error));
    }
}

/// Gives a bubble that starts at its largest the liquid that begins to move from rest, where the case has that field.
///
/// - `is_free`: whether there is such a bubble, and the case does not say.
pub(super) fn at_rest(
    is_free: bool,
    initial: &mut InitialCondition,
    gravity: Option<Gravity>,
    grid: &GridCase,
    boundary: [Boundary; 4],
    context: Context,
) {
    let domain = Domain { geometry: context.geometry, z: grid.z, r: grid.r };
    let weightless = initial.weightless(gravity);
    if is_free && context.scheme.is_some() && RayleighField::between(&weightless, &domain, boundary).is_ok() {
        initial.pressure = InitialPressure::Rayleigh;
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
        RayleighError::BeyondWall { region, .. } => {
            otherwise(&format!("put the centre of fluid.region.{region} on the wall or above it"))
        }
        RayleighError::MeetsSide { region, side } => {
            otherwise(&format!("make fluid.region.{region} smaller or the fluid larger, or open {side}"))
        }
        RayleighError::Overlap { first, second } => otherwise(&format!(
            "move fluid.region.{first} and fluid.region.{second} apart, or give both one pressure"
        )),
        RayleighError::ClosedBox => otherwise("open r_max or z_max under [fluid.boundary]"),
        RayleighError::Periodic => {
            otherwise("under [fluid.boundary] make the periodic sides \"wall\" or open ones")
        }
        RayleighError::TooMany { .. } => otherwise("make do with fewer bubbles (fluid.region)"),
        RayleighError::TooNear { .. } => {
            otherwise("leave more space between the bubbles (fluid.region) and to the walls")
        }
    }
}
