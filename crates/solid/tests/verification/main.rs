//! Numerical verification of the solid's solver: errors, orders, invariants.

#![allow(clippy::unwrap_used, reason = "a test that fails to step has failed")]

mod adaptation;
mod adaptive_error;
mod boundaries;
mod coming;
mod first_yield;
mod helpers;
mod ledgers;
mod orders;
mod plastic_ledgers;
mod plastic_pit;
mod plastic_waves;
mod sides;
mod static_start;
mod surface;
mod symmetry;
mod weight;
