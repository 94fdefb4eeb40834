//! Surface tension: Laplace's jump, spurious currents, oscillations, ledgers.

use fluid::{
    FluidSetup, FluidSolver, InitialCondition, InitialPressure, Phase, PhaseState, Region, Scales, Shape,
    StiffenedGas, SurfaceTension,
};
use mesh::{Domain, Geometry};

use crate::helpers::*;

/// σ = ρ_l U² R with U = 1 m/s, R = 1 m and ρ_l = 1000 kg/m³.
const TENSION: f64 = 1000.0;
/// So soft that sound is thirty times as fast as capillary waves, not five thousand times.
const SOFT: StiffenedGas = StiffenedGas { gamma: 4.4, pi: 2e5 };
const GAS_PRESSURE: f64 = 1e4;
const GAS_DENSITY: f64 = 10.0;

fn state(phase: Phase, density: f64, pressure: f64) -> PhaseState {
    PhaseState { phase, density, pressure, velocity: [0.0; 2] }
}

/// A ball of radius 1 m of one phase in the other, in a box of walls.
fn ball(kind: Kind, geometry: Geometry, inside: Phase, cells: usize, centre: [f64; 2]) -> FluidSolver<8> {
    let (z, r) = ([0.0, 4.0], if geometry == AXIAL { [0.0, 2.0] } else { [0.0, 4.0] });
    let count = |range: [f64; 2]| ((range[1] - range[0]) * cells as f64).round() as usize;
    let setup = FluidSetup {
        domain: Domain { geometry, z, r },
        liquid: SOFT,
        surface_tension: Some(SurfaceTension { coefficient: TENSION, density: 1000.0 }),
        scales: Scales { pressure: 1e4, density: 1e3 },
        ..setup_of(kind, geometry, [count(z), count(r)], if geometry == AXIAL { CYLINDER } else { WALLS })
    };
    let jump = TENSION * if geometry == AXIAL { 2.0 } else { 1.0 };
    let sign = if inside == Phase::Gas { 1.0 } else { -1.0 };
    let gas = state(Phase::Gas, GAS_DENSITY, GAS_PRESSURE);
    let liquid = state(Phase::Liquid, 1000.0, GAS_PRESSURE - sign * jump);
    let (inner, ambient) = if inside == Phase::Gas { (gas, liquid) } else { (liquid, gas) };
    let initial = InitialCondition {
        ambient,
        pressure: InitialPressure::Uniform,
        regions: vec![Region { shape: Shape::Sphere { centre, radius: 1.0 }, state: inner }],
        pulses: vec![],
    };
    FluidSolver::new(&setup, &initial).unwrap()
}

/// The fastest fluid, m/s, and the mean pressures of the gas and the liquid.
fn at_rest(fluid: &FluidSolver<8>) -> (f64, f64, f64) {
    let mut fastest: f64 = 0.0;
    let mut sums = [[0.0; 2]; 2];
    each_cell(fluid, |_, _, w| {
        fastest = fastest.max(w.v_z.hypot(w.v_r));
        if w.phi < 1e-6 || w.phi > 1.0 - 1e-6 {
            let sum = &mut sums[usize::from(w.phi > 0.5)];
            *sum = [sum[0] + 1.0, sum[1] + w.pressure];
        }
    });
    let mean = |[count, sum]: [f64; 2]| sum / count;
    (fastest, mean(sums[1]), mean(sums[0]))
}

#[test]
#[ignore = "a study"]
fn study_static() {
    for (name, kind) in [("sharp", SHARP), ("mixture", MIXTURE)] {
        for geometry in [AXIAL, PLANAR] {
            for inside in [Phase::Gas, Phase::Liquid] {
                for cells in [8, 16, 20, 32] {
                    let centre = [2.0 + 0.3 / cells as f64, if geometry == AXIAL { 0.0 } else { 2.0 + 0.4 / cells as f64 }];
                    let mut fluid = ball(kind, geometry, inside, cells, centre);
                    let mut line = format!("{name} {geometry:?} {inside:?} {cells}:");
                    let jump = TENSION * if geometry == AXIAL { 2.0 } else { 1.0 };
                    for time in [0.05, 0.2, 0.5, 1.0] {
                        run_to(&mut fluid, time);
                        let (fastest, gas, liquid) = at_rest(&fluid);
                        line += &format!(" [{time}: u {fastest:.2e}, jump {:+.4}%]", 100.0 * ((gas - liquid).abs() / jump - 1.0));
                    }
                    eprintln!("{line} steps {} {:?}", fluid.steps(), fluid.fixups().first_order);
                }
            }
        }
    }
}
