//! Initial states that Python functions give.
//!
//! A function is called with arrays z, r of the centres of all cells of a level at once, as soon as one of them is asked
//! for; a mesh that adapts asks for several levels.

use std::sync::{Mutex, OnceLock, PoisonError};

use cav::case::{Case, GridCase};
use cav::run::setup::{fluid_setup, solid_setup};
use fluid::{FluidSolver, Primitive};
use mesh::BLOCK;
use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use solid::{ElasticState, SolidSolver};

use crate::error::Failure;

/// More cells than this on a level are asked for one at a time.
const MOST_AT_ONCE: usize = 1 << 23;

/// What a Python function says of the cells of a domain.
struct GridFunction<'a, const COUNT: usize> {
    function: &'a Py<PyAny>,
    /// Keys of the dictionary that the function returns; those with a default may be left out.
    keys: [(&'static str, Option<f64>); COUNT],
    grid: &'a GridCase,
    levels: Vec<OnceLock<Vec<[f64; COUNT]>>>,
    /// The first exception.
    raised: Mutex<Option<PyErr>>,
}

impl<'a, const COUNT: usize> GridFunction<'a, COUNT> {
    fn new(function: &'a Py<PyAny>, keys: [(&'static str, Option<f64>); COUNT], grid: &'a GridCase) -> Self {
        let levels = (0..=grid.levels).map(|_| OnceLock::new()).collect();
        Self { function, keys, grid, levels, raised: Mutex::new(None) }
    }

    /// The values at a cell's centre; NaN once the function has raised an exception.
    fn at(&self, point: [f64; 2]) -> [f64; COUNT] {
        for level in 0..=self.grid.levels {
            let cells = self.grid.cells_on(level);
            if let Some([i, j]) = self.cell(point, cells)
                && cells[0] * cells[1] <= MOST_AT_ONCE
            {
                let values = self.levels[level].get_or_init(|| self.ask_level(cells));
                return values[j * cells[0] + i];
            }
        }
        self.ask(vec![point[0]], vec![point[1]])[0]
    }

    /// The cell of a grid whose centre the point is. Centres of one level are corners on the next.
    fn cell(&self, point: [f64; 2], cells: [usize; 2]) -> Option<[usize; 2]> {
        let mut index = [0; 2];
        for (axis, [low, high]) in [self.grid.z, self.grid.r].into_iter().enumerate() {
            let place = (point[axis] - low) / (high - low) * cells[axis] as f64 - 0.5;
            if (place - place.round()).abs() > 1e-3 || place < -0.25 {
                return None;
            }
            index[axis] = (place.round() as usize).min(cells[axis] - 1);
        }
        Some(index)
    }

    fn ask_level(&self, cells: [usize; 2]) -> Vec<[f64; COUNT]> {
        let centres = |[low, high]: [f64; 2], count: usize| -> Vec<f64> {
            (0..count).map(|k| low + (k as f64 + 0.5) * ((high - low) / count as f64)).collect()
        };
        let (along_z, along_r) = (centres(self.grid.z, cells[0]), centres(self.grid.r, cells[1]));
        let r = along_r.iter().flat_map(|r| std::iter::repeat_n(*r, cells[0])).collect();
        let z = along_z.repeat(cells[1]);
        self.ask(z, r)
    }

    fn ask(&self, z: Vec<f64>, r: Vec<f64>) -> Vec<[f64; COUNT]> {
        let nothing = vec![[f64::NAN; COUNT]; z.len()];
        let mut raised = self.raised.lock().unwrap_or_else(PoisonError::into_inner);
        if raised.is_some() {
            return nothing;
        }
        Python::attach(|py| self.call(py, z, r)).unwrap_or_else(|error| {
            *raised = Some(error);
            nothing
        })
    }

    fn call(&self, py: Python<'_>, z: Vec<f64>, r: Vec<f64>) -> PyResult<Vec<[f64; COUNT]>> {
        let count = z.len();
        let given = self.function.bind(py).call1((z.into_pyarray(py), r.into_pyarray(py)))?;
        let given = given.cast_into::<PyDict>().map_err(|error| {
            PyValueError::new_err(format!("an initial state is a dictionary of arrays: {error}"))
        })?;
        for key in given.keys() {
            let name: String = key.extract()?;
            if !self.keys.iter().any(|(allowed, _)| *allowed == name) {
                let names = self.keys.map(|(name, _)| name).join(", ");
                return Err(PyKeyError::new_err(format!("{name} is none of {names}")));
            }
        }
        let numpy = py.import("numpy")?;
        let mut values = vec![[0.0; COUNT]; count];
        for (column, (name, default)) in self.keys.iter().enumerate() {
            match (given.get_item(name)?, default) {
                (Some(array), _) => {
                    let array = numpy.call_method1("asarray", (array, "float64"))?;
                    let array = numpy.call_method1("broadcast_to", (array, (count,)))?;
                    let array = numpy.call_method1("ascontiguousarray", (array,))?;
                    let array = array.cast_into::<PyArray1<f64>>().map_err(PyErr::from)?;
                    for (row, value) in values.iter_mut().zip(array.readonly().as_array()) {
                        row[column] = *value;
                    }
                }
                (None, Some(default)) => values.iter_mut().for_each(|row| row[column] = *default),
                (None, None) => return Err(PyKeyError::new_err(format!("the initial state has no {name}"))),
            }
        }
        Ok(values)
    }

    /// The exception that the function has raised, else the solver or its error.
    fn verdict<S, E: Into<Failure>>(self, solver: Result<S, E>) -> Result<S, Failure> {
        match self.raised.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(Failure::Python(error)),
            None => solver.map_err(Into::into),
        }
    }
}

/// A case's fluid, filled by a Python function of z and r.
pub fn fluid_from(case: &Case, function: &Py<PyAny>) -> Result<FluidSolver<BLOCK>, Failure> {
    let Some(fluid) = &case.fluid else {
        return Err(Failure::Python(PyValueError::new_err("the case has no fluid to fill")));
    };
    let keys = [
        ("density", None),
        ("velocity_z", Some(0.0)),
        ("velocity_r", Some(0.0)),
        ("pressure", None),
        ("gas_fraction", Some(0.0)),
    ];
    let values = GridFunction::new(function, keys, &fluid.grid);
    let solver =
        FluidSolver::from_fn(&fluid_setup(case, fluid), |point| Primitive::from_array(values.at(point)));
    values.verdict(solver)
}

/// A case's solid, filled by a Python function of z and r.
pub fn solid_from(case: &Case, function: &Py<PyAny>) -> Result<SolidSolver<BLOCK>, Failure> {
    let Some(solid) = &case.solid else {
        return Err(Failure::Python(PyValueError::new_err("the case has no solid to fill")));
    };
    let names = ["velocity_z", "velocity_r", "stress_zz", "stress_zr", "stress_rr", "stress_phiphi"];
    let values = GridFunction::new(function, names.map(|name| (name, Some(0.0))), &solid.grid);
    let solver =
        SolidSolver::new(solid_setup(case, solid), |point| ElasticState::from_array(values.at(point)));
    values.verdict(solver)
}
