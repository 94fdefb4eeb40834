//! The link within one process: two mailboxes, no threads, no shared memory.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::error::CouplerError;
use crate::frame::{Frame, FrameHeader};
use crate::kinds::Participant;
use crate::link::{Conversation, Link, LinkCounters, now_ns};

/// One direction: the buffer is kept, so frames of known length allocate nothing.
#[derive(Debug, Default)]
struct Mailbox {
    header: FrameHeader,
    payload: Vec<f64>,
    full: bool,
    /// The writing end is gone.
    closed: bool,
}

/// One end of a link between two solvers in the same process.
#[derive(Debug)]
pub struct DirectLink {
    outbox: Arc<Mutex<Mailbox>>,
    inbox: Arc<Mutex<Mailbox>>,
    talk: Conversation,
}

/// The fluid's and the solid's end of a new link.
pub fn direct_pair(case_hash: [u8; 32]) -> (DirectLink, DirectLink) {
    let to_solid = Arc::new(Mutex::new(Mailbox::default()));
    let to_fluid = Arc::new(Mutex::new(Mailbox::default()));
    let fluid = DirectLink {
        outbox: Arc::clone(&to_solid),
        inbox: Arc::clone(&to_fluid),
        talk: Conversation::new(Participant::Solid, case_hash),
    };
    let solid = DirectLink {
        outbox: to_fluid,
        inbox: to_solid,
        talk: Conversation::new(Participant::Fluid, case_hash),
    };
    (fluid, solid)
}

/// A panic in a peer's `fill` or `read` leaves plain numbers behind, so the box stays usable.
fn open(mailbox: &Mutex<Mailbox>) -> MutexGuard<'_, Mailbox> {
    mailbox.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Link for DirectLink {
    fn send(&mut self, header: FrameHeader, fill: impl FnOnce(&mut [f64])) -> Result<(), CouplerError> {
        let (mut header, len) = self.talk.stamp(header)?;
        let mut outbox = open(&self.outbox);
        if outbox.full {
            return Err(CouplerError::MailboxFull { peer: self.talk.peer, step: header.step });
        }
        outbox.payload.clear();
        outbox.payload.resize(len, 0.0);
        fill(&mut outbox.payload);
        header.ready_ns = now_ns();
        outbox.header = header;
        outbox.full = true;
        self.talk.sent(&header, len);
        Ok(())
    }

    fn try_receive<R>(&mut self, read: impl FnOnce(&Frame<'_>) -> R) -> Result<Option<R>, CouplerError> {
        let mut inbox = open(&self.inbox);
        if !inbox.full {
            self.talk.asked_in_vain();
            return Ok(None);
        }
        inbox.full = false;
        let frame = Frame { header: &inbox.header, payload: &inbox.payload, sender: self.talk.peer };
        self.talk.accept(&frame)?;
        Ok(Some(read(&frame)))
    }

    fn wait(&mut self) -> Result<(), CouplerError> {
        let inbox = open(&self.inbox);
        if inbox.full {
            Ok(())
        } else if inbox.closed {
            Err(CouplerError::PeerClosed { peer: self.talk.peer, step: self.talk.step })
        } else {
            Err(CouplerError::NothingToWaitFor { peer: self.talk.peer, step: self.talk.step })
        }
    }

    fn counters(&self) -> LinkCounters {
        self.talk.counters.clone()
    }
}

impl Drop for DirectLink {
    fn drop(&mut self) {
        open(&self.outbox).closed = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinds::{Fault, FrameKind};

    fn trace(step: u64, count: u64) -> FrameHeader {
        FrameHeader { step, count, fields: 2, ..FrameHeader::new(FrameKind::Trace) }
    }

    #[test]
    fn frames_of_changing_length_arrive_as_written_and_nan_passes() {
        let (mut fluid, mut solid) = direct_pair([1; 32]);
        for step in 0..50 {
            let count = 1 + step % 7;
            fluid
                .send(trace(step, count), |payload| {
                    payload.fill(step as f64);
                    payload[0] = f64::NAN;
                })
                .unwrap();
            solid
                .receive(|frame| {
                    assert_eq!((frame.header.step, frame.payload.len()), (step, 2 * count as usize));
                    assert!(frame.row(0)[0].is_nan());
                    assert!(frame.row(1).iter().all(|value| *value == step as f64));
                })
                .unwrap();
        }
        assert_eq!(fluid.counters().sent, 50);
        assert_eq!(solid.counters().received, 50);
        assert_eq!(fluid.counters().bytes, solid.counters().bytes);
    }

    #[test]
    fn the_payload_starts_at_zero_even_after_a_longer_frame() {
        let (mut fluid, mut solid) = direct_pair([1; 32]);
        fluid.send(trace(0, 9), |payload| payload.fill(3.0)).unwrap();
        solid.receive(|_| ()).unwrap();
        fluid.send(trace(1, 4), |payload| assert_eq!(payload, [0.0; 8])).unwrap();
    }

    #[test]
    fn waiting_for_nobody_and_sending_twice_are_errors() {
        let (mut fluid, mut solid) = direct_pair([1; 32]);
        assert_eq!(solid.wait(), Err(CouplerError::NothingToWaitFor { peer: Participant::Fluid, step: 0 }));
        fluid.send(trace(4, 1), |_| ()).unwrap();
        assert_eq!(
            fluid.send(trace(5, 1), |_| ()),
            Err(CouplerError::MailboxFull { peer: Participant::Solid, step: 5 })
        );
        drop(fluid);
        assert_eq!(solid.receive(|frame| frame.header.step), Ok(4), "what was sent is still read");
        assert_eq!(solid.wait(), Err(CouplerError::PeerClosed { peer: Participant::Fluid, step: 4 }));
    }

    #[test]
    fn replayed_and_wrong_length_frames_are_refused() {
        let (mut fluid, mut solid) = direct_pair([1; 32]);
        fluid.send(trace(0, 1), |_| ()).unwrap();
        solid.receive(|_| ()).unwrap();
        open(&solid.inbox).full = true;
        assert_eq!(solid.try_receive(|_| ()), Err(CouplerError::SequenceMismatch { expected: 2, found: 1 }));
        fluid.send(trace(1, 3), |_| ()).unwrap();
        open(&solid.inbox).payload.pop();
        assert_eq!(
            solid.try_receive(|_| ()),
            Err(CouplerError::LengthMismatch { fields: 2, count: 3, found: 5 })
        );
    }

    #[test]
    fn a_fault_reaches_the_peer_with_its_reason() {
        let (mut fluid, mut solid) = direct_pair([1; 32]);
        fluid.send_fault(Fault::Numerical, 17).unwrap();
        assert_eq!(
            solid.receive(|_| ()),
            Err(CouplerError::PeerFailed { peer: Participant::Fluid, step: 17, fault: Fault::Numerical })
        );
    }

    #[test]
    fn both_ends_can_move_to_another_thread() {
        fn movable<T: Send>(_: &T) {}
        let (fluid, _solid) = direct_pair([1; 32]);
        movable(&fluid);
    }
}
