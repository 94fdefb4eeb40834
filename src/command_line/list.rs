//! `cav list`.

use std::io::{IsTerminal, Write};
use std::path::PathBuf;

use clap::Args;

use crate::runs::{Asked, ListError, Listing};

/// Which runs, in what order, in what form.
#[derive(Args)]
pub(super) struct ListArgs {
    /// The folder that the runs are in, at any depth.
    #[arg(value_name = "DIR", default_value = "runs")]
    folder: PathBuf,
    /// Only runs of which this holds: KEY=VALUE, or != < <= > >= or ~ (contains) in place of =; may be repeated. Keys are those of cases,
    /// of summary.json, and path, state, progress, started, version.
    #[arg(long = "where", value_name = "CONDITION")]
    conditions: Vec<String>,
    /// Only runs in this state: running, finished, failed or interrupted; may be repeated.
    #[arg(long = "state", value_name = "STATE", value_delimiter = ',')]
    states: Vec<String>,
    /// Sort by a key instead of by path, the smallest first.
    #[arg(long, value_name = "KEY")]
    sort: Option<String>,
    /// The last first.
    #[arg(long)]
    reverse: bool,
    /// Show these keys, parted by commas, or all of them.
    #[arg(long, value_name = "KEYS", value_delimiter = ',')]
    columns: Option<Vec<String>>,
    /// As JSON: a list with a table for each run.
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// As CSV.
    #[arg(long)]
    csv: bool,
}

/// Lists runs; returns the exit code.
pub(super) fn list(args: &ListArgs) -> u8 {
    match listed(args) {
        Ok((text, notes)) => {
            notes.iter().for_each(|note| eprintln!("note: {note}"));
            let mut out = std::io::stdout().lock();
            // A reader that has seen enough (`cav list | head`) is no error.
            let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
            0
        }
        Err(error) => {
            eprintln!("error: {error}");
            2
        }
    }
}

fn listed(args: &ListArgs) -> Result<(String, Vec<String>), ListError> {
    let asked = Asked {
        conditions: args.conditions.clone(),
        states: args.states.clone(),
        sort: args.sort.clone(),
        reverse: args.reverse,
    };
    let listing = Listing::of(&args.folder, &asked)?;
    let columns = args.columns.as_deref();
    let text = if args.json {
        listing.json(&listing.columns(columns)?)
    } else if args.csv {
        listing.csv(&listing.columns(columns)?)
    } else {
        let is_terminal = std::io::stdout().is_terminal();
        let width = ratatui::crossterm::terminal::size().ok().filter(|_| is_terminal);
        listing.table(
            &listing.table_columns(columns)?,
            width.map(|(width, _)| width.into()),
            columns.is_some(),
        )
    };
    Ok((text, listing.notes))
}
