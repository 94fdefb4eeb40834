//! What the tables of several parts of a case share.

use coupler::Scheme;
use mesh::{Geometry, Side};

use super::reader::{Faults, Given, Table, array, pair};
use super::{LocalSteps, Medium, Probe, index};

/// What the tables of both sides need to know of the rest of the case.
#[derive(Clone, Copy)]
pub(super) struct Context {
    pub geometry: Geometry,
    /// `None` where the name given is faulty.
    pub scheme: Option<Scheme>,
    /// Whether levels have steps of their own.
    pub local_steps: LocalSteps,
}

/// A probe and where its point stands.
pub(super) struct PlacedProbe {
    pub probe: Probe,
    pub position: Given<[f64; 2]>,
    pub medium: Given<Medium>,
}

/// The four sides of a `[....boundary]` table; `fixed` says what a side is that cannot be chosen, and why. Naming it
/// as what it is does no harm.
pub(super) fn boundaries<B: Copy + PartialEq>(
    table: Option<Table<'_>>,
    names: &[(&'static str, B)],
    fixed: impl Fn(Side) -> Option<(&'static str, &'static str)>,
    default: [B; 4],
    periodic: B,
    faults: &mut Faults,
) -> [B; 4] {
    let mut sides = default;
    let Some(mut table) = table else { return sides };
    let mut given: [Option<Given<B>>; 4] = [const { None }; 4];
    for (key, side) in Side::NAMES {
        if let Some((name, reason)) = fixed(side) {
            if let Some(value) = table.raw(key).filter(|given| given.value.as_str() != Some(name)) {
                faults.of(&value, reason, format!("remove `{key}`"));
            }
            continue;
        }
        given[index(side)] = table.choice(key, names, faults);
    }
    table.finish(faults);
    for (side, given) in sides.iter_mut().zip(&given) {
        if let Some(given) = given {
            *side = given.value;
        }
    }
    for [one, other] in [[Side::ZMin, Side::ZMax], [Side::RMin, Side::RMax]].map(|pair| pair.map(index)) {
        for (here, there) in [(one, other), (other, one)] {
            if let Some(value) = given[here].as_ref().filter(|given| given.value == periodic)
                && sides[there] != periodic
            {
                let opposite = Side::NAMES[there].0;
                let message = format!("the opposite side, {opposite}, is not periodic");
                faults.of(value, message, "make both sides \"periodic\", or neither");
            }
        }
    }
    sides
}

/// A list of [time, value] with ascending times.
pub(super) fn history(
    table: &mut Table<'_>,
    key: &'static str,
    faults: &mut Faults,
) -> Option<Given<Vec<[f64; 2]>>> {
    let units = &table.unit(key);
    let Some(given) = table.raw(key) else {
        table.missing(key, format!("give `{key} = [[t, value], ...]` in {units}"), faults);
        return None;
    };
    let elements = array(&given, "a list of [time, value]", units, faults)?;
    let rows: Vec<_> = elements.iter().map(|element| pair(element, units, faults)).collect();
    let value = rows.into_iter().collect::<Option<Vec<_>>>()?;
    let given = Given { value, path: given.path, span: given.span };
    if given.value.is_empty() {
        faults.of(&given, "is empty", "give at least one [time, value]");
        return None;
    }
    if let Some(two) = given.value.windows(2).find(|two| two[1][0] <= two[0][0]) {
        let message = format!("times must ascend, got {:?} s after {:?} s", two[1][0], two[0][0]);
        faults.of(&given, message, "put the rows in the order of time, each time once");
        return None;
    }
    Some(given)
}

/// The `name` of a table by which its datasets are called; `kind` is what the table is for.
pub(super) fn name_of(
    table: &mut Table<'_>,
    kind: &str,
    is_taken: impl Fn(&str) -> bool,
    faults: &mut Faults,
) -> Option<String> {
    if !table.has("name") {
        table.missing("name", format!("give `name = \"...\"`, it names the {kind}'s datasets"), faults);
    }
    let name = table.string("name", faults)?;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if name.value.is_empty() || !name.value.chars().all(plain) {
        let message = format!("`{}` is no name for a {kind}", name.value);
        faults.of(&name, message, "use letters, digits, `_` and `-` only");
    }
    if is_taken(name.value) {
        let message = format!("another {kind} is called `{}`", name.value);
        faults.of(&name, message, format!("give every {kind} a name of its own"));
    }
    Some(name.value.to_owned())
}

/// A number that is not below 0; 0 switches off what it is for.
pub(super) fn not_negative(table: &mut Table<'_>, key: &'static str, faults: &mut Faults) -> Option<f64> {
    let given = not_below_zero(table, key, "; 0 switches it off", faults)?;
    (given.value >= 0.0).then_some(given.value)
}

/// A number, with a fault if it is below 0.
///
/// - `at_zero`: what 0 does, behind what is to be given.
pub(super) fn not_below_zero(
    table: &mut Table<'_>,
    key: &'static str,
    at_zero: &str,
    faults: &mut Faults,
) -> Option<Given<f64>> {
    let given: Given<f64> = table.number(key, faults)?;
    if given.value < 0.0 {
        let unit = table.unit(key);
        let message = format!("must not be negative, got {:?} {unit}", given.value);
        faults.of(&given, message, format!("give a number >= 0 in {unit}{at_zero}"));
    }
    Some(given)
}
