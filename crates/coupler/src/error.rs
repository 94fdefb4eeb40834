//! What can go wrong between two participants, each with its numbers and its remedy.

use std::path::PathBuf;
use std::time::Duration;

use crate::kinds::Participant;
use crate::kinds::{Fault, FrameKind};

/// Why two participants could not meet, or could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CouplerError {
    // --- before the first step ---
    /// The run's name cannot be part of a service name.
    #[error("the run id {run_id:?} is not usable: give 1 to 64 of the characters A-Z a-z 0-9 _ . -")]
    BadRunId {
        /// As given.
        run_id: String,
    },
    /// The directory of the run's management files cannot be used safely.
    #[error("the directory {path:?} {reason}; remove it, or choose another")]
    BadRoot {
        /// The directory.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The operating system or iceoryx2 refused a resource.
    #[error(
        "{what} failed: {cause}; see whether the other side was killed meanwhile, whether /dev/shm is full, and whether both sides are of the same build"
    )]
    SharedMemory {
        /// What was being done.
        what: &'static str,
        /// What iceoryx2 said.
        cause: String,
    },
    /// Shared memory cannot be used at all.
    #[error(
        "shared memory cannot be written to: /dev/shm: {cause}; mount it so that you may write there, or run both sides in \
         one process (--in-process)"
    )]
    NotWritable {
        /// What the system says.
        cause: String,
    },
    /// Shared memory is full, or too small.
    #[error(
        "shared memory is too small: /dev/shm has {} KiB free of {} KiB, about {} KiB are needed; enlarge it \
         (mount -o remount,size=1G /dev/shm; in a container --shm-size=1g), remove what others have left in it, or run \
         both sides in one process (--in-process)",
        free / 1024, total / 1024, needed / 1024
    )]
    NoRoom {
        /// Bytes that are needed.
        needed: u64,
        /// Bytes that are free.
        free: u64,
        /// Bytes there are.
        total: u64,
    },
    /// Somebody else already plays this part in this run.
    #[error("run {run_id:?} already has a {name} (process {pid}); end it, or choose another run id")]
    NameTaken {
        /// The part in question.
        name: Participant,
        /// The run.
        run_id: String,
        /// Who plays it.
        pid: u32,
    },
    /// The other participant never came.
    #[error(
        "no {peer} joined run {run_id:?} within {:.1} s; start it, with the same run id",
        waited.as_secs_f64()
    )]
    PeerAbsent {
        /// The part that is missing.
        peer: Participant,
        /// The run.
        run_id: String,
        /// For how long.
        waited: Duration,
    },

    // --- the frame is not the one that must come now ---
    /// The two sides were built with different frame layouts.
    #[error("frame format {theirs} received, {ours} expected; run both sides from the same build")]
    VersionMismatch {
        /// Of this build.
        ours: u32,
        /// Of the frame.
        theirs: u32,
    },
    /// The two sides read different cases.
    #[error(
        "the other side runs a different case ({}, here {}); start both from the same file, with the same --set",
        hex(theirs),
        hex(ours)
    )]
    CaseMismatch {
        /// Hash of this side's case.
        ours: [u8; 32],
        /// Hash in the frame.
        theirs: [u8; 32],
    },
    /// A frame is missing or came twice.
    #[error("frame number {found} received, {expected} expected; this is a fault of the program, report it")]
    SequenceMismatch {
        /// The next number.
        expected: u64,
        /// The number in the frame.
        found: u64,
    },
    /// Somebody other than the peer sent this.
    #[error("a frame of process {found} received, of {expected} expected; give each run its own id")]
    SenderMismatch {
        /// Who said hello.
        expected: u32,
        /// Who sent this.
        found: u32,
    },
    /// Header and payload disagree.
    #[error("a frame of {found} numbers says it has {fields} x {count}; run both sides from the same build")]
    LengthMismatch {
        /// Rows, by the header.
        fields: u64,
        /// Numbers per row, by the header.
        count: u64,
        /// Numbers in the payload.
        found: usize,
    },
    /// A kind this build does not know.
    #[error("frame of unknown kind {found}; run both sides from the same build")]
    UnknownKind {
        /// The number in the frame.
        found: u32,
    },
    /// Not this frame's turn.
    #[error("a {found} frame received, a {expected} frame expected; both sides must use the same scheme")]
    KindMismatch {
        /// Whose turn it is.
        expected: FrameKind,
        /// What came.
        found: FrameKind,
    },

    // --- what the frame says makes no sense ---
    /// A number that has to be one is none.
    #[error(
        "the {peer}'s {kind} frame has {value} for the {row} of face {face}; its solution has gone bad, or it keeps to \
         another protocol: see its log"
    )]
    NotFinite {
        /// Who sent it.
        peer: Participant,
        /// In which frame.
        kind: FrameKind,
        /// Which of its rows.
        row: &'static str,
        /// Where in the row.
        face: usize,
        /// NaN or an infinity.
        value: f64,
    },
    /// The faces of a trace do not make up the interface.
    #[error(
        "the faces of the {peer}'s trace do not make up the interface: {reason}; they begin where it begins, ascend, and \
         end where it ends"
    )]
    BadFaces {
        /// Who sent it.
        peer: Participant,
        /// What is wrong with them.
        reason: String,
    },
    /// The frame is about another step than the one that is due.
    #[error(
        "the {peer}'s {kind} frame has {what} {found:e} s, which has to be {expected}; both sides must run the same case in \
         the same steps"
    )]
    BadStep {
        /// Who sent it.
        peer: Participant,
        /// Which frame.
        kind: FrameKind,
        /// Which of its times.
        what: &'static str,
        /// As in the frame.
        found: f64,
        /// What it has to be.
        expected: String,
    },
    /// Waves that are said to come, and are none.
    #[error(
        "the {peer}'s {kind} frame says that waves come that take {time:e} s over a cell, up to {reach:e} m from where the interface begins: both \
         have to be finite and not negative"
    )]
    BadWave {
        /// Who sent it.
        peer: Participant,
        /// Which frame.
        kind: FrameKind,
        /// As in the frame, s.
        time: f64,
        /// As in the frame, m.
        reach: f64,
    },
    /// Something that the scheme does not have, or not now.
    #[error("the {peer}'s {kind} frame {what}; both sides must use the same scheme")]
    OutOfTurn {
        /// Who sent it.
        peer: Participant,
        /// Which frame.
        kind: FrameKind,
        /// What it should not.
        what: &'static str,
    },

    // --- the interface ---
    /// A trace on the interface is no state of its medium, or the two have no state in common.
    #[error(
        "the {side}'s trace at r = {radius:.6e} m, t = {time:.6e} s is no state: {values}; try a smaller time.cfl"
    )]
    NoState {
        /// Whose.
        side: Participant,
        /// On the face in question, m.
        radius: f64,
        /// When it was met, s.
        time: f64,
        /// The numbers.
        values: String,
    },

    // --- the peer ---
    /// The peer's process ended without a word.
    #[error("the {peer} (process {pid}) died at step {step}; its own output and log say why")]
    PeerLost {
        /// Who.
        peer: Participant,
        /// Its process.
        pid: u32,
        /// Step of the last frame that passed either way.
        step: u64,
    },
    /// The peer closed its end while a frame was still expected.
    #[error("the {peer} left the run after step {step} while it was still needed; see its log")]
    PeerClosed {
        /// Who.
        peer: Participant,
        /// Step of the last frame that passed either way.
        step: u64,
    },
    /// The peer says that it cannot go on.
    #[error("the {peer} gave up at step {step}: {fault}; see its log")]
    PeerFailed {
        /// Who.
        peer: Participant,
        /// The step it names.
        step: u64,
        /// Why.
        fault: Fault,
    },
    /// The peer lives, but does not answer.
    #[error(
        "the {peer} (process {pid}) lives but has sent nothing for {:.1} s after step {step}; is it stopped?",
        waited.as_secs_f64()
    )]
    PeerSilent {
        /// Who.
        peer: Participant,
        /// Its process.
        pid: u32,
        /// Step of the last frame that passed either way.
        step: u64,
        /// For how long.
        waited: Duration,
    },
    /// A frame could not be handed over.
    #[error(
        "the {peer} (process {pid}) has not taken the frame before that of step {step} for {:.1} s; is it stopped?",
        waited.as_secs_f64()
    )]
    Undelivered {
        /// Who.
        peer: Participant,
        /// Its process.
        pid: u32,
        /// Step of the frame in hand.
        step: u64,
        /// For how long.
        waited: Duration,
    },

    // --- within one process ---
    /// Waiting in one process for a frame that nobody can send.
    #[error("nothing from the {peer} to wait for after step {step}; let it step first")]
    NothingToWaitFor {
        /// Who should have sent.
        peer: Participant,
        /// Step of the last frame that passed either way.
        step: u64,
    },
    /// Two frames in a row without one being read.
    #[error("the {peer} has not read the frame before that of step {step}; let it step first")]
    MailboxFull {
        /// Who should have read.
        peer: Participant,
        /// Step of the frame in hand.
        step: u64,
    },

    /// The caller's own hook ended the wait.
    #[error("the wait was ended: {reason}")]
    Interrupted {
        /// As the hook says.
        reason: String,
    },
}

impl CouplerError {
    /// Whether the peer is there and does not know: what it sent was refused, or cannot be met.
    #[must_use]
    pub fn is_refusal(&self) -> bool {
        matches!(
            self,
            Self::SequenceMismatch { .. }
                | Self::LengthMismatch { .. }
                | Self::UnknownKind { .. }
                | Self::KindMismatch { .. }
                | Self::NotFinite { .. }
                | Self::BadFaces { .. }
                | Self::BadStep { .. }
                | Self::BadWave { .. }
                | Self::OutOfTurn { .. }
                | Self::NoState { .. }
        )
    }
}

/// The first digits of a hash, as people compare them.
fn hex(hash: &[u8; 32]) -> String {
    hash[..6].iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_names_the_cause_its_numbers_and_the_remedy() {
        let lost = CouplerError::PeerLost { peer: Participant::Solid, pid: 4711, step: 12 };
        assert_eq!(
            lost.to_string(),
            "the solid (process 4711) died at step 12; its own output and log say why"
        );
        let mismatch = CouplerError::CaseMismatch { ours: [0xab; 32], theirs: [1; 32] };
        assert!(mismatch.to_string().contains("010101010101, here abababababab"));
    }
}
