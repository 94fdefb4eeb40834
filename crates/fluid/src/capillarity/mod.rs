//! Surface tension between gas and liquid: curvature, and the jump of pressure that faces carry.
//!
//! Nothing of this is made where a case has no surface tension. What it adds to a step is in `rows.rs`, why it is made like that in
//! `docs/theory/surface-tension.md`.

mod block;
mod contact;
mod curvature;
mod fallback;
mod initial;
mod jumps;
mod patch;
mod place;
mod rows;
mod single_pressure;

pub(crate) use contact::cell_at_wall;
pub(crate) use initial::level_mixed_cells;
pub(crate) use jumps::FaceJumps;
pub(crate) use rows::{CapillaryRows, Interfaces};
pub(crate) use single_pressure::SinglePressure;
