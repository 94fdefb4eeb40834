//! What only follows the cells: their displacement, and the rate of their plastic strain. No step depends on it, so it is kept once, not
//! before and after each step, and touched no more often than it must be.

use std::sync::{Mutex, MutexGuard, PoisonError};

use mesh::{
    Adapted, ComponentsOfCell, Field, Mesh, Misfit, Multiresolution, Patch, ScratchPool, Side, fetch,
};
use serde::{Deserialize, Serialize};

use crate::analysis::Analysis;
use crate::state::component::S_PHIPHI;

/// Own steps of a block between two of its velocities that are counted. A P wave crosses less than two cells in them, so the shortest wave
/// that the scheme carries, four cells long, still has two counts in a period and nothing is aliased; memory is what counting costs.
const EVERY: u8 = 4;

/// Displacement and rate of the plastic strain of solids that can yield.
pub(crate) struct Following {
    blocks: Vec<Mutex<Follower>>,
    numbers_of_block: usize,
}

/// What follows the cells of a block.
#[derive(Clone, Debug)]
pub(crate) struct Follower {
    /// u_z, u_r at `counted.until`, m: component by component, `[j][i]`.
    displacement: Vec<f64>,
    counted: Counted,
    /// dε_p/dt in the last step.
    pub rates: Rates,
}

/// How far the velocities of a block have been counted.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Counted {
    /// Until this time, s.
    until: f64,
    /// When the last step began that was looked at, s.
    step: f64,
    /// Steps until the next velocity is counted.
    left: u8,
}

impl Counted {
    /// Everything until a time, s; the velocities then are the next to be counted.
    fn all(until: f64) -> Self {
        Self { until, step: f64::NEG_INFINITY, left: 0 }
    }
}

/// dε_p/dt of the cells of a block, 1/s.
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
    counted: Vec<Counted>,
    rates: Field,
}

impl Following {
    /// Of a solid at t = 0 in blocks of so many cells.
    ///
    /// - `displacement`: u_z, u_r of all blocks, m.
    pub fn new(displacement: &Field, cells: usize) -> Self {
        let follower =
            |moved: &[f64]| Mutex::new(Follower::new(moved, Counted::all(0.0), Rates::zeros(cells)));
        let blocks = displacement.as_slice().chunks_exact(2 * cells).map(follower).collect();
        Self { blocks, numbers_of_block: 3 * cells }
    }

    /// How many numbers it holds.
    pub fn numbers(&self) -> usize {
        self.blocks.len() * self.numbers_of_block
    }

    /// What follows the cells of a block. The thread that steps it has it alone.
    pub fn of_block(&self, slot: usize) -> MutexGuard<'_, Follower> {
        self.blocks[slot].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The displacement of all blocks of so many cells at `time`, s.
    ///
    /// - `state`: the components of a block at that time.
    pub fn displacements<'a>(&self, cells: usize, time: f64, state: impl Fn(usize) -> &'a [f64]) -> Field {
        let mut now = Field::zeros(self.blocks.len(), cells, 2);
        for slot in 0..self.blocks.len() {
            let follower = self.of_block(slot);
            let moved = follower.displacement(time, state(slot));
            now.block_mut(slot).iter_mut().zip(moved).for_each(|(to, from)| *to = from);
        }
        now
    }

    /// Carries all of it over to another mesh; `state`: of the cells at `time`, s, on the earlier one.
    pub fn remap<const N: usize>(
        &mut self,
        adapted: &Adapted<N>,
        (mesh, state): (&Mesh<N>, &Field),
        analysis: &Analysis,
        time: f64,
    ) {
        let patches = |components| ScratchPool::new(move || Patch::<N>::zeros(components));
        // The displacement is reflected as the velocity, and has its places.
        let moved = adapted.remap(
            mesh,
            &self.displacements(N * N, time, |slot| state.block(slot)),
            analysis,
            &patches(2),
        );
        let rates = adapted.remap(mesh, &self.rates(N * N), &Scalar(analysis), &patches(1));
        self.take(&moved, |_| Counted::all(time), &rates);
    }

    fn rates(&self, cells: usize) -> Field {
        let mut field = Field::zeros(self.blocks.len(), cells, 1);
        for slot in 0..self.blocks.len() {
            let follower = self.of_block(slot);
            if !follower.rates.is_zero {
                field.block_mut(slot).copy_from_slice(&follower.rates.cells);
            }
        }
        field
    }

    fn take(&mut self, displacement: &Field, counted: impl Fn(usize) -> Counted, rates: &Field) {
        let blocks = displacement.as_slice().chunks_exact(displacement.block_len());
        let rates = rates.as_slice().chunks_exact(rates.block_len());
        let follower =
            |(slot, (moved, rates))| Mutex::new(Follower::new(moved, counted(slot), Rates::of(rates)));
        self.blocks.clear();
        self.blocks.extend(blocks.zip(rates).enumerate().map(follower));
    }

    /// What of it changes in time.
    pub fn saved(&self) -> SavedFollowing {
        let cells = self.numbers_of_block / 3;
        let mut displacement = Field::zeros(self.blocks.len(), cells, 2);
        let mut counted = Vec::with_capacity(self.blocks.len());
        for slot in 0..self.blocks.len() {
            let follower = self.of_block(slot);
            displacement.block_mut(slot).copy_from_slice(&follower.displacement);
            counted.push(follower.counted);
        }
        SavedFollowing { displacement, counted, rates: self.rates(cells) }
    }

    /// Takes up what was saved of a mesh of so many blocks.
    pub fn restore(&mut self, saved: &SavedFollowing, blocks: usize) -> Result<(), Misfit> {
        let SavedFollowing { displacement, counted, rates } = saved;
        let cells = self.numbers_of_block / 3;
        let fits = displacement.has_shape(blocks, cells, 2) && rates.has_shape(blocks, cells, 1);
        if !fits || counted.len() != blocks {
            return Err(Misfit(format!("the displacement is not of {blocks} blocks")));
        }
        self.take(displacement, |slot| counted[slot], rates);
        Ok(())
    }
}

