//! Plastic flow in a sweep: the states at mid-step are returned strip by strip, as [`super::plastic`] returns those of a whole block.

use crate::boundary::outer_states::MidStep;
use crate::plasticity::{PlasticRows, Plasticity};
use crate::step::mises::{LEAST, largest_mises};
use crate::step::sweep::MOST;

/// Of a tile whose law has no heat and needs no guess.
pub(super) struct FlowOfStrips<'a> {
    plasticity: &'a Plasticity,
    /// Plastic strain of the padded cells at the beginning of the step.
    strain: &'a [f64],
    /// Length of half a step, s.
    half_dt: f64,
    /// See [`most_mises_at_rest`], Pa²; `None` where it is not worth while to look, as cells flow.
    most_mises: Option<f64>,
    strain_of_strip: [f64; MOST],
    increment: [f64; MOST],
    work: [f64; MOST],
}

impl<'a> FlowOfStrips<'a> {
    /// - `strain`: plastic strain of the padded cells at the beginning of the step. `dt`: its length, s. `flows`: whether cells have in the last one.
    pub fn new(plasticity: &'a Plasticity, strain: &'a [f64], dt: f64, flows: bool) -> Self {
        let most_mises = (!flows).then(|| most_mises_at_rest(plasticity, 0.0));
        let zeros = [0.0; MOST];
        let (strain_of_strip, increment, work) = (zeros, zeros, zeros);
        Self { plasticity, strain, half_dt: 0.5 * dt, most_mises, strain_of_strip, increment, work }
    }

    /// Returns states at mid-step, all stresses of which are the elastic predictor's.
    pub fn return_strip(&mut self, MidStep { first, half, .. }: &mut MidStep<'_>) {
        let [_, _, stress_zz, stress_zr, stress_rr, stress_phiphi] = half;
        let n = stress_zz.len();
        let stress = [&**stress_zz, &**stress_zr, &**stress_rr, &**stress_phiphi];
        if self.most_mises.is_some_and(|most| largest_mises(stress) <= most) {
            return;
        }
        let strain = &mut self.strain_of_strip[..n];
        // Ghosts that are predicted or continued may have less than none.
        strain.iter_mut().zip(&self.strain[*first..][..n]).for_each(|(own, old)| *own = old.max(0.0));
        let mut rows = PlasticRows {
            stress_zz,
            stress_zr,
            stress_rr,
            stress_phiphi,
            strain,
            temperature: &mut [],
            increment: &mut self.increment[..n],
            work: &mut self.work[..n],
        };
        self.plasticity.return_rows(&mut rows, self.half_dt);
    }
}

/// The squared von Mises stress up to which nothing flows at a temperature (K), Pa²: flow stress never falls with plastic strain.
pub(super) fn most_mises_at_rest(plasticity: &Plasticity, temperature: f64) -> f64 {
    let least = plasticity.hardening().yield_stress(0.0, 0.0, temperature);
    LEAST * least * least
}
