//! What the solid has agreed with the fluid about the next step.

use coupler::{CouplerError, Frame, FrameHeader, FrameKind, Scheme, StepLength};

use super::SolidSide;

/// Lengths of steps may pass what is agreed by this share, and the end of the run by as much of it: round-off, and a step that
/// is made a little longer rather than leave a splinter.
const OVER_LIMIT: f64 = 1e-9;

impl SolidSide {
    /// Whether a frame of the fluid's is about the step that begins now, no longer than agreed, and part of the scheme.
    pub(super) fn require_turn(&self, frame: &Frame<'_>) -> Result<(), CouplerError> {
        let header = frame.header;
        let is_yours = frame.require(FrameKind::Yours).is_ok();
        if !is_yours {
            frame.require(FrameKind::Trace)?;
        }
        frame.require_time(self.own.solver.time())?;
        if header.has(FrameHeader::LAST) {
            return Ok(());
        }
        let [tries, settles] = [FrameHeader::TRIAL, FrameHeader::SETTLED].map(|flag| header.has(flag));
        let refuse = |what: &'static str| {
            let kind = FrameKind::try_from(header.kind)?;
            Err(CouplerError::OutOfTurn { peer: frame.sender, kind, what })
        };
        match self.trial {
            _ if is_yours && self.scheme.exchanges_cells() => refuse("asks for a trace in a scheme without"),
            None if tries && self.scheme != Scheme::Strong => refuse("is a trial in a scheme without"),
            None if settles => refuse("settles a step that was not tried"),
            Some(_) if is_yours || tries == settles => refuse("leaves a step that was tried"),
            Some(_) => frame.require_step(self.own.solver.time(), StepLength::Is(self.own.last_dt)),
            None => {
                let most = self.longest_step();
                // Its own steps within are as many as agreed, too.
                let own = if is_yours { self.own.rule.most_steps() * frame.require_limit()? } else { most };
                let room = 1.0 + OVER_LIMIT;
                frame.require_step(self.own.solver.time(), StepLength::AtMost(room * most.min(own)))
            }
        }
    }

    /// The longest step that the fluid may plan from here, s: none goes beyond the end of the run, and none of our own fluid's is
    /// longer than this side has said that it can follow.
    fn longest_step(&self) -> f64 {
        let left = self.end * (1.0 + OVER_LIMIT) - self.own.solver.time();
        if self.scheme == Scheme::External { left } else { left.min(self.own.rule.longest(self.promised)) }
    }
}
