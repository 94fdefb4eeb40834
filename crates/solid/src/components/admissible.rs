//! Prolongation that leaves no cell outside its yield surface.

use mesh::{ComponentsOfCell, MOST_COMPONENTS, Multiresolution, Side};

use super::{PLASTIC_STRAIN, TEMPERATURE};
use crate::analysis::Analysis;
use crate::plasticity::{Plasticity, Stress};
use crate::state::component::{S_NORMAL, S_PHIPHI, S_ZR};

/// The analysis of a solid that can yield, for cells that are going to stay: children of a cell take as large a share of the
/// predicted deviations as keeps all of them within their yield surfaces.
///
/// q is convex in the stress and Y concave in ε_p, so q − Y is convex along the share: the root of a chord between a share
/// that is admissible and one that is not is admissible. Where a cell's mean is on the surface, that share is zero unless
/// its children only differ in ways that do not matter. Restriction needs nothing: q of a mean is at most the mean
/// of q, that at most the mean of Y, and that at most Y of the mean (Jensen).
pub(crate) struct Admissible<'a> {
    pub analysis: &'a Analysis,
    pub plasticity: &'a Plasticity,
}

impl Admissible<'_> {
    /// q − Y at no rate, Pa, of a cell `share` of its deviations away from the mean.
    fn beyond(&self, mean: &[f64], deviations: &[f64; MOST_COMPONENTS], share: f64) -> f64 {
        let at = |c: usize| mean[c] + share * deviations[c];
        let [zz, rr] = S_NORMAL.map(at);
        let stress = Stress { zz, zr: at(S_ZR), rr, phiphi: at(S_PHIPHI) };
        let temperature = if self.plasticity.has_heat() { at(TEMPERATURE) } else { 0.0 };
        let strength =
            self.plasticity.hardening().yield_stress(at(PLASTIC_STRAIN).max(0.0), 0.0, temperature);
        stress.von_mises_squared().sqrt() - strength
    }

    /// The share, at most `most`, with which one child is admissible.
    fn share_of(&self, mean: &[f64], deviations: &[f64; MOST_COMPONENTS], most: f64, overstress: f64) -> f64 {
        const CHORDS: usize = 6;
        let beyond = |share: f64| self.beyond(mean, deviations, share) - overstress;
        let (mut low, mut high) =
            ((0.0, self.beyond(mean, deviations, 0.0) - overstress), (most, beyond(most)));
        if high.1 <= 0.0 {
            return most;
        }
        for _ in 0..CHORDS {
            let root = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let end = (root, beyond(root));
            if end.1 <= 0.0 {
                low = end;
            } else {
                high = end;
            }
        }
        low.0
    }
}

impl Multiresolution for Admissible<'_> {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        self.analysis.parity(side, component)
    }

    fn counts_beside(&self, side: Side) -> bool {
        self.analysis.counts_beside(side)
    }

    fn share(&self, mean: &[f64], deviations: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        let mut share: f64 = 1.0;
        for d in deviations {
            let own = mean[PLASTIC_STRAIN].max(0.0);
            if d[PLASTIC_STRAIN] < -own {
                share = share.min(own / -d[PLASTIC_STRAIN]);
            }
        }
        // What a law with rate holds beyond its surface may be in the children, too.
        let overstress = self.beyond(mean, &deviations[0], 0.0).max(0.0);
        deviations.iter().fold(share, |share, d| self.share_of(mean, d, share, overstress))
    }

    fn significance(&self, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        self.analysis.significance(cell, detail)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plasticity::Hardening;
    use crate::{Boundary, WaveSpeeds};

    #[test]
    fn children_stay_within_their_yield_surfaces() {
        let speeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };
        let plasticity =
            Plasticity::new(Hardening::linear(4e8, 8e9).unwrap_or_else(|e| panic!("{e}")), speeds);
        let analysis = Analysis {
            boundaries: [Boundary::Free; 4],
            stress_scale: 1e6,
            impedances: [speeds.z1(), speeds.z2()],
            direction: None,
            strain_modulus: 3.0 * speeds.shear_modulus(),
        };
        let rule = Admissible { analysis: &analysis, plasticity: &plasticity };
        for size in [1e7, 3e8, 2e9] {
            let mean = [0.0, 0.0, 2e8, 0.0, -1e8, 0.0, 1e-3];
            let deviations: [[f64; MOST_COMPONENTS]; 4] = std::array::from_fn(|child| {
                let sign = if child % 2 == 0 { 1.0 } else { -1.0 };
                let mut d = [0.0; MOST_COMPONENTS];
                d[..7].copy_from_slice(&[
                    1.0,
                    0.0,
                    sign * size,
                    0.2 * size,
                    0.0,
                    0.3 * sign * size,
                    -sign * 2e-3,
                ]);
                d
            });
            let share = rule.share(&mean, &deviations);
            assert!(share <= 0.5 && share > 0.01, "{share}");
            for d in &deviations {
                assert!(rule.beyond(&mean, d, share) <= 0.0, "{size}: {share}");
                assert!(mean[6] + share * d[6] >= 0.0, "{share}");
            }
            // Larger by a tenth, and one is outside, or has less than no plastic strain.
            let larger = 1.1 * share;
            assert!(
                deviations
                    .iter()
                    .any(|d| rule.beyond(&mean, d, larger) > 0.0 || mean[6] + larger * d[6] < 0.0)
            );
        }
    }
}
