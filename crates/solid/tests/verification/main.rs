//! Numerical verification of the solid's solver: errors, orders, invariants. Run in release mode.

mod boundaries;
mod helpers;
mod ledgers;
mod orders;
mod symmetry;
