//! Runs that survive: checkpoints, and what happens to runs.

// Long ones tell what they have measured.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "reliability/apart.rs"]
mod apart;
#[path = "reliability/both_sides.rs"]
mod both_sides;
#[path = "reliability/cases.rs"]
mod cases;
#[path = "reliability/compare.rs"]
mod compare;
#[path = "reliability/confined.rs"]
mod confined;
#[path = "reliability/faults.rs"]
mod faults;
mod fixture;
#[path = "reliability/going_on.rs"]
mod going_on;
#[path = "reliability/long.rs"]
mod long;
#[path = "reliability/longer.rs"]
mod longer;
#[path = "reliability/processes.rs"]
mod processes;
#[path = "reliability/refused.rs"]
mod refused;
