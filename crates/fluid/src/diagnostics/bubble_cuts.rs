//! Where bubbles on one axis are told apart.

use serde::{Deserialize, Serialize};

use crate::{InitialCondition, Phase, Shape};

/// Below this gas fraction a cell counts as liquid with traces of gas.
pub const TRACE_GAS: f64 = 1e-6;

/// Where bubbles are told apart: planes z = const in the gaps between them, ascending.
///
/// A plane stays in the middle between the nearest cells with φ ≥ ½ below and above it. Where there is none on one side
/// up to the next plane (a bubble smaller than a cell), or where such a cell lies across the plane (two bubbles have
/// merged), it stays where it was. Gas belongs to the bubble between whose planes its cell's centre is, so the parts of
/// a bubble that its jet has pierced or torn stay one bubble.
///
/// Valid for: bubbles beside each other along z. Tests: two and three bubbles that move, merge and vanish.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BubbleCuts {
    pub(crate) cuts: Vec<f64>,
}

impl BubbleCuts {
    /// Between the gas regions of an initial condition; none with fewer than two, or in ambient gas.
    pub fn of(initial: &InitialCondition) -> Self {
        let mut ranges: Vec<[f64; 2]> = initial
            .regions
            .iter()
            .filter(|region| region.state.phase == Phase::Gas && initial.ambient.phase == Phase::Liquid)
            .map(|region| match region.shape {
                Shape::Sphere { centre: [z, _], radius } => [z - radius, z + radius],
                Shape::Box { z, .. } => z,
            })
            .collect();
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        ranges.sort_by(|a, b| middle(*a).total_cmp(&middle(*b)));
        let between = |pair: &[[f64; 2]]| {
            // Regions that overlap may reach beyond each other's middles.
            middle([pair[0][1], pair[1][0]]).clamp(middle(pair[0]), middle(pair[1]))
        };
        Self { cuts: ranges.windows(2).map(between).collect() }
    }

    /// How many bubbles they tell apart; one without any cut.
    pub fn bubbles(&self) -> usize {
        self.cuts.len() + 1
    }

    /// The planes' z, ascending, m.
    pub fn positions(&self) -> &[f64] {
        &self.cuts
    }

    /// Which bubble gas at `z` belongs to, from 0.
    pub(crate) fn bubble_at(&self, z: f64) -> usize {
        self.cuts.partition_point(|cut| *cut < z)
    }
}
