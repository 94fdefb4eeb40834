//! The files of a run survive a kill.
//!
//! A program of its own: while a process is being started, its copies of open files keep HDF5's locks on them, and other
//! tests beside it could not open those files again.

#![allow(clippy::unwrap_used)]

#[path = "output/kill.rs"]
mod kill;
#[path = "output/snapshots.rs"]
mod snapshots;
