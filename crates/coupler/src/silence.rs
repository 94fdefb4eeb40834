//! How long a peer that lives has been silent, and telling the user of it.

use std::fs;
use std::time::{Duration, Instant};

use crate::kinds::Participant;
use crate::notice::Notice;

/// A stopped peer is told of after this time.
const STOPPED_AFTER: Duration = Duration::from_secs(1);
/// Any other peer after this time: a step may be long.
const SILENT_AFTER: Duration = Duration::from_secs(60);
/// Between two looks longer than this the waiting process was itself stopped, and heard nothing for that reason.
const LONGEST_LOOK: Duration = Duration::from_secs(1);

/// A wait for the peer: for its next frame, or until it takes one.
pub(crate) struct Silence {
    notice: Option<Notice>,
    patience: Duration,
    peer: Option<(Participant, u32)>,
    waited: Duration,
    looked: Instant,
    is_told: bool,
}

impl std::fmt::Debug for Silence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Silence").field("waited", &self.waited).finish_non_exhaustive()
    }
}

impl Silence {
    pub(crate) fn new(notice: Option<Notice>, patience: Duration) -> Self {
        let (waited, looked) = (Duration::ZERO, Instant::now());
        Self { notice, patience, peer: None, waited, looked, is_told: false }
    }

    /// From now on this is the peer, with its process.
    pub(crate) fn set_peer(&mut self, peer: Participant, pid: u32) {
        self.peer = Some((peer, pid));
    }

    /// A wait begins.
    pub(crate) fn begin(&mut self) {
        self.waited = Duration::ZERO;
        self.looked = Instant::now();
    }

    /// The wait goes on; returns how long it has lasted while this process was awake.
    pub(crate) fn grows(&mut self) -> Duration {
        let now = Instant::now();
        self.waited += now.duration_since(self.looked).min(LONGEST_LOOK);
        self.looked = now;
        if let Some((peer, pid)) = self.peer.filter(|_| !self.is_told && self.waited >= STOPPED_AFTER) {
            let is_stopped = is_stopped(pid);
            if is_stopped || self.waited >= SILENT_AFTER {
                let what = if is_stopped { "is stopped" } else { "lives but is silent" };
                let limit = self.patience.as_secs_f64();
                self.tell(&format!(
                    "the {peer} (process {pid}) {what}; waiting for it for {limit} s at most"
                ));
                self.is_told = true;
            }
        }
        self.waited
    }

    /// The peer has answered.
    pub(crate) fn end(&mut self) {
        if let (true, Some((peer, pid))) = (std::mem::take(&mut self.is_told), self.peer) {
            self.tell(&format!("the {peer} (process {pid}) goes on"));
        }
    }

    fn tell(&mut self, what: &str) {
        if let Some(notice) = &mut self.notice {
            notice(what);
        }
    }
}

/// Whether a process is stopped by a signal or by a debugger; unknown counts as no.
fn is_stopped(pid: u32) -> bool {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    // The state follows the name, which is in parentheses and may hold any of these.
    stat.rsplit(')').next().is_some_and(|rest| rest.trim_start().starts_with(['T', 't']))
}
