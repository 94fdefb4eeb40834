//! Walls that heat passes: kept at a temperature, or conducting themselves.

use fluid::{Boundary, ConductingWall, Conduction, FluidSetup, FluidSolver, Phase, ThinGas, WallHeat};
use mesh::{Adaptation, LevelBound, Zone};

use crate::conduction::*;
use crate::helpers::*;

const ALONE: [Boundary; 4] = [Boundary::Wall, Boundary::Symmetry, Boundary::Symmetry, Boundary::Symmetry];

/// Liquid with this diffusivity (m²/s) above a wall.
fn above(cells: [usize; 2], d: f64, wall: WallHeat) -> FluidSetup {
    let conduction = Conduction { wall, ..conducting([d; 2]) };
    FluidSetup { conduction: Some(conduction), ..media(SHARP, PLANAR, cells, ALONE, [d; 2]) }
}

/// The mean heat flux and temperature of the wall's faces.
fn on_wall(fluid: &FluidSolver<8>) -> [f64; 2] {
    let (mut fluxes, mut temperatures) = (vec![], vec![]);
    fluid.wall_face_heat(&mut fluxes, &mut temperatures);
    [fluxes, temperatures].map(|row| row.iter().sum::<f64>() / row.len() as f64)
}

/// A half-space beside a wall at another temperature, erfc(z/√(4Dt)), and what the wall gets.
#[test]
fn a_wall_kept_at_a_temperature_heats_the_fluid() {
    let d = 2.0;
    let exact = |[z, _]: [f64; 2], t: f64| 1.0 - erf(z / (4.0 * d * t).sqrt());
    let (start, end) = (1e-3, 5e-3);
    let mut fluxes = vec![];
    let mut error = |cells: usize| {
        let wall = WallHeat::Isothermal(TEMPERATURE * (1.0 + AMPLITUDE));
        let mut fluid = FluidSolver::<8>::from_fn(&above([cells, 8], d, wall), |x| {
            warmer(Phase::Liquid, exact(x, start))
        })
        .unwrap();
        let before = fluid.totals().energy;
        run_to(&mut fluid, end - start);
        let wanted =
            -d * DENSITIES[0] * CAPACITY * TEMPERATURE * AMPLITUDE / (std::f64::consts::PI * d * end).sqrt();
        fluxes.push((on_wall(&fluid)[0] / wanted - 1.0).abs());
        let (gained, ledger) = (fluid.totals().energy - before, fluid.ledger());
        assert!((gained - ledger.energy[0]).abs() < 1e-13 * before, "{gained} {:?}", ledger.energy);
        approx::assert_relative_eq!(ledger.wall_heat, -ledger.energy[0], max_relative = 1e-9);
        approx::assert_relative_eq!(
            on_wall(&fluid)[1],
            TEMPERATURE * (1.0 + AMPLITUDE),
            max_relative = 1e-12
        );
        error_of(&fluid, |x| exact(x, end))
    };
    let errors = [16, 32, 64].map(&mut error);
    let orders = [order("wall at a temperature", &errors), order("its heat flux", &fluxes)];
    assert!(orders[0] > 1.8 && fluxes[2] < 5e-3, "{orders:?} {fluxes:?}");
}

/// Warm liquid is put on a wall that conducts: the wall has the temperature between at once.
#[test]
fn a_wall_that_conducts_has_the_temperature_between() {
    let d = 2.0;
    let own = DENSITIES[0] * CAPACITY * f64::sqrt(d);
    for ratio in [0.2, 3.0] {
        let effusivity = ratio * own;
        let between = 1.0 / (1.0 + ratio);
        let exact = |[z, _]: [f64; 2], t: f64| between + (1.0 - between) * erf(z / (4.0 * d * t).sqrt());
        let end = 4e-3;
        let mut temperatures = vec![];
        let mut error = |cells: usize| {
            let wall = WallHeat::Conducting(ConductingWall { temperature: TEMPERATURE, effusivity });
            let mut fluid =
                FluidSolver::<8>::from_fn(&above([cells, 8], d, wall), |_| warmer(Phase::Liquid, 1.0))
                    .unwrap();
            let before = fluid.totals().energy;
            run_to(&mut fluid, end);
            let theta = (on_wall(&fluid)[1] / TEMPERATURE - 1.0) / AMPLITUDE;
            temperatures.push((theta - between).abs());
            let lost = before - fluid.totals().energy;
            assert!((lost - fluid.ledger().wall_heat).abs() < 1e-13 * before, "{lost}");
            error_of(&fluid, |x| exact(x, end))
        };
        let errors = [16, 32, 64].map(&mut error);
        let what = format!("wall that conducts {ratio} times as well");
        let orders = [order(&what, &errors), order("its temperature", &temperatures)];
        assert!(orders[0] > 1.4 && temperatures[2] < 5e-3, "{orders:?} {temperatures:?}");
    }
}

