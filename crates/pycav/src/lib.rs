//! Python bindings of `cav`. No numerics: arguments are taken apart, the solvers called, results handed back as copies.
//!
//! | module | is |
//! |---|---|
//! | `case` | a case file, read and changed |
//! | `simulation` | a run in this process, step by step |
//! | `alone` | the fluid's and the solid's solver, each with its surface driven from Python |
//! | `medium` | what of that is the fluid's or the solid's own |
//! | `new` | cases for what is asked most often |
//! | `fields` | cells and samples of a solver as arrays |
//! | `initial` | initial states that Python functions give |
//! | `launch` | runs in two processes, on finer and finer grids, and the command line |
//! | `runs` | the runs in a folder |
//! | `log` | the log of a run directory |
//! | `error` | errors and panics as exceptions |
//!
//! The lock of the interpreter is released while anything computes. Everything that is handed out is a copy.

mod alone;
mod case;
mod error;
mod fields;
mod given;
mod initial;
mod launch;
mod log;
mod medium;
mod new;
mod runs;
mod simulation;

use pyo3::pymodule;

/// The compiled part of `pycav`; what users call is in the Python package around it.
#[pymodule]
mod _pycav {
    #[pymodule_export]
    use super::alone::{FluidSolver, SolidSolver};
    #[pymodule_export]
    use super::case::{Case, materials};
    #[pymodule_export]
    use super::error::{CaseError, CouplingError, InternalError, NumericalError, OutputError, RunError};
    #[pymodule_export]
    use super::launch::{convergence, main, resume, run_in_processes};
    #[pymodule_export]
    use super::new::{new_collapse, new_free_bubble, new_laser_bubble, new_shocked_bubble, new_wall_load};
    #[pymodule_export]
    use super::runs::{run_state, runs};
    #[pymodule_export]
    use super::simulation::Simulation;
}
