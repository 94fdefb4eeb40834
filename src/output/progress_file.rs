//! `progress.json`: how far a run is, for whoever looks at its directory meanwhile.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::progress_line::ProgressLine;
use super::run_directory::PROGRESS;
use super::throttle::Throttle;
use super::{RunDirectory, safe_file};

/// Time between two versions of the file.
const INTERVAL: Duration = Duration::from_millis(500);

/// Where a run stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// The state after a step.
    #[serde(flatten)]
    pub line: ProgressLine,
    /// Simulated time at which the run ends (at the latest), s.
    pub end: f64,
    /// Wall time that is left, by the speed of the last seconds, s; unknown at first.
    pub left: Option<f64>,
}

impl Standing {
    /// What the directory of a run says; `None` if it says nothing, as of a run that has just begun or is finished.
    #[must_use]
    pub fn read(directory: &Path) -> Option<Self> {
        serde_json::from_str(&fs::read_to_string(directory.join(PROGRESS)).ok()?).ok()
    }
}

/// The file, written whole twice a second at most.
#[derive(Debug)]
pub(super) struct ProgressFile {
    path: PathBuf,
    throttle: Throttle,
}

impl ProgressFile {
    pub(super) fn new(directory: &RunDirectory) -> Self {
        Self { path: directory.file(PROGRESS), throttle: Throttle::new(INTERVAL) }
    }

    pub(super) fn is_due(&mut self) -> bool {
        self.throttle.is_due()
    }

    /// A run does not fail for want of it, nor does it wait for the disk: after a loss of power nobody asks how far it was.
    pub(super) fn write(&self, standing: &Standing) {
        let text = serde_json::to_string(standing).expect("numbers and texts can be written");
        let written = safe_file::replace(&self.path, |temporary| {
            fs::write(temporary, text + "\n").map_err(super::OutputError::io(&self.path, "write"))
        });
        if let Err(error) = written {
            tracing::debug!(%error, "the progress is not told");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_a_part_of_it_is_nothing() {
        let place = tempfile::tempdir().expect("a directory");
        let directory = RunDirectory::open(place.path()).expect("it is there");
        assert_eq!(Standing::read(place.path()), None);
        let line = ProgressLine::example();
        for left in [None, Some(12.5)] {
            let standing = Standing { line: line.clone(), end: 6.57e-5, left };
            ProgressFile::new(&directory).write(&standing);
            assert_eq!(Standing::read(place.path()), Some(standing));
        }
        let path = place.path().join(PROGRESS);
        let whole = fs::read(&path).expect("it is written");
        fs::write(&path, &whole[..whole.len() / 2]).expect("it is cut");
        assert_eq!(Standing::read(place.path()), None);
    }
}
