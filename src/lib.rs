//! A bubble collapses near an elastic solid: cases, runs, output.

pub mod case;
pub mod output;
