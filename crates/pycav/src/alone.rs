//! The fluid's and the solid's solver, each with its surface driven from Python.

use std::sync::{Mutex, MutexGuard, TryLockError};

use cav::run::process::launch::thread_pool;
use cav::run::setup::{fluid_solver, solid_solver};
use coupler::{
    FluidTrace, SolidTrace, fluid_at_moving_wall, fluid_under_pressure, solid_moved, solid_under_pressure,
};
use mesh::{BLOCK, FaceState};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::ThreadPool;
use solid::SurfaceTrace;

use crate::case::Case;
use crate::error::{Failure, guarded};
use crate::fields;
use crate::given::Given;
use crate::initial::{fluid_from, solid_from};

/// A solver with the threads that its scratch memory is made for.
struct Alone<S> {
    solver: S,
    pool: ThreadPool,
    cfl: f64,
}

impl<S: Send> Alone<S> {
    /// With as many threads as asked for, in which `make` makes the solver.
    fn new(
        py: Python<'_>,
        case: &cav::case::Case,
        threads: Option<usize>,
        make: impl FnOnce() -> Result<S, Failure> + Send,
    ) -> PyResult<Mutex<Self>> {
        let alone = py.detach(|| {
            guarded(|| {
                let pool = thread_pool(threads)?;
                let solver = pool.install(make)?;
                Ok(Self { solver, pool, cfl: case.time.cfl })
            })
        })?;
        Ok(Mutex::new(alone))
    }
}

fn locked<T>(alone: &Mutex<T>) -> PyResult<MutexGuard<'_, T>> {
    match alone.try_lock() {
        Ok(alone) => Ok(alone),
        Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
        Err(TryLockError::WouldBlock) => {
            Err(PyRuntimeError::new_err("the solver is computing in another thread"))
        }
    }
}

fn checked(dt: f64) -> PyResult<()> {
    match dt > 0.0 && dt.is_finite() {
        true => Ok(()),
        false => Err(PyValueError::new_err(format!("a step has a positive length, not {dt} s"))),
    }
}

/// The fluid of a case without its solid.
#[pyclass(frozen, module = "pycav._pycav")]
pub struct FluidSolver {
    alone: Mutex<Alone<fluid::FluidSolver<BLOCK>>>,
}

fn wall_traces(solver: &fluid::FluidSolver<BLOCK>, dt: f64) -> Vec<FluidTrace> {
    let mut traces = Vec::new();
    if solver.interface().faces() > 0 {
        solver.traces_at_mid_step(dt, &mut traces);
    }
    traces
}

