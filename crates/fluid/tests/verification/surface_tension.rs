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
        liquid: SOFT.into(),
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

#[test]
#[ignore = "a study"]
fn study_where() {
    for (name, kind) in [("sharp", SHARP), ("mixture", MIXTURE)] {
        for inside in [Phase::Gas, Phase::Liquid] {
            for cells in [16, 32] {
                let mut fluid = ball(kind, AXIAL, inside, cells, [2.0 + 0.3 / cells as f64, 0.0]);
                for time in [0.05, 0.2, 0.5, 1.0] {
                    run_to(&mut fluid, time);
                    let mut list = vec![];
                    let (mut energy, mut mass) = (0.0, 0.0);
                    each_cell(&fluid, |[z, r], ij, w| {
                        list.push((w.v_z.hypot(w.v_r), ij, (z - 2.0, r), w.phi));
                        if w.phi < 0.5 { energy += r * (w.v_z * w.v_z + w.v_r * w.v_r); mass += r; }
                    });
                    list.sort_by(|a, b| b.0.total_cmp(&a.0));
                    eprintln!("{name} {inside:?} {cells} {time} rms liquid {:.2e}", (energy / mass as f64).sqrt());
                    for x in list.iter().step_by(3).take(4) { eprintln!("    {:.2e} {:?} z,r {:.3?} phi {:.5}", x.0, x.1, x.2, x.3); }
                }
            }
        }
    }
}

#[test]
#[ignore = "a study"]
fn study_dump() {
    let cells = 32;
    let mut fluid = ball(MIXTURE, AXIAL, Phase::Gas, cells, [2.0 + 0.3 / cells as f64, 0.0]);
    for time in [0.0, 0.01, 0.2] {
        if time > 0.0 { run_to(&mut fluid, time); }
        let mut all = std::collections::BTreeMap::new();
        each_cell(&fluid, |_, ij, w| { all.insert((ij[1], ij[0]), w); });
        for j in 29..35 {
            for i in 50..62 {
                let w = all[&(j, i)];
                eprint!(" {:.6}/{:+.2}/{:+.1e}/{:+.1e}", w.phi, w.pressure - if w.phi == 0.0 { 8000.0 } else { 1e4 }, w.v_z, w.v_r);
            }
            eprintln!();
        }
        eprintln!();
    }
}
