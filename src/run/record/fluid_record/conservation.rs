//! The history of what is conserved in the fluid, with what crossed its sides.

use fluid::FluidSolver;
use mesh::BLOCK;

use crate::output::Column;
use crate::run::record::{MOMENTUM, TIME, column, through_sides};

/// Its columns.
pub fn columns() -> Vec<Column<'static>> {
    let mut columns = TOTALS.to_vec();
    for side in 0..4 {
        columns.extend(THROUGH_SIDES.map(|quantity| quantity[side]));
    }
    columns.extend(FLOOR_AND_INTERFACE);
    columns.push(GAS);
    columns.extend(GAS_THROUGH_SIDES);
    columns.extend(OTHERS);
    columns
}

/// A row of it.
pub fn row(solver: &FluidSolver<BLOCK>) -> Vec<f64> {
    let (totals, ledger, fixups) = (solver.totals(), solver.ledger(), solver.fixups());
    let mut row = vec![solver.time(), totals.mass, totals.momentum_z, totals.energy];
    for side in 0..4 {
        row.extend([ledger.mass[side], ledger.momentum[side], ledger.energy[side]]);
    }
    row.extend([fixups.floor_energy, ledger.wall_impulse, ledger.wall_work]);
    row.push(totals.gas_mass);
    row.extend(ledger.gas_mass);
    row.push(fixups.gas_mass_added - fixups.liquid_mass_added);
    row.extend([ledger.tension_impulse, ledger.tension_work]);
    let phases = solver.phase_ledger();
    row.extend([phases.evaporated - phases.condensed, phases.energy, ledger.wall_heat]);
    row
}

const TOTALS: [Column<'static>; 4] = [
    TIME,
    column("mass", "kg/rad", "mass in the domain (planar: kg/m)"),
    MOMENTUM,
    column("energy", "J/rad", "energy in the domain"),
];

/// Mass, momentum and energy that came in, on each side.
const THROUGH_SIDES: [[Column<'static>; 4]; 3] = [
    through_sides!(
        "mass",
        "kg/rad",
        [
            "mass that came in through z_min; under a solid the wall's motion carries it",
            "the same through z_max",
            "the same through "
        ]
    ),
    through_sides!(
        "momentum",
        "N s/rad",
        [
            "axial momentum and impulse of the pressure through z_min",
            "the same through z_max",
            "the same through "
        ]
    ),
    through_sides!(
        "energy",
        "J/rad",
        ["energy and work of the pressure through z_min", "the same through z_max", "the same through "]
    ),
];

const FLOOR_AND_INTERFACE: [Column<'static>; 3] = [
    column("energy_from_floor", "J/rad", "energy that the pressure floor added"),
    column(
        "interface_impulse",
        "N s/rad",
        "impulse of p* on the interface: minus the solid's momentum_in_z_max",
    ),
    column("interface_work", "J/rad", "work of p* on the fluid: minus the solid's energy_in_z_max"),
];

const GAS: Column<'static> = column(
    "gas_mass",
    "kg/rad",
    "mass of the gas in the domain (planar: kg/m); NaN where phases have no masses",
);

const GAS_THROUGH_SIDES: [Column<'static>; 4] = through_sides!(
    "gas_mass",
    "kg/rad",
    [
        "mass of the gas that came in through z_min; under a solid the wall's motion carries it",
        "the same through z_max",
        "the same through "
    ]
);

const OTHERS: [Column<'static>; 6] = [
    column(
        "gas_mass_from_fixups",
        "kg/rad",
        "mass that the gas got from the liquid where it had less than none, and the other way round",
    ),
    column("tension_impulse", "N s/rad", "axial impulse of surface tension on the fluid"),
    column("tension_work", "J/rad", "work of surface tension on the fluid"),
    column("gas_mass_evaporated", "kg/rad", "mass that evaporated, less what condensed"),
    column(
        "energy_from_phase_change",
        "J/rad",
        "what that adds to the energy, which leaves reference energies out",
    ),
    column(
        "heat_to_wall",
        "J/rad",
        "heat that the wall on z_min got by conduction; energy_in_z_min has it, too",
    ),
];