#[pymethods]
impl FluidSolver {
    #[new]
    #[pyo3(signature = (case, initial=None, threads=None))]
    fn new(
        py: Python<'_>,
        case: &Case,
        initial: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let case = case.case();
        let Some(fluid) = &case.fluid else { return Err(PyValueError::new_err("the case has no fluid")) };
        let make = || match &initial {
            Some(function) => fluid_from(case, function),
            None => Ok(fluid_solver(case, fluid)?),
        };
        Ok(Self { alone: Alone::new(py, case, threads, make)? })
    }

    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(locked(&self.alone)?.solver.time())
    }

    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(locked(&self.alone)?.solver.steps())
    }

    /// The longest step that the case's Courant number allows, s.
    fn time_step_limit(&self) -> PyResult<f64> {
        let alone = locked(&self.alone)?;
        Ok(alone.solver.time_step_limit(alone.cfl))
    }

    /// Outer radii of the faces of the wall, m, shape (faces,); empty where the case has no solid.
    #[getter]
    fn surface_edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let alone = locked(&self.alone)?;
        let has_interface = alone.solver.interface().faces() > 0;
        Ok(if has_interface { alone.solver.interface_edges() } else { Vec::new() }.into_pyarray(py))
    }

    /// The fluid's own state on the wall in the middle of a step of length `dt`, arrays of shape (faces,).
    fn trace<'py>(&self, py: Python<'py>, dt: f64) -> PyResult<Bound<'py, PyDict>> {
        checked(dt)?;
        let alone = locked(&self.alone)?;
        let traces = wall_traces(&alone.solver, dt);
        let found = PyDict::new(py);
        let column =
            |of: fn(&FluidTrace) -> f64| traces.iter().map(of).collect::<Vec<f64>>().into_pyarray(py);
        found.set_item("pressure", column(|t| t.pressure))?;
        found.set_item("velocity", column(|t| t.velocity))?;
        found.set_item("density", column(|t| t.density))?;
        found.set_item("gamma", column(|t| t.gamma))?;
        found.set_item("pi", column(|t| t.pi))?;
        found.set_item("impedance", column(FluidTrace::impedance))?;
        Ok(found)
    }

    /// Makes a step of length `dt` with the surface as given.
    #[pyo3(signature = (dt, pressure=None, velocity=None, power=None))]
    fn step(
        &self,
        py: Python<'_>,
        dt: f64,
        pressure: Option<PyReadonlyArray1<'_, f64>>,
        velocity: Option<PyReadonlyArray1<'_, f64>>,
        power: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<()> {
        checked(dt)?;
        let mut alone = locked(&self.alone)?;
        let given = Given::new(alone.solver.interface().faces(), pressure, velocity, power)?;
        let Alone { solver, pool, .. } = &mut *alone;
        py.detach(|| {
            guarded(|| {
                let traces = wall_traces(solver, dt);
                solver.interface_mut().set_all(|face| {
                    let trace = &traces[face];
                    let under = |pressure| fluid_under_pressure(trace, pressure);
                    let moved = |velocity| fluid_at_moving_wall(trace, velocity);
                    let [pressure, velocity, power] = given.state(face, under, moved);
                    FaceState { pressure, velocity, power }
                });
                pool.install(|| {
                    solver.step(dt)?;
                    solver.adapt_if_due(dt, 1);
                    Ok(())
                })
            })
        })?;
        py.check_signals()
    }

    /// Mean pressure of the last step on the faces, Pa.
    #[getter]
    fn surface_pressure<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let alone = locked(&self.alone)?;
        Ok(alone
            .solver
            .interface()
            .states()
            .iter()
            .map(|wall| wall.pressure)
            .collect::<Vec<f64>>()
            .into_pyarray(py))
    }

    /// Equivalent radius of the gas, m.
    #[getter]
    fn equivalent_radius(&self) -> PyResult<f64> {
        Ok(locked(&self.alone)?.solver.bubble().equivalent_radius)
    }

    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        fields::cells(py, &locked(&self.alone)?.solver)
    }

    fn sample<'py>(
        &self,
        py: Python<'py>,
        z: PyReadonlyArray1<'py, f64>,
        r: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        fields::sample(py, &locked(&self.alone)?.solver, &z, &r)
    }
}

/// The solid of a case without its fluid.
#[pyclass(frozen, module = "pycav._pycav")]
pub struct SolidSolver {
    alone: Mutex<Alone<solid::SolidSolver<BLOCK>>>,
}

fn surface_traces(solver: &solid::SolidSolver<BLOCK>, dt: f64) -> Vec<SurfaceTrace> {
    let mut traces = Vec::new();
    if solver.interface().faces() > 0 {
        solver.traces_at_mid_step(dt, &mut traces);
    }
    traces
}

