//! What a block's step needs to know of surface tension, made once at its beginning.

use mesh::{Field, GHOSTS, Mesh, Padded, Side};

use super::block::BlockCurvature;
use super::jumps::{FaceJumps, Tension, share_of_jump};
use super::patch::WidePatch;
use crate::reconstruction::Rows;
use crate::step::update::Metric;
use crate::two_phase::{Compression, is_compliant, is_mixed, phase_densities};
use crate::{Boundary, Mixture};

/// A block whose interfaces have a tension.
#[derive(Clone, Copy)]
pub(crate) struct Interfaces<'a, const N: usize> {
    pub mesh: &'a Mesh<N>,
    /// The cells at the beginning of the step.
    pub field: &'a Field,
    pub slot: usize,
    /// What bounds the domain.
    pub kinds: [Boundary; 4],
    pub mixture: &'a Mixture,
    /// σ, N/m.
    pub tension: f64,
    /// Whether traces of gas count as one phase, as in the five-equation model.
    pub has_phases: bool,
    /// Whether the gas fraction follows the closure of the phases' compression.
    pub has_closure: bool,
}

/// Gas fractions of two cells that differ by less have no interface between them. With 1e-6 pressures do not balance beside the last
/// step that counts, and currents about a ball at rest are twice as fast by R/U.
const LEAST_STEP: f64 = 1e-9;

/// The same in the paper's mixture, where traces count wherever they are: with 1e-9 and `"hllc-lm"` its bubbles oscillate 2 % too fast, and its
/// drops gain height.
const LEAST_STEP_OF_MIXTURE: f64 = 1e-6;

/// How much a cell's curvature counts on its faces besides φ(1 − φ).
const LEAST_WEIGHT: f64 = 1e-3;

/// What is known of a cell's curvature, 1/m: from heights, if it has any, and without them.
#[derive(Clone, Copy, Debug, Default)]
struct Known {
    heights: Option<Option<f64>>,
    normals: Option<f64>,
}

/// The jumps of a padded block; thread-local, and without any memory where no case asks for it.
#[derive(Clone, Debug, Default)]
pub(crate) struct CapillaryRows {
    patch: WidePatch,
    known: Vec<Known>,
    /// Faces with a jump: the cell below, the step to that above.
    found: Vec<(usize, usize, Tension)>,
    /// ψ of the cells.
    share: Vec<f64>,
    /// J beside the faces along z and r, and what the pressure rises by across them, Pa.
    tension: [Vec<Tension>; 2],
    jump: [Vec<f64>; 2],
    /// J of the cells, Pa: the largest beside their faces.
    own: Vec<f64>,
    /// (1 − ψ)J: by how much the pressure of the cells' gas exceeds that of the cells, Pa.
    excess: Vec<f64>,
    /// What tension takes from a cell's energy per unit of its dilatation, Pa, see [`CapillaryRows::for_gains`].
    stretched: Vec<f64>,
    /// Cells of the block and of the first layer around it that have a face with a jump.
    cells: Vec<usize>,
    is_present: bool,
}

impl CapillaryRows {
    /// Whether the block has any jump.
    pub fn is_present(&self) -> bool {
        self.is_present
    }

    /// There is none in the block.
    pub fn clear(&mut self) {
        self.is_present = false;
    }

