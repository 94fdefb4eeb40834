//! The command line: `cav`, and `python -m pycav` likewise.

mod list;
mod log;
mod watch;

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::case::{Case, CaseErrors, materials_table, report};
use crate::convergence::plan::Source;
use crate::convergence::study::study;
use crate::convergence::table::table;
use crate::run::process::drive::Joining;
use crate::run::process::launch::run_side;
use crate::run::process::launch_options::Options;
use crate::run::process::stop::Stop;
use crate::run::{RunError, resume, run, wall};
use clap::{Args, Parser, Subcommand};
use coupler::Participant;
use log::{Follower, log_to};

/// A cavitation bubble collapsing near an elastic solid: what it does to the wall.
#[derive(Parser)]
#[command(name = "cav", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Option<Commands>,
}

#[derive(Subcommand)]
enum Commands {
    /// Run a case and leave a run directory.
    Run(RunArgs),
    /// Check a case: cells, memory, time steps, impedances, run time.
    Check {
        /// The case file.
        case: PathBuf,
        /// Change a key of the case, as fluid.region.0.radius=0.01; may be repeated.
        #[arg(long = "set", value_name = "KEY=VALUE")]
        sets: Vec<String>,
    },
    /// Run the fluid's side alone; the solid's runs elsewhere under the same --run.
    Fluid(SideArgs),
    /// Run the solid's side alone; the fluid's runs elsewhere under the same --run.
    Solid(SideArgs),
    /// List the runs in a folder: what was varied, key numbers, states.
    List(list::ListArgs),
    /// Watch a run as it goes on: curves, step, time left.
    Watch(watch::WatchArgs),
    /// List the library of materials.
    Materials,
}

/// What is run, and where.
#[derive(Args)]
struct What {
    /// The run directory [default: output.directory of the case, else runs/NAME].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Change a key of the case, as fluid.region.0.radius=0.01; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
    /// Replace the directory of a finished run.
    #[arg(long)]
    force: bool,
}

/// How it is run.
#[derive(Args)]
struct How {
    /// Worker threads of each process [default: all processors].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Keep a checkpoint after so much wall time: a number with ms, s, min or h, or off.
    #[arg(long, value_name = "TIME", default_value = "5min", value_parser = Every::parse)]
    checkpoint_every: Every,
    /// Show nothing but errors.
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Log more; twice: everything.
    #[arg(short, long, action = clap::ArgAction::Count)]
    verbose: u8,
}

#[derive(Args)]
struct RunArgs {
    /// The case file.
    #[arg(required_unless_present = "resume")]
    case: Option<PathBuf>,
    #[command(flatten)]
    what: What,
    /// Go on with the run in DIR that was not finished.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["case", "out", "sets", "force"])]
    resume: Option<PathBuf>,
    #[command(flatten)]
    how: How,
    /// Run both sides in this process instead of two.
    #[arg(long)]
    in_process: bool,
    /// Run the case on N grids, 2 to 5, each with cells half as wide as the one before, and say what its numbers converge to.
    /// Each has a run directory in DIR; the same command again goes on.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=5), conflicts_with = "resume")]
    refine: Option<u16>,
}

#[derive(Args)]
struct SideArgs {
    /// The case file.
    case: PathBuf,
    #[command(flatten)]
    what: What,
    #[command(flatten)]
    how: How,
    /// The run's id, the same on both sides.
    #[arg(long, value_name = "ID")]
    run: String,
    /// Started by `cav run`.
    #[arg(long, hide = true)]
    child: bool,
    /// The step of the checkpoint to go on from.
    #[arg(long, hide = true)]
    from: Option<u64>,
    /// What the case is called, if not as its file.
    #[arg(long, hide = true)]
    name: Option<String>,
}

/// After how much wall time; `None` is never.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Every(Option<Duration>);

impl Every {
    /// From a number, of seconds unless a unit follows, or `off`.
    fn parse(text: &str) -> Result<Self, String> {
        if text == "off" {
            return Ok(Self(None));
        }
        let every = match text.parse() {
            Ok(seconds) => Duration::try_from_secs_f64(seconds).ok(),
            Err(_) => humantime::parse_duration(text).ok(),
        };
        every
            .map(|every| Self(Some(every)))
            .ok_or_else(|| "give a time, as 30s, 5min or 1h, or off".to_owned())
    }
}

