//! Waves that are about to come out of the surface, for the grid of what is beyond it.

use mesh::{BLOCK, BlockSolver, Side, largest_detail};

use crate::physics::Solid;
use crate::state::component::{S_NORMAL, V_Z};
use crate::{Boundary, SolidSolver};

/// Every so many columns of a block are looked at.
const COLUMNS_APART: usize = 4;
/// And so many rows, from the upper end on: waves along the surface.
const ROWS: usize = 2;

/// How fast third-order details of smooth waves grow from level to coarser level.
const GROWTH: f64 = 8.0;

/// Waves that come: how long they take over a cell that carries them, s, and how far from r_min on there are any that need one so short, m;
/// the shortest first, each twice as long as the one before. Zeros where there are no more.
pub type ComingWaves = [[f64; 2]; 4];

impl SolidSolver<BLOCK> {
    /// The waves that will have reached the surface within a time: what runs upwards has the pressure ½(ρ̄c₁v_z − σ_zz), and cells must
    /// be as short as makes its details small.
    ///
    /// Details on the level of a block are known; those of coarser cells, of a smooth wave, are eight times as large with each level.
    ///
    /// - `within`: s; `longest`: waves that cells so long carry are left out, s; `least`: the detail that counts on cells so long, Pa.
    pub fn coming_waves(&self, within: f64, longest: f64, least: impl Fn(f64) -> f64) -> ComingWaves {
        let blocks: &BlockSolver<Solid, BLOCK> = self;
        let speeds = self.setup().speeds;
        let mut found = Vec::new();
        if self.setup().boundaries[Side::ZMax as usize] != Boundary::Interface {
            return ComingWaves::default();
        }
        let (mesh, surface) = (blocks.mesh(), blocks.mesh().domain().z[1]);
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            let (origin, widths) = (mesh.origin(*id), mesh.widths(id.level));
            let [top, end] = [0, 1].map(|axis| origin[axis] + BLOCK as f64 * widths[axis]);
            let reach = end - mesh.domain().r[0];
            if surface - top > within * speeds.c1 {
                continue;
            }
            let time = widths[0] / speeds.c1;
            let [own, pairs] = largest_details(blocks, slot, speeds.z1());
            if own > least(time) {
                found.push([time, reach]);
                continue;
            }
            let (mut time, mut detail) = (2.0 * time, pairs);
            while time < longest && detail <= least(time) {
                (time, detail) = (2.0 * time, GROWTH * detail);
            }
            if time < longest {
                found.push([time, reach]);
            }
        }
        staircase(&found)
    }
}

/// How far cells of which times are needed: four of them at the most, each twice the one before.
fn staircase(found: &[[f64; 2]]) -> ComingWaves {
    let shortest = found.iter().fold(f64::INFINITY, |shortest, [time, _]| shortest.min(*time));
    let mut coming = ComingWaves::default();
    if found.is_empty() {
        return coming;
    }
    let last = coming.len() - 1;
    for (step, [time, reach]) in coming.iter_mut().enumerate() {
        *time = shortest * f64::from(1_u32 << step);
        // What would need a fifth gets the fourth.
        let is_served = |needed: f64| needed < 1.5 * *time || step == last;
        *reach = found
            .iter()
            .filter(|[needed, _]| is_served(*needed))
            .fold(0.0, |most: f64, row| most.max(row[1]));
    }
    coming
}

/// The largest third-order details of the pressure of what runs upwards in a block: of its cells, and of pairs of them. What stands has
/// stresses, too; what runs has velocities as large, but at t = 0, when nothing has moved yet.
fn largest_details(blocks: &BlockSolver<Solid, BLOCK>, slot: usize, impedance: f64) -> [f64; 2] {
    let (velocity, stress) = (blocks.component(slot, V_Z), blocks.component(slot, S_NORMAL[0]));
    let columns = (0..BLOCK).step_by(COLUMNS_APART).map(|j| std::array::from_fn(|i| j * BLOCK + i));
    let rows = (0..ROWS).map(|row| std::array::from_fn(|j| j * BLOCK + BLOCK - 1 - row * BLOCK / ROWS));
    let mut largest = [0.0_f64; 2];
    for cells in columns.chain(rows) {
        let cells: [usize; BLOCK] = cells;
        let moving = cells.map(|cell| impedance * velocity[cell]);
        let upwards: [f64; BLOCK] = std::array::from_fn(|k| 0.5 * (moving[k] - stress[cells[k]]));
        let [of_moving, of_upwards] = [moving, upwards].map(|line| {
            let pairs: [f64; BLOCK / 2] = std::array::from_fn(|k| 0.5 * (line[2 * k] + line[2 * k + 1]));
            [largest_detail(&line), largest_detail(&pairs)]
        });
        let bound = |level: usize| if blocks.time() > 0.0 { of_moving[level] } else { f64::INFINITY };
        largest = std::array::from_fn(|level| bound(level).min(of_upwards[level]).max(largest[level]));
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_step_reaches_as_far_as_what_needs_cells_so_short() {
        assert_eq!(staircase(&[]), ComingWaves::default());
        let found = [[4.0, 7.0], [1.0, 2.0], [1.0, 3.0], [2.0, 1.0], [64.0, 9.0]];
        assert_eq!(staircase(&found), [[1.0, 3.0], [2.0, 3.0], [4.0, 7.0], [8.0, 9.0]]);
    }
}
