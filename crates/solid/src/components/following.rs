//! What only follows the cells: their displacement, and the rate of their plastic strain. No step depends on it, so it is kept once, not
//! before and after each step, and touched no more often than it must be.

use std::sync::{Mutex, MutexGuard, PoisonError};

use mesh::{Adapted, Field, Mesh, Misfit, Multiresolution, Patch, ScratchPool, Side, for_some_blocks};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;
use crate::state::component::S_PHIPHI;

/// Steps of the finest level between two looks at the velocities. At the Courant numbers of a solid a P wave goes about a cell in them.
const EVERY: u64 = 4;

/// Displacement and rate of the plastic strain of solids that can yield.
pub(crate) struct Following {
    /// u_z, u_r of all blocks, m.
    displacement: Field,
    /// The time up to which velocities have been counted, s: half an interval beyond the last look.
    counted: f64,
    /// Time (s) and step of the last look.
    last: (f64, u64),
    rates: Vec<Mutex<Rates>>,
}

/// dε_p/dt in a block's last step, 1/s.
#[derive(Clone, Debug)]
pub(crate) struct Rates {
    /// Whether all are zero; their cells then need not be looked at.
    pub is_zero: bool,
    /// `[j][i]`.
    pub cells: Vec<f64>,
}

/// What of it changes in time.
#[derive(Serialize, Deserialize)]
pub(crate) struct SavedFollowing {
    displacement: Field,
    counted: f64,
    last: (f64, u64),
    rates: Field,
}

impl Following {
    /// Of a solid at t = 0 in blocks of so many cells.
    ///
    /// - `displacement`: u_z, u_r of all blocks, m.
    pub fn new(displacement: Field, cells: usize) -> Self {
        let blocks = displacement.as_slice().len() / displacement.block_len();
        let rates = (0..blocks).map(|_| Mutex::new(Rates::zeros(cells))).collect();
        Self { displacement, counted: 0.0, last: (0.0, 0), rates }
    }

    /// Counts the velocities at the end of a whole step, if it is time to.
    ///
    /// The midpoint rule: a velocity stands for the time from half an interval before the look to half of one after it. What the next
    /// interval is longer or shorter than foreseen, the next velocity counts.
    ///
    /// - `state`: of all blocks at `time`, s, after so many `steps` of the finest level.
    /// - tested by: the displacement of a moving solid at looks in irregular distances.
    pub fn look(&mut self, time: f64, steps: u64, state: &Field) {
        if steps < self.last.1 + EVERY {
            return;
        }
        let next = time + 0.5 * (time - self.last.0);
        let weight = next - self.counted;
        (self.counted, self.last) = (next, (time, steps));
        let both = self.displacement.block_len();
        let blocks = self.displacement.as_slice().len() / both;
        let mut reports = vec![(); blocks];
        for_some_blocks(
            &mut self.displacement,
            &mut reports,
            |_| true,
            |slot, moved, ()| {
                // Velocities are the first two components.
                let velocities = &state.block(slot)[..both];
                moved.iter_mut().zip(velocities).for_each(|(u, v)| *u += weight * v);
            },
        );
    }

