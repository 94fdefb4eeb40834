//! The files of a run: what is written is read back, and survives a kill.

#![allow(clippy::unwrap_used)]

#[path = "output/history.rs"]
mod history;
#[path = "output/kill.rs"]
mod kill;
#[path = "output/run_directory.rs"]
mod run_directory;
#[path = "output/vtkhdf.rs"]
mod vtkhdf;
