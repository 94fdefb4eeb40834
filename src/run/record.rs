//! What both sides' records have in common.

use mesh::{BLOCK, Mesh};

use crate::case::{Case, Probe};
use crate::output::{Column, HistoryFile, OutputError, SeriesId};

/// Points and quadrilaterals of all cells: (BLOCK + 1)² points a block, cells in the order of snapshots.
pub struct CellGeometry {
    /// x = z, y = r, z = 0.
    pub points: Vec<f64>,
    /// Corners of each cell.
    pub quads: Vec<[usize; 4]>,
}

impl CellGeometry {
    /// Of all blocks of a mesh.
    pub fn of(mesh: &Mesh<BLOCK>) -> Self {
        let row = BLOCK + 1;
        let mut points = Vec::with_capacity(mesh.blocks() * row * row * 3);
        let mut quads = Vec::with_capacity(mesh.cells());
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            let [h_z, h_r] = mesh.widths(id.level);
            let [z, r] = mesh.origin(*id);
            for j in 0..row {
                for i in 0..row {
                    points.extend([z + i as f64 * h_z, r + j as f64 * h_r, 0.0]);
                }
            }
            let first = slot * row * row;
            for j in 0..BLOCK {
                for i in 0..BLOCK {
                    let low = first + j * row + i;
                    quads.push([low, low + 1, low + row + 1, low + row]);
                }
            }
        }
        Self { points, quads }
    }
}

/// Events at fixed intervals of simulated time, at the first step at or after each.
#[derive(Clone, Copy, Debug)]
pub struct Ticker {
    every: f64,
    next: f64,
}

impl Ticker {
    /// Shares of the run after which the slower histories are written where the case does not say.
    const DEFAULT_SHARE: f64 = 1e-3;

    /// With the case's `output.interface_every`, or a thousandth of the run.
    pub fn of(case: &Case) -> Self {
        Self { every: case.output.interface_every.unwrap_or(Self::DEFAULT_SHARE * case.time.end), next: 0.0 }
    }

    /// Whether an event is due at `time`.
    pub fn is_due(&mut self, time: f64) -> bool {
        let due = time >= self.next * (1.0 - 1e-12);
        while self.next <= time * (1.0 + 1e-12) && self.every > 0.0 {
            self.next += self.every;
        }
        due
    }
}

/// A column of one number.
pub const fn column<'a>(name: &'a str, unit: &'a str, description: &'a str) -> Column<'a> {
    Column { name, unit, description, width: 1 }
}

/// A probe with its series.
pub struct ProbeSeries {
    /// Where and what.
    pub probe: Probe,
    /// Its series.
    pub series: SeriesId,
    /// Whether it lies on the interface between the media.
    pub on_interface: bool,
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
            Ok(ProbeSeries { probe: probe.clone(), series, on_interface })
        })
        .collect()
}

/// A value between the centres of interface faces, linear in r, constant beyond the first and the last centre.
pub fn between_faces(edges: &[f64], begin: f64, r: f64, value: impl Fn(usize) -> f64) -> f64 {
    let centre = |k: usize| 0.5 * (edges[k] + if k == 0 { begin } else { edges[k - 1] });
    let above = (0..edges.len()).find(|k| centre(*k) >= r);
    match above {
        None => value(edges.len() - 1),
        Some(0) => value(0),
        Some(k) => {
            let share = (r - centre(k - 1)) / (centre(k) - centre(k - 1));
            value(k - 1) + share * (value(k) - value(k - 1))
        }
    }
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
    fn values_between_faces_are_linear() {
        let edges = [1.0, 2.0, 3.0];
        let value = |k: usize| 10.0 * (k as f64 + 0.5);
        assert_eq!(between_faces(&edges, 0.0, 1.5, value), 15.0);
        assert_eq!(between_faces(&edges, 0.0, 2.0, value), 20.0);
        assert_eq!(between_faces(&edges, 0.0, 0.1, value), 5.0);
        assert_eq!(between_faces(&edges, 0.0, 3.0, value), 25.0);
    }
}
