//! The gas as a whole, and bubbles told apart along the axis.

use mesh::{BlockSolver, Geometry};

use crate::physics::Fluid;
use crate::state::conserved::PHI;
use crate::{Bubble, BubbleCuts, FluidSolver, TRACE_GAS};

/// Below this gas fraction gas does not belong to an interface.
const THIN_GAS: f64 = 1e-2;

/// So many blocks are worth it to wake a thread that adds up what is in them.
const BLOCKS_TO_ADD: usize = 8;

/// From this gas fraction on a cell counts as part of a bubble when the gaps between bubbles are looked for.
const OF_A_BUBBLE: f64 = 0.5;

impl BubbleCuts {
    /// Follows the gaps to where they are now; to be called after every step.
    pub fn follow<const N: usize>(&mut self, fluid: &BlockSolver<Fluid, N>) {
        if self.cuts.is_empty() {
            return;
        }
        // For each plane where the gas below it ends and the gas above it begins, and whether gas lies across.
        let mut gaps = vec![(f64::NEG_INFINITY, f64::INFINITY, false); self.cuts.len()];
        for (slot, id) in fluid.mesh().tree().leaves().iter().enumerate() {
            if fluid.reports().finished[slot].extremes.phi < OF_A_BUBBLE {
                continue;
            }
            let half = 0.5 * fluid.mesh().widths(id.level)[0];
            let phi = fluid.component(slot, PHI);
            for i in 0..N {
                if !(0..N).any(|j| phi[j * N + i] >= OF_A_BUBBLE) {
                    continue;
                }
                let z = fluid.mesh().centre(*id, i, 0)[0];
                let (low, high, bubble) = (z - half, z + half, self.bubble_at(z));
                if let Some(above) = gaps.get_mut(bubble) {
                    let cut = self.cuts[bubble];
                    *above = (above.0.max(high), above.1, above.2 || high > cut);
                }
                if let Some(below) = bubble.checked_sub(1) {
                    let gap = &mut gaps[below];
                    *gap = (gap.0, gap.1.min(low), gap.2 || low < self.cuts[below]);
                }
            }
        }
        for (cut, (below, above, across)) in self.cuts.iter_mut().zip(gaps) {
            if !across && below.is_finite() && above.is_finite() {
                *cut = 0.5 * (below + above);
            }
        }
    }
}

/// Integrals over some of the gas, per radian in axial symmetry, per metre of depth in planar geometry.
#[derive(Clone, Copy, Default)]
struct Sums {
    volume: f64,
    trace: f64,
    thin: f64,
    moment: f64,
    gas_mass: f64,
}

impl Sums {
    fn add(&mut self, other: &Self) {
        self.volume += other.volume;
        self.trace += other.trace;
        self.thin += other.thin;
        self.moment += other.moment;
        self.gas_mass += other.gas_mass;
    }

    fn bubble(self, geometry: Geometry) -> Bubble {
        let (angle, equivalent_radius) = match geometry {
            Geometry::Axisymmetric => (std::f64::consts::TAU, (1.5 * self.volume).cbrt()),
            Geometry::Planar => (1.0, (self.volume / std::f64::consts::PI).sqrt()),
        };
        Bubble {
            volume: angle * self.volume,
            trace_volume: angle * self.trace,
            thin_volume: angle * self.thin,
            equivalent_radius,
            centroid_z: self.moment / self.volume,
            gas_mass: angle * self.gas_mass,
        }
    }
}

impl<const N: usize> FluidSolver<N> {
    /// The gas as a whole.
    pub fn bubble(&self) -> Bubble {
        bubbles(self, &BubbleCuts::default())[0]
    }

    /// The bubbles that `cuts` tell apart, the lowest first. Their volumes and masses add up to those of the whole.
    pub fn bubbles(&self, cuts: &BubbleCuts) -> Vec<Bubble> {
        bubbles(self, cuts)
    }
}

pub(crate) fn bubbles<const N: usize>(fluid: &BlockSolver<Fluid, N>, cuts: &BubbleCuts) -> Vec<Bubble> {
    let geometry = fluid.mesh().domain().geometry;
    gas_sums(fluid, cuts).into_iter().map(|sums| sums.bubble(geometry)).collect()
}

