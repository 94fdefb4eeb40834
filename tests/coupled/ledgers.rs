//! What one side gives the other gets; what a closed box has it keeps.

use crate::fixture::{THIN_GAS, bubble, inner_sides, steel, water};
use crate::harness::Sides;

/// Cells of the fluid and of the solid, which do not match: 2:3 on equal levels.
const UNIFORM: [&str; 2] = ["cells = [32, 32]\n", "cells = [32, 48]\n"];
/// The same in levels that come and go, on either side as its own waves ask for.
const ADAPTIVE: [&str; 2] = [
    "cells = [8, 8]\nlevels = 4\nadapt_every = 3\nepsilon = 2e-1\n",
    "cells = [16, 24]\nlevels = 4\nadapt_every = 4\nepsilon = 2e-2\n",
];

/// A gas bubble that collapses in a closed box over steel.
///
/// - `local`: whether levels step by themselves.
fn closed_box(model: &str, geometry: &str, grids: [&str; 2], local: bool) -> Sides {
    let centre = if geometry == "planar" { [0.004, 0.005] } else { [0.004, 0.0] };
    closed_box_of(centre, model, geometry, grids, local)
}

/// The same with the bubble at another place.
fn closed_box_of(centre: [f64; 2], model: &str, geometry: &str, grids: [&str; 2], local: bool) -> Sides {
    let inner = inner_sides(geometry);
    let lines = |z: [f64; 2], cells: &str| format!("z = {z:?}\nr = [0.0, 0.01]\n{cells}");
    Sides::of_parts(&[
        &format!("geometry = \"{geometry}\"\n[time]\nend = 8e-6\nlocal_steps = {local}\n"),
        &water(&format!("{}model = \"{model}\"\nlimiter = \"minmod\"\n", lines([0.0, 0.01], grids[0])), 5e7),
        &bubble(centre, 0.002, THIN_GAS),
        "[fluid.boundary]\nz_max = \"wall\"\nr_max = \"wall\"\n",
        inner[0],
        &steel(&lines([-0.01, 0.0], grids[1])),
        "[solid.boundary]\nz_min = \"fixed\"\nr_max = \"symmetry\"\n",
        inner[1],
    ])
}

/// Gas on a wall that moves is carried through the face that does not: what the gas has lost the ledger has.
#[test]
fn gas_that_lies_on_a_moving_wall_is_accounted_for() {
    for local in [false, true] {
        let mut sides = closed_box_of([0.001, 0.0], "five-equation", "axisymmetric", ADAPTIVE, local);
        let before = sides.fluid.solver().totals().gas_mass;
        sides.run(|_, _| {});
        let fluid = sides.fluid.solver();
        let (now, ledger, fixups) = (fluid.totals().gas_mass, fluid.ledger(), fluid.fixups());
        let through_wall = ledger.gas_mass[0] / before;
        assert!(through_wall.abs() > 1e-6, "the wall moves gas: {through_wall:e}");
        assert_eq!(ledger.gas_mass[1..], [0.0; 3]);
        let wanted = before + ledger.gas_mass[0] + fixups.gas_mass_added - fixups.liquid_mass_added;
        let off = (now - wanted).abs() / before;
        eprintln!("local steps {local}: {through_wall:e} of the gas through the wall, off by {off:.1e}");
        assert!(off < 1e-12, "{off:e}");
    }
}

/// Round-off of sums over some thousand cells and some hundred steps, relative to the sums of absolute values.
const ROUND_OFF: f64 = 1e-13;

#[test]
fn a_coupled_box_keeps_its_ledgers() {
    let (default, papers) = ("five-equation", "saurel-abgrall");
    for (model, geometry, grids, local) in [
        (default, "planar", UNIFORM, false),
        (default, "axisymmetric", UNIFORM, false),
        (default, "planar", ADAPTIVE, false),
        (default, "planar", ADAPTIVE, true),
        (default, "axisymmetric", ADAPTIVE, true),
        (papers, "axisymmetric", UNIFORM, false),
        (papers, "axisymmetric", ADAPTIVE, true),
    ] {
        let mut sides = closed_box(model, geometry, grids, local);
        let mut faces = [Vec::new(), Vec::new()];
        let before = (sides.fluid.solver().totals(), sides.solid.solver().totals());
        // Sums of absolute values that the round-off is to be measured by: impulse, work, both at the wall.
        let [mut impulse, mut work] = [0.0, 0.0];
        let mut last = [0.0; 2];
        sides.run(|fluid, solid| {
            faces[0].push(fluid.interface().faces());
            faces[1].push(solid.interface().faces());
            let ledger = fluid.ledger();
            impulse += (ledger.wall_impulse - last[0]).abs();
            work += (ledger.wall_work - last[1]).abs();
            last = [ledger.wall_impulse, ledger.wall_work];
        });
        let (fluid, solid) = (sides.fluid.solver(), sides.solid.solver());
        let (now, ledger, fixups) = (fluid.totals(), fluid.ledger(), fluid.fixups());
        assert!(fluid.steps() > 60 && fluid.bubble().volume > 0.0, "{} steps", fluid.steps());
        faces.iter_mut().for_each(Vec::dedup);
        eprintln!("{model}, {geometry}: faces of the interface {faces:?}");
        let changes = faces.iter().any(|faces| faces.len() > 1);
        assert_eq!(changes, grids == ADAPTIVE, "the interface changes in size");
        let moved = solid.totals().kinetic;
        assert!(moved > 0.0 && work > 0.0, "the wall moves");

        let sum = |sides: [f64; 4]| sides.iter().sum::<f64>();
        let size = |sides: [f64; 4]| sides.iter().map(|side| side.abs()).sum::<f64>();
        let check = |what: &str, found: f64, wanted: f64, scale: f64| {
            let error = (found - wanted).abs() / scale;
            eprintln!("{geometry}: {what} {found:e}, off by {error:.1e}");
            assert!(error < ROUND_OFF, "{geometry}: {what}: {found:e} of {wanted:e}, off by {error:.1e}");
        };
        check("fluid mass", now.mass - before.0.mass, sum(ledger.mass), now.mass);
        let wanted = sum(ledger.energy) + fixups.floor_energy;
        check("fluid energy", now.energy - before.0.energy, wanted, now.energy);
        let gained = now.momentum_z - before.0.momentum_z;
        check("fluid momentum", gained, sum(ledger.momentum), size(ledger.momentum));
        let below = solid.ledger();
        let gained = solid.totals().momentum_z - before.1.momentum_z;
        check("solid momentum", gained, sum(below.momentum), size(below.momentum));
        let z_max = mesh::Side::ZMax as usize;
        check("impulse to the solid", -below.momentum[z_max], ledger.wall_impulse, impulse);
        check("work on the solid", -below.energy[z_max], ledger.wall_work, work);
        // Walls and the fixed bottom do no work.
        assert_eq!(ledger.mass[1..], [0.0; 3]);
        assert_eq!(ledger.energy[1..], [0.0; 3]);
        assert_eq!(below.energy[0], 0.0);
        // The solid's scheme may lose energy, never gain it; prediction on new cells may bring a little.
        let tolerance = if grids == ADAPTIVE { 1e-4 } else { ROUND_OFF };
        let totals = |t: &solid::Totals| t.kinetic + t.elastic;
        let dissipated = totals(&before.1) + below.energy.iter().sum::<f64>() - totals(&solid.totals());
        assert!(dissipated > -tolerance * totals(&solid.totals()), "{dissipated:e}");
    }
}
