//! `cav completions` and `cav man`: what shells and `man` read of the command line.

use std::fs;
use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, Command, ValueHint};
use clap_complete::Shell;

use super::print::print;
use crate::case::key_paths;

/// For whom, and where to.
#[derive(Args)]
pub(super) struct CompletionsArgs {
    /// The shell.
    shell: Shell,
    /// A directory for the script; without it it goes to standard output.
    #[arg(value_hint = ValueHint::DirPath)]
    dir: Option<PathBuf>,
}

/// Where to.
#[derive(Args)]
pub(super) struct ManArgs {
    /// A directory for the pages, one a command; without it the main page goes to standard output.
    #[arg(value_hint = ValueHint::DirPath)]
    dir: Option<PathBuf>,
}

/// Writes a completion script; returns the exit code.
///
/// - `command`: the whole command line; `name`: what the program is called.
pub(super) fn completions(args: &CompletionsArgs, command: Command, name: &str) -> u8 {
    // Paths of keys are offered, and not all that is understood.
    let mut command = command.mut_subcommand("keys", |keys| {
        keys.mut_arg("path", |path| {
            path.value_parser(PossibleValuesParser::new(key_paths())).hide_possible_values(true)
        })
    });
    match &args.dir {
        None => {
            let mut script = Vec::new();
            clap_complete::generate(args.shell, &mut command, name, &mut script);
            let _ = print(&String::from_utf8_lossy(&script));
            0
        }
        Some(directory) => written(directory, || {
            clap_complete::generate_to(args.shell, &mut command, name, directory)?;
            Ok(())
        }),
    }
}

/// Writes the manual's pages; returns the exit code.
pub(super) fn man(args: &ManArgs, command: Command) -> u8 {
    match &args.dir {
        None => {
            let mut page = Vec::new();
            // Into memory; that cannot fail.
            let _ = clap_mangen::Man::new(command).render(&mut page);
            let _ = print(&String::from_utf8_lossy(&page));
            0
        }
        Some(directory) => written(directory, || clap_mangen::generate_to(command, directory)),
    }
}

/// Makes a directory and what is to be in it.
fn written(directory: &Path, make: impl FnOnce() -> std::io::Result<()>) -> u8 {
    match fs::create_dir_all(directory).and_then(|()| make()) {
        Ok(()) => 0,
        Err(error) => {
            eprintln!("error: cannot write to {}: {error}; choose another directory", directory.display());
            5
        }
    }
}
