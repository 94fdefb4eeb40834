//! Errors and panics as exceptions.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use cav::case::CaseErrors;
use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

create_exception!(pycav, CaseError, PyValueError, "A case is bad; the text is the command line's.");
create_exception!(pycav, RunError, PyRuntimeError, "A run could not be made or did not reach its end.");
create_exception!(
    pycav,
    NumericalError,
    RunError,
    "A solver left the range in which its equations make sense."
);
create_exception!(pycav, CouplingError, RunError, "The other process was lost, or the way to it.");
create_exception!(pycav, OutputError, RunError, "Output could not be written.");
create_exception!(pycav, InternalError, RunError, "A fault of the program itself.");

/// What a call that computes may end with.
pub enum Failure {
    /// An error of the run.
    Run(cav::run::RunError),
    /// A panic, by its message.
    Panic(String),
    /// An exception that Python code raised meanwhile.
    Python(PyErr),
}

impl From<cav::run::RunError> for Failure {
    fn from(error: cav::run::RunError) -> Self {
        Self::Run(error)
    }
}

impl From<fluid::FluidError> for Failure {
    fn from(error: fluid::FluidError) -> Self {
        Self::Run(error.into())
    }
}

impl From<solid::SolidError> for Failure {
    fn from(error: solid::SolidError) -> Self {
        Self::Run(error.into())
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Run(error) => run_error(&error),
            Failure::Panic(message) => {
                InternalError::new_err(format!("a fault of the program itself: {message}"))
            }
            Failure::Python(error) => error,
        }
    }
}

fn run_error(error: &cav::run::RunError) -> PyErr {
    // What the command line calls options are arguments here. With the word before, so that no path is touched.
    let text =
        error.to_string().replace("with --out", "with out=").replace("with --force", "with force=True");
    match (error, error.exit_code()) {
        (cav::run::RunError::Case(errors), _) => case_error(errors),
        (cav::run::RunError::Grid { source, number, levels }, _) => match &**source {
            cav::run::RunError::Case(errors) => {
                case_error_of(&format!("grid {number} ({levels}):\n"), errors)
            }
            _ => run_error_of(error.exit_code(), text),
        },
        (cav::run::RunError::Refine(_), _) => PyValueError::new_err(text),
        (_, code) => run_error_of(code, text),
    }
}

/// The class of an exit code.
fn run_error_of(code: u8, text: String) -> PyErr {
    match code {
        3 => NumericalError::new_err(text),
        4 => CouplingError::new_err(text),
        5 => OutputError::new_err(text),
        _ => RunError::new_err(text),
    }
}

/// A [`CaseError`] with the command line's text, and its `faults` as dictionaries.
pub fn case_error(errors: &CaseErrors) -> PyErr {
    case_error_of("", errors)
}

/// The same of one of several cases, which the text begins with.
fn case_error_of(which: &str, errors: &CaseErrors) -> PyErr {
    let raised = CaseError::new_err(format!("{which}{}", errors.render(false).trim_end()));
    let described = Python::attach(|py| -> PyResult<()> {
        let faults = PyList::empty(py);
        for fault in errors.faults() {
            let entry = PyDict::new(py);
            let (line, column) = errors.position(fault).unzip();
            entry.set_item("path", &fault.path)?;
            entry.set_item("message", &fault.message)?;
            entry.set_item("help", &fault.help)?;
            entry.set_item("line", line)?;
            entry.set_item("column", column)?;
            faults.append(entry)?;
        }
        raised.value(py).setattr("faults", faults)
    });
    described.err().unwrap_or(raised)
}

/// Runs what may panic.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(Failure::Panic(message(&*panic))))
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "it panicked".to_owned())
}
