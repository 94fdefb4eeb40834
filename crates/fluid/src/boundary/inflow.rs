//! What enters through sides of kind [`Boundary::Inflow`], as adaptation has to know of it before it is there.

use mesh::{Entering, Entry, Mesh, Side, mean_since_start};

use crate::analysis::Analysis;
use crate::boundary::history::PressureHistory;
use crate::setup::InitialState;
use crate::{Boundary, FluidSetup};

/// The wave that the inflow makes, for adaptation.
#[derive(Clone, Debug)]
pub(crate) struct IncomingWave {
    history: PressureHistory,
    /// The pressure inside at t = 0, Pa.
    initial: f64,
    /// The speed of sound there, m/s.
    speed: f64,
    /// See [`mesh::Adaptation::epsilon`].
    epsilon: f64,
}

impl IncomingWave {
    /// Of a setup whose grid adapts and into which something flows.
    pub fn of(setup: &FluidSetup, initial: &InitialState<'_>) -> Option<Self> {
        let (history, adaptation) = (setup.inflow.clone()?, setup.adaptation.as_ref()?);
        let side = Side::ALL.into_iter().find(|side| setup.boundaries[*side as usize] == Boundary::Inflow)?;
        // What is in the middle of that side, as far within as a cell of a fine grid is.
        let ranges = [setup.domain.z, setup.domain.r];
        let widths = ranges.map(|[low, high]| (high - low) / 1024.0);
        let mut place = ranges.map(|[low, high]| 0.5 * (low + high));
        let axis = side.axis_across();
        let is_lower = matches!(side, Side::ZMin | Side::RMin);
        let half = 0.5 * widths[axis];
        place[axis] = if is_lower { ranges[axis][0] + half } else { ranges[axis][1] - half };
        let inside = initial(place, widths).state;
        let law = if inside.phi > 0.5 { setup.gas } else { setup.liquid };
        let speed = law.sound_speed(inside.density, inside.pressure);
        Some(Self { history, initial: inside.pressure, speed, epsilon: adaptation.epsilon })
    }

    /// The level that each block should have for what is about to enter there; 0 elsewhere.
    ///
    /// - `base`: the finest level that details may ask for; `time`: the present, s.
    pub fn demanded_levels<const N: usize>(
        &self,
        mesh: &Mesh<N>,
        analysis: &Analysis,
        base: u8,
        time: f64,
    ) -> Vec<u8> {
        let mut demanded = vec![0; mesh.blocks()];
        for side in Side::ALL {
            if analysis.boundaries[side as usize] == Boundary::Inflow {
                let (speed, scale, epsilon) = (self.speed, analysis.scales.pressure, self.epsilon);
                let entry = Entry { entering: self, side, speed, scale, time, epsilon, base };
                raise(&mut demanded, entry.demanded_levels(mesh));
            }
        }
        demanded
    }
}

impl Entering for IncomingWave {
    fn mean(&self, from: f64, to: f64, _: f64) -> f64 {
        mean_since_start(from, to, |from, to| self.history.mean(from, to) - self.initial)
    }

    fn changes(&self, from: f64, to: f64) -> bool {
        self.history.changes_from(self.initial, from, to)
    }

    fn varies_along(&self) -> bool {
        false
    }
}

/// Raises levels to others of the same blocks; where there are none yet they become those.
pub(crate) fn raise(levels: &mut Vec<u8>, others: Vec<u8>) {
    if levels.is_empty() {
        *levels = others;
    } else {
        levels.iter_mut().zip(others).for_each(|(level, other)| *level = (*level).max(other));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_begins_with_a_jump_changes_at_once_and_is_nothing_before() {
        let history = PressureHistory::new(vec![[0.0, 3e5]]).unwrap();
        let wave = IncomingWave { history, initial: 1e5, speed: 1500.0, epsilon: 1e-3 };
        assert!(wave.changes(-1e-9, 1e-9) && !wave.changes(1e-9, 2e-9) && !wave.changes(-2e-9, -1e-9));
        assert_eq!([wave.mean(-1.0, 0.0, 0.0), wave.mean(-1.0, 1.0, 0.0)], [0.0, 1e5]);
    }
}