#[pymethods]
impl SolidSolver {
    #[new]
    #[pyo3(signature = (case, initial=None, threads=None))]
    fn new(
        py: Python<'_>,
        case: &Case,
        initial: Option<Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let case = case.case();
        let Some(solid) = &case.solid else { return Err(PyValueError::new_err("the case has no solid")) };
        let make = || match &initial {
            Some(function) => solid_from(case, function),
            None => Ok(solid_solver(case, solid)?),
        };
        Ok(Self { alone: Alone::new(py, case, threads, make)? })
    }

    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(locked(&self.alone)?.solver.time())
    }

    #[getter]
    fn steps(&self) -> PyResult<u64> {
        Ok(locked(&self.alone)?.solver.steps())
    }

    /// The longest step that the case's Courant number allows, s.
    fn time_step_limit(&self) -> PyResult<f64> {
        let alone = locked(&self.alone)?;
        Ok(alone.solver.time_step_limit(alone.cfl))
    }

    /// Outer radii of the faces of the surface, m, shape (faces,); empty where the case has no fluid.
    #[getter]
    fn surface_edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let alone = locked(&self.alone)?;
        let has_interface = alone.solver.interface().faces() > 0;
        Ok(if has_interface { alone.solver.interface_edges() } else { Vec::new() }.into_pyarray(py))
    }

    /// The solid's own state on its surface in the middle of a step of length `dt`, arrays of shape (faces,).
    fn trace<'py>(&self, py: Python<'py>, dt: f64) -> PyResult<Bound<'py, PyDict>> {
        checked(dt)?;
        let alone = locked(&self.alone)?;
        let traces = surface_traces(&alone.solver, dt);
        let found = PyDict::new(py);
        let column =
            |of: fn(&SurfaceTrace) -> f64| traces.iter().map(of).collect::<Vec<f64>>().into_pyarray(py);
        found.set_item("pressure", column(|t| t.pressure))?;
        found.set_item("velocity", column(|t| t.velocity))?;
        found.set_item("shear", column(|t| t.shear))?;
        let impedance = vec![alone.solver.setup().speeds.z1(); traces.len()];
        found.set_item("impedance", impedance.into_pyarray(py))?;
        Ok(found)
    }

    /// Makes a step of length `dt` with the surface as given.
    #[pyo3(signature = (dt, pressure=None, velocity=None, power=None))]
    fn step(
        &self,
        py: Python<'_>,
        dt: f64,
        pressure: Option<PyReadonlyArray1<'_, f64>>,
        velocity: Option<PyReadonlyArray1<'_, f64>>,
        power: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<()> {
        checked(dt)?;
        let mut alone = locked(&self.alone)?;
        let given = Given::new(alone.solver.interface().faces(), pressure, velocity, power)?;
        let Alone { solver, pool, .. } = &mut *alone;
        py.detach(|| {
            guarded(|| {
                let traces = surface_traces(solver, dt);
                let impedance = solver.setup().speeds.z1();
                solver.interface_mut().set_all(|face| {
                    let own = &traces[face];
                    let trace = SolidTrace { pressure: own.pressure, velocity: own.velocity, impedance };
                    let under = |pressure| solid_under_pressure(&trace, pressure);
                    let moved = |velocity| solid_moved(&trace, velocity);
                    let [pressure, velocity, power] = given.state(face, under, moved);
                    FaceState { pressure, velocity, power }
                });
                pool.install(|| -> Result<(), Failure> {
                    let adapts = solver.adaptation_follows(dt, 1);
                    solver.step(dt)?;
                    if adapts {
                        solver.adapt(dt, 1);
                    }
                    Ok(())
                })
            })
        })?;
        py.check_signals()
    }

    /// Mean velocity of the last step on the faces, m/s.
    #[getter]
    fn surface_velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let alone = locked(&self.alone)?;
        Ok(alone
            .solver
            .interface()
            .states()
            .iter()
            .map(|face| face.velocity)
            .collect::<Vec<f64>>()
            .into_pyarray(py))
    }

    fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        fields::cells(py, &locked(&self.alone)?.solver)
    }

    fn sample<'py>(
        &self,
        py: Python<'py>,
        z: PyReadonlyArray1<'py, f64>,
        r: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        fields::sample(py, &locked(&self.alone)?.solver, &z, &r)
    }
}
