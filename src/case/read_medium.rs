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
    let covolume = table.number("covolume", faults);
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
    if let Some(given) = covolume.as_ref().filter(|given| given.value < 0.0) {
        let message = format!("must not be negative, got {:?} m3/kg", given.value);
        faults.of(
            given,
            message,
            "the covolume: 0 for an ideal gas, 6.61e-4 m3/kg for water of \"water-nasg\"",
        );
        sound = false;
    }
    let covolume = covolume.map_or(known.map_or(0.0, |law| law.covolume), |given| given.value);
    sound.then_some(NobleAbelStiffenedGas { gamma: gamma.value, pi: pi.value, covolume, heat })
}

/// The paper's mixture has one density, and covolumes ask for those of the phases.
pub(super) fn refuse_covolumes(
    phases: [(&'static str, Option<NobleAbelStiffenedGas>); 2],
    table: &Table<'_>,
    faults: &mut Faults,
) {
    for (phase, law) in phases {
        if let (Some(law), Some(given)) = (law.filter(|law| law.covolume != 0.0), table.place(phase)) {
            let b = law.covolume;
            let message = format!(
                "a covolume, {b:?} m3/kg, needs phases with densities of their own, got model = \"saurel-abgrall\""
            );
            faults.of(&given, message, "model = \"five-equation\" (the default), or covolume = 0");
        }
    }
}

/// Whether a covolume leaves room to move at a table's density; if not it is refused.
pub(super) fn leaves_room(
    (phase, law): (&str, NobleAbelStiffenedGas),
    density: f64,
    table: &Table<'_>,
    faults: &mut Faults,
) -> bool {
    let leaves = law.free_share(density) > 0.0;
    if let Some(given) = table.place("density").filter(|_| !leaves) {
        let (most, b) = (1.0 / law.covolume, law.covolume);
        let message = format!("the covolume of {b:?} m3/kg takes all of the volume at {density:?} kg/m3");
        let help =
            format!("give a density below 1/covolume = {most:?} kg/m3, or a smaller fluid.{phase}.covolume");
        faults.of(&given, message, help);
    }
    leaves
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
