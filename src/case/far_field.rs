//! `"far-field"` sides: which they are where the case does not say, and whether it has what it asks for.

use fluid::{
    Boundary, FarField, FarFieldError, Gravity, InitialCondition, Mixture, NobleAbelStiffenedGas,
    PressureHistory,
};
use mesh::{Domain, Side};

use super::reader::{Faults, Given};
use super::shared::Context;
use super::{GridCase, Inflow};

/// Makes those sides `"non-reflecting"` that would be `"far-field"` by default in a case that has none, and records why others
/// cannot be what the case calls them.
///
/// - `named`: where the case names a side; `media`: the equations of state of liquid and gas, where known.
#[expect(clippy::too_many_arguments, reason = "what a case says, no kernel")]
pub(super) fn decide(
    boundary: &mut [Boundary; 4],
    named: &[Option<Given<()>>; 4],
    initial: &InitialCondition,
    grid: &GridCase,
    media: [Option<NobleAbelStiffenedGas>; 2],
    (inflow, gravity): (Option<&Inflow>, Option<Gravity>),
    context: Context,
    faults: &mut Faults,
) {
    // Faulty ones have been told of.
    let [Some(liquid), Some(gas)] = media else { return };
    let domain = Domain { geometry: context.geometry, z: grid.z, r: grid.r };
    let inflow = inflow.and_then(|inflow| PressureHistory::new(inflow.pressure.clone()));
    let mixture = Mixture::new(liquid, gas);
    // How much a wall reflects does not matter here.
    let found = match gravity {
        Some(_) => Err(FarFieldError::Gravity),
        None => FarField::of(initial, &mixture, &domain, *boundary, inflow.as_ref(), 1.0).map(|_| ()),
    };
    let Err(error) = found else { return };
    for side in Side::ALL.map(|side| side as usize) {
        if boundary[side] == Boundary::FarField {
            if let Some(given) = &named[side] {
                let message = format!("\"far-field\" does not go with this case: {error}");
                faults.of(given, message, remedy(error));
            }
            boundary[side] = Boundary::NonReflecting;
        }
    }
}

fn remedy(error: FarFieldError) -> String {
    let otherwise = |what: &str| format!("{what}, or make the side \"non-reflecting\"");
    match error {
        FarFieldError::Planar => otherwise("take geometry = \"axisymmetric\""),
        FarFieldError::GasAmbient => otherwise("make the ambient phase \"liquid\""),
        FarFieldError::NoGas => otherwise("add a [[fluid.region]] with phase = \"gas\""),
        FarFieldError::OffAxis { region } => otherwise(&format!("let fluid.region.{region} begin at r = 0")),
        FarFieldError::Tube => otherwise("make r_max \"far-field\" or \"non-reflecting\""),
        FarFieldError::Layer => otherwise("open z_min or z_max"),
        FarFieldError::Gravity => otherwise("remove gravity"),
    }
}