    /// (u_z, u_r) of the cells of a block at `time`, s, component by component.
    pub fn displacement<'a>(
        &'a self,
        slot: usize,
        time: f64,
        state: &'a Field,
    ) -> impl Iterator<Item = f64> + 'a {
        let since = time - self.counted;
        let moved = self.displacement.block(slot);
        moved.iter().zip(state.block(slot)).map(move |(u, v)| u + since * v)
    }

    /// (u_z, u_r) of one cell of a block, likewise.
    pub fn of_cell(&self, slot: usize, cell: usize, time: f64, state: &Field) -> [f64; 2] {
        let since = time - self.counted;
        [0, 1].map(|c| self.displacement.component(slot, c)[cell] + since * state.component(slot, c)[cell])
    }

    /// [`Following::displacement`] of all blocks.
    pub fn displacements(&self, time: f64, state: &Field) -> Field {
        let mut now = self.displacement.clone();
        for slot in 0..self.rates.len() {
            let moved = self.displacement(slot, time, state);
            now.block_mut(slot).iter_mut().zip(moved).for_each(|(to, from)| *to = from);
        }
        now
    }

    /// The rates of a block. The thread that steps it has them alone.
    pub fn rates(&self, slot: usize) -> MutexGuard<'_, Rates> {
        self.rates[slot].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Carries all of it over to another mesh.
    pub fn remap<const N: usize>(&mut self, adapted: &Adapted<N>, mesh: &Mesh<N>, analysis: &Analysis) {
        let patches = |components| ScratchPool::new(move || Patch::<N>::zeros(components));
        // The displacement is reflected as the velocity, and has its places.
        self.displacement = adapted.remap(mesh, &self.displacement, analysis, &patches(2));
        let rates = adapted.remap(mesh, &self.all_rates(N * N), &Scalar(analysis), &patches(1));
        self.set_rates(&rates);
    }

    fn all_rates(&self, cells: usize) -> Field {
        let mut field = Field::zeros(self.rates.len(), cells, 1);
        for slot in 0..self.rates.len() {
            let rates = self.rates(slot);
            if !rates.is_zero {
                field.block_mut(slot).copy_from_slice(&rates.cells);
            }
        }
        field
    }

    fn set_rates(&mut self, field: &Field) {
        let cells = field.block_len();
        let of_block = |block: &[f64]| {
            let is_zero = block.iter().all(|rate| *rate == 0.0);
            // A parabola may lead below zero.
            Mutex::new(Rates { is_zero, cells: block.iter().map(|rate| rate.max(0.0)).collect() })
        };
        self.rates.clear();
        self.rates.extend(field.as_slice().chunks_exact(cells).map(of_block));
    }

    /// What of it changes in time.
    pub fn saved(&self) -> SavedFollowing {
        let cells = self.displacement.block_len() / self.displacement.components();
        let Self { displacement, counted, last, rates: _ } = self;
        SavedFollowing {
            displacement: displacement.clone(),
            counted: *counted,
            last: *last,
            rates: self.all_rates(cells),
        }
    }

    /// Takes up what was saved of a mesh of so many blocks.
    pub fn restore(&mut self, saved: SavedFollowing, blocks: usize) -> Result<(), Misfit> {
        let SavedFollowing { displacement, counted, last, rates } = saved;
        let cells = self.displacement.block_len() / 2;
        if !displacement.has_shape(blocks, cells, 2) || !rates.has_shape(blocks, cells, 1) {
            return Err(Misfit(format!("the displacement is not of {blocks} blocks")));
        }
        (self.displacement, self.counted, self.last) = (displacement, counted, last);
        self.set_rates(&rates);
        Ok(())
    }
}

impl Rates {
    fn zeros(cells: usize) -> Self {
        Self { is_zero: true, cells: vec![0.0; cells] }
    }

    /// Sets all to zero.
    pub fn clear(&mut self) {
        if !self.is_zero {
            self.cells.fill(0.0);
            self.is_zero = true;
        }
    }
}

/// A field that is reflected as a number without a direction.
struct Scalar<'a>(&'a Analysis);

impl Multiresolution for Scalar<'_> {
    fn parity(&self, side: Side, _: usize) -> Option<f64> {
        self.0.parity(side, S_PHIPHI)
    }

    fn share(&self, _: &[f64], _: &[[f64; mesh::MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    fn significance(&self, _: &[f64], _: &[f64]) -> f64 {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v = ω sin ωt: looks at irregular times give 1 − cos ωt to second order, and at the end of the motion nothing is missing.
    #[test]
    fn irregular_looks_integrate_the_velocity() {
        let far = |steps: usize| -> f64 {
            let omega = 2.0;
            let mut following = Following::new(Field::zeros(1, 64, 2), 64);
            let mut state = Field::zeros(1, 64, 6);
            let (mut time, mut worst) = (0.0, 0.0_f64);
            for step in 1..=steps {
                time +=
                    std::f64::consts::TAU / omega / steps as f64 * (1.0 + 0.4 * (step as f64 * 1.7).sin());
                state.block_mut(0)[..128].fill(omega * (omega * time).sin());
                following.look(time, step as u64, &state);
                let moved = following.displacement(0, time, &state).next().unwrap_or(f64::NAN);
                worst = worst.max((moved - (1.0 - (omega * time).cos())).abs());
            }
            worst
        };
        let [coarse, fine] = [far(160), far(640)];
        assert!(coarse < 0.02 && fine < 0.1 * coarse, "{coarse} {fine}");
    }
}
