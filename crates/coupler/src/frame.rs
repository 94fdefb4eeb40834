//! The message that crosses the interface: a header and rows of numbers.

use iceoryx2::prelude::ZeroCopySend;
use serde::{Deserialize, Serialize};

use crate::error::CouplerError;
use crate::kinds::{Fault, FrameKind, Participant};

/// Layout and meaning of [`FrameHeader`]; a change of either counts it up.
pub const FRAME_VERSION: u32 = 6;

impl TryFrom<u32> for FrameKind {
    type Error = CouplerError;

    fn try_from(value: u32) -> Result<Self, CouplerError> {
        [Self::Hello, Self::Trace, Self::Register, Self::Fault, Self::Goodbye, Self::Yours]
            .into_iter()
            .find(|kind| *kind as u32 == value)
            .ok_or(CouplerError::UnknownKind { found: value })
    }
}

/// Who sends what, of which step. Lives in shared memory beside the payload.
///
/// The caller sets what the frame is about; the link stamps `version`, `case_hash`, `pid` and `sequence`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, ZeroCopySend, Serialize, Deserialize)]
#[type_name("cav_frame_header")]
pub struct FrameHeader {
    /// [`FRAME_VERSION`] of the sender.
    pub version: u32,
    /// A [`FrameKind`].
    pub kind: u32,
    /// Hash of the sender's case.
    pub case_hash: [u8; 32],
    /// The sender's process.
    pub pid: u32,
    /// Any of [`STOP_INTERRUPT`](Self::STOP_INTERRUPT), [`STOP_TERMINATE`](Self::STOP_TERMINATE), [`LAST`](Self::LAST),
    /// [`SNAPSHOT`](Self::SNAPSHOT), [`CHECKPOINT`](Self::CHECKPOINT).
    pub flags: u32,
    /// Counts the sender's frames, from 1.
    pub sequence: u64,
    /// Number of the step the frame belongs to.
    pub step: u64,
    /// Time at the start of that step, s; an answer repeats it.
    pub time: f64,
    /// Length of that step, s; an answer repeats it.
    pub dt: f64,
    /// The sender's largest admissible next step, s; infinite if it has no limit.
    pub dt_max: f64,
    /// Numbers per row: interface faces.
    pub count: u64,
    /// Rows: fields per face.
    pub fields: u64,
    /// Of a fault frame: the [`Fault`]. Else 0.
    pub code: u64,
    /// When the payload was complete, nanoseconds since the epoch; stamped by the link.
    pub ready_ns: u64,
    /// Cells of the sender's grid, for what is shown while it runs.
    pub cells: u64,
    /// Of waves of the sender that are about to come through the interface: how long they take over a cell that carries them, s, and how far from
    /// where the interface begins there are any that need one so short, m. Zeros: no more of them, or the sender does not know.
    pub coming: [[f64; 2]; 4],
}

impl FrameHeader {
    /// The sender was interrupted (SIGINT): both sides write what they have and end.
    pub const STOP_INTERRUPT: u32 = 1;
    /// The sender was terminated (SIGTERM): likewise.
    pub const STOP_TERMINATE: u32 = 2;
    /// No frame of this sender follows.
    pub const LAST: u32 = 4;
    /// Both sides write a snapshot at the end of this step.
    pub const SNAPSHOT: u32 = 8;
    /// Strong scheme: the values are an iterate's; the step is to be tried, not yet made.
    pub const TRIAL: u32 = 16;
    /// Strong scheme: the last iterate counts; there is no payload.
    pub const SETTLED: u32 = 32;
    /// The sender makes its steps within the receiver's, whatever its `dt_max` says.
    pub const FOLLOWS: u32 = 64;
    /// The sender has kept a checkpoint of its state before the step `step`; the receiver does likewise, before anything else.
    pub const CHECKPOINT: u32 = 128;
    /// Set by the link: longer than all before, so its memory is new and the sender wants to know that it was read.
    pub(crate) const GROWN: u32 = 1 << 31;

    /// An empty frame of this kind, to be completed by struct update.
    pub fn new(kind: FrameKind) -> Self {
        Self { version: FRAME_VERSION, kind: kind as u32, ..Self::default() }
    }

    /// A fault frame.
    pub fn fault(fault: Fault, step: u64) -> Self {
        Self { code: fault as u64, step, ..Self::new(FrameKind::Fault) }
    }

    /// Whether this flag is set.
    pub fn has(&self, flag: u32) -> bool {
        self.flags & flag != 0
    }

    /// Numbers in the payload by the header; `None` if that does not fit into memory.
    pub fn len(&self) -> Option<usize> {
        self.fields.checked_mul(self.count).and_then(|len| usize::try_from(len).ok())
    }

    /// Whether there is no payload.
    pub fn is_empty(&self) -> bool {
        self.len() == Some(0)
    }
}

/// What the receiver knows of the next frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expected {
    /// Of this side's case.
    pub case_hash: [u8; 32],
    /// Number of the last frame, plus one.
    pub sequence: u64,
    /// The peer's process, once known.
    pub pid: Option<u32>,
}

/// A received frame, read where it lies.
#[derive(Debug, Clone, Copy)]
pub struct Frame<'a> {
    /// Who sends what.
    pub header: &'a FrameHeader,
    /// `[fields][count]`.
    pub payload: &'a [f64],
    /// Whose it is.
    pub sender: Participant,
}

