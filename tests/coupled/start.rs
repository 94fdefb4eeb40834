//! A run that begins with Rayleigh's pressure begins with both media in equilibrium on the wall.

use cav::case::Case;
use cav::run::setup::solid_solver;

use crate::fixture::{AIR, bubble, grid, steel, water};
use crate::harness::{Sides, case, solid_cells};

/// A bubble of 2 mm, 16 cells, two radii above steel.
fn parts(stress: &str) -> [String; 5] {
    let lines = |z| grid(z, 0.008, [64, 64]);
    [
        "[time]\nend = 1e-3\n".to_owned(),
        water(&(lines([0.0, 0.008]) + "initial_pressure = \"rayleigh\"\n"), 1e6),
        bubble([0.004, 0.0], 0.002, AIR),
        steel(&lines([-0.008, 0.0])),
        format!("initial_stress = \"{stress}\"\n"),
    ]
}

fn at_start(stress: &str) -> Sides {
    Sides::of_parts(&parts(stress).each_ref().map(String::as_str))
}

/// On the axis the pressure of the start is 0.70 MPa below the ambient one. A solid under the latter would be thrown
/// up with that over its impedance.
#[test]
fn the_solid_carries_the_pressure_of_the_start() {
    let thrown = 0.7e6 / (7800.0 * 5990.0);
    for stress in ["uniaxial", "hydrostatic"] {
        let mut sides = at_start(stress);
        let off = |sides: &Sides| {
            let cells = solid_cells(sides.solid.solver());
            cells.iter().fold(0.0_f64, |most, (_, w)| most.max(w.v_z.abs()).max(w.v_r.abs()))
        };
        let cells = solid_cells(sides.solid.solver());
        let highest = cells.iter().fold(f64::NEG_INFINITY, |most, (_, w)| most.max(w.stress_zz));
        assert!((highest + 0.3e6).abs() < 0.03e6, "{stress}: {highest:e}");
        // Until sound has gone half a radius in the liquid and four in the steel.
        while sides.fluid.solver().time() < 0.5 * 0.002 / 1465.0 {
            assert!(sides.round(|_, _| ()), "the run is long");
        }
        let speed = off(&sides) / thrown;
        eprintln!("{stress}: {speed:.4} of {thrown:.4} m/s");
        assert!(speed < 0.1, "{stress}: {speed}");
    }
}

/// The stress of the start is that of a half-space: beneath the wall it falls off as the distance grows, where columns would carry
/// their own pressure all the way down. Sides that a half-space has not keep the columns.
#[test]
fn the_stress_of_the_start_falls_off_with_the_depth() {
    let von_mises = |sides: &Sides, most: f64| {
        let cells = solid_cells(sides.solid.solver());
        let beneath = cells.iter().filter(|([z, _], _)| *z < -most);
        beneath.fold(0.0_f64, |largest, (_, w)| {
            largest.max(solid::von_mises(w.stress_zz, w.stress_zr, w.stress_rr, w.stress_phiphi))
        })
    };
    let half_space = at_start("hydrostatic");
    let columns = {
        let mut all = parts("hydrostatic");
        all[4] += "[solid.boundary]\nr_max = \"free\"\n";
        Sides::of_parts(&all.each_ref().map(String::as_str))
    };
    let [[near, far], [near_columns, far_columns]] =
        [&half_space, &columns].map(|sides| [0.0, 0.007].map(|depth| von_mises(sides, depth)));
    eprintln!("{near:e} {far:e} {near_columns:e} {far_columns:e}");
    assert!((near_columns / 0.7e6 - 1.0).abs() < 0.05 && far_columns > 0.99 * near_columns);
    assert!(near < 0.55 * near_columns && far < 0.9 * near, "{near:e} {far:e}");
}

/// What a run has recorded begins on a solid alone as it began there.
#[test]
fn a_recorded_start_begins_with_the_same_stress() {
    let place = tempfile::tempdir().unwrap();
    let mut all = parts("hydrostatic");
    all[0] = "[time]\nend = 2e-8\n".to_owned();
    let recorded = case(&all.concat());
    crate::hits::run(&recorded, &place.path().join("run"));
    all[1].clear();
    all[2].clear();
    let load =
        format!("[coupling]\nscheme = \"load\"\n[coupling.load]\nrun = {:?}\n", place.path().join("run"));
    let alone = case(&(all.concat() + &load));
    let cells = |case: &Case| {
        let solid = case.solid.as_ref().expect("a solid");
        solid_cells(&solid_solver(case, solid).expect("a solver"))
    };
    let (first, again) = (cells(&recorded), cells(&alone));
    assert!(first == again, "{:?} {:?}", first[0], again[0]);
}
