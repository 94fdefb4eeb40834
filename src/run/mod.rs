//! The run: from a case to a run directory, in one process or in two.
//!
//! | module | is |
//! |---|---|
//! | [`setup`] | a case made into solvers |
//! | [`schedule`] | when to stop, when to write, and so how long a step may be |
//! | [`side`] | one side's part of the step loop: the fluid's, the solid's, and what they have in common |
//! | [`record`] | what each side writes, and what is made of both when a run has ended |
//! | [`process`] | `cav run`, one process or two; the step loops; signals; a run taken up again |
//! | [`checkpoints`] | states to go on from: written, kept, chosen |
//! | [`memory`] | whether a grid that grows still has room |
//! | [`wall`] | what stays in a wall, for the run that hits it next |
//! | [`error`] | what can go wrong, and the exit code it means |

mod carried;
pub mod checkpoints;
mod coming_load;
pub mod error;
pub mod memory;
pub mod process;
pub mod record;
pub mod schedule;
pub mod setup;
pub mod side;
pub mod wall;

pub use error::RunError;
pub use process::launch::run;
pub use process::launch_options::Options;
pub use process::resume::resume;
