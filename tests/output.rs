//! The files of a run: what is written is read back.

#![allow(clippy::unwrap_used)]

#[path = "output/background.rs"]
mod background;
#[path = "output/history.rs"]
mod history;
#[path = "output/run_directory.rs"]
mod run_directory;
#[path = "output/snapshots.rs"]
mod snapshots;
#[path = "output/vtkhdf.rs"]
mod vtkhdf;
