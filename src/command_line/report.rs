//! `cav run --report`: the page that pycav makes of a run.

use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::run::RunError;

/// Said where there is no pycav.
const MISSING: &str = "\
no report: pycav is not there. Install it with
  python3 -m venv .venv && .venv/bin/pip install ./crates/pycav
and make the page with
  .venv/bin/pycav report";

/// Makes the page of a run and says where it is.
///
/// - `program`: the command that is this program, if Python started it; that Python has pycav. Otherwise `pycav` on the path is asked.
///
/// # Errors
/// pycav was asked and failed. Where it is not there, that is said and no error: the run is complete.
pub(super) fn make(directory: &Path, program: &[OsString]) -> Result<(), RunError> {
    let (name, first) = match program {
        [name, first @ ..] => (name.clone(), first.to_vec()),
        [] => ("pycav".into(), Vec::new()),
    };
    let asked = Command::new(&name).args(first).arg("report").arg(directory).stdin(Stdio::null()).status();
    match asked {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(RunError::Report(format!("pycav ended with {status}"))),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            eprintln!("{MISSING} {}", directory.display());
            Ok(())
        }
        Err(error) => Err(RunError::Report(format!("cannot start {}: {error}", name.display()))),
    }
}