    /// The faces along an axis (0: z, 1: r); `None` where none has a jump.
    pub fn along<const N: usize>(&self, axis: usize) -> Option<FaceJumps<'_>> {
        self.is_present.then(|| FaceJumps {
            tension: &self.tension[axis],
            jump: &self.jump[axis],
            share: &self.share,
            step: if axis == 0 { 1 } else { Padded::<N>::STRIDE },
        })
    }

    /// What the pressure rises by on the faces along z and r, Pa; `None` where there is none.
    pub fn jumps(&self) -> Option<[&[f64]; 2]> {
        self.is_present.then(|| [&self.jump[0][..], &self.jump[1][..]])
    }

    /// By how much the pressure of the padded cells' gas exceeds that of the cells, Pa; `None` where it does nowhere.
    pub fn excess(&self) -> Option<&[f64]> {
        self.is_present.then_some(&self.excess)
    }

    /// The padded cells that have a face with a jump.
    pub fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// J of a padded cell of the block, Pa: by how much the pressure of its gas exceeds that of its liquid.
    pub fn jump(&self, k: usize) -> f64 {
        if self.is_present { self.own[k] } else { 0.0 }
    }

    /// Finds the jumps of a block.
    ///
    /// - `cells`: the padded cells, primitive; `gas_shares`: the gas's part of their mass.
    pub fn find<const N: usize>(&mut self, block: &Interfaces<'_, N>, cells: Rows<'_>, gas_shares: &[f64]) {
        let [density, _, _, pressure, phi] = cells;
        self.clear();
        self.find_faces(block, pressure, phi);
        if self.found.is_empty() {
            return;
        }
        self.is_present = true;
        let len = Padded::<N>::LEN;
        for (tension, jump) in self.tension.iter_mut().zip(&mut self.jump) {
            tension.clear();
            tension.resize(len, Tension::default());
            jump.clear();
            jump.resize(len, 0.0);
        }
        for row in [&mut self.own, &mut self.excess, &mut self.stretched] {
            row.clear();
            row.resize(len, 0.0);
        }
        self.share.clear();
        let shares =
            (0..len).map(|k| share_of_jump(phi[k], density[k], density[k] * gas_shares[k], block.mixture));
        self.share.extend(shares);
        for &(k, step, tension) in &self.found {
            let axis = usize::from(step != 1);
            self.tension[axis][k] = tension;
            for (cell, own) in [k, k + step].into_iter().zip(tension.of_cells) {
                if own.abs() > self.own[cell].abs() {
                    self.own[cell] = own;
                }
            }
            self.jump[axis][k] = tension.rise([self.share[k], self.share[k + step]]);
        }
        self.list_cells::<N>();
        if !block.has_closure {
            return;
        }
        for &k in &self.cells {
            let excess = (1.0 - self.share[k]) * self.own[k];
            let densities = phase_densities(density[k], gas_shares[k], phi[k], block.mixture);
            let closure = Compression::at(pressure[k] + excess, phi[k], densities, block.mixture, true);
            self.stretched[k] = if is_mixed(phi[k]) { excess * closure.expansion(phi[k]) } else { 0.0 };
            self.excess[k] = excess;
        }
    }

    /// Finds the faces with a jump.
    ///
    /// J = σκ passes from one cell's to the other's where their mean weighted by φ(1 − φ) is that of the face: what lies far from the
    /// middle of the interface knows less of it. A cell without a height function has the other's.
    ///
    /// Where phases have densities of their own, traces of gas in liquid and of liquid in gas have a jump only if columns through them go
    /// from gas to liquid: the outermost cells of an interface, not what it has left behind. Without the jumps of those outermost cells
    /// no pressures balance beside them, and a ball at rest gets ever faster.
    fn find_faces<const N: usize>(&mut self, block: &Interfaces<'_, N>, pressure: &[f64], phi: &[f64]) {
        let Self { patch, known, found, .. } = self;
        found.clear();
        let least = if block.has_phases { LEAST_STEP } else { LEAST_STEP_OF_MIXTURE };
        let is_step = |k: usize, step: usize| (phi[k + step] - phi[k]).abs() > least;
        let faces = faces::<N>().filter(|(k, step)| is_step(*k, *step) && !is_open(block, *k, *step));
        let mut faces = faces.peekable();
        if faces.peek().is_none() {
            return;
        }
        patch.fill(block.mesh, block.field, block.slot, block.kinds, phi);
        known.clear();
        known.resize(Padded::<N>::LEN, Known::default());
        let id = block.mesh.tree().leaves()[block.slot];
        let curvature = BlockCurvature { mesh: block.mesh, id, patch, has_images: block.has_phases };
        let is_compliant = |k: usize| is_compliant(pressure[k], phi[k], block.mixture);
        for (k, step) in faces {
            let cells = [k, k + step];
            let heights = cells
                .map(|k| *known[k].heights.get_or_insert_with(|| curvature.of_heights(place_of::<N>(k))));
            let counts = !block.has_phases
                || heights.iter().any(Option::is_some)
                || (phi[k + step] - phi[k]).abs() > 0.5
                || cells.into_iter().any(is_compliant);
            if !counts {
                continue;
            }
            let tension = if heights == [None; 2] {
                let kappas = cells.map(|k| {
                    *known[k].normals.get_or_insert_with(|| curvature.without_heights(place_of::<N>(k)))
                });
                Tension::even(block.tension * 0.5 * (kappas[0] + kappas[1]), cells.map(|k| phi[k]))
            } else {
                between(heights, cells.map(|k| phi[k]), block.tension)
            };
            found.push((k, step, tension));
        }
    }

    fn list_cells<const N: usize>(&mut self) {
        self.cells.clear();
        let n = N as isize;
        for j in -1..=n {
            for i in -1..=n {
                let k = Padded::<N>::index(i, j);
                let around = [(0, k), (0, k - 1), (1, k), (1, k - Padded::<N>::STRIDE)];
                if around.iter().any(|(axis, k)| self.jump[*axis][*k] != 0.0) {
                    self.cells.push(k);
                }
            }
        }
    }

    /// What the axial and radial momentum and the energy of cells gain in a step per volume: half of the jump on each of their faces,
    /// and that times the face's velocity, see [`FaceJumps::settle`].
    ///
    /// The work of tension is −J ∂φ/∂t: J v·∇φ, and −J times what φ grows by where the gas of a mixed cell expands. So gas does the work of its
    /// own pressure, p + (1 − ψ)J, not that of the cell's.
    ///
    /// - `n`: cells along the block's side; `velocities`: normal to the faces along z and r; `gain`: gets j N + i and the gains.
    pub fn for_gains(
        &self,
        n: usize,
        metric: &Metric<'_>,
        [z_velocity, r_velocity]: [&[f64]; 2],
        mut gain: impl FnMut(usize, [f64; 3]),
    ) {
        if !self.is_present {
            return;
        }
        for j in 0..n {
            let row = metric.row(j);
            for i in 0..n {
                let k = metric.origin + j * metric.stride + i;
                let below = k - metric.stride;
                let [east, west] = [k, k - 1].map(|face| 0.5 * self.jump[0][face]);
                let [north, south] = [k, below].map(|face| 0.5 * self.jump[1][face]);
                let work = row.axial(z_velocity[k] * east, -(z_velocity[k - 1] * west))
                    + row.radial(r_velocity[k] * north, -(r_velocity[below] * south));
                let dilatation = row.axial(z_velocity[k], z_velocity[k - 1])
                    + row.radial(r_velocity[k], r_velocity[below]);
                let work = work - self.stretched[k] * dilatation;
                // As the pressure's, the radial force has no weights.
                let radial = metric.dt * metric.inverse_h[1] * (north + south);
                gain(j * n + i, [row.axial(east, -west), radial, work]);
            }
        }
    }
}

