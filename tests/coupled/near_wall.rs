//! Bubbles at and near the wall, through the second collapse: a coarse part of `tests/long/near_wall.py`.

use crate::fixture::{THIN_GAS, bubble, grid, steel, water};
use crate::harness::Sides;

/// Radius of the bubble, m.
const RADIUS: f64 = 0.01;

/// A bubble of 12.8 cells per radius, its centre so many radii above a solid, until 2.9 Rayleigh times: 2.5 collapse times of the slowest.
///
/// - `lines`: of `[time]`; `fluid`: of `[fluid]`; `material`: of the solid.
fn near_wall(stand_off: f64, pressure: f64, [lines, fluid, material]: [&str; 3]) -> Sides {
    let end = 2.9 * 0.915 * RADIUS * (1000.0 / (pressure - THIN_GAS[1])).sqrt();
    let cells = |z| grid(z, 0.05, [16, 16]) + "levels = 2\n";
    let solid = steel(&cells([-0.05, 0.0])).replace("structural-steel", material);
    Sides::of_parts(&[
        &format!("[time]\nend = {end:e}\n{lines}"),
        &water(&(cells([0.0, 0.05]) + fluid), pressure),
        &bubble([stand_off * RADIUS, 0.0], RADIUS, THIN_GAS),
        &solid,
    ])
}

#[test]
fn bubbles_at_any_distance_from_the_wall_go_through_two_collapses() {
    const STEEL: &str = "structural-steel";
    const RAYLEIGH: &str = "initial_pressure = \"rayleigh\"\n";
    const LOCAL: &str = "local_steps = true\n";
    for (stand_off, pressure, lines) in [
        (0.0, 5e7, ["", "", STEEL]),
        (0.1, 5e7, [LOCAL, RAYLEIGH, STEEL]),
        (0.3, 5e7, ["", "", "pmma"]),
        (0.5, 5e7, [LOCAL, "", STEEL]),
        (0.7, 5e7, ["", RAYLEIGH, "aluminium"]),
        (0.9, 5e7, ["", "", STEEL]),
        (1.0, 5e7, [LOCAL, RAYLEIGH, STEEL]),
        (1.1, 5e7, ["", "near_wall.film_levels = 2\n", "pmma"]),
        (1.3, 5e7, ["", RAYLEIGH, STEEL]),
        (1.6, 5e7, [LOCAL, "", "aluminium"]),
        (2.2, 5e7, ["", RAYLEIGH, STEEL]),
        (3.0, 5e7, ["", "", "pmma"]),
        (0.4, 5e6, ["", RAYLEIGH, "pmma"]),
        (1.05, 5e6, [LOCAL, "", STEEL]),
    ] {
        let what = format!("d/R = {stand_off}, {pressure:e} Pa, {lines:?}");
        let mut sides = near_wall(stand_off, pressure, lines);
        let (before, energy) =
            (sides.fluid.solver().totals(), pressure * sides.fluid.solver().bubble().volume);
        let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
        sides.run(|fluid, _| {
            let volume = fluid.bubble().volume;
            // What follows the smallest: the rebound.
            if volume < smallest {
                (smallest, largest) = (volume, volume);
            }
            largest = largest.max(volume);
        });
        let fluid = sides.fluid.solver();
        let (now, ledger, fixups) = (fluid.totals(), fluid.ledger(), fluid.fixups());
        let sum = |sides: [f64; 4]| sides.iter().sum::<f64>();
        let gas = sum(ledger.gas_mass) + fixups.gas_mass_added - fixups.liquid_mass_added;
        let off = [
            (now.gas_mass - before.gas_mass - gas) / before.gas_mass,
            (now.mass - before.mass - sum(ledger.mass)) / before.mass,
            (now.energy - before.energy - sum(ledger.energy) - fixups.floor_energy) / before.energy,
        ];
        let floor = std::f64::consts::TAU * fixups.floor_energy / energy;
        let shown = off.map(|off| format!("{off:.1e}")).join(", ");
        eprintln!(
            "{what}: gas, mass, energy off by {shown}, rebound {:.3}, redone {}, floor {floor:.1e}",
            (largest / smallest).cbrt(),
            fixups.redone
        );
        assert!(off.iter().all(|off| off.abs() < 1e-10), "{what}: gas, mass, energy off by {shown}");
        assert!(largest > 1.3 * smallest, "{what}: it rebounds");
        assert_eq!(fixups.floored, 0, "{what}: the floor adds {floor:e} of the energy");
        assert!(
            (fixups.redone as f64) < 1e-3 * fluid.cell_updates() as f64,
            "{what}: {} redone",
            fixups.redone
        );
    }
}

/// A film below a bubble just above the wall has the cells that the case names from the start on, and is followed until it is far thinner.
#[test]
fn a_film_is_followed_by_the_levels_that_the_case_names() {
    let followed = |levels: usize| {
        let film = format!(
            "initial_pressure = \"rayleigh\"\nnear_wall.film_levels = {levels}\nnear_wall.film_cells = 3\n"
        );
        let mut sides = near_wall(1.05, 5e7, ["", &film, "structural-steel"]);
        let at_first = sides.fluid.solver().film().0.expect("a film").cells();
        let (mut thinnest, mut is_whole) = (f64::INFINITY, true);
        sides.run(|fluid, _| {
            let (film, is_broken) = fluid.film();
            is_whole &= !is_broken;
            if let Some(film) = film.filter(|_| is_whole) {
                thinnest = film.thickness.min(thinnest);
            }
        });
        [at_first, thinnest]
    };
    let [[coarse_cells, coarse], [fine_cells, fine]] = [0, 3].map(followed);
    eprintln!(
        "{coarse_cells:.2} cells, {coarse:e} m; with up to three levels more {fine_cells:.2} cells, {fine:e} m"
    );
    assert!(coarse_cells < 1.0 && fine_cells >= 3.0, "{coarse_cells} {fine_cells}");
    assert!(fine < 0.5 * coarse, "{coarse:e} {fine:e}");
}
