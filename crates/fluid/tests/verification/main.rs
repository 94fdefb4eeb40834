//! Numerical verification of the fluid solver: errors, orders, invariants.

#![allow(clippy::unwrap_used, reason = "a test that fails to step has failed")]

mod adaptation;
mod adaptive_error;
mod all_terms;
mod beside_fast_gas;
mod boundaries;
mod bubble;
mod bubble_cut;
mod condensation;
mod conduction;
mod conduction_media;
mod conduction_walls;
mod contact;
mod covolumes;
mod far_field;
mod five_equation;
mod gravity;
mod helpers;
mod ledgers;
mod low_mach;
mod micro_bubble;
mod near_wall;
mod orders;
mod oscillations;
mod phase_change;
mod random_trees;
mod rayleigh_start;
mod rescue;
mod shock_tubes;
mod stefan;
mod super_stepping;
mod superheated;
mod surface_tension;
mod symmetry;
mod tension;
mod tracer;
mod viscosity;
