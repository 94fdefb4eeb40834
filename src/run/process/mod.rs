//! Processes: `cav run`, its two children, the step loops they drive, and how they stop.
//!
//! | module | is |
//! |---|---|
//! | [`launch`], [`launch_options`] | `cav run`; in `children`, two processes started and watched |
//! | [`mod@resume`] | a run directory taken up again; in `longer`, to a later end |
//! | [`session`] | a run in one process, step by step |
//! | [`drive`] | the step loop of a run in one process, of one of two processes |
//! | [`stop`] | signals, and a launcher that is gone |

mod children;
pub mod drive;
pub mod launch;
pub mod launch_options;
mod longer;
pub mod resume;
pub mod session;
pub mod stop;