impl<'a> Frame<'a> {
    /// Whether this is the frame that must come now, and in itself consistent. What it says is looked at by those who know
    /// what was agreed, see [`Frame::require_step`], [`Frame::trace`] and [`Frame::register`].
    ///
    /// - returns: the frame's kind.
    /// - errors: the first of version, case, kind, sequence, sender, length that does not fit.
    pub fn check(&self, expected: &Expected) -> Result<FrameKind, CouplerError> {
        let header = self.header;
        if header.version != FRAME_VERSION {
            return Err(CouplerError::VersionMismatch { ours: FRAME_VERSION, theirs: header.version });
        }
        if header.case_hash != expected.case_hash {
            return Err(CouplerError::CaseMismatch { ours: expected.case_hash, theirs: header.case_hash });
        }
        let kind = FrameKind::try_from(header.kind)?;
        if header.sequence != expected.sequence {
            return Err(CouplerError::SequenceMismatch {
                expected: expected.sequence,
                found: header.sequence,
            });
        }
        if let Some(pid) = expected.pid
            && header.pid != pid
        {
            return Err(CouplerError::SenderMismatch { expected: pid, found: header.pid });
        }
        if header.len() != Some(self.payload.len()) {
            return Err(CouplerError::LengthMismatch {
                fields: header.fields,
                count: header.count,
                found: self.payload.len(),
            });
        }
        Ok(kind)
    }

    /// An error unless the frame is of this kind.
    pub fn require(&self, expected: FrameKind) -> Result<(), CouplerError> {
        let found = FrameKind::try_from(self.header.kind)?;
        if found == expected { Ok(()) } else { Err(CouplerError::KindMismatch { expected, found }) }
    }

    /// An error unless the frame has this many rows of this many faces.
    pub fn require_shape(&self, fields: usize, count: usize) -> Result<(), CouplerError> {
        if self.header.fields == fields as u64 && self.header.count == count as u64 {
            return Ok(());
        }
        let found = self.payload.len();
        Err(CouplerError::LengthMismatch { fields: fields as u64, count: count as u64, found })
    }

    /// Field `k` of all faces, length `count`.
    ///
    /// # Panics
    /// If the frame has no such row.
    pub fn row(&self, k: usize) -> &'a [f64] {
        let count = self.header.count as usize;
        &self.payload[k * count..(k + 1) * count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HASH: [u8; 32] = [7; 32];

    fn good() -> (FrameHeader, Vec<f64>, Expected) {
        let header = FrameHeader {
            case_hash: HASH,
            pid: 42,
            sequence: 9,
            count: 3,
            fields: 2,
            ..FrameHeader::new(FrameKind::Trace)
        };
        (
            header,
            vec![1.0, 2.0, 3.0, f64::NAN, 5.0, 6.0],
            Expected { case_hash: HASH, sequence: 9, pid: Some(42) },
        )
    }

    fn refused(change: impl FnOnce(&mut FrameHeader)) -> CouplerError {
        let (mut header, payload, expected) = good();
        change(&mut header);
        Frame { header: &header, payload: &payload, sender: Participant::Fluid }
            .check(&expected)
            .expect_err("must be refused")
    }

    #[test]
    fn the_right_frame_passes_whatever_its_values() {
        let (header, payload, expected) = good();
        let frame = Frame { header: &header, payload: &payload, sender: Participant::Fluid };
        assert_eq!(frame.check(&expected), Ok(FrameKind::Trace));
        assert_eq!(frame.row(0), [1.0, 2.0, 3.0]);
        assert_eq!(frame.row(1)[1..], [5.0, 6.0]);
    }

    #[test]
    fn each_wrong_entry_is_refused_by_its_own_error() {
        assert_eq!(
            refused(|h| h.version = 1),
            CouplerError::VersionMismatch { ours: FRAME_VERSION, theirs: 1 }
        );
        assert_eq!(
            refused(|h| h.case_hash[31] = 8),
            CouplerError::CaseMismatch { ours: HASH, theirs: std::array::from_fn(|i| 7 + u8::from(i == 31)) }
        );
        assert_eq!(refused(|h| h.kind = 77), CouplerError::UnknownKind { found: 77 });
        assert_eq!(refused(|h| h.sequence = 8), CouplerError::SequenceMismatch { expected: 9, found: 8 });
        assert_eq!(refused(|h| h.pid = 43), CouplerError::SenderMismatch { expected: 42, found: 43 });
        assert_eq!(refused(|h| h.count = 4), CouplerError::LengthMismatch { fields: 2, count: 4, found: 6 });
    }

    #[test]
    fn a_length_beyond_memory_is_refused_not_wrapped() {
        let error = refused(|h| (h.count, h.fields) = (1 << 63, 2));
        assert_eq!(error, CouplerError::LengthMismatch { fields: 2, count: 1 << 63, found: 6 });
    }

    #[test]
    fn another_kind_than_the_required_is_refused() {
        let (header, payload, _) = good();
        let frame = Frame { header: &header, payload: &payload, sender: Participant::Fluid };
        assert_eq!(frame.require(FrameKind::Trace), Ok(()));
        assert_eq!(
            frame.require(FrameKind::Register),
            Err(CouplerError::KindMismatch { expected: FrameKind::Register, found: FrameKind::Trace })
        );
    }
}
