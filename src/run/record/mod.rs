//! What both sides' records have in common.
//!
//! | module | is |
//! |---|---|
//! | [`fluid_record`], [`solid_record`] | what each side writes |
//! | [`of_side`] | what records of both sides can do |
//! | [`side_files`] | into which files |
//! | [`interface_history`] | of the interface on a fixed grid |
//! | [`sensors`] | of discs on it |
//! | [`wall_axis`] | of the pressure on it at the axis: its largest mean, its impulse |
//! | [`load_impulse`] | the impulse of a load |
//! | [`running_mean`] | the mean over the last while, whatever the steps |
//! | [`two_collapses`] | the rebound, the second collapse, and what either load did |
//! | [`surface`] | of the solid's surface: its displacement and the pit in it |
//! | [`collapse`] | the collapse time |
//! | [`film`] | of the liquid between bubble and wall |
//! | [`timed`] | where the wall time goes |
//! | [`equivalent_load`] | the Gaussian pulse nearest to what pressed on the wall |
//! | [`answer`] | the answer in words |
//! | [`how_sure`] | what a study of grid convergence says of it |
//! | [`conclusion`] | one history and one summary of both sides' parts |

pub mod answer;
pub mod collapse;
pub mod conclusion;
pub mod equivalent_load;
pub mod film;
pub mod fluid_record;
pub mod how_sure;
pub mod interface_history;
pub mod load_impulse;
pub mod of_side;
pub mod running_mean;
pub mod sensors;
pub mod side_files;
pub mod solid_record;
pub mod surface;
pub mod timed;
pub mod two_collapses;
pub mod wall_axis;
mod wall_heat;
mod wall_peak;
mod wall_shear;

use mesh::{BLOCK, BlockId, Limiter, Mesh, Misfit};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::case::{Case, Probe};
use crate::output::{BlockMesh, Column, HistoryFile, OutputError, SeriesId};

/// The blocks of a mesh, cells in the order of snapshots.
pub fn cell_geometry(mesh: &Mesh<BLOCK>) -> BlockMesh<BLOCK> {
    let of_block = |id: &BlockId| [mesh.origin(*id), mesh.widths(id.level)];
    BlockMesh { blocks: mesh.tree().leaves().iter().map(of_block).collect() }
}

/// How many cells there were.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct CellCount {
    last: usize,
    largest: usize,
}

impl CellCount {
    /// Takes notice of the cells there are now.
    pub fn see(&mut self, cells: usize) {
        self.last = cells;
        self.largest = self.largest.max(cells);
    }

    /// `cells`, `cell_updates` and `steps_saved` of a side's part of the summary.
    ///
    /// - `common`: the updates if all levels made the steps of the finest.
    pub fn summary(&self, side: &str, updates: u64, common: u64) -> Map<String, Value> {
        let saved = if common == 0 { 0.0 } else { 1.0 - updates as f64 / common as f64 };
        let cells = json!({ "final": self.last, "largest": self.largest });
        Map::from_iter([
            ("cells".to_owned(), json!({ side: cells })),
            ("cell_updates".to_owned(), json!({ side: updates })),
            ("steps_saved".to_owned(), json!({ side: saved })),
        ])
    }
}

/// Events at fixed intervals of simulated time, at the first step at or after each.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Ticker {
    every: f64,
    next: f64,
}

impl Ticker {
    /// Of the slower histories.
    pub fn of(case: &Case) -> Self {
        Self { every: case.interface_every(), next: 0.0 }
    }

    /// Whether an event is due at `time`.
    pub fn is_due(&mut self, time: f64) -> bool {
        let due = time >= self.next * (1.0 - 1e-12);
        if due && self.every > 0.0 {
            // All intervals that have passed at once: a step may hold any number of them.
            self.next += ((time - self.next) / self.every).floor().max(0.0) * self.every;
            if self.next <= time * (1.0 + 1e-12) {
                self.next += self.every;
            }
        }
        due
    }
}

/// The entries of an object that `json!` has written.
pub fn entries(object: Value) -> Map<String, Value> {
    match object {
        Value::Object(entries) => entries,
        _ => unreachable!("an object was written"),
    }
}

