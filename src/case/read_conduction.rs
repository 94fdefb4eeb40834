//! `[fluid.terms.conduction]`: conduction of heat, and what walls do with it.

use fluid::{Boundary, ConductingWall, Conduction, Model, NobleAbelStiffenedGas, ThinGas, WallHeat};
use mesh::Side;
use solid::Material;

use super::error::suggest;
use super::reader::{Faults, Given, Table};
use super::shared::not_negative;

/// What walls do with heat, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wall {
    Adiabatic,
    Isothermal,
    Conducting,
}

const WALLS: [(&str, Wall); 3] =
    [("adiabatic", Wall::Adiabatic), ("isothermal", Wall::Isothermal), ("conducting", Wall::Conducting)];

/// What a case asks for, with where it says so. What a conducting wall is made of is found out when the solid is known.
#[derive(Debug)]
pub(super) struct Asked {
    pub conduction: Conduction,
    /// Where the conductivities are given.
    place: Given<()>,
    wall: Given<Wall>,
    /// √(λρc) of the wall, where the case says it.
    effusivity: Option<f64>,
}

/// Reads the table.
pub(super) fn conduction(terms: &mut Table<'_>, faults: &mut Faults) -> Option<Asked> {
    let place = terms.place("conduction")?;
    let mut table = terms.table("conduction", faults)?;
    let [liquid, gas] = ["liquid", "gas"].map(|phase| {
        if !table.has(phase) {
            let help = format!("give `{phase} = ...` in {}", table.unit(phase));
            table.missing(phase, help, faults);
        }
        not_negative(&mut table, phase, faults)
    });
    let thin_gas = table.name("thin_gas", &ThinGas::NAMES, faults);
    let given = table.choice("wall", &WALLS, faults);
    let is_lost = given.is_none() && table.has("wall");
    let temperature_place = table.place("wall_temperature");
    let temperature = table.positive("wall_temperature", faults);
    let implied = if temperature_place.is_some() { Wall::Isothermal } else { Wall::Adiabatic };
    let wall = given.unwrap_or_else(|| {
        let Given { path, span, .. } = temperature_place.clone().unwrap_or_else(|| place.clone());
        Given { value: implied, path, span }
    });
    let effusivity = made_of(&mut table, wall.value, faults);
    if wall.value != Wall::Adiabatic && temperature_place.is_none() && !is_lost {
        table.missing("wall_temperature", "give `wall_temperature = 293.15`, in K", faults);
    }
    if let Some(given) = temperature_place.filter(|_| wall.value == Wall::Adiabatic && !is_lost) {
        let message = "has no say where wall = \"adiabatic\": nothing passes";
        faults.of(&given, message, "remove it, or take wall = \"isothermal\" or \"conducting\"");
    }
    table.finish(faults);
    let wall_heat = match (wall.value, temperature) {
        (Wall::Adiabatic, _) | (_, None) => WallHeat::Adiabatic,
        (Wall::Isothermal, Some(temperature)) => WallHeat::Isothermal(temperature),
        (Wall::Conducting, Some(temperature)) => {
            WallHeat::Conducting(ConductingWall { temperature, effusivity: effusivity.unwrap_or(0.0) })
        }
    };
    let conduction = Conduction { liquid: liquid?, gas: gas?, thin_gas, wall: wall_heat };
    Some(Asked { conduction, place, wall, effusivity })
}

/// √(λρc) of the wall, where the case says it or names what it is made of.
fn made_of(table: &mut Table<'_>, wall: Wall, faults: &mut Faults) -> Option<f64> {
    let places = ["wall_material", "wall_effusivity"].map(|key| table.place(key));
    let material = table.string("wall_material", faults).and_then(|given| {
        let library = Material::library();
        let found = library.iter().find(|material| material.name() == given.value);
        if found.is_none() {
            let names = library.iter().map(Material::name);
            let message = format!("unknown material `{}`", given.value);
            let help = format!("{}; or give wall_effusivity", suggest(given.value, names));
            faults.of(&given, message, help);
        }
        found.and_then(Material::effusivity)
    });
    let effusivity = table.positive("wall_effusivity", faults);
    if wall != Wall::Conducting {
        for given in places.iter().flatten() {
            let message = "is that of a wall that conducts, and this one does not";
            faults.of(given, message, "take wall = \"conducting\", or remove it");
        }
    } else if let [Some(_), Some(given)] = &places {
        faults.of(given, "wall_material and wall_effusivity exclude each other", "remove one of the two");
    }
    effusivity.or(material)
}

/// The conduction of a case, whose fluid and solid are known; what it cannot have is refused.
///
/// - `laws`: of liquid and gas; `solid`: the material of the solid, if there is one.
/// - returns: `None` where nothing is conducted.
pub(super) fn settle(
    asked: &Asked,
    laws: [NobleAbelStiffenedGas; 2],
    (boundary, solid): ([Boundary; 4], Option<&Material>),
    faults: &mut Faults,
) -> Option<Conduction> {
    let Asked { conduction, place, wall, effusivity } = asked;
    let mut conduction = *conduction;
    for (law, phase) in laws.iter().zip(["liquid", "gas"]) {
        if law.heat.is_none() {
            let named = if phase == "liquid" { "water-nasg" } else { "air" };
            let message = format!("asks for temperatures, and fluid.{phase} has no heat_capacity");
            let help =
                format!("write [fluid.{phase}] fluid = \"{named}\", or give heat_capacity there in J/(kg K)");
            faults.of(place, message, help);
        }
    }
    let has_wall = |side: Side| boundary[side as usize].is_wall();
    let is_there = match wall.value {
        Wall::Adiabatic => true,
        Wall::Isothermal => Side::ALL.into_iter().any(has_wall),
        Wall::Conducting => has_wall(Side::ZMin),
    };
    if !is_there {
        let where_to = if wall.value == Wall::Conducting { "on z_min" } else { "on any side" };
        let help = "take coupling.scheme = \"rigid\" or \"riemann\", or remove it";
        faults.of(wall, format!("there is no wall {where_to}"), help);
    }
    if let WallHeat::Conducting(conducting) = &mut conduction.wall {
        match effusivity.or(solid.and_then(Material::effusivity)) {
            Some(effusivity) => conducting.effusivity = effusivity,
            None => {
                let of = solid.map_or("there is no solid".to_owned(), |solid| {
                    format!("material `{}` is not in the library", solid.name())
                });
                let help = "give wall_material = \"stainless-316l\", or wall_effusivity = 8000.0";
                faults.of(wall, format!("how well the wall conducts is not known: {of}"), help);
            }
        }
    }
    (conduction.liquid > 0.0 || conduction.gas > 0.0).then_some(conduction)
}

/// Why the paper's mixture conducts nothing, if it is asked to.
pub(super) fn refuse_mixture(asked: &Asked, model: Model, faults: &mut Faults) {
    if model == Model::SaurelAbgrall {
        let message = "cells that hold gas and liquid have one density, got model = \"saurel-abgrall\": how warm either \
                       phase is, and which one gets heat, is not known";
        faults.of(&asked.place, message, "model = \"five-equation\" (the default), or remove it");
    }
}
