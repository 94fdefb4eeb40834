//! Meshes of several levels: trees, ghosts, details, remapping, flux registers.

#![allow(clippy::unwrap_used, clippy::type_complexity)]

mod common;
mod conservation;
mod exactness;
mod registers;
mod speed;
mod steps;
mod trees;
mod uniformity;
mod wanted;
