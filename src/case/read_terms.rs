//! `[fluid.terms]`: what acts on the fluid besides the waves of two-phase flow.

use fluid::PhaseChange;

use super::read_phase_change::{Asked, phase_change};
use super::reader::{Faults, Given, Table};

/// The terms of a case; each is off where it is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TermsCase {
    /// Dynamic viscosities of liquid and gas, Pa s.
    pub viscosity: Option<[f64; 2]>,
    /// Surface tension σ between liquid and gas, N/m.
    pub surface_tension: Option<f64>,
    /// Evaporation and condensation.
    pub phase_change: Option<PhaseChange>,
}

/// The terms, and where phase change is asked for: whether the phases can is looked at when they are known.
pub(super) fn terms(table: &mut Table<'_>, faults: &mut Faults) -> (TermsCase, Option<Asked>) {
    let Some(mut table) = table.table("terms", faults) else { return (TermsCase::default(), None) };
    let viscosity = table.table("viscosity", faults).and_then(|table| of_phases(table, faults));
    let surface_tension = not_negative(&mut table, "surface_tension", faults);
    let change = phase_change(&mut table, faults);
    table.finish(faults);
    let terms = TermsCase {
        viscosity,
        surface_tension: surface_tension.filter(|sigma| *sigma > 0.0),
        phase_change: change.as_ref().map(|change| change.value),
    };
    (terms, change)
}

/// A coefficient of each phase, `{ liquid = ..., gas = ... }`.
fn of_phases(mut table: Table<'_>, faults: &mut Faults) -> Option<[f64; 2]> {
    let both = ["liquid", "gas"].map(|phase| {
        if !table.has(phase) {
            let help = format!("give `{phase} = ...` in {}", table.unit(phase));
            table.missing(phase, help, faults);
        }
        not_negative(&mut table, phase, faults)
    });
    table.finish(faults);
    let [liquid, gas] = both;
    Some([liquid?, gas?])
}

fn not_negative(table: &mut Table<'_>, key: &'static str, faults: &mut Faults) -> Option<f64> {
    let given: Given<f64> = table.number(key, faults)?;
    if given.value < 0.0 {
        let unit = table.unit(key);
        let message = format!("must not be negative, got {:?} {unit}", given.value);
        faults.of(&given, message, format!("give a number >= 0 in {unit}; 0 switches it off"));
        return None;
    }
    Some(given.value)
}
