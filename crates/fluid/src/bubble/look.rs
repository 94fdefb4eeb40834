//! What is done with a bubble that is followed after each step of the whole.

use mesh::BlockSolver;

use super::follow::Follower;
use super::reset;
use super::rule::ResetReport;
use crate::FluidSolver;
use crate::diagnostics::bubbles::bubbles;
use crate::physics::Fluid;

/// A bubble has grown from its start when its volume is so many times that.
const GROWN: f64 = 1.01;

/// Looks at the bubble between two steps of the whole, and cuts its gas if that is due.
fn look<const N: usize>(follower: &mut Follower, fluid: &mut BlockSolver<Fluid, N>) {
    follower.now.cuts.follow(fluid);
    let volume = bubbles(fluid, &follower.now.cuts)[follower.rule.number].volume;
    let before = std::mem::replace(&mut follower.now.volume, volume);
    if follower.now.start == 0.0 {
        follower.now.start = volume;
        return;
    }
    let Some(rule) = &follower.rule.reset else { return };
    if follower.now.reset.is_none() && volume < before && before > GROWN * follower.now.start {
        let size = [follower.radius(), volume];
        follower.now.reset = Some(reset::cut(fluid, (&follower.now.cuts, follower.rule.number), size, rule));
    }
}

/// Follows the bubble that a fluid is asked to, if any; between two steps of the whole.
pub(crate) fn follow_bubble<const N: usize>(fluid: &mut BlockSolver<Fluid, N>) {
    let Some(mut follower) = fluid.model_mut().follower.take() else { return };
    look(&mut follower, fluid);
    fluid.model_mut().follower = Some(follower);
}

impl<const N: usize> FluidSolver<N> {
    /// What the cut of the followed bubble's gas was, once it has happened.
    pub fn bubble_reset(&self) -> Option<&ResetReport> {
        self.model().follower.as_ref().and_then(|follower| follower.now.reset.as_ref())
    }

    /// Whether the gas of a bubble is, or will be, cut.
    pub fn cuts_a_bubble(&self) -> bool {
        self.model().follower.as_ref().is_some_and(|follower| follower.rule.reset.is_some())
    }
}
