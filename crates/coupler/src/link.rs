//! What a solver sees of its peer: send, receive, wait.

use std::time::{Duration, SystemTime};

use serde::{Deserialize, Serialize};

use crate::error::CouplerError;
use crate::frame::{Expected, Frame, FrameHeader};
use crate::kinds::{Fault, FrameKind, Participant};
use crate::latency::Latencies;

/// What a link has done so far. Greetings and goodbyes count, too.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LinkCounters {
    /// Frames sent.
    pub sent: u64,
    /// Frames received.
    pub received: u64,
    /// Payload and headers, both ways.
    pub bytes: u64,
    /// Time spent blocked in [`Link::wait`].
    pub waited: Duration,
    /// What the exchange itself cost: from the moment when a frame was complete and its reader asked for it, to
    /// the moment when the reader had it.
    pub exchanging: Duration,
    /// The same frame by frame.
    pub latencies: Latencies,
}

impl LinkCounters {
    /// What was done here and in `other`.
    #[must_use]
    pub fn plus(self, other: &Self) -> Self {
        Self {
            sent: self.sent + other.sent,
            received: self.received + other.received,
            bytes: self.bytes + other.bytes,
            waited: self.waited + other.waited,
            exchanging: self.exchanging + other.exchanging,
            latencies: self.latencies.plus(&other.latencies),
        }
    }

    /// What was done since these counters stood at `earlier`.
    #[must_use]
    pub fn since(self, earlier: &Self) -> Self {
        Self {
            sent: self.sent - earlier.sent,
            received: self.received - earlier.received,
            bytes: self.bytes - earlier.bytes,
            waited: self.waited.saturating_sub(earlier.waited),
            exchanging: self.exchanging.saturating_sub(earlier.exchanging),
            latencies: self.latencies.since(&earlier.latencies),
        }
    }
}

/// One end of the way between two participants.
///
/// Frames alternate or nearly so: one frame each way can be under way, a second one waits until the first was read.
pub trait Link {
    /// Writes a frame in place and hands it over.
    ///
    /// - `header`: kind, step, times and the shape `fields` x `count`, which may differ in every frame. Version,
    ///   case hash, pid and sequence are stamped by the link.
    /// - `fill`: gets the payload, `fields` rows of `count` numbers, all zero, where the peer will read it.
    /// - errors: the peer is dead or does not take the frame before.
    fn send(&mut self, header: FrameHeader, fill: impl FnOnce(&mut [f64])) -> Result<(), CouplerError>;

    /// Reads the next frame in place, if there is one.
    ///
    /// - `read`: gets a frame whose header was checked; its return value is handed on.
    /// - returns: `None` if nothing has arrived.
    /// - errors: a frame that must not come now; the peer's fault; the peer left.
    fn try_receive<R>(&mut self, read: impl FnOnce(&Frame<'_>) -> R) -> Result<Option<R>, CouplerError>;

    /// Blocks without using the processor until a frame has arrived.
    ///
    /// - errors: the peer died, left, or was silent for too long; the caller's hook ended the wait.
    fn wait(&mut self) -> Result<(), CouplerError>;

    /// What was done so far.
    fn counters(&self) -> LinkCounters;

    /// Waits for the next frame and reads it.
    fn receive<R>(&mut self, read: impl FnOnce(&Frame<'_>) -> R) -> Result<R, CouplerError> {
        let mut read = Some(read);
        loop {
            let mut once = |frame: &Frame<'_>| read.take().map(|read| read(frame));
            if let Some(Some(value)) = self.try_receive(&mut once)? {
                return Ok(value);
            }
            self.wait()?;
        }
    }

    /// Tells the peer that this side cannot go on, so that it need not wait.
    fn send_fault(&mut self, fault: Fault, step: u64) -> Result<(), CouplerError> {
        self.send(FrameHeader::fault(fault, step), |_| {})
    }
}

/// The part of a link that does not depend on how bytes travel: stamps, checks, counts.
#[derive(Debug)]
pub(crate) struct Conversation {
    pub(crate) peer: Participant,
    pub(crate) peer_pid: Option<u32>,
    pub(crate) case_hash: [u8; 32],
    /// Step of the last frame that passed either way.
    pub(crate) step: u64,
    pub(crate) counters: LinkCounters,
    /// Since when the next frame is asked for in vain, nanoseconds since the epoch.
    asking_since: Option<u64>,
}

/// Nanoseconds since the epoch, the one clock that two processes share.
pub(crate) fn now_ns() -> u64 {
    let since = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    u64::try_from(since.as_nanos()).unwrap_or(u64::MAX)
}

impl Conversation {
    pub(crate) fn new(peer: Participant, case_hash: [u8; 32]) -> Self {
        Self {
            peer,
            peer_pid: None,
            case_hash,
            step: 0,
            counters: LinkCounters::default(),
            asking_since: None,
        }
    }

    /// The header as it goes out, and the payload's length.
    pub(crate) fn stamp(&self, header: FrameHeader) -> Result<(FrameHeader, usize), CouplerError> {
        let len = header.len().ok_or(CouplerError::LengthMismatch {
            fields: header.fields,
            count: header.count,
            found: 0,
        })?;
        let stamped = FrameHeader {
            case_hash: self.case_hash,
            pid: std::process::id(),
            sequence: self.counters.sent + 1,
            ..header
        };
        Ok((stamped, len))
    }

    /// Counts a frame that was handed over.
    pub(crate) fn sent(&mut self, header: &FrameHeader, len: usize) {
        self.counters.sent += 1;
        self.counters.bytes += frame_bytes(len);
        self.note_step(header);
    }

    /// Takes notice that a frame was asked for and none was there.
    pub(crate) fn asked_in_vain(&mut self) {
        self.asking_since.get_or_insert_with(now_ns);
    }

    /// Checks an arrived frame and counts it; faults and goodbyes become errors.
    pub(crate) fn accept(&mut self, frame: &Frame<'_>) -> Result<(), CouplerError> {
        let kind = frame.check(&Expected {
            case_hash: self.case_hash,
            sequence: self.counters.received + 1,
            pid: self.peer_pid,
        })?;
        self.peer_pid = Some(frame.header.pid);
        self.counters.received += 1;
        let now = now_ns();
        let both_there = self.asking_since.take().unwrap_or(now).max(frame.header.ready_ns);
        let latency = Duration::from_nanos(now.saturating_sub(both_there));
        self.counters.exchanging += latency;
        self.counters.latencies.add(latency);
        self.counters.bytes += frame_bytes(frame.payload.len());
        match kind {
            FrameKind::Fault => Err(CouplerError::PeerFailed {
                peer: self.peer,
                step: frame.header.step,
                fault: Fault::from_code(frame.header.code),
            }),
            FrameKind::Goodbye => Err(CouplerError::PeerClosed { peer: self.peer, step: self.step }),
            FrameKind::Hello | FrameKind::Trace | FrameKind::Register | FrameKind::Yours => {
                self.note_step(frame.header);
                Ok(())
            }
        }
    }

    fn note_step(&mut self, header: &FrameHeader) {
        if header.kind == FrameKind::Trace as u32 || header.kind == FrameKind::Register as u32 {
            self.step = header.step;
        }
    }
}

fn frame_bytes(len: usize) -> u64 {
    (size_of::<FrameHeader>() + len * size_of::<f64>()) as u64
}
