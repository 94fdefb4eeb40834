//! What can go wrong in a run, and the exit code it means.

use coupler::{CouplerError, Fault, Scheme};

use crate::case::{Case, CaseErrors};
use crate::output::OutputError;

/// The end of a run other than by completion.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The case is bad.
    #[error("{0}")]
    Case(#[from] CaseErrors),
    /// The run directory cannot be used.
    #[error(transparent)]
    Directory(OutputError),
    /// The fluid failed.
    #[error(transparent)]
    Fluid(#[from] fluid::FluidError),
    /// The solid failed.
    #[error(transparent)]
    Solid(#[from] solid::SolidError),
    /// The time step collapsed.
    #[error(
        "the time step collapsed to {dt:.3e} s at t = {time:.6e} s (step {step}), limited by the {limited_by}; \
         the solution has most likely gone bad: look at the last snapshot, try a smaller time.cfl"
    )]
    TimeStepCollapsed {
        /// The step's length, s.
        dt: f64,
        /// Time, s.
        time: f64,
        /// Number of the step.
        step: u64,
        /// "fluid" or "solid".
        limited_by: &'static str,
    },
    /// The grid has grown beyond what the machine has.
    #[error(
        "memory runs short: the {side} has {cells} cells at t = {time:.6e} s, the next snapshot of which takes about {} MiB, and \
         {} MiB are available; take fewer {side}.levels or a larger {side}.epsilon, or free some and `--resume`",
        needed >> 20,
        available >> 20
    )]
    Memory {
        /// "fluid" or "solid".
        side: &'static str,
        /// Its cells.
        cells: usize,
        /// Time, s.
        time: f64,
        /// Bytes.
        needed: u64,
        /// Bytes.
        available: u64,
    },
    /// One side of a case that has no other.
    #[error("coupling.scheme: this case couples no two media, so `cav {side}` has no peer; use `cav run`")]
    NoPeer {
        /// "fluid" or "solid".
        side: &'static str,
    },
    /// The other side is another program's, which the launcher cannot start.
    #[error(
        "coupling.scheme = \"external\": the other side is another program's; \
         start this one with `cav {side} CASE --run ID` and that one under the same ID"
    )]
    PeerIsElsewhere {
        /// "fluid" or "solid", the side that is ours.
        side: &'static str,
    },
    /// The peer or the way to it failed.
    #[error(transparent)]
    Coupler(#[from] CouplerError),
    /// One of the launched processes ended otherwise than it should.
    #[error("the {side} (process {pid}) {what}; {log} in the run directory says more")]
    Child {
        /// "fluid" or "solid".
        side: &'static str,
        /// Its process.
        pid: u32,
        /// How it ended.
        what: String,
        /// Name of the log.
        log: &'static str,
        /// The exit code to pass on.
        code: u8,
    },
    /// A run cannot be taken up again.
    #[error("cannot go on with the run in {}: {reason}", path.display())]
    Resume {
        /// Its directory, or the file in question.
        path: std::path::PathBuf,
        /// Why not, and what helps.
        reason: String,
    },
    /// The wall of an earlier run cannot be taken up.
    #[error("solid.initial = \"{}\": {reason}", run.display())]
    Wall {
        /// The run's directory.
        run: std::path::PathBuf,
        /// Why not, and what helps.
        reason: String,
    },
    /// A study of grid convergence cannot be made.
    #[error("grid convergence: {0}")]
    Refine(String),
    /// What went wrong with one of its grids.
    #[error("grid {number} ({levels}): {source}")]
    Grid {
        /// Its number; 0 is the case as it is given.
        number: usize,
        /// Its levels, as keys of the case.
        levels: String,
        /// What went wrong.
        source: Box<RunError>,
    },
    /// A checkpoint does not belong to what the case makes.
    #[error("the checkpoint does not fit the case: {0}; run the case anew in another directory")]
    Misfit(#[from] mesh::Misfit),
    /// Output could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The run is complete, its report is not.
    #[error("the run is complete, but not its report: {0}")]
    Report(String),
    /// A thread pool or a process could not be started.
    #[error("cannot start {what}: {source}")]
    Start {
        /// What.
        what: String,
        /// Why not.
        source: std::io::Error,
    },
    /// SIGINT.
    #[error("interrupted: the run stopped after the current step, what was computed is written")]
    Interrupted,
    /// SIGTERM.
    #[error("terminated: the run stopped after the current step, what was computed is written")]
    Terminated,
}

impl RunError {
    /// An error if a case leaves one side to another program, so that this one cannot run it as a whole.
    pub fn unless_whole(case: &Case) -> Result<(), Self> {
        let side = if case.fluid.is_some() { "fluid" } else { "solid" };
        if case.coupling.scheme == Scheme::External { Err(Self::PeerIsElsewhere { side }) } else { Ok(()) }
    }

    /// The process's exit code, see `docs/reference/command-line.md`.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Case(_)
            | Self::Directory(_)
            | Self::NoPeer { .. }
            | Self::PeerIsElsewhere { .. }
            | Self::Resume { .. }
            | Self::Wall { .. }
            | Self::Refine(_)
            | Self::Misfit(_) => 2,
            Self::Grid { source, .. } => source.exit_code(),
            Self::Coupler(CouplerError::BadRunId { .. } | CouplerError::NameTaken { .. }) => 2,
            Self::Coupler(CouplerError::NoState { .. }) => 3,
            Self::Fluid(_) | Self::Solid(_) | Self::TimeStepCollapsed { .. } => 3,
            Self::Coupler(_) | Self::Start { .. } => 4,
            Self::Output(_) | Self::Memory { .. } | Self::Report(_) => 5,
            Self::Child { code, .. } => *code,
            Self::Interrupted => 130,
            Self::Terminated => 143,
        }
    }

    /// What the peer is told of it.
    pub fn fault(&self) -> Fault {
        match self {
            Self::Fluid(_) | Self::Solid(_) | Self::TimeStepCollapsed { .. } => Fault::Numerical,
            Self::Output(_) | Self::Directory(_) | Self::Memory { .. } | Self::Report(_) => Fault::Output,
            Self::Coupler(CouplerError::NoState { .. }) => Fault::Numerical,
            Self::Coupler(_) => Fault::Protocol,
            Self::Interrupted | Self::Terminated => Fault::Stopped,
            Self::Case(_)
            | Self::NoPeer { .. }
            | Self::PeerIsElsewhere { .. }
            | Self::Resume { .. }
            | Self::Wall { .. }
            | Self::Refine(_)
            | Self::Grid { .. }
            | Self::Misfit(_)
            | Self::Child { .. }
            | Self::Start { .. } => Fault::Other,
        }
    }
}