fn options(case: &Path, what: &What, how: &How) -> Options {
    Options {
        case_path: case.to_path_buf(),
        sets: what.sets.clone(),
        out: what.out.clone(),
        force: what.force,
        in_process: false,
        threads: how.threads.map(usize::from),
        checkpoint_every: how.checkpoint_every.0,
        from: None,
        name: None,
        program: Vec::new(),
        quiet: how.quiet,
        verbosity: how.verbose,
    }
}

const NEXT: &str = "\
cav: a cavitation bubble collapsing near an elastic solid, and what it does to the wall.

What to type next:
  cargo run --release -- run cases/dickopp2012-coarse.toml     run the main case, half a minute
  cargo run --release -- check cases/dickopp2012-coarse.toml   what it would cost, without running it
  cargo run --release -- materials                             the library of materials
  cargo run --release -- --help                                everything else

docs/cases.md explains the keys of a case file, docs/output.md what a run leaves behind.
";

/// Does what a command line says, the program's name first; returns the exit code.
///
/// - `program`: the command by which this program can be started again, for a run in two processes; empty where it is
///   this process's own executable.
pub fn main(arguments: impl IntoIterator<Item = OsString>, program: &[OsString]) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are asked for and go to standard output.
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(2);
        }
    };
    let result = match cli.command {
        None => print(NEXT),
        Some(Commands::List(args)) => return list::list(&args),
        Some(Commands::Watch(args)) => return watch::watch(&args),
        Some(Commands::Materials) => print(&materials_table()),
        Some(Commands::Check { case, sets }) => {
            let checked = |case: &Case| wall::check(case).and_then(|()| print(&report(case)));
            Case::load(&case, &sets).map_err(RunError::from).and_then(|case| checked(&case))
        }
        Some(Commands::Run(args)) => run_case(&args, program),
        Some(Commands::Fluid(args)) => side(&args, Participant::Fluid),
        Some(Commands::Solid(args)) => side(&args, Participant::Solid),
    };
    match result {
        Ok(()) => 0,
        Err(error) => {
            complain(&error);
            error.exit_code()
        }
    }
}

fn run_case(args: &RunArgs, program: &[OsString]) -> Result<(), RunError> {
    let path = args.case.as_deref().unwrap_or(Path::new(""));
    let options = Options {
        program: program.to_vec(),
        in_process: args.in_process,
        ..options(path, &args.what, &args.how)
    };
    let log = |directory: &Path| log_to(directory, options.verbosity, true);
    if let Some(directory) = &args.resume {
        let stop = Stop::on_signals()?;
        return resume(directory, &options, &stop, log).map(|_| ());
    }
    if let Some(grids) = args.refine {
        return refine(usize::from(grids), &options);
    }
    let case = Case::load(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    run(&case, &options, &stop, log).map(|_| ())
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

fn side(args: &SideArgs, participant: Participant) -> Result<(), RunError> {
    let common = options(&args.case, &args.what, &args.how);
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

fn print(text: &str) -> Result<(), RunError> {
    let mut out = std::io::stdout().lock();
    // A reader that has seen enough (`cav materials | head`) is no error.
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    Ok(())
}

fn complain(error: &RunError) {
    match error {
        RunError::Case(errors) => eprint!("{}", render(errors)),
        RunError::Grid { number, levels, source } => match &**source {
            RunError::Case(errors) => eprint!("grid {number} ({levels}):\n{}", render(errors)),
            _ => eprintln!("error: {error}"),
        },
        other => eprintln!("error: {other}"),
    }
    tracing::error!("{error}");
}

fn render(errors: &CaseErrors) -> String {
    errors.render(std::io::stderr().is_terminal())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_numbers_with_units_or_off() {
        let seconds =
            |text| Every::parse(text).ok().map(|Every(every)| every.map(|every| every.as_secs_f64()));
        for (text, expected) in [
            ("5min", 300.0),
            ("0.5 h", 1800.0),
            ("1h 30min", 5400.0),
            ("2 days", 172_800.0),
            ("250ms", 0.25),
            ("3s", 3.0),
            ("7", 7.0),
        ] {
            assert_eq!(seconds(text), Some(Some(expected)), "{text}");
        }
        assert_eq!(seconds("off"), Some(None));
        for text in ["", "min", "-3s", "-3", "5 parsecs", "1e400", "nan", "99999999999999999999h"] {
            assert_eq!(seconds(text), None, "{text}");
        }
    }
}