impl Follower {
    fn new(displacement: &[f64], counted: Counted, rates: Rates) -> Self {
        Self { displacement: displacement.to_vec(), counted, rates }
    }

    /// Counts the velocities that a block begins a step with, if it is their turn: they stand for half of the time since those counted before
    /// and half of the time until the next, so that in sum the trapezoidal rule is made, in steps of the block's own.
    ///
    /// A step that is tried again begins with the same velocities and counts nothing.
    ///
    /// - `state`: of the block at `time`, s, velocities first. `dt`: of its step, s.
    /// - tested by: the displacement of a moving solid in irregular steps, some of them tried twice; pits.
    #[inline]
    pub fn count(&mut self, time: f64, dt: f64, state: &[f64]) {
        let Counted { until, step, left } = self.counted;
        if time <= step {
            return;
        }
        (self.counted.step, self.counted.left) = (time, if left == 0 { EVERY - 1 } else { left - 1 });
        if left == 0 {
            self.counted.until = time + 0.5 * f64::from(EVERY) * dt;
            let weight = self.counted.until - until;
            self.displacement.iter_mut().zip(state).for_each(|(u, v)| *u += weight * v);
        }
    }

    /// Asks for a part of the memory that the step is likely to need.
    pub fn look_ahead(&self, part: usize, parts: usize) {
        if self.counted.left == 0 {
            fetch(&self.displacement, part, parts);
        }
        // What flowed goes on with it.
        if !self.rates.is_zero {
            fetch(&self.rates.cells, part, parts);
        }
    }

    /// u_z, u_r at `time`, s, component by component.
    ///
    /// - `state`: of the block at that time.
    pub fn displacement<'a>(&'a self, time: f64, state: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let since = time - self.counted.until;
        self.displacement.iter().zip(state).map(move |(u, v)| u + since * v)
    }
}

impl Rates {
    fn zeros(cells: usize) -> Self {
        Self { is_zero: true, cells: vec![0.0; cells] }
    }

    fn of(cells: &[f64]) -> Self {
        // A parabola may lead below zero.
        let cells: Vec<f64> = cells.iter().map(|rate| rate.max(0.0)).collect();
        Self { is_zero: cells.iter().all(|rate| *rate == 0.0), cells }
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

    fn significance(&self, _: &ComponentsOfCell, _: &ComponentsOfCell) -> f64 {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// v = ω sin ωt: irregular steps give 1 − cos ωt to second order at all times, also where one is tried twice.
    #[test]
    fn irregular_steps_integrate_the_velocity() {
        let far = |steps: usize| -> f64 {
            let omega = 2.0;
            let mut follower = Follower::new(&[0.0; 128], Counted::all(0.0), Rates::zeros(64));
            let (mut state, mut time, mut worst) = ([0.0; 384], 0.0, 0.0_f64);
            for step in 1..=steps {
                let dt =
                    std::f64::consts::TAU / omega / steps as f64 * (1.0 + 0.4 * (step as f64 * 1.7).sin());
                follower.count(time, dt, &state);
                if step % 3 == 0 {
                    follower.count(time, dt, &state);
                }
                time += dt;
                state[..128].fill(omega * (omega * time).sin());
                let moved = follower.displacement(time, &state).next().unwrap_or(f64::NAN);
                worst = worst.max((moved - (1.0 - (omega * time).cos())).abs());
            }
            worst
        };
        // As many of them are counted in a period.
        let [coarse, fine] = [50, 200].map(|counted| far(usize::from(EVERY) * counted));
        assert!(coarse < 0.01 && fine < 0.08 * coarse, "{coarse} {fine}");
    }
}
