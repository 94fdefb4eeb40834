//! `cav run`, `cav fluid` and `cav solid`.

use std::ffi::OsString;
use std::path::Path;

use coupler::Participant;

use super::arguments::{How, RunArgs, SideArgs, What};
use super::log::{Follower, log_to};
use super::print::print;
use super::report;
use crate::case::Case;
use crate::convergence::plan::Source;
use crate::convergence::study::study;
use crate::convergence::table::table;
use crate::run::process::drive::Joining;
use crate::run::process::launch::run_side;
use crate::run::process::launch_options::Options;
use crate::run::process::stop::Stop;
use crate::run::{RunError, resume, run};

fn options(case: &Path, what: &What, force: bool, how: &How) -> Options {
    Options {
        case_path: case.to_path_buf(),
        sets: what.sets.clone(),
        out: what.out.clone(),
        force,
        in_process: false,
        threads: how.threads.map(usize::from),
        checkpoint_every: how.checkpoint_every.0,
        end: None,
        from: None,
        name: None,
        program: Vec::new(),
        quiet: how.quiet,
        verbosity: how.verbose,
    }
}

/// `cav run`.
pub(super) fn run_case(args: &RunArgs, program: &[OsString]) -> Result<(), RunError> {
    let path = args.case.as_deref().unwrap_or(Path::new(""));
    let options = Options {
        program: program.to_vec(),
        in_process: args.in_process,
        end: args.end,
        ..options(path, &args.what, args.force, &args.how)
    };
    let log = |directory: &Path| log_to(directory, options.verbosity, true);
    if let Some(directory) = &args.resume {
        let stop = Stop::on_signals()?;
        let directory = resume(directory, &options, &stop, log)?;
        return if args.report { report::make(&directory, program) } else { Ok(()) };
    }
    if let Some(grids) = args.refine {
        return refine(usize::from(grids), &options);
    }
    let case = Case::load(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    let directory = run(&case, &options, &stop, log)?;
    if args.report { report::make(&directory, program) } else { Ok(()) }
}

/// A case on so many grids, and the table of its numbers.
fn refine(grids: usize, options: &Options) -> Result<(), RunError> {
    let source = Source::of_file(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    let log = Follower::begin(options.verbosity);
    let study = study(&source, grids, options, &stop, |directory| log.follow(directory))?;
    if !options.quiet {
        print(&table(&study.grids, &study.ends))?;
    }
    study.failure.map_or(Ok(()), Err)
}

/// `cav fluid` and `cav solid`.
pub(super) fn side(args: &SideArgs, participant: Participant) -> Result<(), RunError> {
    let common = options(&args.case, &args.what, args.force, &args.how);
    let options = Options { from: args.from, name: args.name.clone(), ..common };
    let mut case = Case::load(&options.case_path, &options.sets)?;
    if let Some(name) = &options.name {
        case.name.clone_from(name);
    }
    let stop = Stop::on_signals()?;
    if args.child {
        stop.watch_launcher();
    }
    let joining = Joining { run_id: args.run.clone(), participant, notice: None };
    let log = |directory: &Path| log_to(directory, options.verbosity, !args.child);
    run_side(&case, &options, joining, args.child, &stop, log)
}
