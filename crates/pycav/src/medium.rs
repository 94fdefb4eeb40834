//! What is particular about the fluid's and the solid's solver where each is driven alone.

use cav::case::Case;
use cav::run::setup::{fluid_solver, solid_solver};
use coupler::{
    FluidTrace, InterfaceStar, SolidTrace, fluid_at_moving_wall, fluid_under_pressure, solid_moved,
    solid_under_pressure,
};
use mesh::BLOCK;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::error::Failure;
use crate::fields::Readable;
use crate::initial::{fluid_from, solid_from};

/// Names of numbers, and how each is found in a `T`.
type Columns<T> = &'static [(&'static str, fn(&T) -> f64)];

/// A medium's solver as [`crate::alone`] makes and drives it.
pub trait Medium: Readable + Send + Sized {
    /// Its own state on a face of the surface.
    type Trace: 'static;
    /// The numbers of a trace.
    const COLUMNS: Columns<Self::Trace>;

    /// The solver of a case, filled by a Python function if there is one.
    fn of_case(case: &Case, initial: Option<&Py<PyAny>>) -> Result<Self, Failure>;
    /// Its own states on the faces in the middle of a step of length `dt`; to be asked only if there are faces.
    fn traces(&self, dt: f64) -> Vec<Self::Trace>;
    /// What a face comes to under a given pressure.
    fn under(trace: &Self::Trace, pressure: f64) -> InterfaceStar;
    /// What a face comes to that moves with a given velocity.
    fn moved(trace: &Self::Trace, velocity: f64) -> InterfaceStar;
    /// Makes a step, and adapts the grid if it is time to.
    fn advance(&mut self, dt: f64) -> Result<(), Failure>;
}

fn missing(medium: &str) -> Failure {
    Failure::Python(PyValueError::new_err(format!("the case has no {medium}")))
}

fn filled<T>(fill: impl FnOnce(&mut Vec<T>)) -> Vec<T> {
    let mut values = Vec::new();
    fill(&mut values);
    values
}

impl Medium for fluid::FluidSolver<BLOCK> {
    type Trace = FluidTrace;
    const COLUMNS: Columns<FluidTrace> = &[
        ("pressure", |t| t.pressure),
        ("velocity", |t| t.velocity),
        ("density", |t| t.density),
        ("gamma", |t| t.gamma),
        ("pi", |t| t.pi),
        ("impedance", FluidTrace::impedance),
    ];

    fn of_case(case: &Case, initial: Option<&Py<PyAny>>) -> Result<Self, Failure> {
        let fluid = case.fluid.as_ref().ok_or_else(|| missing("fluid"))?;
        initial.map_or_else(|| Ok(fluid_solver(case, fluid)?), |function| fluid_from(case, function))
    }

    fn traces(&self, dt: f64) -> Vec<FluidTrace> {
        filled(|traces| self.traces_at_mid_step(dt, traces))
    }

    fn under(trace: &FluidTrace, pressure: f64) -> InterfaceStar {
        fluid_under_pressure(trace, pressure)
    }

    fn moved(trace: &FluidTrace, velocity: f64) -> InterfaceStar {
        fluid_at_moving_wall(trace, velocity)
    }

    fn advance(&mut self, dt: f64) -> Result<(), Failure> {
        self.step(dt)?;
        self.adapt_if_due(dt, 1);
        Ok(())
    }
}

/// The solid's own state on a face of its surface.
pub struct SolidFace {
    trace: SolidTrace,
    shear: f64,
}

impl Medium for solid::SolidSolver<BLOCK> {
    type Trace = SolidFace;
    const COLUMNS: Columns<SolidFace> = &[
        ("pressure", |face| face.trace.pressure),
        ("velocity", |face| face.trace.velocity),
        ("shear", |face| face.shear),
        ("impedance", |face| face.trace.impedance),
    ];

    fn of_case(case: &Case, initial: Option<&Py<PyAny>>) -> Result<Self, Failure> {
        let solid = case.solid.as_ref().ok_or_else(|| missing("solid"))?;
        initial.map_or_else(|| Ok(solid_solver(case, solid)?), |function| solid_from(case, function))
    }

    fn traces(&self, dt: f64) -> Vec<SolidFace> {
        let face = |own: solid::SurfaceTrace| SolidFace {
            trace: SolidTrace { pressure: own.pressure, velocity: own.velocity, impedance: own.impedance },
            shear: own.shear,
        };
        filled(|traces| self.traces_at_mid_step(dt, traces)).into_iter().map(face).collect()
    }

    fn under(face: &SolidFace, pressure: f64) -> InterfaceStar {
        solid_under_pressure(&face.trace, pressure)
    }

    fn moved(face: &SolidFace, velocity: f64) -> InterfaceStar {
        solid_moved(&face.trace, velocity)
    }

    fn advance(&mut self, dt: f64) -> Result<(), Failure> {
        let adapts = self.adaptation_follows(dt, 1);
        self.step(dt)?;
        if adapts {
            self.adapt(dt, 1);
        }
        Ok(())
    }
}
