//! The film of liquid between the bubble and the wall: how thin it becomes, and by how many cells it is resolved.

use fluid::{Film, FluidSolver};
use mesh::BLOCK;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::output::{Column, HistoryFile, OutputError, SeriesId};
use crate::run::record::column;

/// The history of the film.
#[derive(Clone, Copy, Debug)]
pub struct FilmRecord(SeriesId);

/// The film where it had the fewest cells, as long as there was one everywhere.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct ThinnestFilm {
    /// With its time, s.
    thinnest: Option<(Film, f64)>,
    /// When gas first lay on the wall, s.
    broken: Option<f64>,
}

impl FilmRecord {
    /// Makes its history.
    pub fn create(history: &mut HistoryFile) -> Result<Self, OutputError> {
        history.add_series("", &COLUMNS).map(Self)
    }

    /// Takes notice of a finished step.
    pub fn after_step(
        self,
        solver: &FluidSolver<BLOCK>,
        ThinnestFilm { thinnest, broken }: &mut ThinnestFilm,
        history: &mut HistoryFile,
    ) -> Result<(), OutputError> {
        let (film, is_broken) = solver.film();
        let row = film.map_or([f64::NAN; 3], |film| [film.thickness, film.cells(), film.radius]);
        history.push(self.0, &row)?;
        if is_broken && broken.is_none() {
            *broken = Some(solver.time());
        }
        if let Some(film) = film.filter(|_| broken.is_none())
            && thinnest.is_none_or(|(least, _)| film.cells() < least.cells())
        {
            *thinnest = Some((film, solver.time()));
        }
        Ok(())
    }
}

impl ThinnestFilm {
    /// Its part of the summary.
    pub fn summary(&self) -> Map<String, Value> {
        let film = self.thinnest.map(|(film, _)| film);
        let entries = [
            ("film_cells_min", json!(film.map(|film| film.cells()))),
            ("film_thickness_min", json!(film.map(|film| film.thickness))),
            ("film_thickness_min_radius", json!(film.map(|film| film.radius))),
            ("film_thickness_min_time", json!(self.thinnest.map(|(_, time)| time))),
            ("gas_on_wall_time", json!(self.broken)),
        ];
        entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
    }
}

const COLUMNS: [Column<'static>; 3] = [
    column(
        "film/thickness",
        "m",
        "of the liquid between gas and wall, where it is resolved by the fewest cells; NaN where there is none thinner than a block",
    ),
    column("film/cells", "1", "cells across it there"),
    column("film/radius", "m", "where that is"),
];
