//! The run: from a case to a run directory, in one process or in two.
//!
//! | module | is |
//! |---|---|
//! | [`checkpoints`] | states to go on from: written, kept, chosen |
//! | [`past`] | what was done before a run was taken up again |
//! | [`mod@resume`] | a run directory taken up again |
//! | [`setup`] | a case made into solvers |
//! | [`schedule`] | when to stop, when to write, and so how long a step may be |
//! | [`fluid_side`], [`solid_side`] | one side's part of the step loop |
//! | [`cell_exchange`] | the paper's coupling schemes |
//! | [`fluid_record`], [`solid_record`] | what each side writes |
//! | [`coupled_solver`] | long and short steps of a solver, whichever medium it is for |
//! | [`run_side`] | what the step loops need of either side, and how its part ends |
//! | [`memory`] | whether a grid that grows still has room |
//! | [`side_files`] | into which files |
//! | [`load`] | a given pressure on a solid without a fluid |
//! | [`interface_history`] | of the interface on a fixed grid |
//! | [`session`] | a run in one process, step by step |
//! | [`drive`] | the step loop of a run in one process, of one of two processes |
//! | [`launch`] | `cav run`; in `children`, two processes started and watched |
//! | [`timed`] | where the wall time goes |
//! | [`conclusion`] | one history and one summary of both sides' parts |
//! | [`stop`] | signals, and a launcher that is gone |
//! | [`error`] | what can go wrong, and the exit code it means |

pub mod cell_exchange;
pub mod checkpoints;
mod children;
pub mod collapse;
pub mod conclusion;
pub mod coupled_solver;
pub mod drive;
pub mod error;
pub mod fluid_record;
pub mod fluid_side;
pub mod interface_history;
pub mod launch;
pub mod launch_options;
pub mod load;
pub mod memory;
pub mod past;
pub mod record;
pub mod resume;
pub mod run_side;
pub mod schedule;
pub mod session;
pub mod setup;
pub mod side_files;
pub mod solid_record;
pub mod solid_side;
pub mod stop;
pub mod timed;
pub mod wall_faces;

pub use error::RunError;
pub use launch::run;
pub use launch_options::Options;
pub use resume::resume;