/// A column of one number.
pub const fn column<'a>(name: &'a str, unit: &'a str, description: &'a str) -> Column<'a> {
    Column { name, unit, description, width: 1 }
}

/// Of histories with a row after each step.
pub const TIME_AFTER_STEP: Column<'static> = column("time", "s", "time after the step");
/// Of those with a row now and then.
pub const TIME: Column<'static> = column("time", "s", "time");
/// Of a side's whole domain.
pub const MOMENTUM: Column<'static> = column("momentum_z", "N s/rad", "axial momentum in the domain");
/// At a probe, along z and r.
pub const PROBE_VELOCITY: [Column<'static>; 2] = [
    column("velocity_z", "m/s", "axial velocity; on the interface that of the star state"),
    column("velocity_r", "m/s", "radial velocity"),
];

/// The columns of what came in through each of the four sides, `NAME_in_SIDE`, in their order.
///
/// - a description of z_min's, of z_max's, and of r_min's and r_max's but for the side.
macro_rules! through_sides {
    ($name:literal, $unit:literal, [$z_min:literal, $z_max:literal, $others:literal]) => {
        [
            $crate::run::record::column(concat!($name, "_in_z_min"), $unit, $z_min),
            $crate::run::record::column(concat!($name, "_in_z_max"), $unit, $z_max),
            $crate::run::record::column(concat!($name, "_in_r_min"), $unit, concat!($others, "r_min")),
            $crate::run::record::column(concat!($name, "_in_r_max"), $unit, concat!($others, "r_max")),
        ]
    };
}
pub(crate) use through_sides;

/// A probe with its series.
pub struct ProbeSeries {
    /// Where and what.
    pub probe: Probe,
    /// Its series.
    pub series: SeriesId,
    /// Whether it lies on the interface between the media.
    pub on_interface: bool,
    /// What of the star state there is known as means over steps.
    pub star: StepEnds,
}

/// From means over steps of two quantities to their values at given times.
///
/// A mean is the value at mid-step; taken for the one at the step's end it is late by half a step, an error of first order.
/// It is continued with the smaller of the last two rates of change, so that a front makes no overshoot.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct StepEnds {
    last: Option<([f64; 2], f64)>,
    rates: [f64; 2],
    limited: [f64; 2],
}

impl StepEnds {
    /// Values at `time` from the means over the last step, the middle of which was at `middle` (s). Several times may lie in
    /// one step, where levels have steps of their own.
    pub fn at(&mut self, means: [f64; 2], middle: f64, time: f64) -> [f64; 2] {
        if let Some((last, then)) = self.last.filter(|(_, then)| *then < middle) {
            for c in 0..means.len() {
                let rate = (means[c] - last[c]) / (middle - then);
                self.limited[c] = Limiter::Minmod.difference(self.rates[c], rate);
                self.rates[c] = rate;
            }
        }
        self.last = Some((means, middle));
        std::array::from_fn(|c| means[c] + (time - middle) * self.limited[c])
    }
}

/// What of probes lasts from one step to the next.
pub fn saved_probes(probes: &[ProbeSeries]) -> Vec<StepEnds> {
    let kept = |ProbeSeries { probe: _, series: _, on_interface: _, star }: &ProbeSeries| *star;
    probes.iter().map(kept).collect()
}

/// Takes up what was kept of the same probes.
pub fn restore_probes(probes: &mut [ProbeSeries], saved: Vec<StepEnds>) -> Result<(), Misfit> {
    if probes.len() != saved.len() {
        return Err(Misfit(format!("it has {} probes where the case has {}", saved.len(), probes.len())));
    }
    probes.iter_mut().zip(saved).for_each(|(probe, star)| probe.star = star);
    Ok(())
}

