//! What is asked of a frame's content where it enters: times as agreed, numbers that are numbers, faces that make up the
//! interface.
//!
//! The peer may be anybody's program. What lies behind relies on what is looked at here, so receivers take the content of
//! frames through these functions only. Each number is looked at once.

use crate::error::CouplerError;
use crate::exchange::{RegisterRow, TraceRow, WallRegister};
use crate::frame::Frame;
use crate::kinds::FrameKind;
use crate::mapping::CommonRefinement;

/// Times of both sides may differ by this share: each adds up its own steps, which are the same but for round-off.
const SAME_TIME: f64 = 1e-9;

/// Both sides' last edges may differ by this share of the interface, as their domains do in the case.
const SAME_END: f64 = 1e-9;

/// What a receiver knows of the length of the step that a frame is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepLength {
    /// That long, s: the frame answers one that said so.
    Is(f64),
    /// At most that long, s.
    AtMost(f64),
}

impl<'a> Frame<'a> {
    /// Whether the frame is about the step that begins at `begin` (s).
    ///
    /// - errors: it is about another time.
    pub fn require_time(&self, begin: f64) -> Result<(), CouplerError> {
        let found = self.header.time;
        // `!(a <= b)`, so that NaN does not pass.
        if !((found - begin).abs() <= SAME_TIME * begin.abs()) {
            return Err(self.bad_step("the time", found, format!("{begin:e} s"))?);
        }
        Ok(())
    }

    /// Whether the frame is about the step that is due: its time, and a length that moves time on and is as agreed.
    ///
    /// - errors: one of them is not.
    pub fn require_step(&self, begin: f64, length: StepLength) -> Result<(), CouplerError> {
        self.require_time(begin)?;
        let found = self.header.dt;
        let (fits, expected) = match length {
            StepLength::Is(dt) => (found == dt, format!("{dt:e} s")),
            StepLength::AtMost(most) => (found <= most, format!("above 0 and at most {most:e} s")),
        };
        if fits && found > 0.0 && begin + found > begin {
            return Ok(());
        }
        Err(self.bad_step("the step", found, expected)?)
    }

    /// The sender's largest next step, s: not negative, maybe infinite; and its [`FrameHeader::coming`](crate::FrameHeader::coming) waves are some.
    ///
    /// - errors: it is NaN or negative, or so is a wave's time or reach, or infinite.
    pub fn require_limit(&self) -> Result<f64, CouplerError> {
        let found = self.header.dt_max;
        if !(found >= 0.0) {
            return Err(self.bad_step("the largest next step", found, "a time".to_owned())?);
        }
        for [time, reach] in self.header.coming {
            if ![time, reach].iter().all(|value| (0.0..f64::INFINITY).contains(value)) {
                let (peer, kind) = (self.sender, FrameKind::try_from(self.header.kind)?);
                return Err(CouplerError::BadWave { peer, kind, time, reach });
            }
        }
        Ok(found)
    }

    /// The rows of a trace, and how many faces it has.
    ///
    /// - `interface`: the radii where the interface begins and ends, m.
    /// - errors: not [`TraceRow::COUNT`] rows, a number that is none, faces that do not make up the interface.
    pub fn trace(&self, interface: [f64; 2]) -> Result<(&'a [f64], usize), CouplerError> {
        self.trace_on(Some(interface))
    }

    /// [`Frame::trace`] for one who does not know the interface but by this.
    pub(crate) fn trace_on(&self, interface: Option<[f64; 2]>) -> Result<(&'a [f64], usize), CouplerError> {
        let faces = usize::try_from(self.header.count).unwrap_or(usize::MAX);
        self.require_shape(TraceRow::COUNT, faces)?;
        self.require_finite(&TraceRow::NAMES)?;
        let edges = TraceRow::Edge.of(self.payload, faces);
        self.require_faces(edges, interface)?;
        Ok((self.payload, faces))
    }

