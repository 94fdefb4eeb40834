//! What the fluid shows of itself on a face of the wall to the solid.

use crate::Mixture;
use crate::state::primitive::{PHI, PRESSURE, RHO, V_R, V_Z};
use crate::state::{COUNT, PrimitiveCell};

/// The least that a trace may have of its cell's density and p + π: what the predictor asks of face states, see
/// [`crate::step::rows::half_step`].
const LEAST_SHARE: f64 = 1e-3;

/// The state ρ, v_z, v_r, p, φ on a face at the beginning of a step, its rate of change, and its slope along the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Trace {
    pub state: PrimitiveCell,
    pub rate: PrimitiveCell,
    pub slope: PrimitiveCell,
}

impl Trace {
    /// One that stays as it is through the step and along the face.
    pub fn steady(state: PrimitiveCell) -> Self {
        Self { state, rate: [0.0; COUNT], slope: [0.0; COUNT] }
    }

    /// The trace with as much of its rates and slopes as leaves it a state at all times of the step and on all of the face.
    ///
    /// The predictor sees to the middle of the step and of the face only, which is all that the fluid's own flux asks for. The solid
    /// meets the trace at the middle of each of its own, shorter steps and on each of its faces. Where a jet of liquid compresses a
    /// cell of gas on the wall severalfold within a step, the line through mid-step with the predictor's rate begins below zero.
    /// All rates and slopes are scaled by one share about the state in the middle, which stays: it is what the fluid's own
    /// Riemann problem has. The trace is linear, so what holds at both ends holds in between.
    ///
    /// - `cell`: the cell's own state; `reach`: half of the step, s, and of the face's width, m.
    /// - returns: the trace itself, to the last bit, where all of it is a state. errors: none.
    /// - tested by: a jet through gas on the wall; share 1 where nothing comes near.
    pub fn admissible(self, cell: PrimitiveCell, [half_dt, half_width]: [f64; 2], mixture: &Mixture) -> Self {
        let pi = mixture.at(self.state[PHI]).pi;
        let cell_pi = mixture.at(cell[PHI].clamp(0.0, 1.0)).pi;
        let room = |c: usize, pi: f64, cell_pi: f64| {
            let middle = self.state[c] + half_dt * self.rate[c] + pi;
            let swing = half_dt * self.rate[c].abs() + half_width * self.slope[c].abs();
            let least = LEAST_SHARE * middle.min(cell[c] + cell_pi);
            if middle - swing >= least { 1.0 } else { ((middle - least) / swing).max(0.0) }
        };
        let share = room(RHO, 0.0, 0.0).min(room(PRESSURE, pi, cell_pi));
        if share == 1.0 {
            return self;
        }
        let moved = |c: usize| self.state[c] + (1.0 - share) * half_dt * self.rate[c];
        Self {
            state: [moved(RHO), moved(V_Z), moved(V_R), moved(PRESSURE), self.state[PHI]],
            rate: self.rate.map(|rate| share * rate),
            slope: self.slope.map(|slope| share * slope),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ρ and p + π where and when the solid may ask for them: on both ends of the face and of the step.
    fn extremes(trace: &Trace, [half_dt, half_width]: [f64; 2]) -> Vec<[f64; 2]> {
        let pi = Mixture::water_and_air().at(trace.state[PHI]).pi;
        let at = |c: usize, after: f64, offset: f64| {
            trace.state[c] + after * trace.rate[c] + offset * trace.slope[c]
        };
        let corners =
            [0.0, 2.0 * half_dt].map(|after| [-half_width, half_width].map(|offset| [after, offset]));
        corners.concat().into_iter().map(|[t, r]| [at(RHO, t, r), at(PRESSURE, t, r) + pi]).collect()
    }

    /// Seen below a bubble on the wall: at mid-step 1 kPa, at the beginning of the step less than nothing.
    #[test]
    fn gas_that_a_jet_compresses_is_a_state_throughout_the_step() {
        let reach = [5e-9, 1e-4];
        let cell = [0.4, -900.0, 3.0, 3000.0, 1.0];
        let trace = Trace {
            state: [-0.046, -800.0, 2.0, -1845.0, 1.0],
            rate: [0.084 / reach[0], 1e9, 0.0, 2840.0 / reach[0], 0.0],
            slope: [100.0, 0.0, 0.0, -4e6, 0.0],
        };
        assert!(extremes(&trace, reach).iter().flatten().any(|value| *value < 0.0));
        let scaled = trace.admissible(cell, reach, &Mixture::water_and_air());
        for [density, pressure] in extremes(&scaled, reach) {
            assert!(density > 0.9e-3 * 0.038 && pressure > 0.9e-3 * 995.0, "{density} {pressure}");
        }
        for c in [RHO, V_Z, V_R, PRESSURE] {
            let middle = |trace: &Trace| trace.state[c] + reach[0] * trace.rate[c];
            approx::assert_relative_eq!(middle(&scaled), middle(&trace), max_relative = 1e-12);
        }
        let least = extremes(&scaled, reach).into_iter().flatten().fold(f64::INFINITY, f64::min);
        assert!(least < 1e-2, "no more is taken away than must be: {least}");
    }

    #[test]
    fn a_trace_of_liquid_stays_as_it_is() {
        let trace = Trace {
            state: [1000.0, -3.0, 2.0, -1e6, 0.0],
            rate: [1e10, 1e9, 3.0, 2e15, 0.0],
            slope: [1e3, 4.0, 5.0, 6e9, 0.0],
        };
        let cell = [1001.0, -3.0, 2.0, 2e5, 0.0];
        assert_eq!(trace.admissible(cell, [5e-9, 1e-4], &Mixture::water_and_air()), trace);
    }
}