/// Tells the far field what the bubbles do; between two steps of the whole.
pub(crate) fn follow_sources<const N: usize>(fluid: &mut BlockSolver<Fluid, N>) {
    if !fluid.model().far.sources.is_due(fluid.time()) {
        return;
    }
    let mut sources = std::mem::take(&mut fluid.model_mut().far.sources);
    sources.cuts.follow(fluid);
    sources.sample(fluid.time(), &bubbles(fluid, &sources.cuts));
    fluid.model_mut().far.sources = sources;
}

fn gas_sums<const N: usize>(fluid: &BlockSolver<Fluid, N>, cuts: &BubbleCuts) -> Vec<Sums> {
    let (leaves, model) = (fluid.mesh().tree().leaves(), fluid.model());
    let mut all = vec![Sums::default(); cuts.bubbles()];
    if model.scheme.phases.gas_component().is_none() {
        all.iter_mut().for_each(|sums| sums.gas_mass = f64::NAN);
    }
    let may_have_gas =
        |slot: &usize| fluid.reports().finished[*slot].extremes.phi > 0.0 || model.has_gas[*slot];
    let slots: Vec<usize> = (0..leaves.len()).filter(may_have_gas).collect();
    let of_blocks =
        mesh::map_in_order(slots.len(), BLOCKS_TO_ADD, |number| bubbles_of(fluid, cuts, slots[number]));
    for (bubble, sums) in of_blocks.into_iter().flatten() {
        all[bubble].add(&sums);
    }
    all
}

/// The gas of a block: the bubbles that it belongs to, and how much of it.
fn bubbles_of<const N: usize>(
    fluid: &BlockSolver<Fluid, N>,
    cuts: &BubbleCuts,
    slot: usize,
) -> Vec<(usize, Sums)> {
    let id = fluid.mesh().tree().leaves()[slot];
    let mut found: Vec<(usize, Sums)> = Vec::new();
    for (i, column) in columns_of(fluid, slot).into_iter().enumerate() {
        let z = fluid.mesh().centre(id, i, 0)[0];
        let (bubble, column) = (cuts.bubble_at(z), Sums { moment: column.volume * z, ..column });
        match found.last_mut().filter(|(last, _)| *last == bubble) {
            Some((_, sums)) => sums.add(&column),
            None => found.push((bubble, column)),
        }
    }
    found
}

/// The gas in each column of cells of a block, which are at one z; without moments.
fn columns_of<const N: usize>(fluid: &BlockSolver<Fluid, N>, slot: usize) -> [Sums; N] {
    let (mesh, id) = (fluid.mesh(), fluid.mesh().tree().leaves()[slot]);
    let gas = fluid.model().scheme.phases.gas_component().map(|gas| fluid.component(slot, gas));
    let cells: [f64; N] = std::array::from_fn(|j| mesh.volume(id, j));
    let [volume, trace, thin, gas_mass] = add_columns(fluid.component(slot, PHI), gas, &cells);
    std::array::from_fn(|i| Sums {
        volume: volume[i],
        trace: trace[i],
        thin: thin[i],
        moment: 0.0,
        gas_mass: gas_mass[i],
    })
}

