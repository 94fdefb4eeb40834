//! Fluid and solid together, in this process: what the interface does to waves, impulse and work.

mod adaptive_pulse;
mod collapse;
mod exchange;
#[path = "../fixture/mod.rs"]
mod fixture;
mod hammer;
mod harness;
mod hits;
#[allow(clippy::unwrap_used, clippy::print_stdout, reason = "how many inputs were tried is told")]
#[allow(clippy::duplicate_mod, reason = "the fuzz targets have fixtures of their own")]
mod hostile;
mod ledgers;
mod load;
mod modes;
mod near_wall;
mod out_of_the_solid;
#[allow(clippy::unwrap_used, reason = "without a thread there is no test")]
#[path = "../fixture/own_thread.rs"]
mod own_thread;
mod paper_schemes;
mod participants;
mod pits;
mod pulse;
mod rest;
mod spherical_pulse;
mod start;
mod steps;
mod surface;
