//! The command line: `cav`, and `python -m pycav` likewise.

mod arguments;
mod check;
mod help;
mod keys;
mod list;
mod log;
mod new;
mod print;
mod reference;
mod report;
mod run;
mod scripts;
mod watch;

use std::ffi::OsString;
use std::path::Path;

use clap::{FromArgMatches, Parser, Subcommand};
use coupler::Participant;

use crate::case::materials_table;
use crate::run::RunError;
use arguments::{RunArgs, SideArgs};
use print::{complain, print};
pub use reference::reference;

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
    ///
    /// A coupled case starts two processes, the fluid's and the solid's, and watches them. One medium alone, or a fluid above a
    /// rigid wall, needs one process. Progress goes to standard error: a bar on a terminal, else a plain line now and then.
    ///
    /// With --refine the case runs on N grids. Each has its run directory in DIR, which also gets convergence.json; without --out
    /// that is the case's own with "-convergence" behind. A table of values, observed orders and grid-convergence indices goes to
    /// standard output. The same command again goes on: what is complete is kept, the rest is taken up from its checkpoint.
    Run(RunArgs),
    /// Write a case file for what is asked; without a kind, list the kinds.
    New(new::New),
    /// Check a case: cells, memory, time steps, impedances, run time.
    ///
    /// Nothing is run. Besides it says cells per radius, the Rayleigh time, and warnings. Of an adaptive grid it names levels and
    /// thresholds; memory and time are then upper bounds, with a guess beside them. What begins with more memory than the machine has
    /// available is refused by every command that runs it.
    Check(check::CheckArgs),
    /// Show the keys of a case file: values, units, defaults.
    Keys(keys::KeysArgs),
    /// Run the fluid's side alone; the solid's runs elsewhere under the same --run.
    ///
    /// The two sides are started in two terminals, in either order. Both need the same case, the same --set, the same --run and the
    /// same directory. The fluid makes the run directory and shows the progress. A side waits for the other for
    /// coupling.connect_timeout seconds. If the cases differ, both sides end with exit code 4 and say so.
    Fluid(SideArgs),
    /// Run the solid's side alone; the fluid's runs elsewhere under the same --run.
    ///
    /// See `fluid`: both sides need the same case, --set, --run and directory.
    Solid(SideArgs),
    /// List the runs in a folder: what was varied, key numbers, states.
    List(list::ListArgs),
    /// Watch a run as it goes on: curves, step, time left.
    Watch(watch::WatchArgs),
    /// List the library of materials and fluids.
    ///
    /// Densities, wave speeds, yield strengths and sources; and below, for those that have some, the constants of the Johnson-Cook
    /// law with theirs, and what other sources say.
    Materials,
    /// Write a completion script for a shell.
    Completions(scripts::CompletionsArgs),
    /// Write the manual's pages.
    Man(scripts::ManArgs),
}

const NEXT: &str = "\
cav: a cavitation bubble collapsing near an elastic solid, and what it does to the wall.

What to type next:
  cav run cases/collapse.toml            a bubble collapses above aluminium: ten seconds
  cav new                                a case for a bubble of your own
  cav check CASE                         what a case is and costs, without running it
  cav keys                               what a case file may say
  cav materials                          the library of walls
  cav --help                             everything else

From the source directory `cargo run --release --` stands for `cav`.

docs/reference/cases.md explains case files, docs/reference/output.md what a run leaves behind.
";

/// Does what a command line says, the program's name first; returns the exit code.
///
/// - `program`: the command by which this program can be started again, for a run in two processes; empty where it is
///   this process's own executable.
/// - `others`: commands that the caller does itself, with what they do: they are named in helps and completions.
pub fn main(
    arguments: impl IntoIterator<Item = OsString>,
    program: &[OsString],
    others: &[(String, String)],
) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let name = arguments.first().and_then(|first| Path::new(first).file_stem()?.to_str()).unwrap_or("cav");
    let command = help::command(name, others);
    let matched = command.clone().try_get_matches_from(&arguments);
    let cli = match matched.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are asked for and go to standard output.
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(2);
        }
    };
    let is_child = matches!(&cli.command, Some(Commands::Fluid(args) | Commands::Solid(args)) if args.child);
    let result = match cli.command {
        None => print(NEXT),
        Some(Commands::List(args)) => return list::list(&args),
        Some(Commands::Watch(args)) => return watch::watch(&args),
        Some(Commands::Materials) => print(&materials_table()),
        Some(Commands::New(args)) => new::text(args).map_err(RunError::from).and_then(|text| print(&text)),
        Some(Commands::Check(args)) => check::check(&args),
        Some(Commands::Run(args)) => run::run_case(&args, program),
        Some(Commands::Fluid(args)) => run::side(&args, Participant::Fluid),
        Some(Commands::Solid(args)) => run::side(&args, Participant::Solid),
        Some(Commands::Keys(args)) => return keys::keys(&args),
        Some(Commands::Completions(args)) => return scripts::completions(&args, command, name),
        Some(Commands::Man(args)) => return scripts::man(&args, command),
    };
    match result {
        Ok(()) => 0,
        // That it was stopped the launcher says, once for both sides.
        Err(error @ (RunError::Interrupted | RunError::Terminated)) if is_child => error.exit_code(),
        Err(error) => {
            complain(&error);
            error.exit_code()
        }
    }
}