/// Volume, traces, thin gas and mass of the gas in the columns of a block.
///
/// - `phi`, `gas`: gas fraction and m_g of the block's cells; `cells`: the volume of one in each row.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn add_columns<const N: usize>(phi: &[f64], gas: Option<&[f64]>, cells: &[f64; N]) -> [[f64; N]; 4] {
    /// So many columns at once that their sums stay in registers.
    const AT_ONCE: usize = 8;
    const { assert!(N.is_multiple_of(AT_ONCE), "blocks are whole batches wide") };
    let mut columns = [[0.0; N]; 4];
    let mut first = 0;
    while first + AT_ONCE <= N {
        let (mut sums, mut mass) = ([[0.0; AT_ONCE]; 3], [0.0; AT_ONCE]);
        for (phi, cell) in phi.chunks_exact(N).zip(cells) {
            for (i, phi) in phi[first..first + AT_ONCE].iter().enumerate() {
                let is_trace = *phi <= TRACE_GAS;
                sums[0][i] += if is_trace { 0.0 } else { phi * cell };
                sums[1][i] += if is_trace { phi.max(0.0) * cell } else { 0.0 };
                sums[2][i] += if is_trace || *phi >= THIN_GAS { 0.0 } else { phi * cell };
            }
        }
        for (gas, cell) in gas.into_iter().flat_map(|gas| gas.chunks_exact(N)).zip(cells) {
            mass.iter_mut().zip(&gas[first..first + AT_ONCE]).for_each(|(mass, gas)| *mass += gas * cell);
        }
        for (columns, sums) in columns.iter_mut().zip(sums.iter().chain([&mass])) {
            columns[first..first + AT_ONCE].copy_from_slice(sums);
        }
        first += AT_ONCE;
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Boundary, FluidSetup, InitialCondition, InitialPressure, Model, Phase, PhaseState, Scales, Sharpening,
    };
    use mesh::Domain;

    /// A column of 8 m with [`CELLS`] cells along z.
    const CELLS: usize = 128;

    fn state(phase: Phase, velocity: f64) -> PhaseState {
        let density = if phase == Phase::Gas { 10.0 } else { 1000.0 };
        PhaseState { phase, density, pressure: 1e5, velocity: [velocity, 0.0] }
    }

    fn of_spheres(spheres: &[[f64; 2]], velocity: f64) -> InitialCondition {
        let balls = spheres.iter().map(|sphere| (*sphere, state(Phase::Gas, velocity)));
        InitialCondition::of_balls(state(Phase::Liquid, velocity), InitialPressure::Uniform, balls)
    }

    fn fluid(spheres: &[[f64; 2]], velocity: f64, model: Model) -> FluidSolver<8> {
        let setup = FluidSetup {
            model,
            sharpening: Sharpening::None,
            scales: Scales { pressure: 1e5, density: 1e3 },
            ..FluidSetup::new(
                Domain { geometry: Geometry::Axisymmetric, z: [0.0, 8.0], r: [0.0, 1.0] },
                [CELLS, 16],
                [Boundary::Periodic, Boundary::Periodic, Boundary::Axis, Boundary::Wall],
            )
        };
        FluidSolver::new(&setup, &of_spheres(spheres, velocity)).expect("a fluid")
    }

    /// Two bubbles and three are carried along by a uniform flow, up and down, farther than the gaps between them are
    /// wide. Planes that stayed would have one bubble's gas counted as the other's.
    #[test]
    fn bubbles_that_move_keep_their_gas() {
        for (spheres, velocity) in [
            (&[[2.0, 0.5], [3.4, 0.7]][..], 200.0),
            (&[[5.6, 0.7], [6.9, 0.4]], -200.0),
            (&[[0.9, 0.5], [2.05, 0.4], [3.3, 0.6]], 200.0),
        ] {
            let mut fluid = fluid(spheres, velocity, Model::FiveEquation);
            let mut cuts = BubbleCuts::of(&of_spheres(spheres, velocity));
            assert_eq!(cuts.bubbles(), spheres.len());
            let first = fluid.bubbles(&cuts);
            for ([z, radius], bubble) in spheres.iter().zip(&first) {
                assert!((bubble.centroid_z - z).abs() < 1e-3, "{bubble:?}");
                let volume = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
                assert!((bubble.volume / volume - 1.0).abs() < 2e-3, "{bubble:?}");
                assert!((bubble.gas_mass / (10.0 * volume) - 1.0).abs() < 2e-3, "{bubble:?}");
                assert!((bubble.equivalent_radius / radius - 1.0).abs() < 1e-3, "{bubble:?}");
            }
            while fluid.time() < 7e-3 {
                fluid.step_at(0.45).expect("a step");
                cuts.follow(&fluid);
            }
            let way = velocity * fluid.time();
            let last = fluid.bubbles(&cuts);
            for (before, after) in first.iter().zip(&last) {
                let moved = after.centroid_z - before.centroid_z;
                assert!((moved / way - 1.0).abs() < 0.02, "{moved} of {way}");
                // The scheme smears gas across gaps of three and four cells.
                assert!((after.gas_mass / before.gas_mass - 1.0).abs() < 0.01, "{before:?} {after:?}");
            }
            let whole = fluid.bubble();
            let sum = |part: fn(&Bubble) -> f64| last.iter().map(part).sum::<f64>();
            approx::assert_relative_eq!(sum(|b| b.volume), whole.volume, max_relative = 1e-12);
            approx::assert_relative_eq!(sum(|b| b.gas_mass), whole.gas_mass, max_relative = 1e-12);
        }
    }

    #[test]
    fn cuts_stay_where_bubbles_merge_and_where_one_vanishes() {
        let three = [[1.5, 0.5], [3.5, 0.5], [6.0, 0.5]];
        let mut cuts = BubbleCuts::of(&of_spheres(&three, 0.0));
        assert_eq!(cuts.positions(), [2.5, 4.75]);
        // The middle one vanishes: its planes stay, though there is gas beyond the next ones.
        cuts.follow(&fluid(&[[1.5, 0.5], [6.0, 0.5]], 0.0, Model::FiveEquation));
        assert_eq!(cuts.positions(), [2.5, 4.75]);
        // The upper two merge at their plane, the lower one rises.
        cuts.follow(&fluid(&[[1.75, 0.5], [4.25, 0.75], [5.25, 0.75]], 0.0, Model::FiveEquation));
        let positions = cuts.positions();
        assert!((positions[0] - 2.875).abs() < 0.07 && positions[1] == 4.75, "{positions:?}");
        // They part again.
        cuts.follow(&fluid(&[[1.75, 0.5], [4.0, 0.5], [5.75, 0.5]], 0.0, Model::FiveEquation));
        assert!((cuts.positions()[1] - 4.875).abs() < 0.07, "{:?}", cuts.positions());
    }

    #[test]
    fn overlapping_regions_and_single_ones_have_ascending_cuts_or_none() {
        let cuts = |spheres: &[[f64; 2]]| BubbleCuts::of(&of_spheres(spheres, 0.0)).cuts;
        assert_eq!(cuts(&[[2.0, 1.0]]), []);
        assert_eq!(cuts(&[[5.0, 0.5], [2.0, 1.0]]), [3.75], "in the order of z");
        assert_eq!(cuts(&[[2.0, 1.5], [2.5, 1.1], [6.0, 1.0]]), [2.45, 4.3]);
        assert_eq!(
            cuts(&[[2.0, 1.5], [2.25, 0.1], [6.0, 1.0]]),
            [4.25],
            "what is within another one is none"
        );
    }

    /// The sums in batches of columns are those cell by cell.
    #[test]
    fn traces_and_thin_gas_are_told_apart_cell_by_cell() {
        let mut fluid = fluid(&[[4.0, 0.5]], 0.0, Model::FiveEquation);
        let gas = fluid.model().scheme.phases.gas_component().expect("it has masses");
        let kinds = [1e-13, 0.5 * TRACE_GAS, 2.0 * TRACE_GAS, 0.5 * THIN_GAS, THIN_GAS, 0.3, -1e-9, 0.0];
        let slot = fluid.mesh().tree().leaves().len() / 2;
        let cells = 8 * 8;
        for cell in 0..cells {
            let block = fluid.state_mut().block_mut(slot);
            block[PHI * cells + cell] = kinds[(3 * cell + cell / 8) % kinds.len()];
            block[gas * cells + cell] = 0.01 * cell as f64;
        }
        fluid.model_mut().has_gas.fill(true);
        let (mut volume, mut trace, mut thin, mut mass) = (0.0, 0.0, 0.0, 0.0);
        for (slot, id) in fluid.mesh().tree().leaves().iter().enumerate() {
            for cell in 0..cells {
                let own = std::f64::consts::TAU * fluid.mesh().volume(*id, cell / 8);
                let phi = fluid.component(slot, PHI)[cell];
                match phi {
                    phi if phi <= TRACE_GAS => trace += own * phi.max(0.0),
                    phi if phi < THIN_GAS => (volume, thin) = (volume + own * phi, thin + own * phi),
                    _ => volume += own * phi,
                }
                mass += own * fluid.component(slot, gas)[cell];
            }
        }
        assert!(trace > 0.0 && thin > 0.0);
        let bubble = fluid.bubble();
        for (told, wanted) in [
            (bubble.volume, volume),
            (bubble.trace_volume, trace),
            (bubble.thin_volume, thin),
            (bubble.gas_mass, mass),
        ] {
            approx::assert_relative_eq!(told, wanted, max_relative = 1e-13);
        }
    }

    #[test]
    fn the_papers_mixture_has_volumes_but_no_masses() {
        let bubble = fluid(&[[4.0, 0.5]], 0.0, Model::SaurelAbgrall).bubble();
        assert!(bubble.volume > 0.5 && bubble.gas_mass.is_nan(), "{bubble:?}");
    }
}
