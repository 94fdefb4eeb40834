//! The link between two processes: iceoryx2, frames written and read where they lie in shared memory.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use iceoryx2::config::Config;
use iceoryx2::port::SendError;

use crate::domain::{Domain, Presence, require_room};
use crate::error::CouplerError;
use crate::frame::{Frame, FrameHeader};
use crate::kinds::FrameKind;
use crate::kinds::Participant;
use crate::link::{Conversation, Link, LinkCounters, now_ns};
use crate::making::Making;
use crate::notice::Notice;
use crate::ports::{Ports, failed, pid_of};
use crate::watch::{LINGER, PeerWatch, SLICE};

/// What a participant's services take besides its frames, bytes.
const ROOM_TO_BEGIN: u64 = 1 << 20;

/// What frames of `len` numbers take at most, bytes: a few of them are there at once, and memory grows by doubling.
fn room_for(len: usize) -> u64 {
    8 * size_of::<f64>() as u64 * len as u64
}

/// Asked about ten times a second while a participant waits; its error ends the wait.
pub type Interrupt = Box<dyn FnMut() -> Result<(), CouplerError> + Send>;

/// Which run to join, as whom.
pub struct Endpoint {
    /// The same on both sides, different for each run on the machine: 1 to 64 of `A-Z a-z 0-9 _ . -`.
    pub run_id: String,
    /// Who this is.
    pub name: Participant,
    /// Hash of the effective case; both sides must have the same.
    pub case_hash: [u8; 32],
    /// Numbers in the largest frame to be expected. Only a hint: more memory is taken as frames grow.
    pub initial_len: usize,
    /// How long to wait for the peer to come.
    pub connect_timeout: Duration,
    /// How long to wait for a peer that lives but does not answer.
    pub patience: Duration,
    /// Ends waits early, e.g. when the launcher is gone.
    pub interrupt: Option<Interrupt>,
    /// Told when the peer is silent for long, and when it goes on.
    pub notice: Option<Notice>,
    /// Where shared objects live; the default unless runs must not see each other at all.
    pub domain: Domain,
}

impl Endpoint {
    /// With 10 s to connect and ten minutes of patience.
    pub fn new(run_id: impl Into<String>, name: Participant, case_hash: [u8; 32]) -> Self {
        Self {
            run_id: run_id.into(),
            name,
            case_hash,
            initial_len: 4096,
            connect_timeout: Duration::from_secs(10),
            patience: Duration::from_secs(600),
            interrupt: None,
            notice: None,
            domain: Domain::default(),
        }
    }
}

/// One end of a link between two processes (or threads).
///
/// Dropping it says goodbye. That may block until the peer has read the last frame, for ten seconds at most, and not if
/// the peer is dead.
pub struct ProcessLink {
    ports: Ports,
    domain: Domain,
    config: Config,
    watch: Arc<PeerWatch>,
    talk: Conversation,
    peer_pid: u32,
    patience: Duration,
    interrupt: Option<Interrupt>,
    /// Length of the longest frame sent.
    longest: Option<usize>,
    /// Frames in new memory that the peer has not confirmed.
    unread: u64,
    /// The peer died or left: nothing more to say to it.
    parted: bool,
    /// Last, so that it is given up after the ports.
    _presence: Presence,
}

impl std::fmt::Debug for ProcessLink {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ProcessLink").field("talk", &self.talk).finish_non_exhaustive()
    }
}

impl ProcessLink {
    /// Clears away what dead runs left, joins the run, waits for the peer, and compares version and case with it.
    ///
    /// - errors: unusable names or directories, the name is taken, no peer in time, a peer with another case (both
    ///   sides learn it at once).
    pub fn connect(endpoint: Endpoint) -> Result<Self, CouplerError> {
        Self::connect_saying(endpoint, FrameHeader::new(FrameKind::Hello))
    }

