//! Whether the peer's process is alive.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use iceoryx2::config::Config;
use iceoryx2::identifiers::UniqueNodeId;
use iceoryx2::port::{BackpressureAction, BackpressureInfo};
use iceoryx2::prelude::{Node, NodeState};

use crate::domain::Ipc;
use crate::notice::Notice;
use crate::silence::Silence;

/// How often a blocked participant looks after its peer. One look takes well under a millisecond.
pub(crate) const SLICE: Duration = Duration::from_millis(100);
/// How long a participant that leaves waits for its last frame to be read.
pub(crate) const LINGER: Duration = Duration::from_secs(10);

/// Watches one peer; shared with the handler that is asked while a send is blocked.
#[derive(Debug)]
pub(crate) struct PeerWatch {
    config: Config,
    patience: Duration,
    peer: OnceLock<UniqueNodeId>,
    leaving: AtomicBool,
    looked_ms: AtomicU64,
    silence: Mutex<Silence>,
}

impl PeerWatch {
    pub(crate) fn new(config: Config, patience: Duration, notice: Option<Notice>) -> Self {
        Self {
            config,
            patience,
            peer: OnceLock::new(),
            leaving: AtomicBool::new(false),
            looked_ms: AtomicU64::new(0),
            silence: Mutex::new(Silence::new(notice, patience)),
        }
    }

    /// The wait for the peer.
    pub(crate) fn silence(&self) -> MutexGuard<'_, Silence> {
        // A notice that panicked leaves plain numbers behind.
        self.silence.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// From now on this is the peer.
    pub(crate) fn set_peer(&self, node: UniqueNodeId) {
        // A second call cannot happen: connecting ends with the first.
        let _ = self.peer.set(node);
    }

    /// Sends shall not block for longer than the linger time any more.
    pub(crate) fn leave(&self) {
        self.leaving.store(true, Ordering::Relaxed);
    }

    pub(crate) fn is_peer_alive(&self) -> bool {
        self.peer.get().is_some_and(|node| is_alive(&self.config, *node))
    }

    /// What a send does while the peer has not taken the frame before.
    pub(crate) fn while_blocked(&self, info: &BackpressureInfo) -> BackpressureAction {
        let limit =
            if self.leaving.load(Ordering::Relaxed) { self.patience.min(LINGER) } else { self.patience };
        let now = info.elapsed_time.as_millis() as u64;
        let last = self.looked_ms.load(Ordering::Relaxed);
        // `last` may stem from an earlier, longer send.
        if now < last || now - last >= SLICE.as_millis() as u64 {
            self.looked_ms.store(now, Ordering::Relaxed);
            if self.silence().grows() >= limit || !self.is_peer_alive() {
                return BackpressureAction::DiscardDataAndFail;
            }
        }
        BackpressureAction::Retry
    }
}

/// Whether this node's process lives. Unsure counts as alive: patience ends that wait.
pub(crate) fn is_alive(config: &Config, node: UniqueNodeId) -> bool {
    match Node::<Ipc>::state_of(config, node) {
        Ok(Some(NodeState::Dead(_)) | None) => false,
        Ok(Some(NodeState::Alive(_) | NodeState::Inaccessible(_) | NodeState::Undefined(_))) | Err(_) => true,
    }
}