/// The tension beside a face of which at least one cell has a height function.
///
/// - `heights`: κ below and above; `phi`: the gas fractions there; `sigma`: N/m.
fn between(heights: [Option<f64>; 2], phi: [f64; 2], sigma: f64) -> Tension {
    let [below, above] = [0, 1].map(|side| {
        let fraction = phi[side].clamp(0.0, 1.0);
        heights[side].map_or(0.0, |_| fraction * (1.0 - fraction) + LEAST_WEIGHT)
    });
    let part = below / (below + above);
    let curvatures = match heights {
        [Some(below), Some(above)] => [below, above],
        [one, other] => [one.or(other).unwrap_or(0.0); 2],
    };
    Tension {
        of_cells: curvatures.map(|kappa| sigma * kappa),
        passes_at: (1.0 - part) * phi[0] + part * phi[1],
    }
}

/// The faces that the cells of a block, and the ghosts that share a face with it, have: (cell below, step to that above).
fn faces<const N: usize>() -> impl Iterator<Item = (usize, usize)> {
    let n = N as isize;
    let along_z = (-1..=n).flat_map(move |j| (-2..=n).map(move |i| (Padded::<N>::index(i, j), 1)));
    let along_r =
        (-2..=n).flat_map(move |j| (-1..=n).map(move |i| (Padded::<N>::index(i, j), Padded::<N>::STRIDE)));
    along_z.chain(along_r)
}

/// The cell (i, j) of padded place `k`.
fn place_of<const N: usize>(k: usize) -> [isize; 2] {
    [k % Padded::<N>::STRIDE, k / Padded::<N>::STRIDE].map(|along| along as isize - GHOSTS as isize)
}

/// Whether a face has a cell beyond an open side of the domain: what is outside has no interface.
fn is_open<const N: usize>(block: &Interfaces<'_, N>, k: usize, step: usize) -> bool {
    let n = N as isize;
    let cells = [k, k + step].map(place_of::<N>);
    Side::ALL.into_iter().any(|side| {
        block.kinds[side as usize].is_open()
            && cells.iter().any(|&[i, j]| match side {
                Side::ZMin => i < 0,
                Side::ZMax => i >= n,
                Side::RMin => j < 0,
                Side::RMax => j >= n,
            })
            && block.mesh.touches(block.slot, side)
    })
}
