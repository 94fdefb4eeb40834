//! `cav run --resume DIR --end TIME`: a run that ends later than its case said.

use crate::case::{Case, MOST_SNAPSHOTS};
use crate::output::run_directory::{CASE, FLUID_FIELDS, FLUID_HISTORY, HISTORY, SOLID_FIELDS, SOLID_HISTORY};
use crate::output::{RunDirectory, set_of_file};
use crate::run::RunError;
use crate::run::checkpoints::Checkpoints;
use crate::run::record::attributes;

/// The case of a run with a later end, and with snapshots up to it: in the interval of those so far, if they have one, else at the
/// end alone. One at the earlier end stays, and so does the interval of `/interface`.
///
/// - `path`: of the case, for errors.
/// - errors: it cannot have this end.
pub(super) fn with_end(case: &Case, end: f64, path: &str) -> Result<Case, RunError> {
    let key = if case.time.settles { "longest" } else { "end" };
    let sets = [
        format!("time.{key}={end:?}"),
        format!("time.snapshots={:?}", snapshots(&case.time.snapshots, end)),
        format!("output.interface_every={:?}", case.interface_every()),
    ];
    Ok(Case::read(&case.effective_toml(), &case.name, path, &sets)?)
}

/// Times of snapshots up to a later end.
fn snapshots(times: &[f64], end: f64) -> Vec<f64> {
    let mut all = times.to_vec();
    let [.., before, last] = times else { return all };
    let every = times[1];
    let is_regular = |(k, time): (usize, &f64)| (time - k as f64 * every).abs() <= 1e-9 * every;
    let is_few = end / every <= MOST_SNAPSHOTS;
    if is_few && *before > 0.0 && times[..times.len() - 1].iter().enumerate().all(is_regular) {
        let from = (last / every * (1.0 + 1e-9)).floor() as usize + 1;
        all.extend((from..).map(|k| k as f64 * every).take_while(|time| *time < end));
    }
    all
}

/// Makes the run in a directory one of a case that ends later: its checkpoint, its files, its case. If it is killed meanwhile, it is
/// as it was or does the rest when it is asked for the same again.
///
/// - `step`: of the checkpoint.
pub(super) fn take_over(
    directory: &RunDirectory,
    case: &Case,
    checkpoints: &Checkpoints,
    step: Option<u64>,
) -> Result<(), RunError> {
    if let Some(step) = step {
        checkpoints.take_over(step)?;
    }
    directory.mark_unfinished()?;
    let attributes = attributes(case);
    for name in [FLUID_HISTORY, SOLID_HISTORY, HISTORY, FLUID_FIELDS, SOLID_FIELDS] {
        let path = directory.file(name);
        if path.exists() {
            set_of_file(&path, &attributes)?;
        }
    }
    directory.write_atomic(CASE, case.effective_toml().as_bytes())?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapshots_go_on_as_they_came() {
        assert_eq!(snapshots(&[0.0, 1.0], 3.0), [0.0, 1.0]);
        assert_eq!(snapshots(&[0.0, 0.25, 0.5, 0.75, 1.0], 1.6), [0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5]);
        assert_eq!(snapshots(&[0.0, 0.4, 0.8, 1.0], 2.0), [0.0, 0.4, 0.8, 1.0, 3.0 * 0.4, 1.6]);
        assert_eq!(snapshots(&[0.0, 0.1, 0.9, 1.0], 2.0), [0.0, 0.1, 0.9, 1.0]);
    }
}
