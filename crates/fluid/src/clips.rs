//! Bounds that act within a step without its being done again, and how often they do.

use std::sync::atomic::{AtomicU64, Ordering};

use mesh::{MOST_COMPONENTS, Multiresolution, Side};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;

/// How often bounds acted, see the table in `docs/equations.md`. Counted per cell and step where nothing else is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Clips {
    /// Cells that kept half of their slopes and of their predictor.
    pub halved_slopes: u64,
    /// Faces at which HLLC found no sound speed on a side, p + π of its state not being above zero, and took 0 for it.
    pub clipped_roots: u64,
    /// Mixed cells of which a face would have had a phase's density beyond a factor of five of the cell's.
    pub bounded_densities: u64,
    /// Mixed cells of which a face would have had less than a tenth of the cell's pressure.
    pub bounded_pressures: u64,
    /// Mixed cells of which a face would have had a gas fraction outside [0, 1].
    pub bounded_fractions: u64,
    /// Faces of mixed cells on which the linear rule leaves no gas behind the wave.
    pub emptied_faces: u64,
    /// Cells whose gas fraction would have left [0, 1] in the step.
    pub clipped_fractions: u64,
    /// Cells of which a gas fraction, or a mass of gas per volume, below what anything feels was set to zero.
    pub removed_traces: u64,
    /// Coarse cells whose children took a share of what was predicted for them: as ghosts in a step, or in adaptation.
    pub limited_predictions: u64,
    /// Faces of the wall to the solid that showed it a share of their rates and slopes, per trace shown.
    pub scaled_traces: u64,
    /// Cells in which a phase had less than no mass at the end of the step, and got what it lacked from the other one.
    pub lifted_phases: u64,
}

impl Clips {
    /// The names of the counts.
    pub const NAMES: [&'static str; 11] = [
        "halved_slopes",
        "clipped_roots",
        "bounded_densities",
        "bounded_pressures",
        "bounded_fractions",
        "emptied_faces",
        "clipped_fractions",
        "removed_traces",
        "limited_predictions",
        "scaled_traces",
        "lifted_phases",
    ];

    /// The counts in the order of their names.
    pub fn counts(&self) -> [u64; 11] {
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            halved_slopes,
            clipped_roots,
            bounded_densities,
            bounded_pressures,
            bounded_fractions,
            emptied_faces,
            clipped_fractions,
            removed_traces,
            limited_predictions,
            scaled_traces,
            lifted_phases,
        } = *self;
        [
            halved_slopes,
            clipped_roots,
            bounded_densities,
            bounded_pressures,
            bounded_fractions,
            emptied_faces,
            clipped_fractions,
            removed_traces,
            limited_predictions,
            scaled_traces,
            lifted_phases,
        ]
    }
}

impl std::ops::AddAssign for Clips {
    fn add_assign(&mut self, other: Self) {
        let Self {
            halved_slopes,
            clipped_roots,
            bounded_densities,
            bounded_pressures,
            bounded_fractions,
            emptied_faces,
            clipped_fractions,
            removed_traces,
            limited_predictions,
            scaled_traces,
            lifted_phases,
        } = other;
        self.halved_slopes += halved_slopes;
        self.clipped_roots += clipped_roots;
        self.bounded_densities += bounded_densities;
        self.bounded_pressures += bounded_pressures;
        self.bounded_fractions += bounded_fractions;
        self.emptied_faces += emptied_faces;
        self.clipped_fractions += clipped_fractions;
        self.removed_traces += removed_traces;
        self.limited_predictions += limited_predictions;
        self.scaled_traces += scaled_traces;
        self.lifted_phases += lifted_phases;
    }
}

/// A count that may be taken where only a shared reference is at hand.
#[derive(Debug, Default)]
pub(crate) struct SharedCount(AtomicU64);

impl SharedCount {
    pub fn add(&self, more: u64) {
        self.0.fetch_add(more, Ordering::Relaxed);
    }

    pub fn get(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

/// The fluid's analysis for predictions that count: how many of them are limited is taken down.
pub(crate) struct CountedAnalysis<'a> {
    analysis: &'a Analysis,
    limited: SharedCount,
}

impl<'a> CountedAnalysis<'a> {
    pub fn new(analysis: &'a Analysis) -> Self {
        Self { analysis, limited: SharedCount::default() }
    }

    /// How many predictions were limited.
    pub fn limited(&self) -> u64 {
        self.limited.get()
    }
}

impl Multiresolution for CountedAnalysis<'_> {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        self.analysis.parity(side, component)
    }

    fn counts_beside(&self, side: Side) -> bool {
        self.analysis.counts_beside(side)
    }

    fn share(&self, mean: &[f64], deviations: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        let share = self.analysis.share(mean, deviations);
        if share < 1.0 {
            self.limited.add(1);
        }
        share
    }

    #[inline(always)]
    fn significance(&self, cell: &[f64], detail: &[f64]) -> f64 {
        self.analysis.significance(cell, detail)
    }

    fn significance_everywhere(&self, cell: &[f64], detail: &[f64]) -> f64 {
        self.analysis.significance_everywhere(cell, detail)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::conserved::{ENERGY, PHI, RHO};
    use crate::{Boundary, Mixture, Primitive, Scales, StiffenedGas};

    #[test]
    fn names_and_counts_go_together() {
        let once = Clips { halved_slopes: 1, scaled_traces: 2, lifted_phases: 3, ..Clips::default() };
        let mut twice = once;
        twice += once;
        let of = |name: &str| {
            let place = Clips::NAMES.iter().position(|other| *other == name).expect("a name");
            twice.counts()[place]
        };
        assert_eq!([of("halved_slopes"), of("scaled_traces"), of("lifted_phases")], [2, 4, 6]);
        assert_eq!(twice.counts().iter().sum::<u64>(), 12);
    }

    #[test]
    fn predictions_that_are_limited_are_counted() {
        let mixture =
            Mixture::new(StiffenedGas { gamma: 7.15, pi: 3e8 }, StiffenedGas { gamma: 1.4, pi: 0.0 });
        let scales = Scales { pressure: 1e7, density: 1000.0 };
        let analysis = Analysis { mixture, boundaries: [Boundary::Wall; 4], scales, has_phases: false };
        let counted = CountedAnalysis::new(&analysis);
        let liquid = Primitive { density: 1000.0, v_z: 0.0, v_r: 0.0, pressure: 5e7, phi: 0.0 };
        let mean = liquid.to_conserved(&mixture);
        let deviations = |share: f64| {
            [-1.0, 1.0, -1.0, 1.0].map(|sign| {
                let mut of_child = [0.0; MOST_COMPONENTS];
                of_child[RHO] = sign * share * mean[RHO];
                of_child[ENERGY] = sign * share * mean[ENERGY];
                of_child[PHI] = sign * share;
                of_child
            })
        };
        assert_eq!((counted.share(&mean, &deviations(0.0)), counted.limited()), (1.0, 0));
        assert!(counted.share(&mean, &deviations(0.3)) < 1.0);
        assert_eq!(counted.limited(), 1);
    }
}
