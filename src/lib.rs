//! A bubble collapses near an elastic solid: cases, runs, output.

#![deny(unsafe_code)]

pub mod case;
pub mod command_line;
pub mod convergence;
pub mod output;
pub mod run;
pub mod runs;
pub mod watch;
