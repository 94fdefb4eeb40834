//! Blocks of N × N cells on a quadtree: geometry, fields, ghost layers, slopes. No physics.
//!
//! - [`Geometry`], [`Domain`]: the rectangle of the (z, r) half-plane and the metric on it.
//! - [`Quadtree`], [`BlockId`]: which blocks there are and who neighbours whom.
//! - [`Mesh`]: both together: where the cells of a block lie.
//! - [`Field`]: the cell averages of all blocks, one allocation.
//! - [`Padded`]: one block with its ghost layers, assembled in scratch; what a kernel works on.
//! - [`limited_differences`]: the slopes of a linear reconstruction.
//! - [`Multiresolution`], [`Patch`], [`Adapted`]: details, the mesh they ask for, and fields carried over to it.
//! - [`FluxRegister`]: what passes a face between levels.
//! - [`BlockSolver`]: state, time and steps of any physics that is a [`Model`]: subcycling, flux correction, adaptation, checkpoints.
//!
//! Only the cells themselves are stored; ghost layers are assembled block by block into scratch. So every
//! block can be advanced in parallel from the old field into the new one without locks or `unsafe`, and
//! both time levels are at hand for what needs them.

#![forbid(unsafe_code)]

mod adaptation;
mod ahead;
mod aligned;
pub mod array;
mod block_solver;
mod cell_fields;
mod courant;
mod details;
mod dispersion;
mod domain;
mod field;
mod geometry;
mod ghosts;
mod horizon;
mod initial;
mod level_clock;
mod level_steps;
mod limiter;
mod marks;
mod multiresolution;
mod padded;
mod parallel;
mod patch;
mod project;
mod quadtree;
mod radial;
mod reduce;
mod register;
mod remap;
mod side_faces;
mod side_states;
mod stage_timer;

pub use adaptation::{Adaptation, LevelBound, Zone};
pub use aligned::{AlignedRow, whole_lines};
pub use block_solver::{
    BlockSolver, FaceState, Interface, Marks, Model, Place, Progress, Reports, SavedBlocks, Step,
};
pub use cell_fields::CellField;
pub use courant::longest_step;
pub use dispersion::{dispersion_share, oblique_dispersion_shares};
pub use domain::{Domain, Mesh, MeshError, Misfit};
pub use field::Field;
pub use geometry::{Geometry, Side};
pub use horizon::Horizon;
pub use level_clock::{GroupStep, LevelClock, steps_in};
pub use level_steps::{FinerSide, LevelSteps, MOST_HALVINGS, Part, Registers};
pub use limiter::{Limiter, limited_differences};
pub use multiresolution::{MOST_COMPONENTS, Multiresolution};
pub use padded::{GHOSTS, Padded};
pub use parallel::{ScratchPool, for_each_block, for_some_blocks};
pub use patch::Patch;
pub use quadtree::{BlockId, Neighbour, Offset, Quadtree};
pub use reduce::maximum;
pub use register::{CorrectedFace, FluxRegister};
pub use remap::{Adapted, Origin};
pub use side_faces::SideFaces;
pub use side_states::SideStates;
pub use stage_timer::StageTimer;

/// Cells along one side of a block, unless a test chooses otherwise.
pub const BLOCK: usize = 16;
