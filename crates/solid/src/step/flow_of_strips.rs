//! Plastic flow in a sweep: the states at mid-step are returned strip by strip, as [`super::plastic`] returns those of a whole block.

use std::ops::ControlFlow;

use crate::boundary::outer_states::MidStep;
use crate::plasticity::Plasticity;
use crate::step::mises::{LEAST, largest_mises};

/// Of a tile whose law is on straight lines, or of any in which nothing has flowed so far.
pub(super) struct FlowOfStrips<'a> {
    plasticity: &'a Plasticity,
    /// Plastic strain of the padded cells at the beginning of the step, empty where returns need none; `None` where nothing has flowed so far.
    strain: Option<&'a [f64]>,
    /// See [`most_mises_at_rest`], Pa²; `None` where it is not worth while to look, as cells flow.
    most_mises: Option<f64>,
}

impl<'a> FlowOfStrips<'a> {
    /// - `strain`: plastic strain of the padded cells at the beginning of the step if anything has flowed before, empty where returns need none.
    ///   `flows`: whether cells have in the last one.
    pub fn new(plasticity: &'a Plasticity, strain: Option<&'a [f64]>, flows: bool) -> Self {
        let most_mises = (!flows).then(|| most_mises_at_rest(plasticity, plasticity.reference()));
        Self { plasticity, strain, most_mises }
    }

    /// Returns states at mid-step, all stresses of which are the elastic predictor's; breaks off where they may be the first to flow.
    pub fn return_strip(&self, MidStep { first, half, .. }: &mut MidStep<'_>) -> ControlFlow<()> {
        let [_, _, zz, zr, rr, phiphi] = half;
        if self.most_mises.is_some_and(|most| largest_mises([&**zz, &**zr, &**rr, &**phiphi]) <= most) {
            return ControlFlow::Continue(());
        }
        // Ghosts that are predicted or continued may have less plastic strain than none.
        let strain = self.strain.map(|strain| strain.get(*first..*first + zz.len()).unwrap_or_default());
        let is_done = strain.is_some_and(|old| self.plasticity.return_stresses([zz, zr, rr, phiphi], old));
        if is_done { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// The squared von Mises stress up to which nothing flows at a temperature (K), Pa²: flow stress never falls with plastic strain.
pub(super) fn most_mises_at_rest(plasticity: &Plasticity, temperature: f64) -> f64 {
    let least = plasticity.hardening().yield_stress(0.0, 0.0, temperature);
    LEAST * least * least
}