    /// What a register says of the receiver's faces.
    ///
    /// - `faces`: how many these are.
    /// - errors: another number of faces or rows, a number that is none.
    pub fn register(&self, faces: usize) -> Result<WallRegister<'a>, CouplerError> {
        self.require_shape(RegisterRow::COUNT, faces)?;
        self.require_finite(&RegisterRow::NAMES)?;
        Ok(WallRegister::of(self.payload, faces))
    }

    /// The first word of a side that does not know the receiver's faces yet: nothing but the header.
    ///
    /// - errors: it has a payload.
    pub fn require_empty(&self) -> Result<(), CouplerError> {
        if self.payload.is_empty() {
            return Ok(());
        }
        let (fields, found) = (self.header.fields, self.payload.len());
        Err(CouplerError::LengthMismatch { fields, count: 0, found })
    }

    fn require_finite(&self, rows: &[&'static str]) -> Result<(), CouplerError> {
        // Without a branch per number, since they all are in all runs but bad ones.
        if self.payload.iter().fold(true, |all, value| all & value.is_finite()) {
            return Ok(());
        }
        let at = self.payload.iter().position(|value| !value.is_finite()).unwrap_or_default();
        let count = self.payload.len() / rows.len();
        Err(CouplerError::NotFinite {
            peer: self.sender,
            kind: FrameKind::try_from(self.header.kind)?,
            row: rows[at / count],
            face: at % count,
            value: self.payload[at],
        })
    }

    /// Whether the outer edges of faces ascend, by more than what would be the same edge, from one end of the interface to
    /// the other.
    fn require_faces(&self, edges: &[f64], interface: Option<[f64; 2]>) -> Result<(), CouplerError> {
        let refuse = |reason: String| Err(CouplerError::BadFaces { peer: self.sender, reason });
        let Some(last) = edges.last() else { return refuse("there are none".to_owned()) };
        let [begin, end] = interface.unwrap_or([f64::NEG_INFINITY, *last]);
        let least = interface.map_or(0.0, |_| CommonRefinement::SAME_EDGE * (end - begin));
        let mut before = begin;
        for (face, edge) in edges.iter().enumerate() {
            if !(edge - before > least) {
                return refuse(format!("face {face} goes from r = {before:e} m to {edge:e} m"));
            }
            before = *edge;
        }
        if interface.is_some() && !((last - end).abs() <= SAME_END * (end - begin)) {
            return refuse(format!("they end at r = {last:e} m, the interface at {end:e} m"));
        }
        Ok(())
    }

    /// The error; or that the frame's kind is none.
    fn bad_step(
        &self,
        what: &'static str,
        found: f64,
        expected: String,
    ) -> Result<CouplerError, CouplerError> {
        let kind = FrameKind::try_from(self.header.kind)?;
        Ok(CouplerError::BadStep { peer: self.sender, kind, what, found, expected })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::FrameHeader;
    use crate::kinds::Participant;

    const INTERFACE: [f64; 2] = [0.0, 0.05];
    const FACES: usize = 4;
    const NONSENSE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

    fn trace_of(edges: &[f64]) -> (FrameHeader, Vec<f64>) {
        let count = edges.len();
        let header = FrameHeader {
            fields: TraceRow::COUNT as u64,
            count: count as u64,
            time: 1e-5,
            dt: 1e-8,
            ..FrameHeader::new(FrameKind::Trace)
        };
        let mut payload = vec![1.0; TraceRow::COUNT * count];
        payload[..count].copy_from_slice(edges);
        (header, payload)
    }

    fn good() -> (FrameHeader, Vec<f64>) {
        trace_of(&[0.01, 0.02, 0.03, 0.05])
    }

    fn seen<R>((header, payload): &(FrameHeader, Vec<f64>), look: impl FnOnce(&Frame<'_>) -> R) -> R {
        look(&Frame { header, payload, sender: Participant::Fluid })
    }

    fn faces_refused(edges: &[f64]) -> String {
        let error = seen(&trace_of(edges), |frame| frame.trace(INTERFACE).map(|_| ()))
            .expect_err("such faces must be refused");
        assert!(matches!(error, CouplerError::BadFaces { .. } | CouplerError::NotFinite { .. }), "{error}");
        error.to_string()
    }

    #[test]
    fn a_good_trace_and_register_pass() {
        seen(&good(), |frame| {
            assert_eq!(frame.trace(INTERFACE).expect("it is one").1, FACES);
            assert_eq!(frame.trace_on(None).expect("it is one").1, FACES);
            assert_eq!(frame.require_step(1e-5, StepLength::Is(1e-8)), Ok(()));
            assert_eq!(frame.require_step(1e-5, StepLength::AtMost(1e-8)), Ok(()));
            assert_eq!(frame.require_step(1e-5 * (1.0 + 1e-12), StepLength::AtMost(2e-8)), Ok(()));
        });
        let count = FACES as u64;
        let header = FrameHeader { fields: 5, count, ..FrameHeader::new(FrameKind::Register) };
        let register = (header, vec![2.0; 5 * FACES]);
        seen(&register, |frame| assert_eq!(frame.register(FACES).expect("it is one").power, [2.0; FACES]));
        // Ends that differ as domains may.
        let (header, mut payload) = good();
        payload[3] *= 1.0 + 1e-12;
        seen(&(header, payload), |frame| assert!(frame.trace(INTERFACE).is_ok()));
    }

    #[test]
    fn any_number_that_is_none_is_refused_and_named() {
        for at in 0..TraceRow::COUNT * FACES {
            for value in NONSENSE {
                let mut frame = good();
                frame.1[at] = value;
                let error = seen(&frame, |frame| frame.trace(INTERFACE).map(|_| ())).expect_err("no number");
                let CouplerError::NotFinite { row, face, .. } = error else { panic!("{error}") };
                assert_eq!((row, face), (TraceRow::NAMES[at / FACES], at % FACES));
            }
        }
        let count = FACES as u64;
        let header = FrameHeader { fields: 5, count, ..FrameHeader::new(FrameKind::Register) };
        for at in 0..5 * FACES {
            let mut register = (header, vec![2.0; 5 * FACES]);
            register.1[at] = f64::NAN;
            let error = seen(&register, |frame| frame.register(FACES).map(|_| ())).expect_err("no number");
            assert!(error.to_string().contains(RegisterRow::NAMES[at / FACES]), "{error}");
        }
    }

    #[test]
    fn faces_that_do_not_make_up_the_interface_are_refused() {
        assert!(faces_refused(&[0.01, f64::NAN, 0.03, 0.05]).contains("NaN for the outer radius of face 1"));
        assert!(faces_refused(&[0.01, 0.03, 0.02, 0.05]).contains("face 2 goes from"));
        assert!(faces_refused(&[0.05, 0.03, 0.02, 0.01]).contains("face 1 goes from"));
        assert!(faces_refused(&[0.01, 0.02, 0.02, 0.05]).contains("face 2 goes from"));
        assert!(faces_refused(&[0.02, 0.02 + 1e-16, 0.05]).contains("face 1 goes from"));
        assert!(faces_refused(&[0.0, 0.05]).contains("face 0 goes from"));
        assert!(faces_refused(&[-0.01, 0.05]).contains("face 0 goes from"));
        assert!(faces_refused(&[0.01, 0.04]).contains("they end at"));
        assert!(faces_refused(&[0.01, 0.06]).contains("they end at"));
        assert!(faces_refused(&[]).contains("there are none"));
    }

    #[test]
    fn another_shape_is_refused() {
        for (fields, count) in [(15, 4), (16, 3), (16, 5), (0, 0), (4, 16), (1 << 60, 16), (0, u64::MAX)] {
            let mut frame = good();
            (frame.0.fields, frame.0.count) = (fields, count);
            assert!(seen(&frame, |frame| frame.trace(INTERFACE).is_err()), "{fields} x {count}");
            assert!(seen(&frame, |frame| frame.register(FACES).is_err()), "{fields} x {count}");
        }
        assert!(seen(&good(), |frame| frame.require_empty().is_err()));
    }

    #[test]
    fn another_step_than_the_agreed_one_is_refused() {
        let step = |time: f64, dt: f64, length: StepLength| {
            let (header, payload) = good();
            let frame = (FrameHeader { time, dt, ..header }, payload);
            seen(&frame, |frame| frame.require_step(1e-5, length))
        };
        let both = [StepLength::Is(1e-8), StepLength::AtMost(1e-8)];
        for length in both {
            for dt in [0.0, -1e-8, f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300, 1.001e-8, 1e-300, 1e-22] {
                let error = step(1e-5, dt, length).expect_err("such a step must be refused").to_string();
                assert!(error.contains("the step"), "{error}");
            }
            for time in [0.0, -1e-5, 1.0001e-5, 1e300, f64::NAN, f64::INFINITY] {
                let error = step(time, 1e-8, length).expect_err("such a time must be refused").to_string();
                assert!(error.contains("the time"), "{error}");
            }
        }
        assert!(step(1e-5, 0.9e-8, StepLength::Is(1e-8)).is_err());
        assert_eq!(step(1e-5, 0.9e-8, StepLength::AtMost(1e-8)), Ok(()));
        // An agreement that is none lets nothing through.
        for length in [StepLength::Is(f64::NAN), StepLength::AtMost(f64::NAN), StepLength::AtMost(-1.0)] {
            assert!(step(1e-5, 1e-8, length).is_err());
        }
    }

    #[test]
    fn a_largest_step_is_a_time() {
        let limit = |dt_max: f64| {
            let (header, payload) = good();
            seen(&(FrameHeader { dt_max, ..header }, payload), |frame| frame.require_limit())
        };
        for good in [0.0, 1e-9, f64::INFINITY] {
            assert_eq!(limit(good), Ok(good));
        }
        for bad in [-1e-9, f64::NAN, f64::NEG_INFINITY] {
            assert!(limit(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn coming_waves_have_times_and_reach() {
        let told = |wave: [f64; 2]| {
            let (mut header, payload) = good();
            header.coming[3] = wave;
            seen(&(header, payload), |frame| frame.require_limit())
        };
        assert!(told([1e-9, 0.5]).is_ok() && told([0.0, 0.0]).is_ok());
        for bad in [[-1e-9, 0.5], [1e-9, -0.5], [f64::NAN, 0.5], [1e-9, f64::INFINITY]] {
            assert!(told(bad).is_err(), "{bad:?}");
        }
    }
}
