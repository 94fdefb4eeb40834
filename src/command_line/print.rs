//! What goes to the terminal: text asked for, and errors.

use std::io::{IsTerminal, Write};

use crate::case::CaseErrors;
use crate::run::RunError;

/// To standard output.
pub(super) fn print(text: &str) -> Result<(), RunError> {
    let mut out = std::io::stdout().lock();
    // A reader that has seen enough (`cav materials | head`) is no error.
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    Ok(())
}

/// To standard error, and to the log.
pub(super) fn complain(error: &RunError) {
    match error {
        RunError::Case(errors) => eprint!("{}", render(errors)),
        RunError::Grid { number, levels, source } => match &**source {
            RunError::Case(errors) => eprint!("grid {number} ({levels}):\n{}", render(errors)),
            _ => eprintln!("error: {error}"),
        },
        other => eprintln!("error: {other}"),
    }
    tracing::error!("{error}");
}

fn render(errors: &CaseErrors) -> String {
    errors.render(std::io::stderr().is_terminal())
}
