//! Where bubbles on one axis are told apart.

use serde::{Deserialize, Serialize};

use crate::{InitialCondition, Phase, Region};

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
    /// Between the gas regions of an initial condition; none with fewer than two, or in ambient gas. Regions within another one of gas, or
    /// painted over by liquid, are no bubbles, nor are those side by side across the axis told apart.
    pub fn of(initial: &InitialCondition) -> Self {
        if initial.ambient.phase == Phase::Gas {
            return Self::default();
        }
        let mut ranges: Vec<[f64; 2]> = (0..initial.regions.len())
            .filter(|number| is_bubble(initial, *number))
            .map(|number| initial.regions[number].shape.extent()[0])
            .collect();
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        ranges.sort_by(|a, b| middle(*a).total_cmp(&middle(*b)));
        let between = |pair: &[[f64; 2]]| {
            // Regions that overlap may reach beyond each other's middles.
            middle([pair[0][1], pair[1][0]]).clamp(middle(pair[0]), middle(pair[1]))
        };
        let is_apart = |pair: &&[[f64; 2]]| middle(pair[0]) < middle(pair[1]);
        Self { cuts: ranges.windows(2).filter(is_apart).map(between).collect() }
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

/// Whether a region is of gas that is there, and no part of another one's.
fn is_bubble(initial: &InitialCondition, number: usize) -> bool {
    let own = &initial.regions[number];
    let is_hidden_by = |(other, region): (usize, &Region)| {
        other != number
            && region.shape.holds(&own.shape)
            && match region.state.phase {
                // Of two that are the same the first one counts.
                Phase::Gas => other < number || !own.shape.holds(&region.shape),
                Phase::Liquid => other > number,
            }
    };
    own.state.phase == Phase::Gas && !initial.regions.iter().enumerate().any(is_hidden_by)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InitialPressure, PhaseState, Shape};

    #[test]
    fn what_is_within_gas_or_under_liquid_is_no_bubble() {
        let state = |phase| PhaseState { phase, density: 1.0, pressure: 1e5, velocity: [0.0; 2] };
        let ball = |z: f64, r: f64, radius: f64, phase| Region {
            shape: Shape::Sphere { centre: [z, r], radius },
            state: state(phase),
        };
        let cell =
            |z: [f64; 2], r: [f64; 2], phase| Region { shape: Shape::Box { z, r }, state: state(phase) };
        use Phase::{Gas, Liquid};
        for (regions, bubbles) in [
            (vec![ball(1.0, 0.0, 0.5, Gas), ball(3.0, 0.0, 0.5, Gas)], 2),
            (vec![ball(1.0, 0.0, 0.5, Gas), ball(1.1, 0.0, 0.2, Gas)], 1),
            (vec![ball(1.1, 0.0, 0.2, Gas), ball(1.0, 0.0, 0.5, Gas)], 1),
            (vec![ball(1.0, 0.0, 0.5, Gas), ball(1.0, 0.0, 0.5, Gas)], 1),
            (
                vec![
                    ball(1.0, 0.0, 0.5, Gas),
                    ball(3.0, 0.0, 0.5, Gas),
                    cell([2.0, 4.0], [0.0, 1.0], Liquid),
                ],
                1,
            ),
            (
                vec![
                    cell([2.0, 4.0], [0.0, 1.0], Liquid),
                    ball(1.0, 0.0, 0.5, Gas),
                    ball(3.0, 0.0, 0.5, Gas),
                ],
                2,
            ),
            (vec![ball(1.0, 0.0, 0.5, Gas), cell([0.9, 1.1], [0.0, 0.1], Gas)], 1),
            (vec![ball(1.0, -2.0, 0.5, Gas), ball(1.0, 2.0, 0.5, Gas)], 1),
        ] {
            let initial = InitialCondition {
                ambient: state(Liquid),
                pressure: InitialPressure::Uniform,
                regions,
                pulses: vec![],
            };
            assert_eq!(BubbleCuts::of(&initial).bubbles(), bubbles, "{:?}", initial.regions);
        }
        let gas = InitialCondition {
            ambient: state(Gas),
            pressure: InitialPressure::Uniform,
            regions: vec![ball(1.0, 0.0, 0.5, Gas)],
            pulses: vec![],
        };
        assert_eq!(BubbleCuts::of(&gas).bubbles(), 1);
    }
}
