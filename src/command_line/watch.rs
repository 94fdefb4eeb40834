//! `cav watch`.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use crate::watch::terminal;

/// What is watched, and how often.
#[derive(Args)]
pub(super) struct WatchArgs {
    /// The directory of a run, or of the grids of `cav run --refine`.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Look at its files after so much time, from 0.1 s.
    #[arg(long, value_name = "TIME", default_value = "500ms", value_parser = interval)]
    every: Duration,
}

/// A time that is not so short that the looking would cost more than it shows.
fn interval(text: &str) -> Result<Duration, String> {
    let refused = || "give a time from 0.1 s to 1 h, as 500ms or 2s".to_owned();
    let every = match text.parse() {
        Ok(seconds) => Duration::try_from_secs_f64(seconds).map_err(|_| refused())?,
        Err(_) => humantime::parse_duration(text).map_err(|_| refused())?,
    };
    let allowed = Duration::from_millis(100)..=Duration::from_secs(3600);
    if allowed.contains(&every) { Ok(every) } else { Err(refused()) }
}

/// Shows a run; returns the exit code.
pub(super) fn watch(args: &WatchArgs) -> u8 {
    match terminal::watch(&args.run, args.every) {
        Ok(()) => 0,
        Err(error) => {
            eprintln!("error: {error}");
            2
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_times_that_are_neither_too_short_nor_too_long() {
        for (text, milliseconds) in [("0.1", 100), ("500ms", 500), ("2s", 2000), ("1h", 3_600_000)] {
            assert_eq!(interval(text), Ok(Duration::from_millis(milliseconds)), "{text}");
        }
        for text in ["0", "50ms", "-1", "nan", "2h", "often", ""] {
            assert!(interval(text).is_err(), "{text}");
        }
    }
}
