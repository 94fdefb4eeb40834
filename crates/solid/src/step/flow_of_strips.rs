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
    /// See [`most_mises_at_rest`], Pa².
    most_mises: f64,
}

impl<'a> FlowOfStrips<'a> {
    /// - `dt`: length of the step, s.
    pub fn new(plasticity: &'a Plasticity, strain: &'a [f64], dt: f64) -> Self {
        Self { plasticity, strain, half_dt: 0.5 * dt, most_mises: most_mises_at_rest(plasticity, 0.0) }
    }

    /// Returns states at mid-step, all stresses of which are the elastic predictor's.
    pub fn to_mid_step(&self, MidStep { first, half, .. }: &mut MidStep<'_>) {
        let [_, _, stress_zz, stress_zr, stress_rr, stress_phiphi] = half;
        let n = stress_zz.len();
        if largest_mises([stress_zz, stress_zr, stress_rr, stress_phiphi]) <= self.most_mises {
            return;
        }
        let (mut strain, mut increment, mut work) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
        // Ghosts that are predicted or continued may have less than none.
        strain.iter_mut().zip(&self.strain[*first..][..n]).for_each(|(own, old)| *own = old.max(0.0));
        let mut rows = PlasticRows {
            stress_zz,
            stress_zr,
            stress_rr,
            stress_phiphi,
            strain: &mut strain[..n],
            temperature: &mut [],
            increment: &mut increment[..n],
            work: &mut work[..n],
        };
        self.plasticity.return_rows(&mut rows, self.half_dt);
    }
}

/// The squared von Mises stress up to which nothing flows at a temperature (K), Pa²: flow stress never falls with plastic strain.
pub(super) fn most_mises_at_rest(plasticity: &Plasticity, temperature: f64) -> f64 {
    let least = plasticity.hardening().yield_stress(0.0, 0.0, temperature);
    LEAST * least * least
}
