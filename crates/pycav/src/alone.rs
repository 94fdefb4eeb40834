//! The fluid's and the solid's solver, each with its surface driven from Python.

use std::sync::{Mutex, MutexGuard, TryLockError};

use cav::run::process::launch::thread_pool;
use coupler::CommonRefinement;
use mesh::{BLOCK, FaceState, Geometry};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::ThreadPool;

use crate::case::Case;
use crate::error::guarded;
use crate::fields;
use crate::given::Given;
use crate::medium::Medium;

/// A new array.
type Array<'py> = Bound<'py, PyArray1<f64>>;
/// An array that may be left out.
type MaybeArray<'py> = Option<PyReadonlyArray1<'py, f64>>;

/// A solver with the threads that its scratch memory is made for.
struct Parts<M> {
    solver: M,
    pool: ThreadPool,
    cfl: f64,
    axisymmetric: bool,
}

impl<M: Medium> Parts<M> {
    fn has_surface(&self) -> bool {
        self.solver.interface().faces() > 0
    }

    fn traces(&self, dt: f64) -> Vec<M::Trace> {
        if self.has_surface() { self.solver.traces(dt) } else { Vec::new() }
    }
}

/// What the faces of a surface had in a step, and where they were.
struct Surface {
    generation: u64,
    begin: f64,
    edges: Vec<f64>,
    states: Vec<FaceState>,
}

impl Surface {
    fn of<M: Medium>(solver: &M) -> Self {
        let there = solver.interface().faces() > 0;
        let edges = if there { solver.interface_edges() } else { Vec::new() };
        Self {
            generation: solver.mesh().generation(),
            begin: solver.mesh().domain().r[0],
            edges,
            states: solver.interface().states().to_vec(),
        }
    }

    /// Gives the faces of a grid that has adapted what they had in the step: means over what each has of the old ones.
    fn carry_over<M: Medium>(&self, solver: &mut M, axisymmetric: bool) {
        // A tree that has changed anywhere numbers all faces anew.
        if solver.mesh().generation() == self.generation {
            return;
        }
        let now = Self::of(solver);
        let mut common = CommonRefinement::default();
        common.update(self.begin, &self.edges, &now.edges, axisymmetric);
        let interface = solver.interface_mut();
        let of = |k: usize| {
            let FaceState { pressure, velocity, power, .. } = self.states[common.sub_faces()[k].first];
            [pressure, velocity, power]
        };
        common.means_of(true, of, |face, row| interface.set(face, row.into()));
    }
}

/// A medium's solver without the other medium.
struct Alone<M>(Mutex<Parts<M>>);

impl<M: Medium> Alone<M> {
    /// With as many threads as asked for, in which the solver is made.
    fn new(
        py: Python<'_>,
        case: &Case,
        initial: Option<&Py<PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let case = case.case();
        let parts = py.detach(|| {
            guarded(|| {
                let pool = thread_pool(threads)?;
                let solver = pool.install(|| M::of_case(case, initial))?;
                let axisymmetric = case.geometry == Geometry::Axisymmetric;
                Ok(Parts { solver, pool, cfl: case.time.cfl, axisymmetric })
            })
        })?;
        Ok(Self(Mutex::new(parts)))
    }

    fn parts(&self) -> PyResult<MutexGuard<'_, Parts<M>>> {
        match self.0.try_lock() {
            Ok(parts) => Ok(parts),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                Err(PyRuntimeError::new_err("the solver is computing in another thread"))
            }
        }
    }

    fn time_step_limit(&self) -> PyResult<f64> {
        let parts = self.parts()?;
        Ok(parts.solver.time_step_limit(parts.cfl))
    }

    fn surface_edges<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let parts = self.parts()?;
        let edges = if parts.has_surface() { parts.solver.interface_edges() } else { Vec::new() };
        Ok(edges.into_pyarray(py))
    }

    fn trace<'py>(&self, py: Python<'py>, dt: f64) -> PyResult<Bound<'py, PyDict>> {
        checked(dt)?;
        let traces = self.parts()?.traces(dt);
        let found = PyDict::new(py);
        for (name, of) in M::COLUMNS {
            found.set_item(name, traces.iter().map(of).collect::<Vec<f64>>().into_pyarray(py))?;
        }
        Ok(found)
    }

    fn step(
        &self,
        py: Python<'_>,
        dt: f64,
        [pressure, velocity, power]: [MaybeArray<'_>; 3],
    ) -> PyResult<()> {
        checked(dt)?;
        let mut parts = self.parts()?;
        let given = Given::new(parts.solver.interface().faces(), pressure, velocity, power)?;
        let most = parts.solver.time_step_limit(parts.cfl.max(STABLE));
        if dt > most * (1.0 + 1e-9) {
            return Err(PyValueError::new_err(format!(
                "dt = {dt:e} s: a step of more than {most:e} s is not stable in these cells; take time_step_limit(), or several steps"
            )));
        }
        let parts = &mut *parts;
        py.detach(|| {
            guarded(|| {
                let traces = parts.traces(dt);
                parts.solver.interface_mut().set_all(|face| {
                    let trace = &traces[face];
                    let [pressure, velocity, power] = given.state(
                        face,
                        |pressure| M::under(trace, pressure),
                        |velocity| M::moved(trace, velocity),
                    );
                    FaceState { pressure, velocity, power, ..FaceState::default() }
                });
                let Parts { solver, pool, axisymmetric, .. } = parts;
                let before = Surface::of(solver);
                pool.install(|| solver.advance(dt))?;
                before.carry_over(solver, *axisymmetric);
                Ok(())
            })
        })?;
        py.check_signals()
    }

    /// A number of each face's state in the last step.
    fn surface<'py>(&self, py: Python<'py>, of: impl Fn(&FaceState) -> f64) -> PyResult<Array<'py>> {
        Ok(self.parts()?.solver.interface().states().iter().map(of).collect::<Vec<f64>>().into_pyarray(py))
    }
}

