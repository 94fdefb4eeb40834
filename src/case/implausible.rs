//! Numbers that a unit was taken wrong in, and states that change at once.

use fluid::{Phase, Shape};
use mesh::Side;
use solid::{Boundary, InitialStress};

use super::format::si;
use super::{FluidCase, SolidCase};

/// Sound in a liquid or a solid that is slower or faster comes from a wrong unit, m/s.
const SOUND: [f64; 2] = [50.0, 2e4];
/// The yield strength of a solid over its Young's modulus; pure metals have 1e-4 and more.
const YIELD: [f64; 2] = [1e-6, 0.3];
/// Pressures of vapour that differ by such a factor do not stay.
const FAR_FROM_EQUILIBRIUM: f64 = 10.0;

/// What of the fluid's numbers is probably not meant.
pub(super) fn fluid(fluid: &FluidCase, warnings: &mut Vec<String>) {
    let ambient = &fluid.initial.ambient;
    let sound = fluid.ambient_sound();
    if ambient.phase == Phase::Liquid && !(SOUND[0]..=SOUND[1]).contains(&sound) {
        warnings.push(format!(
            "fluid.ambient: sound runs at {sound:.3e} m/s in a liquid of {:?} kg/m3 (1480 m/s in water): look at its density, and at gamma and \
             pi of fluid.liquid",
            ambient.density
        ));
    }
    let balls = fluid.initial.regions.iter().enumerate().filter_map(|(number, region)| match region.shape {
        Shape::Sphere { centre, radius } if region.state.phase == Phase::Gas => {
            Some((number, centre, radius, region.state.pressure))
        }
        _ => None,
    });
    for (number, [z, r], radius, pressure) in balls {
        let farthest = |at: f64, [low, high]: [f64; 2]| (at - low).abs().max((at - high).abs());
        let corner = farthest(z, fluid.grid.z).hypot(farthest(r, fluid.grid.r));
        if radius >= corner {
            warnings.push(format!(
                "fluid.region.{number}: a radius of {} holds all of the fluid, of which no liquid is left: is it in m?",
                si(radius, "m")
            ));
        }
        vapour(fluid, (number, pressure), warnings);
        cold_gas(fluid, number, warnings);
    }
}

/// Gas whose temperature is below this share of the liquid's is warmed by it at once.
const COLD: f64 = 0.8;

/// A bubble whose gas has come from R_n along its isentrope, in a liquid that conducts heat to it.
fn cold_gas(fluid: &FluidCase, number: usize, warnings: &mut Vec<String>) {
    let passes_heat = fluid.terms.conduction.is_some() || fluid.terms.phase_change.is_some();
    let (ambient, region) = (&fluid.initial.ambient, &fluid.initial.regions[number].state);
    let of_gas = fluid.gas.temperature(region.density, region.pressure);
    let of_liquid = fluid.liquid.temperature(ambient.density, ambient.pressure);
    if let Some((gas, liquid)) = of_gas.zip(of_liquid)
        && passes_heat
        && ambient.phase == Phase::Liquid
        && gas < COLD * liquid
    {
        warnings.push(format!(
            "fluid.region.{number} begins at {gas:.1} K in liquid of {liquid:.1} K, which warms it at once: gas that expands without \
             heat from its equilibrium radius is that cold; give gas_pressure, of gas at the liquid's temperature"
        ));
    }
}

/// What a bubble's vapour does at once.
fn vapour(fluid: &FluidCase, (number, pressure): (usize, f64), warnings: &mut Vec<String>) {
    let (ambient, terms) = (&fluid.initial.ambient, &fluid.terms);
    let Some(change) = &terms.phase_change else { return };
    let (Some(temperature), Some(saturated)) = fluid.warmth() else { return };
    let vapour = change.vapour_fraction * pressure;
    let ratio = saturated / vapour;
    if ambient.phase == Phase::Liquid
        && vapour > 0.0
        && !(1.0 / FAR_FROM_EQUILIBRIUM..=FAR_FROM_EQUILIBRIUM).contains(&ratio)
    {
        let (does, room) = (
            if ratio > 1.0 { "liquid evaporates into it at once" } else { "it condenses at once" },
            fluid.liquid.density_at(ambient.pressure, 293.15).unwrap_or(f64::NAN),
        );
        warnings.push(format!(
            "fluid.region.{number} begins with vapour of {}, and liquid of {temperature:.1} K has saturated vapour of {}: {does}; at 293.15 K \
             fluid.ambient.density is {room:.2} kg/m3",
            si(vapour, "Pa"),
            si(saturated, "Pa"),
        ));
    }
}