    fn connect_saying(endpoint: Endpoint, hello: FrameHeader) -> Result<Self, CouplerError> {
        let Endpoint {
            run_id,
            name,
            case_hash,
            initial_len,
            connect_timeout,
            patience,
            mut interrupt,
            notice,
            domain,
        } = endpoint;
        check_run_id(&run_id)?;
        let config = domain.config()?;
        let presence = Presence::enter(&domain)?;
        let making = Making::begin(&domain, &config)?;
        require_room(ROOM_TO_BEGIN + room_for(initial_len))?;
        let watch = Arc::new(PeerWatch::new(config.clone(), patience, notice));
        let ports = Ports::open(&config, &run_id, name, initial_len, &watch)?;
        drop(making);

        let start = Instant::now();
        let mut looked = start;
        let peer = loop {
            if let Some(peer) = ports.connected_peer(&config) {
                break peer;
            }
            if start.elapsed() >= connect_timeout {
                return Err(CouplerError::PeerAbsent { peer: name.peer(), run_id, waited: start.elapsed() });
            }
            if looked.elapsed() >= SLICE {
                looked = Instant::now();
                ask(&mut interrupt)?;
                // A peer that was killed while connecting holds its place until it is cleared away.
                Making::try_begin(&domain, &config)?;
            }
            thread::sleep(Duration::from_millis(5));
        };
        watch.set_peer(peer);
        let peer_pid = pid_of(peer);
        watch.silence().set_peer(name.peer(), peer_pid);
        tracing::debug!(peer = %name.peer(), peer_pid, run_id, waited = ?start.elapsed(), "connected");

        let mut talk = Conversation::new(name.peer(), case_hash);
        talk.peer_pid = Some(peer_pid);
        let mut link = Self {
            ports,
            domain,
            config,
            watch,
            talk,
            peer_pid,
            patience,
            interrupt,
            longest: None,
            unread: 0,
            parted: false,
            _presence: presence,
        };
        // Before the hello: whoever hears it may rely on this side taking part in full.
        link.ports.attach()?;
        link.send(hello, |_| {})?;
        link.receive(|frame| frame.require(FrameKind::Hello))??;
        Ok(link)
    }

    /// The peer's process.
    pub fn peer_pid(&self) -> u32 {
        self.peer_pid
    }

    /// The peer is no more: passes on its last word if there is one, else clears away what it left and says so.
    fn lost(&mut self) -> CouplerError {
        self.parted = true;
        while let Ok(Some(sample)) = self.ports.subscriber.receive() {
            let frame =
                Frame { header: sample.user_header(), payload: sample.payload(), sender: self.talk.peer };
            if let Err(word @ (CouplerError::PeerClosed { .. } | CouplerError::PeerFailed { .. })) =
                self.talk.accept(&frame)
            {
                return word;
            }
        }
        if let Err(error) = Making::begin(&self.domain, &self.config) {
            tracing::warn!(%error, "what the dead peer left in shared memory stays until the next run");
        }
        CouplerError::PeerLost { peer: self.talk.peer, pid: self.peer_pid, step: self.talk.step }
    }

    fn has_frame(&self) -> Result<bool, CouplerError> {
        self.ports.subscriber.has_samples().map_err(failed("looking for a frame"))
    }

    fn block(&mut self) -> Result<(), CouplerError> {
        self.watch.silence().begin();
        loop {
            if self.has_frame()? {
                self.watch.silence().end();
                return Ok(());
            }
            let is_quiet = self.sleep();
            let waited = self.watch.silence().grows();
            if !is_quiet {
                continue;
            }
            ask(&mut self.interrupt)?;
            if !self.watch.is_peer_alive() {
                // Its last frame may have come since the look above.
                return if self.has_frame()? { Ok(()) } else { Err(self.lost()) };
            }
            if waited >= self.patience {
                return Err(CouplerError::PeerSilent {
                    peer: self.talk.peer,
                    pid: self.peer_pid,
                    step: self.talk.step,
                    waited,
                });
            }
        }
    }

    /// Sleeps until something happens, a slice at most; `true` if it is time to look after the peer.
    fn sleep(&mut self) -> bool {
        let wake = self.ports.wait(SLICE);
        self.unread = self.unread.saturating_sub(wake.read);
        wake.look_around
    }

    /// Takes what nobody here will read any more, so that the peer need not wait for that.
    fn discard_frames(&self) {
        while let Ok(Some(sample)) = self.ports.subscriber.receive() {
            if sample.user_header().has(FrameHeader::GROWN) {
                self.ports.confirm_read();
            }
        }
    }

    fn undelivered(&mut self, step: u64, start: Instant, cause: SendError) -> CouplerError {
        if !self.watch.is_peer_alive() {
            return self.lost();
        }
        match cause {
            SendError::UnableToDeliver => CouplerError::Undelivered {
                peer: self.talk.peer,
                pid: self.peer_pid,
                step,
                waited: start.elapsed(),
            },
            other => failed("sending a frame")(other),
        }
    }
}

