//! The program `cav`.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(cav::command_line::main(std::env::args_os(), &[], &[]))
}
