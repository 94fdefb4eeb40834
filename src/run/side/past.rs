//! What was done before a run was taken up again, added to what has been done since.

use std::time::{Duration, Instant};

use coupler::LinkCounters;
use serde::{Deserialize, Serialize};

/// Wall time and exchanges of a side, over all parts of a run.
#[derive(Clone, Debug)]
pub struct Past {
    before: Done,
    since: Instant,
    /// What the link had done when this part of the run really began.
    greetings: LinkCounters,
}

/// What was done up to a checkpoint.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Done {
    wall: Duration,
    exchanged: LinkCounters,
}

impl Past {
    /// Begins now, after what was done before.
    pub fn after(before: Done) -> Self {
        Self { before, since: Instant::now(), greetings: LinkCounters::default() }
    }

    /// What the link has done so far was only for the sake of going on, and does not count.
    pub fn leave_out(&mut self, greetings: LinkCounters) {
        self.greetings = greetings;
    }

    /// Wall time of the whole run so far.
    pub fn wall(&self) -> Duration {
        self.before.wall + self.since.elapsed()
    }

    /// Exchanges of the whole run, the link's counters being `now`.
    pub fn exchanged(&self, now: LinkCounters) -> LinkCounters {
        now.since(&self.greetings).plus(&self.before.exchanged)
    }

    /// What has to be kept of it.
    pub fn saved(&self, now: LinkCounters) -> Done {
        Done { wall: self.wall(), exchanged: self.exchanged(now) }
    }
}
