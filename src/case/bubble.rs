//! What a case says of a bubble that is followed, and what of it the solver needs.

use fluid::{BubbleContent, BubbleCuts, BubbleReset, FollowedBubble, NobleAbelStiffenedGas, Shape};

use super::FluidCase;

/// `[fluid.bubble]`, its content made into a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BubbleCase {
    /// Number of the region that is the bubble.
    pub region: usize,
    /// σ in the pressure of equilibrium, N/m.
    pub surface_tension: f64,
    /// Of the vapour, Pa.
    pub vapour_pressure: f64,
    /// Of the gas in equilibrium, and of the vapour, K.
    pub temperature: f64,
    /// Cells along the present radius, if the grid follows the bubble.
    pub cells_per_radius: Option<f64>,
    /// What its gas is cut to when it is at its largest.
    pub reset: Option<ResetCase>,
}

/// `[fluid.bubble.reset]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ResetCase {
    /// The gas of this equilibrium radius, m.
    EquilibriumRadius(f64),
    /// This share of its mass.
    GasShare(f64),
}

impl BubbleCase {
    /// What is in the bubble, in a liquid of a pressure far away, Pa.
    pub fn content(&self, far_pressure: f64, gas: NobleAbelStiffenedGas) -> BubbleContent {
        BubbleContent {
            far_pressure,
            gas,
            surface_tension: self.surface_tension,
            vapour_pressure: self.vapour_pressure,
            temperature: self.temperature,
        }
    }
}

impl FluidCase {
    /// Centre (z, r) and radius of the bubble that is described, at t = 0, m.
    pub fn bubble_sphere(&self) -> Option<([f64; 2], f64)> {
        match self.initial.regions.get(self.bubble?.region)?.shape {
            Shape::Sphere { centre, radius } => Some((centre, radius)),
            Shape::Box { .. } => None,
        }
    }

    /// The bubble that the solver has to follow: if the grid does, or its gas is cut.
    pub fn followed_bubble(&self) -> Option<FollowedBubble> {
        let (bubble, (centre, radius)) = (self.bubble?, self.bubble_sphere()?);
        if bubble.cells_per_radius.is_none() && bubble.reset.is_none() {
            return None;
        }
        let content = bubble.content(self.initial.ambient.pressure, self.gas);
        let cuts = BubbleCuts::of(&self.initial);
        let number = cuts.positions().partition_point(|cut| *cut < centre[0]);
        let reset = bubble.reset.map(|reset| match reset {
            ResetCase::EquilibriumRadius(radius) => BubbleReset::EquilibriumRadius(radius, content),
            ResetCase::GasShare(share) => BubbleReset::GasShare(share),
        });
        Some(FollowedBubble { radius, cuts, number, cells_per_radius: bubble.cells_per_radius, reset })
    }

    /// The width of the finest cells at t = 0, m, by their larger one: a grid that follows a bubble may begin coarser.
    pub fn first_cell(&self) -> f64 {
        let [h_z, h_r] = self.grid.cell_size();
        let finest = self.grid.levels;
        let level = self.first_level();
        h_z.max(h_r) * ((finest - level) as f64).exp2()
    }

    /// The finest level that details may ask for at t = 0.
    pub fn first_level(&self) -> usize {
        let (grid, finest) = (&self.grid, self.grid.levels);
        let (Some(followed), Some(_)) = (self.followed_bubble(), &grid.adaptation) else { return finest };
        let [h_z, h_r] = grid.cell_size();
        let width = |level: u8| h_z.max(h_r) * ((finest - usize::from(level)) as f64).exp2();
        usize::from(followed.finest_level(followed.radius, width, finest as u8)).max(grid.root_level())
    }
}