impl Link for ProcessLink {
    fn send(&mut self, header: FrameHeader, fill: impl FnOnce(&mut [f64])) -> Result<(), CouplerError> {
        let (mut header, len) = self.talk.stamp(header)?;
        let grown = self.longest.is_none_or(|longest| len > longest);
        header.flags |= if grown { FrameHeader::GROWN } else { 0 };
        if grown {
            require_room(room_for(len))?;
        }
        let mut sample =
            self.ports.publisher.loan_slice(len).map_err(failed("taking shared memory for a frame"))?;
        fill(sample.payload_mut());
        header.ready_ns = now_ns();
        *sample.user_header_mut() = header;
        let start = Instant::now();
        self.watch.silence().begin();
        match sample.send() {
            Ok(1) => self.watch.silence().end(),
            // The peer's receiving end is gone.
            Ok(_) if self.watch.is_peer_alive() => {
                self.parted = true;
                return Err(CouplerError::PeerClosed { peer: self.talk.peer, step: self.talk.step });
            }
            Ok(_) => return Err(self.lost()),
            Err(cause) => return Err(self.undelivered(header.step, start, cause)),
        }
        self.talk.sent(&header, len);
        if grown {
            self.longest = Some(len);
            self.unread += 1;
        }
        // A peer that died since is found by the next wait.
        if let Err(error) = self.ports.notifier.notify() {
            tracing::debug!(%error, "the peer could not be woken");
        }
        Ok(())
    }

    fn try_receive<R>(&mut self, read: impl FnOnce(&Frame<'_>) -> R) -> Result<Option<R>, CouplerError> {
        let received = self.ports.subscriber.receive().map_err(failed("taking a frame"))?;
        let Some(sample) = received else {
            self.talk.asked_in_vain();
            return Ok(None);
        };
        let frame = Frame { header: sample.user_header(), payload: sample.payload(), sender: self.talk.peer };
        let result = self.talk.accept(&frame).map(|()| Some(read(&frame)));
        if frame.header.has(FrameHeader::GROWN) {
            self.ports.confirm_read();
        }
        self.parted |= matches!(result, Err(CouplerError::PeerClosed { .. }));
        result
    }

    fn wait(&mut self) -> Result<(), CouplerError> {
        let start = Instant::now();
        let result = self.block();
        self.talk.counters.waited += start.elapsed();
        result
    }

    fn counters(&self) -> LinkCounters {
        self.talk.counters.clone()
    }
}

impl Drop for ProcessLink {
    /// A frame in newly taken memory is lost if its sender leaves before the peer has mapped that memory, even if the
    /// peer has the frame in its queue. So the last such frame must have been read.
    fn drop(&mut self) {
        self.watch.leave();
        if self.parted || !self.ports.has_peer() {
            return;
        }
        self.discard_frames();
        if let Err(error) = self.send(FrameHeader::new(FrameKind::Goodbye), |_| {}) {
            tracing::debug!(%error, "left without the peer taking notice");
            return;
        }
        let start = Instant::now();
        while self.unread > 0 && start.elapsed() < self.patience.min(LINGER) && self.ports.has_peer() {
            self.discard_frames();
            if self.sleep() && !self.watch.is_peer_alive() {
                return;
            }
        }
    }
}

fn ask(interrupt: &mut Option<Interrupt>) -> Result<(), CouplerError> {
    interrupt.as_mut().map_or(Ok(()), |hook| hook())
}

/// Whether a run id can be part of a service name.
///
/// - errors: [`CouplerError::BadRunId`].
pub fn check_run_id(run_id: &str) -> Result<(), CouplerError> {
    let fits = (1..=64).contains(&run_id.len())
        && run_id.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_.-".contains(&byte));
    if fits { Ok(()) } else { Err(CouplerError::BadRunId { run_id: run_id.to_owned() }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::FRAME_VERSION;

    #[test]
    fn only_plain_run_ids_are_taken() {
        let longest = "a".repeat(64);
        for good in ["a", "run_1.2-x", longest.as_str()] {
            assert_eq!(check_run_id(good), Ok(()));
        }
        for bad in ["", "a/b", "ä", "a b", &"a".repeat(65)] {
            assert!(check_run_id(bad).is_err(), "{bad:?}");
        }
    }

    #[test]
    fn a_frame_of_another_version_is_refused_by_the_side_that_sees_it() {
        let run_id = format!("version-{}", std::process::id());
        let newer = Endpoint::new(run_id.clone(), Participant::Solid, [1; 32]);
        let hello = FrameHeader { version: FRAME_VERSION + 1, ..FrameHeader::new(FrameKind::Hello) };
        let other = thread::spawn(move || ProcessLink::connect_saying(newer, hello).map(|_| ()));
        let refused = ProcessLink::connect(Endpoint::new(run_id, Participant::Fluid, [1; 32]));
        assert_eq!(
            refused.map(|_| ()),
            Err(CouplerError::VersionMismatch { ours: FRAME_VERSION, theirs: FRAME_VERSION + 1 })
        );
        // Of this build but for the hello, so it does not mind.
        assert_eq!(other.join().expect("no panic"), Ok(()));
    }

    #[test]
    fn a_link_can_move_to_another_thread() {
        fn movable<T: Send>() {}
        movable::<ProcessLink>();
    }
}
