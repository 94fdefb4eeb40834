//! `[fluid.terms.phase_change]` and `.cavitation`: mass that goes from one phase to the other.

use fluid::{
    EvaporationLaw, InitialCondition, Mixture, Model, NobleAbelStiffenedGas, Phase, PhaseChange, PhaseState,
    Saturation,
};

use super::reader::{Faults, Given, Table};

/// The laws by name; how many of the molecules stick is read besides.
const LAWS: [(&str, bool); 2] = [("hertz-knudsen", true), ("ptg", false)];

/// What a case asks for, with where it says so.
pub(super) type Asked = Given<PhaseChange>;

/// Reads both tables of `[fluid.terms]`.
///
/// - returns: besides whether it is said how much of the gas is vapour.
pub(super) fn phase_change(terms: &mut Table<'_>, faults: &mut Faults) -> Option<(Asked, bool)> {
    let place = terms.place("phase_change");
    let change = terms.table("phase_change", faults).and_then(|table| of_law(table, faults));
    let opens = terms.place("cavitation");
    let cavitation = terms.table("cavitation", faults).and_then(|table| threshold(table, faults));
    if let Some(given) = opens.as_ref().filter(|_| place.is_none()) {
        let message = "opens liquid that cannot close again: there is no phase_change".to_owned();
        faults.of(given, message, "give fluid.terms.phase_change = { law = \"ptg\" } besides, or remove it");
    }
    let (place, (change, is_share_given)) = (place?, change?);
    let value = PhaseChange { cavitation, ..change };
    Some((Given { value, path: place.path, span: place.span }, is_share_given))
}

fn of_law(mut table: Table<'_>, faults: &mut Faults) -> Option<(PhaseChange, bool)> {
    let law = table.choice("law", &LAWS, faults);
    if !table.has("law") {
        table.missing("law", "write law = \"ptg\", or \"hertz-knudsen\" with accommodation = 0.04", faults);
    }
    let has_rate = law.as_ref().is_some_and(|law| law.value);
    let place = table.place("accommodation");
    let accommodation =
        table.within("accommodation", "the part of the molecules that stick: 0.04 to 1 for water", faults);
    if has_rate && place.is_none() {
        table.missing("accommodation", "write accommodation = 0.04", faults);
    }
    if let Some(given) = place.filter(|_| law.as_ref().is_some_and(|law| !law.value)) {
        let message = "has no say in law = \"ptg\", whose phases are in equilibrium".to_owned();
        faults.of(&given, message, "remove it, or take law = \"hertz-knudsen\"");
    }
    let part =
        table.within("vapour_fraction", "the part of the gas's mass that is vapour: 1 where all is", faults);
    table.finish(faults);
    let law = match accommodation.filter(|_| has_rate) {
        Some(given) => EvaporationLaw::HertzKnudsen { accommodation: given.value },
        None if has_rate => return None,
        None => EvaporationLaw::Equilibrium,
    };
    let is_share_given = part.is_some();
    let vapour_fraction = part.map_or(1.0, |given| given.value);
    Some((PhaseChange { law, vapour_fraction, cavitation: None }, is_share_given))
}

fn threshold(mut table: Table<'_>, faults: &mut Faults) -> Option<f64> {
    let given = table.required("threshold", faults);
    table.finish(faults);
    let given = given?;
    if given.value >= 0.0 {
        let message = format!("must be negative, got {:?} Pa: liquid opens under tension", given.value);
        faults.of(&given, message, "give a pressure < 0, as -1e6; cavities in the start are regions of gas");
        return None;
    }
    Some(given.value)
}

/// Where what laws of both phases say of each other is looked at, K.
const ROOM: f64 = 293.15;
/// Liquids that anybody would let evaporate have more saturated vapour there, Pa; mercury has 0.2.
const LEAST: f64 = 1e-9;

/// Whether a case's phases can change into each other; if not it is refused.
///
/// - `laws`: of liquid and gas.
pub(super) fn check(
    asked: &Asked,
    [liquid, gas]: [NobleAbelStiffenedGas; 2],
    model: Model,
    initial: &InitialCondition,
    faults: &mut Faults,
) {
    if model == Model::SaurelAbgrall {
        let message = "needs phases with densities of their own, got model = \"saurel-abgrall\"".to_owned();
        faults.of(asked, message, "model = \"five-equation\" (the default), or remove it");
    }
    let Some(saturation) = Saturation::of(&Mixture::new(liquid, gas)) else {
        let message = format!("{}: there is no equilibrium of both phases", what_is_missing(liquid, gas));
        let help = "write [fluid.liquid] fluid = \"water-nasg\" and [fluid.gas] fluid = \"water-vapour\", or \
                    heat_capacity, energy and entropy of both";
        faults.of(asked, message, help);
        return;
    };
    let at_room = saturation.pressure(ROOM);
    if !(at_room > LEAST && at_room < Saturation::CRITICAL[1]) {
        let message = format!(
            "these laws of liquid and vapour are no pair: at {ROOM} K they have saturated vapour of {at_room:e} Pa"
        );
        let help = "water-nasg goes with water-vapour, water-2.35 with water-vapour-1.43; look at gamma, pi, covolume, heat_capacity, \
                    energy and entropy of fluid.liquid and fluid.gas";
        faults.of(asked, message, help);
        return;
    }
    let [critical_temperature, critical_pressure] = Saturation::CRITICAL;
    let states =
        initial.regions.iter().enumerate().map(|(k, region)| (format!("fluid.region.{k}"), &region.state));
    for (name, state) in [("fluid.ambient".to_owned(), &initial.ambient)].into_iter().chain(states) {
        let law = if state.phase == Phase::Liquid { liquid } else { gas };
        let PhaseState { density, pressure, .. } = *state;
        let temperature = law.temperature(density, pressure).unwrap_or(f64::NAN);
        if temperature >= critical_temperature {
            let message = format!(
                "{name} begins at {temperature:.1} K, above water's critical {critical_temperature} K: its density is {density:?} kg/m3 at {pressure:?} Pa"
            );
            let room = law.density_at(pressure, 293.15).unwrap_or(f64::NAN);
            let law_of = if state.phase == Phase::Liquid { "fluid.liquid" } else { "fluid.gas" };
            let help = format!(
                "at 293.15 K it is {room:.6} kg/m3; look at density and pressure of {name}, and at gamma, pi, covolume and heat_capacity of {law_of}"
            );
            faults.of(asked, message, help);
        }
        let partial = pressure * asked.value.vapour_fraction;
        if state.phase == Phase::Gas && partial >= critical_pressure {
            let message = format!(
                "{name} begins with vapour of {partial:?} Pa, above water's critical {critical_pressure:e} Pa"
            );
            let room = saturation.pressure(293.15);
            faults.of(asked, message, format!("at 293.15 K saturated vapour has {room:.0} Pa"));
        }
    }
}

fn what_is_missing(liquid: NobleAbelStiffenedGas, gas: NobleAbelStiffenedGas) -> String {
    if liquid.heat.is_none() {
        return "fluid.liquid has no heat_capacity".to_owned();
    }
    match gas.heat {
        None => "fluid.gas has no heat_capacity".to_owned(),
        Some(_) if gas.pi != 0.0 || gas.covolume != 0.0 => {
            format!(
                "the vapour must be an ideal gas, got pi = {:?} Pa, covolume = {:?} m3/kg",
                gas.pi, gas.covolume
            )
        }
        Some(heat) => format!(
            "fluid.gas has no reference energy above the liquid's, got energy = {:?} J/kg",
            heat.energy
        ),
    }
}
