//! The command line.

#![forbid(unsafe_code)]

use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use cav::case::{Case, CaseErrors, materials_table, report};
use cav::run::drive::Joining;
use cav::run::launch::{Options, directory_of, run_side};
use cav::run::stop::Stop;
use cav::run::{RunError, run};
use clap::{Args, Parser, Subcommand};
use coupler::Participant;

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
            quiet: self.quiet,
            verbosity: self.verbose,
        }
    }
}

const NEXT: &str = "\
cav: a cavitation bubble collapsing near an elastic solid, and what it does to the wall.

What to type next:
  cargo run --release -- run cases/dickopp2012-coarse.toml     run the main case, about a minute
  cargo run --release -- check cases/dickopp2012-coarse.toml   what it would cost, without running it
  cargo run --release -- materials                             the library of materials
  cargo run --release -- --help                                everything else

docs/cases.md explains the keys of a case file, docs/output.md what a run leaves behind.
";

fn main() -> ExitCode {
    let result = match Cli::parse().command {
        None => print(NEXT),
        Some(Commands::Materials) => print(&materials_table()),
        Some(Commands::Check { case, sets }) => {
            Case::load(&case, &sets).map_err(RunError::from).and_then(|case| print(&report(&case)))
        }
        Some(Commands::Run(args)) => run_case(&args),
        Some(Commands::Fluid(args)) => side(&args, Participant::Fluid),
        Some(Commands::Solid(args)) => side(&args, Participant::Solid),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&error);
            ExitCode::from(error.exit_code())
        }
    }
}

fn run_case(args: &RunArgs) -> Result<(), RunError> {
    let options = args.common.options(args.in_process);
    let case = Case::load(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    log_to_stderr(options.verbosity);
    run(&case, &options, &stop).map(|_| ())
}

fn side(args: &SideArgs, participant: Participant) -> Result<(), RunError> {
    let options = args.common.options(false);
    let case = Case::load(&options.case_path, &options.sets)?;
    let stop = Stop::on_signals()?;
    if args.child {
        stop.watch_launcher();
        log_to_file(&directory_of(&case, options.out.as_deref()), options.verbosity);
    } else {
        log_to_stderr(options.verbosity);
    }
    let joining = Joining { run_id: args.run.clone(), participant };
    run_side(&case, &options, joining, args.child, &stop)
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

fn level(verbosity: u8) -> tracing::Level {
    match verbosity {
        0 => tracing::Level::WARN,
        1 => tracing::Level::INFO,
        _ => tracing::Level::DEBUG,
    }
}

fn log_to_stderr(verbosity: u8) {
    if verbosity > 0 {
        tracing_subscriber::fmt().with_max_level(level(verbosity)).with_writer(std::io::stderr).init();
    }
}

fn log_to_file(directory: &std::path::Path, verbosity: u8) {
    let path = directory.join(cav::output::run_directory::LOG);
    if let Ok(file) = std::fs::OpenOptions::new().create(true).append(true).open(path) {
        tracing_subscriber::fmt()
            .with_max_level(level(verbosity.max(1)))
            .with_ansi(false)
            .with_writer(std::sync::Mutex::new(file))
            .init();
    }
}
