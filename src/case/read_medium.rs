//! The equation of state of a phase.

use fluid::{Heat, NamedFluid, NobleAbelStiffenedGas};

use super::error::suggest;
use super::reader::{Faults, Given, Table};

/// `[fluid.liquid]` or `[fluid.gas]`: a fluid of the library, constants, or both, of which the constants count.
///
/// - `default`: what it is where the table says nothing.
pub(super) fn medium(
    mut table: Table<'_>,
    default: Option<NobleAbelStiffenedGas>,
    faults: &mut Faults,
) -> Option<NobleAbelStiffenedGas> {
    let named = named(&mut table, faults);
    let is_lost = table.has("fluid") && named.is_none();
    let known = named.map(|fluid| fluid.law).or(default);
    let mut value = |key, known: Option<f64>, faults: &mut Faults| match known {
        Some(known) if !table.has(key) => {
            table.raw(key);
            Some(Given { value: known, path: String::new(), span: 0..0 })
        }
        // Its fluid would have said.
        None if is_lost && !table.has(key) => {
            table.raw(key);
            None
        }
        _ => table.required(key, faults),
    };
    let gamma = value("gamma", known.map(|law| law.gamma), faults);
    let pi = value("pi", known.map(|law| law.pi), faults);
    let heat = heat(&mut table, known.and_then(|law| law.heat), faults);
    table.finish(faults);
    let (gamma, pi) = (gamma?, pi?);
    let mut sound = true;
    if gamma.value <= 1.0 {
        let message = format!("must be greater than 1, got {:?}", gamma.value);
        faults.of(&gamma, message, "the adiabatic exponent: 1.4 for air, 7.15 for water");
        sound = false;
    }
    if pi.value < 0.0 {
        let message = format!("must not be negative, got {:?} Pa", pi.value);
        faults.of(&pi, message, "the stiffness: 0 for a gas, 3e8 Pa for water");
        sound = false;
    }
    let covolume = known.map_or(0.0, |law| law.covolume);
    sound.then_some(NobleAbelStiffenedGas { gamma: gamma.value, pi: pi.value, covolume, heat })
}

/// The fluid of the library that a table names.
fn named(table: &mut Table<'_>, faults: &mut Faults) -> Option<&'static NamedFluid> {
    let given = table.string("fluid", faults)?;
    let found = NamedFluid::of(given.value);
    if found.is_none() {
        let names = NamedFluid::library().iter().map(|fluid| fluid.name);
        let message = format!("unknown fluid `{}`", given.value);
        let help =
            format!("{}; `cav materials` lists them with their constants", suggest(given.value, names));
        faults.of(&given, message, help);
    }
    found
}

/// c_v, q and q′; the last two count from 0.
fn heat(table: &mut Table<'_>, known: Option<Heat>, faults: &mut Faults) -> Option<Heat> {
    let capacity = table.positive("heat_capacity", faults).or(known.map(|heat| heat.capacity));
    let mut reference = |key, known: Option<f64>, faults: &mut Faults| {
        let given = table.number(key, faults);
        if let Some(given) = given.as_ref().filter(|_| capacity.is_none() && !table.has("heat_capacity")) {
            let message = format!("counts from a heat capacity, and there is none in {}", table.path);
            faults.of(given, message, "give heat_capacity in J/(kg K), or remove it");
        }
        given.map(|given| given.value).or(known).unwrap_or(0.0)
    };
    let energy = reference("energy", known.map(|heat| heat.energy), faults);
    let entropy = reference("entropy", known.map(|heat| heat.entropy), faults);
    Some(Heat { capacity: capacity?, energy, entropy })
}
