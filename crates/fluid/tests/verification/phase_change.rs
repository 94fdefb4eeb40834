//! Evaporation, condensation and cavitation: areas and rates, ledgers, equilibrium.

use fluid::{
    Conduction, EvaporationLaw, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Mixture,
    NamedFluid, NobleAbelStiffenedGas, Phase, PhaseChange, PhaseState, Primitive, Region, Saturation, Shape,
    SurfaceTension, ThinGas, WallHeat,
};
use mesh::{Adaptation, Domain, Geometry};

use crate::helpers::*;

pub fn laws() -> [NobleAbelStiffenedGas; 2] {
    ["water-nasg", "water-vapour"].map(|name| NamedFluid::of(name).unwrap().law)
}

pub fn saturation() -> Saturation {
    let [liquid, gas] = laws();
    Saturation::of(&Mixture::new(liquid, gas)).unwrap()
}

fn changing(law: EvaporationLaw, vapour_fraction: f64, cavitation: Option<f64>) -> Option<PhaseChange> {
    Some(PhaseChange { law, vapour_fraction, cavitation })
}

fn setup(geometry: Geometry, cells: [usize; 2], phase_change: Option<PhaseChange>) -> FluidSetup {
    let [liquid, gas] = laws();
    let sides = if geometry == AXIAL { CYLINDER } else { WALLS };
    FluidSetup { liquid, gas, phase_change, ..setup_of(SHARP, geometry, cells, sides) }
}

/// Vapour in a shape and water around it, each with a pressure and a temperature.
pub fn cavity(shape: Shape, liquid: [f64; 2], gas: [f64; 2]) -> InitialCondition {
    let [liquid_law, gas_law] = laws();
    let state = |phase, law: NobleAbelStiffenedGas, [pressure, temperature]: [f64; 2]| PhaseState {
        phase,
        density: law.density_at(pressure, temperature).unwrap(),
        pressure,
        velocity: [0.0; 2],
    };
    InitialCondition {
        ambient: state(Phase::Liquid, liquid_law, liquid),
        pressure: InitialPressure::Uniform,
        regions: vec![Region { shape, state: state(Phase::Gas, gas_law, gas) }],
        pulses: vec![],
    }
}

const BALL: Shape = Shape::Sphere { centre: [0.5, 0.0], radius: 0.3 };
/// So small that the pressure of the cells that evaporate stays what it is.
const ACCOMMODATION: f64 = 1e-3;
const RATE: EvaporationLaw = EvaporationLaw::HertzKnudsen { accommodation: ACCOMMODATION };

/// Before anything else has changed a front evaporates and condenses by Hertz's and Knudsen's j per area, and a ball by its surface.
/// Vapour condenses on a front between cells, too.
#[test]
fn a_front_changes_phase_by_its_area() {
    const FRONT: fn(f64) -> Shape = |end| Shape::Box { z: [0.0, end], r: [0.0, 1.0] };
    let temperature = 300.0;
    let gas_constant = (laws()[1].gamma - 1.0) * laws()[1].heat.unwrap().capacity;
    for (name, geometry, shape, (part, area), most) in [
        ("front", PLANAR, FRONT(0.5073), (0.8, 1.0), 0.005),
        ("front", PLANAR, FRONT(0.5073), (1.2, 1.0), 0.005),
        ("front between cells", PLANAR, FRONT(0.5), (1.2, 1.0), 0.005),
        ("ball", AXIAL, BALL, (0.8, 2.0 * 0.3_f64.powi(2)), 0.01),
        ("ball", AXIAL, BALL, (1.2, 2.0 * 0.3_f64.powi(2)), 0.05),
    ] {
        let p = part * saturation().pressure(temperature);
        let driving = saturation().vapour_pressure(temperature, p) - p;
        let flux = ACCOMMODATION * driving / (std::f64::consts::TAU * gas_constant * temperature).sqrt();
        let initial = cavity(shape, [p, temperature], [p, temperature]);
        let mut fluid =
            FluidSolver::<8>::new(&setup(geometry, [32, 32], changing(RATE, 1.0, None)), &initial).unwrap();
        run_steps(&mut fluid, 20);
        let phases = *fluid.phase_ledger();
        let made = (phases.evaporated - phases.condensed) / (flux * area * fluid.time());
        eprintln!("{name} at {part} of saturation: {made:.4} of the rate, {phases:?}");
        assert!((made - 1.0).abs() < most, "{name}: {made}");
        assert!(phases.evaporated.min(phases.condensed) == 0.0 && phases.opened == 0);
    }
}