/// Along a wall with levels that step by themselves each face's heat is its own, and the wall stays as warm everywhere.
#[test]
fn levels_along_a_wall_find_it_equally_warm() {
    let (d, ratio) = (2.0, 1.0);
    let wall = WallHeat::Conducting(ConductingWall {
        temperature: TEMPERATURE,
        effusivity: ratio * DENSITIES[0] * CAPACITY * f64::sqrt(d),
    });
    let zone = |r: [f64; 2], level| LevelBound {
        zone: Zone::Box { z: [-1.0, 2.0], r },
        at_least: level,
        at_most: level,
    };
    let setup = FluidSetup {
        levels: 1,
        adaptation: Some(Adaptation {
            bounds: vec![zone([-1.0, 0.4], 1), zone([0.6, 2.0], 0)],
            ..Adaptation::by_details(1.0, 3)
        }),
        ..above([32, 32], d, wall)
    };
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |_| warmer(Phase::Liquid, 1.0)).unwrap();
    let before = fluid.totals().energy;
    while fluid.time() < 4e-3 {
        let (dt, steps) = step_locally(&mut fluid);
        fluid.adapt_if_due(dt, steps);
    }
    let [coarsest, finest] = fluid.mesh().levels_present();
    assert!(coarsest < finest, "there is a jump of levels");
    let (mut fluxes, mut temperatures) = (vec![], vec![]);
    fluid.wall_face_heat(&mut fluxes, &mut temperatures);
    let worst =
        temperatures.iter().map(|t| ((t / TEMPERATURE - 1.0) / AMPLITUDE - 0.5).abs()).fold(0.0, f64::max);
    let lost = before - fluid.totals().energy;
    eprintln!("levels along a wall: temperature off by at most {worst:.2e}");
    assert!(worst < 0.02, "{worst}");
    assert!((lost - fluid.ledger().wall_heat).abs() < 1e-12 * before, "{lost}");
}

/// Half a cell before a wall conducts twice as well as a whole one, also in the longest step that is stable.
#[test]
fn walls_heat_gas_in_steps_at_the_limit_of_conduction() {
    let (d, end) = (40.0_f64, 4e-4_f64);
    let wall = WallHeat::Isothermal(TEMPERATURE * (1.0 + AMPLITUDE));
    let mut setup = above([128, 8], d, wall);
    setup.conduction.as_mut().unwrap().thin_gas = ThinGas::Resolved;
    let mut fluid = FluidSolver::<8>::from_fn(&setup, |_| warmer(Phase::Gas, 0.0)).unwrap();
    run_to(&mut fluid, end);
    let effusivity = DENSITIES[1] * CAPACITY * d.sqrt();
    let wanted = -2.0 * effusivity * TEMPERATURE * AMPLITUDE * (end / std::f64::consts::PI).sqrt();
    let share = fluid.ledger().wall_heat / wanted;
    eprintln!("heat from a wall to gas, in {} steps: {share:.4} of the exact", fluid.steps());
    assert!((share - 1.0).abs() < 0.01, "{share}");
}

/// In stages, too: thin gas beside walls.
#[test]
fn walls_heat_what_spreads_in_stages() {
    let d = 40.0;
    let exact = |[z, _]: [f64; 2], t: f64| 1.0 - erf(z / (4.0 * d * t).sqrt());
    let (start, end) = (1e-4, 4e-4);
    let error = |cells: usize| {
        let wall = WallHeat::Isothermal(TEMPERATURE * (1.0 + AMPLITUDE));
        let mut setup = above([cells, 8], d, wall);
        setup.conduction.as_mut().unwrap().thin_gas = ThinGas::SuperTimeStepping;
        let mut fluid = FluidSolver::<8>::from_fn(&setup, |x| warmer(Phase::Gas, exact(x, start))).unwrap();
        let before = fluid.totals().energy;
        run_to(&mut fluid, end - start);
        let gained = fluid.totals().energy - before;
        assert!((gained - fluid.ledger().energy[0]).abs() < 1e-13 * before, "{gained}");
        error_of(&fluid, |x| exact(x, end))
    };
    let order = order("wall at a temperature, in stages", &[32, 64, 128].map(error));
    assert!(order > 1.6, "{order}");
}
