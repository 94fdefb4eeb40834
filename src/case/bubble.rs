//! What a case says of a bubble that is followed, and what of it the solver needs.

use fluid::{
    BubbleContent, BubbleCuts, BubbleReset, FollowedBubble, NobleAbelStiffenedGas, PhaseState, Shape,
};

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
    /// The ambient state at a height: under gravity of the hydrostatic pressure there.
    pub fn ambient_at(&self, z: f64) -> PhaseState {
        let ambient = self.initial.ambient;
        self.gravity.map_or(ambient, |gravity| gravity.at_height(ambient, z))
    }

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
        let content = bubble.content(self.ambient_at(centre[0]).pressure, self.gas);
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
        let radius = self.bubble_sphere().map_or(f64::INFINITY, |(_, radius)| radius);
        self.level_about(radius)
    }

    /// The finest level that details may ask for when the bubble has a radius, m.
    pub fn level_about(&self, radius: f64) -> usize {
        let (grid, finest) = (&self.grid, self.grid.levels);
        let (Some(followed), Some(_)) = (self.followed_bubble(), &grid.adaptation) else { return finest };
        let [h_z, h_r] = grid.cell_size();
        let width = |level: u8| h_z.max(h_r) * ((finest - usize::from(level)) as f64).exp2();
        usize::from(followed.finest_level(radius, width, finest as u8)).max(grid.root_level())
    }
}

#[cfg(test)]
mod tests {
    use super::super::Case;

    #[test]
    fn a_bubble_is_in_the_liquid_of_its_height() {
        let text = "[time]\nend = 1e-6\n[fluid]\nz = [0.0, 16e-3]\nr = [0.0, 8e-3]\ncells = [64, 32]\ngravity = -1e5\n\
                    [fluid.liquid]\ngamma = 7.15\npi = 3e8\n[fluid.ambient]\ndensity = 1000.0\npressure = 2e6\n\
                    [fluid.bubble]\ncentre = [8e-3, 0.0]\nradius = 1e-3\nequilibrium_radius = 1e-3\n\
                    [coupling]\nscheme = \"rigid\"\n";
        let read = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            Case::from_toml(text, "deep", &sets).map(|case| case.fluid.expect("a fluid"))
        };
        let fluid = read(&[]).unwrap_or_else(|errors| panic!("{errors}"));
        // ρgh is 0.8 MPa.
        assert!((fluid.initial.regions[0].state.pressure - 1.2e6).abs() < 1e-6);
        assert!((fluid.ambient_at(8e-3).pressure - 1.2e6).abs() < 1e-6);
        let grows = ["fluid.bubble={ centre = [8e-3, 0.0], radius_max = 1e-3, gas_pressure = 1.5e6 }"];
        assert!(
            read(&grows).is_err_and(|errors| errors.to_string().contains("not less than the liquid's 12"))
        );
    }
}
