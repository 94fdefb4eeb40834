//! Meshes of several levels: trees, ghosts, details, remapping, flux registers.

mod common;
mod conservation;
mod exactness;
mod registers;
mod speed;
mod trees;
mod uniformity;
mod wanted;