/// Makes the series `/probes/NAME` of all probes of one medium.
pub fn probe_series(
    case: &Case,
    medium: crate::case::Medium,
    interface_z: Option<f64>,
    columns: &[Column<'_>],
    file: &mut HistoryFile,
) -> Result<Vec<ProbeSeries>, OutputError> {
    (case.probes.iter().filter(|probe| probe.medium == medium))
        .map(|probe| {
            let series = file.add_series(&format!("/probes/{}", probe.name), columns)?;
            let on_interface = interface_z.is_some_and(|z| probe.position[0] == z);
            Ok(ProbeSeries { probe: probe.clone(), series, on_interface, star: StepEnds::default() })
        })
        .collect()
}

/// The attributes that every file of a run carries.
pub fn attributes(case: &Case) -> Vec<(&'static str, String)> {
    let hash = case.hash().iter().map(|byte| format!("{byte:02x}")).collect();
    vec![
        ("program", format!("cav {}", env!("CARGO_PKG_VERSION"))),
        ("git_revision", env!("CAV_GIT_REVISION").to_owned()),
        ("case_name", case.name.clone()),
        ("case_hash", hash),
        ("case", case.effective_toml()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ticker_ticks_once_an_interval() {
        let mut ticker = Ticker { every: 1.0, next: 0.0 };
        let ticks: Vec<f64> = (0..40).map(|k| 0.3 * f64::from(k)).filter(|t| ticker.is_due(*t)).collect();
        assert_eq!(ticks.len(), 12);
        assert_eq!(ticks[0], 0.0);
        assert!((ticks[1] - 1.2).abs() < 1e-12);
    }

    #[test]
    fn a_ticker_passes_any_number_of_intervals_at_once() {
        for every in [1e-30, 1e-300, f64::MIN_POSITIVE, 0.0, f64::NAN] {
            let mut ticker = Ticker { every, next: 0.0 };
            assert!((0..5).all(|k| ticker.is_due(0.3 * f64::from(k)) || !(every > 0.0)), "{every:e}");
        }
        let mut ticker = Ticker { every: 1e-3, next: 0.0 };
        assert!(ticker.is_due(0.5004) && !ticker.is_due(0.5009) && ticker.is_due(0.5011));
    }

    #[test]
    fn means_over_steps_give_the_values_at_their_ends() {
        // Twice within one step of 0.2 after one of 0.1: a line stays one.
        let mut within = StepEnds::default();
        let line = [[0.05, 0.1], [0.15, 0.2], [0.3, 0.3], [0.3, 0.4]];
        let values = line.map(|[middle, time]| within.at([2.0 * middle, -middle], middle, time));
        for (k, [up, down]) in values.into_iter().enumerate().skip(2) {
            assert!((up - 2.0 * line[k][1]).abs() < 1e-15 && (down + line[k][1]).abs() < 1e-15, "{values:?}");
        }

        // t² has the mean t² − t dt + dt²/3 over a step of length dt that ends at t.
        let mut ends = StepEnds::default();
        let (mut time, mut worst) = (1.0, 0.0_f64);
        for k in 0..100 {
            let dt = if k % 3 == 0 { 0.02 } else { 0.01 };
            time += dt;
            let mean = time * time - time * dt + dt * dt / 3.0;
            let [end, still] = ends.at([mean, 7.0], time - 0.5 * dt, time);
            assert_eq!(still, 7.0);
            worst = if k < 2 { 0.0 } else { worst.max((end - time * time).abs()) };
        }
        // The mean itself is off by time · dt, 0.05.
        assert!(worst < 1e-3, "{worst}");
        let mut front = StepEnds::default();
        let mut middle = 0.0;
        let passing = [0.0, 0.0, 0.7, 1.0, 1.0].map(|mean| {
            middle += 1.0;
            front.at([mean, 0.0], middle, middle + 0.5)[0]
        });
        assert!(passing.iter().all(|value| *value <= 1.15), "{passing:?}");
    }

    #[test]
    fn the_largest_and_the_last_number_of_cells_are_kept() {
        let mut count = CellCount::default();
        [4, 10, 6].into_iter().for_each(|cells| count.see(cells));
        let expected = json!({
            "cells": { "solid": { "final": 6, "largest": 10 } },
            "cell_updates": { "solid": 20 },
            "steps_saved": { "solid": 0.375 },
        });
        assert_eq!(Value::Object(count.summary("solid", 20, 32)), expected);
    }
}
