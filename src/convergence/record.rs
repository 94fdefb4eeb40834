//! The record of a study, `convergence.json`; docs/reference/output-summary.md says what is in it.

use mesh::Geometry;
use serde_json::{Map, Value, json};

use crate::case::GridCase;
use crate::convergence::analysis::{Analysis, RATIO, analyse};
use crate::convergence::numbers::{KeyNumber, of_summaries};
use crate::convergence::plan::{End, Grid};

/// What the record's keys mean; a change of that counts it up.
const SCHEMA: u32 = 1;

/// The numbers of all grids, and what they come to.
pub fn numbers(grids: &[Grid], ends: &[End]) -> Vec<(KeyNumber, Analysis)> {
    let summaries: Vec<_> = ends
        .iter()
        .map(|end| match end {
            End::Completed(summary) => Some(summary),
            End::None | End::Failed(_) => None,
        })
        .collect();
    let analysed = |number: KeyNumber| {
        let analysis = analyse(&number.values);
        (number, analysis)
    };
    let geometry = grids.first().map_or(Geometry::Axisymmetric, |grid| grid.case.geometry);
    of_summaries(&summaries, geometry).into_iter().map(analysed).collect()
}

/// The record.
pub fn of(grids: &[Grid], ends: &[End]) -> Map<String, Value> {
    let of_number = |(number, analysis): (KeyNumber, Analysis)| {
        let value = json!({
            "unit": number.unit,
            "values": number.values,
            "convergence": analysis.convergence.name(),
            "grids": analysis.grids,
            "order": analysis.order,
            "richardson": analysis.richardson,
            "order_used": analysis.order_used,
            "safety_factor": analysis.safety_factor,
            "gci": analysis.gci,
            "uncertainties": analysis.uncertainties,
            "spread": analysis.spread,
        });
        (number.name, value)
    };
    Map::from_iter([
        ("schema".to_owned(), json!(SCHEMA)),
        ("program".to_owned(), json!(format!("cav {}", env!("CARGO_PKG_VERSION")))),
        ("case_name".to_owned(), json!(grids.first().map(|grid| &grid.case.name))),
        ("ratio".to_owned(), json!(RATIO)),
        ("grids".to_owned(), grids.iter().zip(ends).map(|(grid, end)| of_grid(grid, end)).collect()),
        ("numbers".to_owned(), Value::Object(numbers(grids, ends).into_iter().map(of_number).collect())),
    ])
}

fn of_grid(grid: &Grid, end: &End) -> Value {
    let sides = [
        ("fluid", grid.case.fluid.as_ref().map(|side| &side.grid)),
        ("solid", grid.case.solid.as_ref().map(|side| &side.grid)),
    ];
    let of_sides = |value: fn(&GridCase) -> Value| -> Value {
        let there = sides.iter().filter_map(|(side, grid)| Some(((*side).to_owned(), value(grid.as_ref()?))));
        Value::Object(there.collect())
    };
    let hash: String = grid.case.hash().iter().map(|byte| format!("{byte:02x}")).collect();
    let (error, seconds) = match end {
        End::None => (None, None),
        End::Completed(summary) => (None, summary.get("wall_seconds")),
        End::Failed(error) => (Some(error), None),
    };
    json!({
        "directory": grid.directory.file_name().map(|name| name.to_string_lossy()),
        "levels": of_sides(|grid| json!(grid.levels)),
        "finest": of_sides(|grid| json!(grid.finest())),
        "cells_per_radius": grid.case.cells_per_radius(),
        "case_hash": hash,
        "completed": matches!(end, End::Completed(_)),
        "error": error,
        "wall_seconds": seconds,
    })
}