/// A collapse in a closed cylinder on a grid that adapts.
fn collapse(asked: Option<PhaseChange>) -> FluidSolver<8> {
    let initial = cavity(BALL, [5e6, 300.0], [1e5, 380.0]);
    let setup = FluidSetup {
        levels: 2,
        adaptation: Some(Adaptation::by_details(5e-2, 2)),
        ..setup(AXIAL, [32, 32], asked)
    };
    FluidSolver::new(&setup, &initial).unwrap()
}

fn vapour(fluid: &FluidSolver<8>) -> f64 {
    fluid.carried_masses().find(|(name, _)| *name == "vapour").unwrap().1
        / fluid.mesh().domain().geometry.turn()
}

#[test]
fn the_ledgers_hold_with_everything_on() {
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        for local in [false, true] {
            let mut fluid = collapse(changing(law, 0.7, Some(-1e5)));
            let (before, held) = (fluid.totals(), vapour(&fluid));
            approx::assert_relative_eq!(held, 0.7 * before.gas_mass, max_relative = 1e-13);
            for _ in 0..if local { 40 } else { 120 } {
                let (dt, made) = if local { step_locally(&mut fluid) } else { step_together(&mut fluid) };
                fluid.adapt_if_due(dt, made);
            }
            let (now, phases, fixups) = (fluid.totals(), *fluid.phase_ledger(), fluid.fixups());
            let net = phases.evaporated - phases.condensed;
            let off = [
                now.mass / before.mass - 1.0,
                (now.energy - before.energy - phases.energy - fixups.floor_energy) / before.energy,
                (now.gas_mass - before.gas_mass - net - fixups.gas_mass_added + fixups.liquid_mass_added)
                    / before.gas_mass,
                (vapour(&fluid) - held - net) / before.gas_mass,
            ];
            // What is left of the gas that does not condense.
            let rest = now.gas_mass - vapour(&fluid);
            let difference = saturation().reference_difference() * net;
            eprintln!(
                "{law:?} {local}: off {off:?}, {net:.3e} of {:.3e} kg/rad, {phases:?}",
                before.gas_mass
            );
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{law:?} {local}: {off:?}");
            assert!(phases.condensed > 1e-2 * before.gas_mass, "something condenses: {phases:?}");
            approx::assert_relative_eq!(phases.energy, difference, max_relative = 1e-6);
            approx::assert_relative_eq!(rest, 0.3 * before.gas_mass, max_relative = 1e-6);
        }
    }
}

/// Vapour and liquid of one temperature at its saturation pressure are at rest for good, and nothing changes phase.
#[test]
fn saturated_vapour_stays_as_it_is() {
    let temperature = 350.0;
    let p = saturation().pressure(temperature);
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        let initial = cavity(BALL, [p, temperature], [p, temperature]);
        let mut fluid =
            FluidSolver::<8>::new(&setup(AXIAL, [16, 16], changing(law, 1.0, None)), &initial).unwrap();
        let before = fluid.totals();
        run_steps(&mut fluid, 100);
        let (now, phases) = (fluid.totals(), *fluid.phase_ledger());
        let mut worst: f64 = 0.0;
        each_cell(&fluid, |_, _, w| worst = worst.max((w.pressure / p - 1.0).abs()));
        let changed = (phases.evaporated + phases.condensed) / before.gas_mass;
        eprintln!(
            "{law:?}: pressure {worst:.1e}, gas {:.1e}, changed {changed:.1e}",
            now.gas_mass / before.gas_mass - 1.0
        );
        assert!(worst < 1e-6 && changed < 1e-6, "{law:?}: {worst:e} {changed:e}");
    }
}

