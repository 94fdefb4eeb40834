//! The command line: `cav`, and `python -m pycav` likewise.

use std::ffi::OsString;
use std::fs::OpenOptions;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use crate::case::{Case, CaseErrors, materials_table, report};
use crate::output::run_directory::LOG;
use crate::run::drive::Joining;
use crate::run::launch::{Options, run_side};
use crate::run::stop::Stop;
use crate::run::{RunError, run};
use clap::{Args, Parser, Subcommand};
use coupler::Participant;
use tracing::Level;
use tracing_subscriber::fmt::writer::MakeWriterExt;

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
    /// List the library of materials.
    Materials,
}

#[derive(Args)]
struct Common {
    /// The case file.
    case: PathBuf,
    /// The run directory [default: output.directory of the case, else runs/NAME].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Change a key of the case, as fluid.region.0.radius=0.01; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
    /// Worker threads of each process [default: all processors].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Replace the directory of a finished run.
    #[arg(long)]
    force: bool,
    /// Show nothing but errors.
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Log more; twice: everything.
    #[arg(short, long, action = clap::ArgAction::Count)]
    verbose: u8,
}

#[derive(Args)]
struct RunArgs {
    #[command(flatten)]
    common: Common,
    /// Run both sides in this process instead of two.
    #[arg(long)]
    in_process: bool,
}

#[derive(Args)]
struct SideArgs {
    #[command(flatten)]
    common: Common,
    /// The run's id, the same on both sides.
    #[arg(long, value_name = "ID")]
    run: String,
    /// Started by `cav run`.
    #[arg(long, hide = true)]
    child: bool,
}

impl Common {
    fn options(&self, in_process: bool) -> Options {
        Options {
            case_path: self.case.clone(),
            sets: self.sets.clone(),
            out: self.out.clone(),
            force: self.force,
            in_process,
            threads: self.threads.map(usize::from),
            program: Vec::new(),
            quiet: self.quiet,
            verbosity: self.verbose,
        }
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
        Some(Commands::Materials) => print(&materials_table()),
        Some(Commands::Check { case, sets }) => {
            Case::load(&case, &sets).map_err(RunError::from).and_then(|case| print(&report(&case)))
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
    let options = Options { program: program.to_vec(), ..args.common.options(args.in_process) };
    let case = Case::load(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    run(&case, &options, &stop, |directory| log_to(directory, options.verbosity, true)).map(|_| ())
}

fn side(args: &SideArgs, participant: Participant) -> Result<(), RunError> {
    let options = args.common.options(false);
    let case = Case::load(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    if args.child {
        stop.watch_launcher();
    }
    let joining = Joining { run_id: args.run.clone(), participant };
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
        other => eprintln!("error: {other}"),
    }
    tracing::error!("{error}");
}

fn render(errors: &CaseErrors) -> String {
    errors.render(std::io::stderr().is_terminal())
}

/// Logs to the run directory, and with `-v` to the terminal unless the launcher does.
fn log_to(directory: &Path, verbosity: u8, to_terminal: bool) {
    let level = if verbosity > 1 { Level::DEBUG } else { Level::INFO };
    let on_terminal = match verbosity {
        0 => Level::ERROR,
        1 => Level::INFO,
        _ => Level::DEBUG,
    };
    let path = directory.join(LOG);
    // A run does not fail for want of a log; what matters is in its other files and on the terminal.
    let Ok(file) = OpenOptions::new().create(true).append(true).open(path) else { return };
    let builder = tracing_subscriber::fmt().with_max_level(level).with_ansi(false);
    if to_terminal && verbosity > 0 {
        builder.with_writer(Mutex::new(file).and(std::io::stderr.with_max_level(on_terminal))).init();
    } else {
        builder.with_writer(Mutex::new(file)).init();
    }
}
