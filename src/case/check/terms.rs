//! What acts on the fluid besides the waves, and how warm it is.

use fluid::{EvaporationLaw, Phase, PhaseViscosity, Shape};

use super::super::format::si;
use super::line;
use crate::case::FluidCase;

/// Sound and temperature of the liquid, and the terms of the case.
pub(super) fn terms(text: &mut String, fluid: &FluidCase) {
    let (ambient, terms) = (&fluid.initial.ambient, &fluid.terms);
    if ambient.phase == Phase::Liquid {
        let sound = fluid.liquid.sound_speed(ambient.density, ambient.pressure);
        let mut parts = vec![format!("sound at {sound:.1} m/s")];
        let (temperature, saturated) = fluid.warmth();
        parts.extend(temperature.map(|temperature| format!("{temperature:.1} K")));
        parts.extend(saturated.map(|pressure| format!("saturated vapour of {}", si(pressure, "Pa"))));
        line(text, "liquid", &parts.join(", "));
    }
    if let Some(viscosity) = &terms.viscosity {
        let of = |phase: PhaseViscosity| match phase.bulk {
            0.0 => si(phase.shear, "Pa s"),
            bulk => format!("{} and {} in bulk", si(phase.shear, "Pa s"), si(bulk, "Pa s")),
        };
        let [liquid, gas] = [viscosity.liquid, viscosity.gas].map(of);
        let thin = viscosity.thin_gas.name();
        line(text, "viscosity", &format!("liquid {liquid}, gas {gas}; thin gas {thin}"));
    }
    if let Some(tension) = terms.surface_tension {
        let rises =
            fluid.initial.regions.iter().enumerate().filter_map(|(number, region)| match region.shape {
                Shape::Sphere { radius, .. } => {
                    Some(format!("2 sigma/R of region {number}: {}", si(2.0 * tension / radius, "Pa")))
                }
                Shape::Box { .. } => None,
            });
        let parts: Vec<String> = [format!("{tension:?} N/m")].into_iter().chain(rises).collect();
        line(text, "tension", &parts.join(", "));
    }
    if let Some(conduction) = &terms.conduction {
        let (liquid, gas) = (conduction.liquid, conduction.gas);
        let thin = conduction.thin_gas.name();
        line(text, "conduction", &format!("liquid {liquid:?} W/(m K), gas {gas:?} W/(m K); thin gas {thin}"));
    }
    if let Some(change) = &terms.phase_change {
        let law = match change.law {
            EvaporationLaw::HertzKnudsen { accommodation } => {
                format!("hertz-knudsen, accommodation {accommodation:?}")
            }
            EvaporationLaw::Equilibrium => "ptg".to_owned(),
        };
        let opens = change
            .cavitation
            .map_or(String::new(), |threshold| format!("; liquid opens below {}", si(threshold, "Pa")));
        let share = 100.0 * change.vapour_fraction;
        line(text, "phase change", &format!("{law}; {share:.1} % of the gas is vapour at the start{opens}"));
    }
    if let Some(gravity) = &fluid.gravity {
        line(text, "gravity", &format!("{:?} m/s2 along z", gravity.acceleration));
    }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, report};

    #[test]
    fn a_check_says_what_acts_and_how_warm_the_liquid_is() {
        let text = "[time]\nend = 1e-7\n[fluid]\nz = [0.0, 4e-3]\nr = [0.0, 4e-3]\ncells = [64, 64]\ngravity = -9.81\n\
                    boundary = { z_min = \"wall\", z_max = \"non-reflecting\", r_max = \"wall\" }\n\
                    [fluid.liquid]\nfluid = \"water-nasg\"\n[fluid.gas]\nfluid = \"water-vapour\"\n\
                    [fluid.ambient]\ndensity = 1061.0\npressure = 1e5\n\
                    [fluid.bubble]\ncentre = [1.5e-3, 0.0]\nradius = 1e-3\ngas_pressure = 1000.0\nvapour_pressure = 2339.0\n\
                    [fluid.terms]\nviscosity = { liquid = 1e-3, gas = 1.8e-5 }\nsurface_tension = 0.01\n\
                    conduction = { liquid = 0.6, gas = 0.026 }\nphase_change = { law = \"ptg\" }\ncavitation = { threshold = -1e6 }\n\
                    [coupling]\nscheme = \"none\"\n";
        let case = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            Case::from_toml(text, "terms", &sets).unwrap_or_else(|errors| panic!("{errors}"))
        };
        let told = report(&case(&[]));
        for words in [
            "293.1 K, saturated vapour of 2.3",
            "liquid 1 mPa s, gas 18 µPa s; thin gas bounded",
            "0.01 N/m, 2 sigma/R of region 0: 20 Pa",
            "liquid 0.6 W/(m K), gas 0.026 W/(m K); thin gas bounded",
            // Of 3339 Pa 2339 are vapour's.
            "ptg; 70.1 % of the gas is vapour at the start; liquid opens below -1 MPa",
            "-9.81 m/s2 along z",
        ] {
            assert!(told.contains(words), "{words}\n{told}");
        }
        let told = report(&case(&["fluid.terms.phase_change.vapour_fraction=1.0"]));
        assert!(told.contains("100.0 % of the gas is vapour"), "{told}");
    }
}