/// The Courant number that steps of any length that is asked for may have with square cells, where both directions add up.
const STABLE: f64 = 0.5;

fn checked(dt: f64) -> PyResult<()> {
    match dt > 0.0 && dt.is_finite() {
        true => Ok(()),
        false => Err(PyValueError::new_err(format!("a step has a positive length, not {dt} s"))),
    }
}

/// A class of Python with the solver of one side: what both have, and what only this one has.
///
/// pyo3 has no generic classes and one `impl` block with methods per class, so that only a macro can say once what both have.
macro_rules! solver_class {
    (
        $(#[$document:meta])*
        $name:ident, $solver:ty,
        $(#[$about:meta])*
        $surface:ident: $of:expr,
        { $($own:tt)* }
    ) => {
        $(#[$document])*
        #[pyclass(frozen, module = "pycav._pycav")]
        pub struct $name(Alone<$solver>);

        #[pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = (case, initial=None, threads=None))]
            fn new(
                py: Python<'_>,
                case: &Case,
                initial: Option<Py<PyAny>>,
                threads: Option<usize>,
            ) -> PyResult<Self> {
                Alone::new(py, case, initial.as_ref(), threads).map(Self)
            }

            #[getter]
            fn time(&self) -> PyResult<f64> {
                Ok(self.0.parts()?.solver.time())
            }

            #[getter]
            fn steps(&self) -> PyResult<u64> {
                Ok(self.0.parts()?.solver.steps())
            }

            /// The longest step that the case's Courant number allows, s.
            fn time_step_limit(&self) -> PyResult<f64> {
                self.0.time_step_limit()
            }

            /// Outer radii of the faces towards the other side, m, shape (faces,); empty where the case has none.
            #[getter]
            fn surface_edges<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
                self.0.surface_edges(py)
            }

            $(#[$about])*
            #[getter]
            fn $surface<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
                self.0.surface(py, $of)
            }

            /// The side's own state on these faces in the middle of a step of length `dt`, arrays of shape (faces,).
            fn trace<'py>(&self, py: Python<'py>, dt: f64) -> PyResult<Bound<'py, PyDict>> {
                self.0.trace(py, dt)
            }

            /// Makes a step of length `dt` with the surface as given.
            #[pyo3(signature = (dt, pressure=None, velocity=None, power=None))]
            fn step(
                &self,
                py: Python<'_>,
                dt: f64,
                pressure: MaybeArray<'_>,
                velocity: MaybeArray<'_>,
                power: MaybeArray<'_>,
            ) -> PyResult<()> {
                self.0.step(py, dt, [pressure, velocity, power])
            }

            fn cells<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
                fields::cells(py, &self.0.parts()?.solver)
            }

            fn sample<'py>(
                &self,
                py: Python<'py>,
                z: PyReadonlyArray1<'py, f64>,
                r: PyReadonlyArray1<'py, f64>,
            ) -> PyResult<Bound<'py, PyDict>> {
                fields::sample(py, &self.0.parts()?.solver, &z, &r)
            }

            $($own)*
        }
    };
}

solver_class!(
    /// The fluid of a case without its solid.
    FluidSolver,
    fluid::FluidSolver<BLOCK>,
    /// Mean pressure of the last step on the faces, Pa.
    surface_pressure: |wall| wall.pressure,
    {
        /// Equivalent radius of the gas, m.
        #[getter]
        fn equivalent_radius(&self) -> PyResult<f64> {
            Ok(self.0.parts()?.solver.bubble().equivalent_radius)
        }
    }
);

solver_class!(
    /// The solid of a case without its fluid.
    SolidSolver,
    solid::SolidSolver<BLOCK>,
    /// Mean velocity of the last step on the faces, m/s.
    surface_velocity: |face| face.velocity,
    {}
);
