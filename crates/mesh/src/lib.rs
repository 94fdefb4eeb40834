//! Blocks of N × N cells on a quadtree: geometry, fields, ghost layers, slopes. No physics.
//!
//! - [`Geometry`], [`Domain`]: the rectangle of the (z, r) half-plane and the metric on it.
//! - [`Quadtree`], [`BlockId`]: which blocks there are and who neighbours whom.
//! - [`Mesh`]: both together: where the cells of a block lie.
//! - [`Field`]: the cell averages of all blocks, one allocation.
//! - [`Padded`]: one block with its ghost layers, assembled in scratch; what a kernel works on.
//! - [`Tile`], [`TileRows`]: four siblings that a step makes as if they were one block.
//! - [`limited_differences`]: the slopes of a linear reconstruction.
//! - [`Multiresolution`], [`Patch`], [`Adapted`]: details, the mesh they ask for, and fields carried over to it.
//! - [`FluxRegister`]: what passes a face between levels.
//! - [`BlockSolver`]: state, time and steps of any physics that is a [`Model`]: subcycling, flux correction, adaptation, checkpoints.
//!
//! Only the cells themselves are stored; ghost layers are assembled block by block into scratch. So every
//! block can be advanced in parallel from the old field into the new one without locks or `unsafe`, and
//! both time levels are at hand for what needs them.

#![forbid(unsafe_code)]

pub mod array;
mod block_solver;
mod cell_fields;
mod derefs;
mod ghosts;
mod kernels;
mod multiresolution;
mod named;
mod subcycling;
mod tree;

pub use block_solver::stage_timer::StageTimer;
pub use block_solver::{
    BlockSolver, BlockWork, CompiledSolver, FaceState, Interface, Marks, Model, Place, Progress, Reports,
    SavedBlocks, Scratches, Step,
};
pub use cell_fields::{CellField, CellLevels, CellSnapshot};
pub use ghosts::cell_below;
pub use ghosts::frame::Frame;
pub use ghosts::padded::{GHOSTS, Padded};
pub use ghosts::side_faces::SideFaces;
pub use ghosts::side_states::SideStates;
pub use ghosts::tile_rows::TileRows;
pub use kernels::ahead::{fetch, fetch_lines};
pub use kernels::aligned::{AlignedRow, whole_lines};
pub use kernels::blend::Blend;
pub use kernels::cell_bits::CellBits;
pub use kernels::dispersion::{dispersion_share, oblique_dispersion_shares};
pub use kernels::elementary::{exp_and_less_one, ln_of};
pub use kernels::limiter::{Limiter, limited_differences};
pub use kernels::parallel::{SUMS_AT_ONCE, ScratchPool, for_each_tile, for_some_blocks, map_in_order};
pub use kernels::reduce::{maximum, sum};
pub use multiresolution::adaptation::{Adaptation, LevelBound, RegionOfInterest, Zone};
pub use multiresolution::entering::{Entering, Entry, largest_detail, mean_since_start};
pub use multiresolution::horizon::Horizon;
pub use multiresolution::patch::Patch;
pub use multiresolution::remap::{Adapted, Origin, Remap};
pub use multiresolution::{ComponentsOfCell, MOST_COMPONENTS, MOST_IN_FIELD, Multiresolution};
pub use subcycling::courant::longest_step;
pub use subcycling::level_clock::{GroupStep, LevelClock, steps_in};
pub use subcycling::level_steps::{FinerSide, LevelSteps, MOST_HALVINGS, Part, Registers, every_slot};
pub use subcycling::register::{CorrectedFace, FluxRegister};
pub use tree::domain::{Domain, Mesh, MeshError, Misfit};
pub use tree::field::Field;
pub use tree::geometry::{Geometry, Side};
pub use tree::quadtree::{BlockId, Neighbour, Offset, Quadtree};
pub use tree::tile::Tile;

/// Cells along one side of a block, unless a test chooses otherwise.
pub const BLOCK: usize = 16;
