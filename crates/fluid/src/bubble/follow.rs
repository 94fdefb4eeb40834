//! A bubble that is followed: its present radius, the grid's finest level that goes with it, and when its gas is cut.

use mesh::{BlockSolver, Mesh};
use serde::{Deserialize, Serialize};

use super::reset::{self, BubbleReset, ResetReport};
use crate::physics::Fluid;
use crate::{BubbleCuts, FluidSolver};

/// A bubble has grown from its start when its volume is so many times that.
const GROWN: f64 = 1.01;

/// Which bubble is followed, and what is done with it.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowedBubble {
    /// Its radius at t = 0, m.
    pub radius: f64,
    /// How the bubbles are told apart.
    pub cuts: BubbleCuts,
    /// Its number among them, from 0.
    pub number: usize,
    /// Cells along its present radius: details ask for no finer level than the first one that has as many.
    pub cells_per_radius: Option<f64>,
    /// What its gas is cut to when it is at its largest for the first time.
    pub reset: Option<BubbleReset>,
}

impl FollowedBubble {
    /// The level that details may ask for at the most while the bubble has a radius.
    ///
    /// - `width`: of the cells of a level, m; `finest`: the level above which there is none.
    #[must_use]
    pub fn finest_level(&self, radius: f64, width: impl Fn(u8) -> f64, finest: u8) -> u8 {
        let Some(cells) = self.cells_per_radius else { return finest };
        // A radius that is a whole number of cells but for round-off.
        let is_enough = |level: &u8| width(*level) * cells <= radius * (1.0 + 1e-9);
        (0..finest).find(is_enough).unwrap_or(finest)
    }
}

/// What changes in time of a bubble that is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Following {
    cuts: BubbleCuts,
    /// Volume at t = 0 and now, m³.
    start: f64,
    volume: f64,
    reset: Option<ResetReport>,
}

/// A bubble that is followed.
#[derive(Clone, Debug)]
pub(crate) struct Follower {
    pub rule: FollowedBubble,
    pub now: Following,
}

impl Follower {
    /// Of a bubble that is not there yet.
    pub fn new(rule: FollowedBubble) -> Self {
        let now = Following { cuts: rule.cuts.clone(), start: 0.0, volume: 0.0, reset: None };
        Self { rule, now }
    }

    /// Its present radius, m; 0 where it is gone.
    fn radius(&self) -> f64 {
        let Following { start, volume, .. } = self.now;
        if start > 0.0 { self.rule.radius * (volume / start).cbrt() } else { 0.0 }
    }

    /// The finest level for details, `base` at the most. A bubble that is gone may come again anywhere: then it is `base`.
    pub fn finest_for_details<const N: usize>(&self, mesh: &Mesh<N>, base: u8) -> u8 {
        let width = |level: u8| mesh.widths(level).into_iter().fold(0.0, f64::max);
        self.rule.finest_level(self.radius(), width, base)
    }

    /// Looks at the bubble between two steps of the whole, and cuts its gas if that is due.
    fn look<const N: usize>(&mut self, fluid: &mut BlockSolver<Fluid, N>) {
        self.now.cuts.follow(fluid);
        let volume = crate::diagnostics::bubbles::bubbles(fluid, &self.now.cuts)[self.rule.number].volume;
        let before = std::mem::replace(&mut self.now.volume, volume);
        if self.now.start == 0.0 {
            self.now.start = volume;
            return;
        }
        let Some(rule) = &self.rule.reset else { return };
        if self.now.reset.is_none() && volume < before && before > GROWN * self.now.start {
            let radius = self.radius();
            self.now.reset = Some(reset::cut(fluid, (&self.now.cuts, self.rule.number), radius, rule));
        }
    }
}

/// Follows the bubble that a fluid is asked to, if any; between two steps of the whole.
pub(crate) fn follow_bubble<const N: usize>(fluid: &mut BlockSolver<Fluid, N>) {
    let Some(mut follower) = fluid.model_mut().follower.take() else { return };
    follower.look(fluid);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_finest_level_has_as_many_cells_per_radius_as_asked() {
        let followed = |cells: Option<f64>| FollowedBubble {
            radius: 1.0,
            cuts: BubbleCuts::default(),
            number: 0,
            cells_per_radius: cells,
            reset: None,
        };
        let width = |level: u8| 1.0 / f64::from(1u32 << level);
        let level = |radius: f64, cells| followed(cells).finest_level(radius, width, 6);
        assert_eq!(level(1.0, None), 6);
        assert_eq!(level(1.0, Some(16.0)), 4);
        assert_eq!(level(1.0 - 1e-12, Some(16.0)), 4, "but for round-off");
        assert_eq!(level(0.99, Some(16.0)), 5);
        assert_eq!(level(100.0, Some(16.0)), 0);
        assert_eq!(level(1e-3, Some(16.0)), 6, "there is none finer");
        assert_eq!(level(0.0, Some(16.0)), 6);
    }
}