/// A bubble of vapour of 1 µm whose gas surface tension keeps at 2.4 bar in liquid of 1 bar, of the temperature at which both are in equilibrium:
/// neither heat nor vapour passes. Were the gas of mixed cells at the pressure of the cell 600 steps would condense 2 % of it, or evaporate as much.
#[test]
fn a_bubble_in_equilibrium_across_a_tense_interface_stays_as_it_is() {
    let (radius, sigma, p) = (1e-6, 0.072, 1e5);
    let of_gas = p + 2.0 * sigma / radius;
    let saturation = saturation();
    let temperature = {
        let [mut low, mut high] = [300.0, 500.0];
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *if saturation.vapour_pressure(middle, p) < of_gas { &mut low } else { &mut high } = middle;
        }
        low
    };
    let length = 2.5 * radius;
    let [liquid, gas] = laws();
    let initial =
        ball_of_laws([liquid, gas], ([0.0; 2], radius), [[p, temperature], [of_gas, temperature]], 0.0);
    let conduction =
        Conduction { liquid: 0.6, gas: 0.026, thin_gas: ThinGas::Bounded, wall: WallHeat::default() };
    let tension = SurfaceTension { coefficient: sigma, density: 1e3, may_touch_walls: false };
    let rest = FluidSetup {
        liquid,
        gas,
        surface_tension: Some(tension),
        ..setup_in(Domain { geometry: AXIAL, z: [-length, length], r: [0.0, length] }, [64, 32], CYLINDER)
    };
    let with = |law| FluidSetup {
        conduction: Some(conduction),
        phase_change: changing(law, 1.0, None),
        ..rest.clone()
    };
    let of = |setup: &FluidSetup| {
        let mut fluid = FluidSolver::<8>::new(setup, &initial).unwrap();
        let before = [fluid.bubble().volume, fluid.totals().gas_mass];
        run_steps(&mut fluid, 600);
        [fluid.bubble().volume / before[0] - 1.0, fluid.totals().gas_mass / before[1] - 1.0]
    };
    let [grown, _] = of(&rest);
    for law in [EvaporationLaw::Equilibrium, EvaporationLaw::HertzKnudsen { accommodation: 1.0 }] {
        let [volume, mass] = of(&with(law));
        eprintln!("{law:?}: volume {volume:+.1e}, {grown:+.1e} without; mass {mass:+.1e}");
        assert!((volume - grown).abs() < 1e-4 && mass.abs() < 1e-4, "{volume:e} {mass:e}");
    }
}

/// Water that is pulled apart opens where it is asked to, and bears any tension where not.
#[test]
fn liquid_opens_below_the_threshold() {
    let p = 1e5;
    let density = laws()[0].density_at(p, 300.0).unwrap();
    let flow = |[z, _]: [f64; 2]| Primitive {
        density,
        v_z: if z < 0.5 { -5.0 } else { 5.0 },
        v_r: 0.0,
        pressure: p,
        phi: 0.0,
    };
    let lowest = |cavitation: Option<f64>| {
        let asked = changing(EvaporationLaw::Equilibrium, 1.0, cavitation);
        let mut fluid = FluidSolver::<8>::from_fn(&setup(PLANAR, [64, 8], asked), flow).unwrap();
        let before = fluid.totals();
        run_to(&mut fluid, 1e-4);
        let mut pressure = f64::INFINITY;
        each_cell(&fluid, |_, _, w| pressure = pressure.min(w.pressure));
        let (now, phases) = (fluid.totals(), *fluid.phase_ledger());
        let off = (now.energy - before.energy - phases.energy) / before.energy;
        assert!((now.mass / before.mass - 1.0).abs() < 1e-13 && off.abs() < 1e-13, "{off:e}");
        assert!(
            (now.gas_mass - phases.evaporated + phases.condensed).abs() < 1e-12 * phases.evaporated.max(1e-9)
        );
        eprintln!("{cavitation:?}: {pressure:.4e} Pa, {phases:?}");
        (pressure, phases)
    };
    let (closed, none) = lowest(None);
    assert!(closed < -5e6 && none.opened == 0, "{closed:e}");
    let (open, phases) = lowest(Some(-1e6));
    assert!(open > -1e6 && phases.opened > 0 && phases.opened_mass > 0.0, "{open:e}");
}
