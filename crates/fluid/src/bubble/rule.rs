//! Which bubble is followed, what its gas is cut to, and what came of that.

use serde::{Deserialize, Serialize};

use super::content::BubbleContent;
use crate::BubbleCuts;

/// What a bubble's gas is cut to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BubbleReset {
    /// The gas of another equilibrium radius, m, and vapour at its pressure.
    EquilibriumRadius(f64, BubbleContent),
    /// This share of its mass.
    GasShare(f64),
}

/// A cut of a bubble's gas. Masses and energies as those of [`crate::Totals`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ResetReport {
    /// When, s.
    pub time: f64,
    /// The bubble's radius then, m, also of one that a plane cuts.
    pub radius: f64,
    /// The volume of its gas, m³.
    pub volume: f64,
    /// Mean pressure of its gas before and after, Pa.
    pub pressure: [f64; 2],
    /// Mass of its gas before and after, kg.
    pub gas_mass: [f64; 2],
    /// Mass that came with it (below zero: left).
    pub mass: f64,
    /// Axial momentum, likewise.
    pub momentum_z: f64,
    /// Energy, likewise.
    pub energy: f64,
}

/// Which bubble is followed, and what is done with it.
#[derive(Clone, Debug, PartialEq)]
pub struct FollowedBubble {
    /// Its radius at t = 0, m.
    pub radius: f64,
    /// How the bubbles are told apart.
    pub cuts: BubbleCuts,
    /// Its number among them, from 0.
    pub number: usize,
    /// Cells along its present radius: details ask for no finer level than the first one that has as many.
    pub cells_per_radius: Option<f64>,
    /// What its gas is cut to when it is at its largest for the first time.
    pub reset: Option<BubbleReset>,
}

impl FollowedBubble {
    /// The level that details may ask for at the most while the bubble has a radius.
    ///
    /// - `width`: of the cells of a level, m; `finest`: the level above which there is none.
    #[must_use]
    pub fn finest_level(&self, radius: f64, width: impl Fn(u8) -> f64, finest: u8) -> u8 {
        let Some(cells) = self.cells_per_radius else { return finest };
        // A radius that is a whole number of cells but for round-off.
        let is_enough = |level: &u8| width(*level) * cells <= radius * (1.0 + 1e-9);
        (0..finest).find(is_enough).unwrap_or(finest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_finest_level_has_as_many_cells_per_radius_as_asked() {
        let followed = |cells: Option<f64>| FollowedBubble {
            radius: 1.0,
            cuts: BubbleCuts::default(),
            number: 0,
            cells_per_radius: cells,
            reset: None,
        };
        let width = |level: u8| 1.0 / f64::from(1u32 << level);
        let level = |radius: f64, cells| followed(cells).finest_level(radius, width, 6);
        assert_eq!(level(1.0, None), 6);
        assert_eq!(level(1.0, Some(16.0)), 4);
        assert_eq!(level(1.0 - 1e-12, Some(16.0)), 4, "but for round-off");
        assert_eq!(level(0.99, Some(16.0)), 5);
        assert_eq!(level(100.0, Some(16.0)), 0);
        assert_eq!(level(1e-3, Some(16.0)), 6, "there is none finer");
        assert_eq!(level(0.0, Some(16.0)), 6);
    }
}
