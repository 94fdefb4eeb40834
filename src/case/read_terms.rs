//! `[fluid.terms]`: what acts on the fluid besides the waves of two-phase flow.

use fluid::{Conduction, PhaseChange, PhaseViscosity, ThinGas, Viscosity};

use super::read_conduction::{self, conduction};
use super::read_phase_change::{self, phase_change};
use super::reader::{Faults, Given, Table};
use super::shared::not_negative;

/// The terms of a case; each is off where it is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TermsCase {
    /// Viscosity of both phases.
    pub viscosity: Option<Viscosity>,
    /// Conduction of heat in both phases.
    pub conduction: Option<Conduction>,
    /// Surface tension σ between liquid and gas, N/m.
    pub surface_tension: Option<f64>,
    /// The angle between an interface and a wall in the liquid, degrees; interfaces may meet walls only where it is given.
    pub contact_angle: Option<f64>,
    /// Evaporation and condensation.
    pub phase_change: Option<PhaseChange>,
}

/// Terms that hang on what is read after them, with where they are asked for.
#[derive(Default)]
pub(super) struct Pending {
    pub phase_change: Option<read_phase_change::Asked>,
    /// Whether it is said how much of the gas is vapour.
    pub is_share_given: bool,
    pub conduction: Option<read_conduction::Asked>,
}

/// The terms, and those of which it is looked at when the rest is known whether the fluid can have them.
pub(super) fn terms(table: &mut Table<'_>, faults: &mut Faults) -> (TermsCase, Pending) {
    let Some(mut table) = table.table("terms", faults) else { return Default::default() };
    let viscosity = table.table("viscosity", faults).and_then(|table| viscosity(table, faults));
    let surface_tension = not_negative(&mut table, "surface_tension", faults);
    let surface_tension = surface_tension.filter(|sigma| *sigma > 0.0);
    let contact_angle = contact_angle(&mut table, surface_tension, faults);
    let conduction = conduction(&mut table, faults);
    let (change, is_share_given) = phase_change(&mut table, faults).unzip();
    table.finish(faults);
    let terms = TermsCase {
        viscosity,
        conduction: None,
        surface_tension,
        contact_angle,
        phase_change: change.as_ref().map(|change| change.value),
    };
    (terms, Pending { phase_change: change, is_share_given: is_share_given.unwrap_or(false), conduction })
}

/// The contact angle, of which there is one.
fn contact_angle(table: &mut Table<'_>, surface_tension: Option<f64>, faults: &mut Faults) -> Option<f64> {
    let given: Given<f64> = table.number("contact_angle", faults)?;
    if given.value != 90.0 {
        let message = format!("must be 90 degrees, got {:?}", given.value);
        faults.of(
            &given,
            message,
            "give 90: interfaces meet walls at right angles, as their mirror images do".to_owned(),
        );
    } else if surface_tension.is_none() {
        let message = "is of no use without surface tension".to_owned();
        faults.of(&given, message, "remove it, or give `surface_tension = ...`".to_owned());
    }
    Some(given.value)
}

/// `{ liquid = ..., gas = ... }`, and what there is besides; none where neither has any.
fn viscosity(mut table: Table<'_>, faults: &mut Faults) -> Option<Viscosity> {
    let both = ["liquid", "gas"].map(|phase| {
        if !table.has(phase) {
            let help = format!("give `{phase} = ...` in {}", table.unit(phase));
            table.missing(phase, help, faults);
        }
        not_negative(&mut table, phase, faults)
    });
    let [bulk_liquid, bulk_gas] =
        ["bulk_liquid", "bulk_gas"].map(|key| not_negative(&mut table, key, faults).unwrap_or(0.0));
    let thin_gas = table.name("thin_gas", &ThinGas::NAMES, faults);
    table.finish(faults);
    let [liquid, gas] = both;
    let viscosity = Viscosity {
        liquid: PhaseViscosity { shear: liquid?, bulk: bulk_liquid },
        gas: PhaseViscosity { shear: gas?, bulk: bulk_gas },
        thin_gas,
    };
    let is_none = |phase| phase == PhaseViscosity::default();
    (!(is_none(viscosity.liquid) && is_none(viscosity.gas))).then_some(viscosity)
}
