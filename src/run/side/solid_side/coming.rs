//! What the solid tells the fluid of waves that are about to come through the interface.

use mesh::{BLOCK, Side};
use solid::{ComingWaves, SolidSolver};

use crate::case::Case;
use crate::run::side::coupled_solver::StepRule;

/// So many of the longest exchanges ahead: the one that is being answered, that which is planned from the answer, and one to find time in.
const EXCHANGES: f64 = 3.0;

/// Which waves count for the fluid's grid.
#[derive(Clone, Copy, Debug)]
pub struct WavesForFluid {
    /// The smallest detail of a wave's pressure in the solid that counts in the fluid on its finest level, Pa. (Where the grid follows a bubble
    /// details of the fluid count from larger ones on: more is demanded than it would keep.)
    least: f64,
    /// How long waves take from cell to cell there, s.
    finest: f64,
    /// The same on the coarsest.
    coarsest: f64,
}

impl WavesForFluid {
    /// Of a case whose fluid has levels and a solid below it.
    pub fn of(case: &Case) -> Option<Self> {
        let (fluid, solid) = (case.fluid.as_ref()?, case.solid.as_ref()?);
        let grid = &fluid.grid;
        if grid.adaptation.is_none() || grid.levels == 0 {
            return None;
        }
        let sound = fluid.ambient_sound();
        let impedances =
            [fluid.initial.ambient.density * sound, solid.material.density() * solid.material.c1()];
        // What of a wave's pressure in the solid is left of it in the fluid.
        let passed = 2.0 * impedances[0] / (impedances[0] + impedances[1]);
        let finest = grid.cell_size()[Side::ZMin.axis_across()] / sound;
        Some(Self {
            least: fluid.scale_pressure * fluid.wave_epsilon / passed,
            finest,
            coarsest: finest * f64::powi(2.0, grid.levels as i32),
        })
    }

    /// What the header of a frame says, see [`coupler::FrameHeader::coming`].
    pub fn told(&self, solver: &SolidSolver<BLOCK>, rule: &StepRule) -> ComingWaves {
        let within = EXCHANGES * rule.most_steps() * solver.time_step_limit(rule.cfl);
        // Thresholds of coarser levels are smaller, see [`mesh::Adaptation::epsilon`].
        let least = |time: f64| self.least * (self.finest / time).min(1.0);
        solver.coming_waves(within, self.coarsest, least)
    }
}
