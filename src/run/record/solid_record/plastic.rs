//! What is written of plastic flow, in runs whose solid can yield.

use mesh::{BLOCK, Side};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use solid::SolidSolver;

use crate::output::Column;
use crate::run::record::column;

/// Beside those of `/solid` of every step.
pub const STEP_COLUMNS: [Column<'static>; 2] = [
    column("plastic_strain_max", "1", "largest plastic strain, of parabolas through the cells about it"),
    column("plastic_work", "J", "plastic work so far (planar: J/m)"),
];

/// Beside those of `/conservation/solid`.
pub const CONSERVATION_COLUMN: Column<'static> =
    column("energy_plastic", "J/rad", "plastic work so far, which does not count as dissipated");

/// Plastic strains from which on a cell belongs to the plastic zone.
const THRESHOLDS: [(&str, f64); 2] = [("", 1e-4), ("_2e-3", 2e-3)];

/// The largest numbers of plastic flow so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlasticPeak {
    strain: f64,
    position: [f64; 2],
    time: f64,
    temperature: f64,
}

impl PlasticPeak {
    /// Takes notice of the present state; returns the columns of the step.
    pub fn follow(&mut self, solver: &SolidSolver<BLOCK>) -> [f64; 2] {
        let peak = solver.plastic_strain_peak();
        if let Some(peak) = peak.filter(|peak| peak.strain > self.strain) {
            (self.strain, self.position, self.time) = (peak.strain, peak.position, solver.time());
        }
        self.temperature = self.temperature.max(solver.temperature_max());
        [peak.map_or(0.0, |peak| peak.strain), whole_work(solver)]
    }

    /// The solid's part of the summary that is about plastic flow.
    pub fn summary(&self, solver: &SolidSolver<BLOCK>) -> Map<String, Value> {
        let has_flowed = self.strain > 0.0;
        let mut map = Map::new();
        let mut put = |key: &str, value: Value| map.insert(key.to_owned(), value);
        put("plastic_strain_peak", json!(self.strain));
        put("plastic_strain_peak_position", json!(has_flowed.then_some(self.position)));
        put("plastic_strain_peak_time", json!(has_flowed.then_some(self.time)));
        put("plastic_strain_rate_peak", json!(solver.plastic_ledger().rate_peak));
        put("plastic_work", json!(whole_work(solver)));
        if solver.interface().faces() > 0 {
            let given = work_on_solid(solver);
            put("work_on_solid", json!(given));
            // More comes from the stress that the run began with.
            let share = (given > 0.0).then_some(whole_work(solver) / given).filter(|share| *share <= 1.0);
            put("plastic_work_share", json!(share));
        }
        if solver.has_heat() {
            put("temperature_peak", json!(self.temperature));
        }
        for (name, threshold) in THRESHOLDS {
            let zone = solver.plastic_zone(threshold);
            put(&format!("plastic_zone_depth{name}"), json!(zone.depth));
            put(&format!("plastic_zone_radius{name}"), json!(zone.radius));
            put(&format!("plastic_volume{name}"), json!(zone.volume));
        }
        map
    }
}

/// Work done on the surface so far, J (planar: J/m).
fn work_on_solid(solver: &SolidSolver<BLOCK>) -> f64 {
    solver.mesh().domain().geometry.turn() * solver.ledger().energy[Side::ZMax as usize]
}

/// Plastic work so far, J (planar: J/m).
fn whole_work(solver: &SolidSolver<BLOCK>) -> f64 {
    solver.mesh().domain().geometry.turn() * solver.plastic_ledger().work
}
