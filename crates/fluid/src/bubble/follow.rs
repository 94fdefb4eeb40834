//! A bubble that is followed: its present radius, and the grid's finest level that goes with it.

use mesh::Mesh;
use serde::{Deserialize, Serialize};

use super::rule::{FollowedBubble, ResetReport};
use crate::BubbleCuts;

/// What changes in time of a bubble that is followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Following {
    pub cuts: BubbleCuts,
    /// Volume at t = 0 and now, m³.
    pub start: f64,
    pub volume: f64,
    pub reset: Option<ResetReport>,
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
    pub fn radius(&self) -> f64 {
        let Following { start, volume, .. } = self.now;
        if start > 0.0 { self.rule.radius * (volume / start).cbrt() } else { 0.0 }
    }

    /// The finest level for details, `base` at the most. A bubble that is gone may come again anywhere: then it is `base`.
    pub fn finest_for_details<const N: usize>(&self, mesh: &Mesh<N>, base: u8) -> u8 {
        let width = |level: u8| mesh.widths(level).into_iter().fold(0.0, f64::max);
        self.rule.finest_level(self.radius(), width, base)
    }
}
