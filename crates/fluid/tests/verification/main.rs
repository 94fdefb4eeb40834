//! Numerical verification of the fluid solver: errors, orders, invariants. Run in release mode.

mod boundaries;
mod bubble;
mod contact;
mod helpers;
mod ledgers;
mod orders;
mod shock_tubes;
mod symmetry;
