//! The cut of a bubble's gas in the ledger and in the summary, of cases with one.

use fluid::FluidSolver;
use mesh::BLOCK;
use serde_json::{Map, Value, json};

use crate::output::{Column, HistoryFile, OutputError, SeriesId};
use crate::run::record::column;

/// Beside the columns of what is conserved, at the same times.
const COLUMNS: [Column<'static>; 4] = [
    column("mass_from_reset", "kg/rad", "mass that came with the cut of a bubble's gas (below zero: left)"),
    column("momentum_from_reset", "N s/rad", "axial momentum, likewise"),
    column("energy_from_reset", "J/rad", "energy, likewise"),
    column("gas_mass_from_reset", "kg/rad", "mass of the gas, likewise; NaN where phases have no masses"),
];

/// The rows of the ledger that are about the cut; none in cases without.
pub(super) struct CutRecord(Option<SeriesId>);

impl CutRecord {
    /// Makes the series of a case with a cut.
    pub fn create(solver: &FluidSolver<BLOCK>, history: &mut HistoryFile) -> Result<Self, OutputError> {
        let series = solver.cuts_a_bubble().then(|| history.add_series("/conservation/fluid", &COLUMNS));
        series.transpose().map(Self)
    }

    /// Writes a row.
    pub fn write(&self, solver: &FluidSolver<BLOCK>, history: &mut HistoryFile) -> Result<(), OutputError> {
        let Some(series) = self.0 else { return Ok(()) };
        let none = if solver.totals().gas_mass.is_nan() { f64::NAN } else { 0.0 };
        let cut = solver.bubble_reset();
        let of_gas = cut.map_or(0.0, |cut| cut.gas_mass[1] - cut.gas_mass[0]);
        let row = cut.map_or([0.0; 3], |cut| [cut.mass, cut.momentum_z, cut.energy]);
        history.push(series, &[row[0], row[1], row[2], of_gas + none])
    }
}

/// The keys of the summary; null as long as the gas is not cut. Masses are whole.
///
/// - `radius`: the equivalent radius of a volume.
pub(super) fn summary(solver: &FluidSolver<BLOCK>, radius: impl Fn(f64) -> f64) -> Map<String, Value> {
    if !solver.cuts_a_bubble() {
        return Map::new();
    }
    let turn = std::f64::consts::TAU;
    let cut = solver.bubble_reset();
    let values = [
        ("reset_time", cut.map(|cut| cut.time)),
        ("reset_equivalent_radius", cut.map(|cut| radius(cut.volume))),
        ("reset_gas_mass_before", cut.map(|cut| turn * cut.gas_mass[0])),
        ("reset_gas_mass_after", cut.map(|cut| turn * cut.gas_mass[1])),
        ("reset_gas_pressure_before", cut.map(|cut| cut.pressure[0])),
        ("reset_gas_pressure_after", cut.map(|cut| cut.pressure[1])),
        ("reset_energy", cut.map(|cut| turn * cut.energy)),
    ];
    values.into_iter().map(|(key, value)| (key.to_owned(), json!(value))).collect()
}
