//! Bounds that act within a step without its being done again, and how often they do.

use std::sync::atomic::{AtomicU64, Ordering};

use mesh::{ComponentsOfCell, MOST_COMPONENTS, Multiresolution, Side};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;

/// Counts by name: a struct of them, their names, and sums.
macro_rules! counts {
    ($(#[$about:meta])* $Counts:ident { $($(#[$what:meta])* $name:ident,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        pub struct $Counts {
            $($(#[$what])* pub $name: u64,)*
        }

        impl $Counts {
            /// The names of the counts.
            pub const NAMES: [&'static str; [$(stringify!($name)),*].len()] = [$(stringify!($name)),*];

            /// The counts in the order of their names.
            pub fn counts(&self) -> [u64; Self::NAMES.len()] {
                [$(self.$name),*]
            }
        }

        impl std::ops::AddAssign for $Counts {
            fn add_assign(&mut self, other: Self) {
                $(self.$name += other.$name;)*
            }
        }
    };
}

counts! {
/// How often bounds acted, see the table in `docs/theory/floors.md`. Counted per cell and step where nothing else is
/// said.
Clips {
    /// Cells that kept half of their slopes and of their predictor.
    halved_slopes,
    /// Faces at which HLLC found no sound speed on a side, p + π of its state not being above zero, and took 0 for it.
    clipped_roots,
    /// Mixed cells of which a face would have had a phase's density beyond a factor of five of the cell's.
    bounded_densities,
    /// Mixed cells of which a face would have had less than a tenth of the cell's pressure.
    bounded_pressures,
    /// Mixed cells of which a face would have had a gas fraction outside [0, 1].
    bounded_fractions,
    /// Faces of mixed cells on which the linear rule leaves no gas behind the wave.
    emptied_faces,
    /// Cells whose gas fraction would have left [0, 1] in the step.
    clipped_fractions,
    /// Cells of which a gas fraction, or a mass of gas per volume, below what anything feels was set to zero.
    removed_traces,
    /// Coarse cells whose children took a share of what was predicted for them: as ghosts in a step, or in adaptation.
    limited_predictions,
    /// Faces of the wall to the solid that showed it a share of their rates and slopes, per trace shown.
    scaled_traces,
    /// Cells in which a phase had less than no mass at the end of the step, and got what it lacked from the other one.
    lifted_phases,
    /// Mixed cells that the step left in tension, and of which the gas has expanded.
    expanded_cells,
    /// Cells that had no more than the viscosity that the step is stable with.
    bounded_viscosities,
    /// Cells that conducted no more heat than the step is stable with.
    bounded_conductivities,
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
    fn significance(&self, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        self.analysis.significance(cell, detail)
    }

    fn significance_everywhere(&self, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        self.analysis.significance_everywhere(cell, detail)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::conserved::{ENERGY, PHI, RHO};
    use crate::{Boundary, Mixture, Primitive, Scales};

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
        let mixture = Mixture::water_and_air();
        let scales = Scales { pressure: 1e7, density: 1000.0 };
        let analysis = Analysis {
            mixture,
            boundaries: [Boundary::Wall; 4],
            scales,
            has_phases: false,
            carried: 5..5,
            direction: None,
        };
        let counted = CountedAnalysis::new(&analysis);
        let liquid = Primitive { density: 1000.0, v_z: 0.0, v_r: 0.0, pressure: 5e7, phi: 0.0 };
        let mean = liquid.to_conserved(0.0, &mixture);
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