/// What of the solid's numbers is probably not meant.
///
/// - `pressure`: of the fluid on it at first, Pa.
pub(super) fn solid(solid: &SolidCase, pressure: f64, warnings: &mut Vec<String>) {
    let material = &solid.material;
    if !(SOUND[0]..=SOUND[1]).contains(&material.c1()) {
        warnings.push(format!(
            "solid.material: sound runs at {:.3e} m/s in it (5900 m/s in steel): are its moduli in Pa, and its density in kg/m3?",
            material.c1()
        ));
    }
    let law = solid.plasticity.as_ref();
    if let Some(law) = law.filter(|_| solid.initial.is_none()) {
        flows_at_once(solid, pressure, law.yield_stress(0.0, 0.0, 0.0), warnings);
    }
    moves_at_once(solid, pressure, warnings);
    let strength = law.map_or(material.yield_strength(), |law| Some(law.yield_stress(0.0, 0.0, 0.0)));
    let share = strength.map(|strength| (strength, strength / material.young()));
    if let Some((strength, share)) = share.filter(|(_, share)| !(YIELD[0]..=YIELD[1]).contains(share)) {
        warnings.push(format!(
            "solid: a yield strength of {} is {share:.1e} of Young's modulus, {}: is it in Pa?",
            si(strength, "Pa"),
            si(material.young(), "Pa")
        ));
    }
}

/// A stress of the start that is beyond the yield strength, Pa.
fn flows_at_once(solid: &SolidCase, pressure: f64, strength: f64, warnings: &mut Vec<String>) {
    let is_uniaxial = solid.initial_stress == InitialStress::Uniaxial;
    let weight = |z: f64| solid.weight.map_or(0.0, |weight| weight.stress(solid.material.density(), z));
    // What σ_zz is beyond the others; along z it is linear.
    let largest =
        |borne: f64| solid.grid.z.map(|z| (weight(z) - borne).abs()).into_iter().fold(0.0, f64::max);
    let (mises, by_weight) = (largest(if is_uniaxial { pressure } else { 0.0 }), largest(0.0));
    if mises <= strength {
        return;
    }
    let [mises, limit] = [mises, strength].map(|stress| si(stress, "Pa"));
    let flows = format!(
        "a von Mises stress of {mises}, and the solid yields at {limit}: it flows at once, without a bubble"
    );
    warnings.push(if is_uniaxial && by_weight <= strength {
        format!(
            "solid.initial_stress = \"uniaxial\" begins with {flows}; write solid.initial_stress = \"hydrostatic\""
        )
    } else {
        format!("solid.gravity: the weight, which sigma_zz alone carries, begins with {flows}; take a solid that is less deep, or a stronger one")
    });
}

