//! A bubble collapses near an elastic solid: cases, runs, output.

#![forbid(unsafe_code)]

pub mod case;
pub mod output;
pub mod run;
