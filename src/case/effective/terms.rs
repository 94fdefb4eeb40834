//! `[fluid.terms]`, written out.

use fluid::{ConductingWall, Conduction, ThinGas, Viscosity, WallHeat};

use super::{Lines, phase_change};
use crate::case::TermsCase;

pub(super) fn write(text: &mut Lines, terms: &TermsCase) {
    if *terms == TermsCase::default() {
        return;
    }
    text.head("[fluid.terms]");
    if let Some(sigma) = terms.surface_tension {
        text.number("surface_tension", sigma);
    }
    if let Some(angle) = terms.contact_angle {
        text.number("contact_angle", angle);
    }
    if let Some(Viscosity { liquid, gas, thin_gas }) = terms.viscosity {
        text.head("[fluid.terms.viscosity]");
        text.number("liquid", liquid.shear);
        text.number("gas", gas.shear);
        text.number("bulk_liquid", liquid.bulk);
        text.number("bulk_gas", gas.bulk);
        text.name("thin_gas", &ThinGas::NAMES, thin_gas);
    }
    if let Some(conduction) = terms.conduction {
        write_conduction(text, conduction);
    }
    if let Some(change) = terms.phase_change {
        phase_change::write(text, change);
    }
}

fn write_conduction(text: &mut Lines, Conduction { liquid, gas, thin_gas, wall }: Conduction) {
    text.head("[fluid.terms.conduction]");
    text.number("liquid", liquid);
    text.number("gas", gas);
    text.name("thin_gas", &ThinGas::NAMES, thin_gas);
    match wall {
        WallHeat::Adiabatic => text.key("wall", "\"adiabatic\""),
        WallHeat::Isothermal(temperature) => {
            text.key("wall", "\"isothermal\"");
            text.number("wall_temperature", temperature);
        }
        WallHeat::Conducting(ConductingWall { temperature, effusivity }) => {
            text.key("wall", "\"conducting\"");
            text.number("wall_temperature", temperature);
            text.number("wall_effusivity", effusivity);
        }
    }
}