/// A pressure of the start on a side that bears none.
fn moves_at_once(solid: &SolidCase, pressure: f64, warnings: &mut Vec<String>) {
    let is_hydrostatic = solid.initial_stress == InitialStress::Hydrostatic;
    for (side, is_pressed) in [(Side::ZMin, true), (Side::RMin, is_hydrostatic), (Side::RMax, is_hydrostatic)]
    {
        if is_pressed
            && pressure != 0.0
            && solid.initial.is_none()
            && solid.boundary[side as usize] == Boundary::Free
        {
            warnings.push(format!(
                "solid.boundary.{} = \"free\" bears no pressure, and the solid begins with {} on it: it moves at once, without a \
                 bubble; take another side{}",
                side.name(),
                si(pressure, "Pa"),
                if side == Side::ZMin { "" } else { ", or solid.initial_stress = \"uniaxial\"" }
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    fn warnings(sets: &[&str]) -> Vec<String> {
        let text = "[time]\nend = 1e-7\n[fluid]\nz = [0.0, 6e-3]\nr = [0.0, 6e-3]\ncells = [64, 64]\n\
                    [fluid.liquid]\nfluid = \"water-nasg\"\n[fluid.gas]\nfluid = \"water-vapour\"\n\
                    [fluid.ambient]\ndensity = 1061.0\npressure = 1e5\n\
                    [[fluid.region]]\nphase = \"gas\"\nshape = \"sphere\"\ncentre = [1.5e-3, 0.0]\nradius = 1e-3\ndensity = 0.0173\npressure = 2340.0\n\
                    [solid]\nz = [-6e-3, 0.0]\nr = [0.0, 6e-3]\ncells = [64, 64]\nmaterial = \"structural-steel\"\n\
                    [solid.plasticity]\nlaw = \"perfect\"\nyield_strength = 2.5e8\n";
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        Case::from_toml(text, "units", &sets).unwrap_or_else(|errors| panic!("{errors}")).warnings()
    }

    #[test]
    fn wrong_units_are_warned_of() {
        let boils = "fluid.terms.phase_change={law=\"ptg\"}";
        for sets in
            [&[][..], &[boils], &[boils, "fluid.terms.surface_tension=0.07", "fluid.region.0.radius=4e-4"]]
        {
            assert_eq!(warnings(sets), Vec::<String>::new(), "{sets:?}");
        }
        for (sets, words) in [
            (&["fluid.ambient.density=2.0"][..], "sound runs at 2.0"),
            (&["fluid.region.0.radius=1.0"], "no liquid is left"),
            (&["solid.plasticity.yield_strength=90.0"], "a yield strength of 90 Pa is 3.9e-10"),
            (&["solid.material={density=7850.0,young=210.0,poisson=0.3,name=\"soft\"}"], "5900 m/s in steel"),
            (&[boils, "fluid.ambient.density=1000.0"], "liquid evaporates into it at once"),
            (
                &["fluid.terms.conduction={liquid=0.6,gas=0.026}", "fluid.region.0.density=0.026"],
                "which warms it at once",
            ),
            (&[boils, "fluid.region.0.pressure=4e4", "fluid.region.0.density=0.29"], "it condenses at once"),
        ] {
            let told = warnings(sets);
            assert!(told.iter().any(|told| told.contains(words)), "{sets:?}: {told:?}");
        }
    }

    #[test]
    fn a_solid_that_yields_before_anything_happens_is_warned_of() {
        let pressed = "fluid.ambient.pressure=3e8";
        let told =
            |sets: &[&str]| warnings(sets).into_iter().filter(|own| own.contains("initial_stress")).count();
        assert_eq!(told(&[pressed]), 1);
        assert_eq!(told(&[pressed, "solid.initial_stress=hydrostatic"]), 0);
        assert_eq!(told(&["fluid.ambient.pressure=2e8"]), 0);
        // 6 mm of steel that weigh 47 MPa at their bottom.
        let heavy =
            ["solid.gravity=-1e6", "solid.plasticity.yield_strength=4e7", "solid.initial_stress=hydrostatic"];
        let words = warnings(&heavy);
        assert!(
            words
                .iter()
                .any(|own| own.contains("sigma_zz alone carries, begins with a von Mises stress of 46.8 MPa")),
            "{words:?}"
        );
        assert_eq!(warnings(&["solid.gravity=-1e6", heavy[2]]), Vec::<String>::new());
    }

    #[test]
    fn a_pressure_on_a_free_side_is_warned_of() {
        let told = |sets: &[&str]| {
            warnings(sets).into_iter().filter(|own| own.contains("bears no pressure")).count()
        };
        assert_eq!(told(&["solid.boundary.r_max=free", "solid.initial_stress=hydrostatic"]), 1);
        assert_eq!(told(&["solid.boundary.r_max=free"]), 0);
        assert_eq!(told(&["solid.boundary.z_min=free"]), 1);
    }
}
