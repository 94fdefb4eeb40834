//! Arguments of the commands that run a case.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueHint};

use crate::case::new::Dimension;

/// What is run, and where.
#[derive(Args)]
pub(super) struct What {
    /// The run directory. Without it the case's output.directory, else runs/NAME, NAME being the case file's.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Change a key of the case for this run, as fluid.region.0.radius=0.01; may be given several times. `cav keys` lists them.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
}

/// How it is run.
#[derive(Args)]
pub(super) struct How {
    /// Threads of each process; without it all processors. The numbers do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Keep a checkpoint after so much wall time: 30s, 5min, 1h, a number of seconds, or off.
    #[arg(long, value_name = "TIME", default_value = "5min", value_parser = Every::parse)]
    pub checkpoint_every: Every,
    /// Show nothing but errors.
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Show plain lines instead of a bar, and more of the log; twice for still more.
    #[arg(short, long, action = clap::ArgAction::Count)]
    pub verbose: u8,
}

#[derive(Args)]
pub(super) struct RunArgs {
    /// The case file.
    #[arg(required_unless_present = "resume", value_hint = ValueHint::FilePath)]
    pub case: Option<PathBuf>,
    #[command(flatten)]
    pub what: What,
    /// Replace a finished run in the directory; with --refine those of other cases. Only files of a run are deleted.
    #[arg(long)]
    pub force: bool,
    /// Go on with the run in DIR from its newest checkpoint.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, conflicts_with_all = ["case", "out", "sets", "force"])]
    pub resume: Option<PathBuf>,
    /// Let the run in DIR end later, 400us or 4e-4; also one that is finished.
    #[arg(long, value_name = "TIME", value_parser = time, requires = "resume", conflicts_with = "case")]
    pub end: Option<f64>,
    #[command(flatten)]
    pub how: How,
    /// Run both sides in this process instead of two, through the same frames; the numbers are the same bitwise.
    #[arg(long)]
    pub in_process: bool,
    /// Make a page of the run when it has ended, where pycav is there.
    #[arg(long)]
    pub report: bool,
    /// Run the case on N grids, 2 to 5, each with cells half as wide as the one before, and say what its numbers converge to.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=5), conflicts_with_all = ["resume", "report"])]
    pub refine: Option<u16>,
}

#[derive(Args)]
pub(super) struct SideArgs {
    /// The case file.
    #[arg(value_hint = ValueHint::FilePath)]
    pub case: PathBuf,
    #[command(flatten)]
    pub what: What,
    /// Replace a finished run in the directory. Only files of a run are deleted.
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    pub how: How,
    /// The run's name, the same on both sides: 1 to 64 of A-Z a-z 0-9 _ . -. Two runs on one machine must differ in it.
    #[arg(long, value_name = "ID")]
    pub run: String,
    /// Started by `cav run`.
    #[arg(long, hide = true)]
    pub child: bool,
    /// The step of the checkpoint to go on from.
    #[arg(long, hide = true)]
    pub from: Option<u64>,
    /// What the case is called, if not as its file.
    #[arg(long, hide = true)]
    pub name: Option<String>,
}

/// A time with a unit, or in s.
pub(super) fn time(text: &str) -> Result<f64, String> {
    Dimension::Time.parse(text)
}

/// After how much wall time; `None` is never.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Every(pub Option<Duration>);

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

#[cfg(test)]
mod tests {
    use super::Every;

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
