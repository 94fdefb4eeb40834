//! The part of a block's step that only the five-equation model has, where there is gas.

use mesh::{Side, Tile, TileRows};

use super::cells::Cells;
use super::expansion::{Gas, expanded};
use super::mixed::Outer;
use super::phase_model::PhaseModel;
use super::reconstruction::CellRule;
use super::scratch::GasScratch;
use super::update::{OldCells, bound_gas, gas_fluxes, gas_shares, is_zero, update_gas, update_mixed};
use crate::capillarity::{CapillaryRows, FaceJumps, SinglePressure};
use crate::options::TwoPhaseOptions;
use crate::physics::FluidStep;
use crate::reconstruction::Reconstruction;
use crate::state::COUNT;
use crate::state::conserved::{ENERGY, GAS, PHI, RHO};
use crate::step::face_rows::FaceRows;
use crate::step::report::BlockReport;
use crate::step::update::{Metric, NewCells};
use crate::step::{BlockScratch, split_block};
use crate::terms::GasMass;
use crate::{Boundary, RiemannSolver};

/// A share of the slopes that is none, but not for want of admissible ones: the cell has face states of its own.
const NOT_THEIRS: f64 = -0.0;

/// Whether there may be gas in a block's padded cells.
pub(crate) fn may_have_gas<const N: usize>(ctx: &FluidStep<'_, N>, slot: usize) -> bool {
    let has_gas = |slot: &usize| ctx.model.has_gas[*slot];
    has_gas(&slot)
        || ctx.model.boundaries.may_let_gas_in(ctx.mesh, slot)
        || (ctx.mesh.tree().neighbours(slot).iter())
            .any(|neighbour| neighbour.slots().any(|slot| has_gas(&slot)))
}

/// What a block's step has to do about gas: decided once per block.
pub(crate) enum BlockGas<'a, const N: usize> {
    /// No gas in the padded cells.
    Absent,
    /// The paper's mixture with gas in them: the kernels carry the gas fraction.
    Fraction,
    /// The five-equation model with gas in them.
    Phases(GasBlock<'a, N>),
}

impl<'a, const N: usize> BlockGas<'a, N> {
    /// - `may_have_gas`: see [`may_have_gas`]; what a neighbour has may be farther away. `cells`: the padded cells of the tile, primitive.
    pub fn of(ctx: &'a FluidStep<'a, N>, tile: Tile, may_have_gas: bool, cells: &TileRows<N>) -> Self {
        let phases = ctx.model.scheme.phases;
        let components = [Some(PHI), phases.gas_component()];
        let has_gas = || {
            !ctx.marks.is_empty()
                || tile.slots().any(|slot| ctx.model.boundaries.may_let_gas_in(ctx.mesh, slot))
                || components.into_iter().flatten().any(|component| !is_zero(cells.component(component)))
        };
        if !(may_have_gas && has_gas()) {
            return Self::Absent;
        }
        let PhaseModel::FiveEquation(options) = phases else { return Self::Fraction };
        let inverse_h = ctx.mesh.widths(ctx.mesh.first_of(tile).level).map(|h| 1.0 / h);
        Self::Phases(GasBlock { ctx, tile, options, inverse_h })
    }

    /// Whether the rows of the gas fraction count.
    pub fn is_present(&self) -> bool {
        !matches!(self, Self::Absent)
    }

    /// Whether the kernels serve mixed cells, too.
    pub fn is_of_kernels(&self) -> bool {
        matches!(self, Self::Fraction)
    }

    /// The gas's part of the mass, as terms see it.
    ///
    /// - `shares`: m_g/ρ of the padded cells, see [`GasBlock::shares`].
    pub fn mass<'b>(&self, shares: &'b [f64]) -> GasMass<'b> {
        match self {
            Self::Fraction => GasMass::Unknown,
            Self::Absent => GasMass::Absent,
            Self::Phases(_) => GasMass::Shares(shares),
        }
    }

    pub fn phases(&self) -> Option<&GasBlock<'a, N>> {
        if let Self::Phases(block) = self { Some(block) } else { None }
    }
}

/// A tile of the five-equation model with gas in its padded cells, or with some that may come in through a side.
pub(crate) struct GasBlock<'a, const N: usize> {
    ctx: &'a FluidStep<'a, N>,
    tile: Tile,
    options: TwoPhaseOptions,
    inverse_h: [f64; 2],
}

/// A block at the beginning of a step, and its geometry.
#[derive(Clone, Copy)]
pub(crate) struct Before<'a> {
    /// Of the block in the tile.
    pub number: usize,
    /// Conserved components without ghosts.
    pub old: &'a [f64],
    /// Pressure and φ of the padded cells.
    pub padded: [&'a [f64]; 2],
    /// 1/r of the padded cells, or 0.
    pub inverse_r: &'a [f64],
    pub metric: &'a Metric<'a>,
    pub capillary: &'a CapillaryRows,
}

impl<'a, const N: usize> GasBlock<'a, N> {
    fn rule<'b>(&self, inverse_r: &'b [f64]) -> CellRule<'b>
    where
        'a: 'b,
    {
        self.ctx.model.rule_with(self.options, self.inverse_h, inverse_r, self.ctx.dt)
    }

    /// The gas's part of the mass in the padded cells of the assembled tile, and beyond its sides.
    pub fn shares(&self, scratch: &mut BlockScratch<N>) {
        let BlockScratch { cells, gas_shares: shares, .. } = scratch;
        gas_shares(cells.component(GAS), cells.component(RHO), shares);
        self.impose_outer_shares(shares);
    }

    /// Finds and reconstructs the mixed cells; `scratch` holds the assembled block and its predicted states.
    pub fn collect(&self, scratch: &mut BlockScratch<N>) {
        let BlockScratch { cells, gas, half, keep, inverse_r, capillary, .. } = scratch;
        let rows = cells.split::<{ COUNT + 1 }>();
        gas.mixed.clear();
        gas.mixed.collect::<N>(
            self.tile,
            &Cells { rows, stride: cells.frame().stride() },
            &CellRule { jumps: capillary.jumps(), excess: capillary.excess(), ..self.rule(inverse_r) },
            Side::ALL.map(|side| self.outer(side)),
            (!self.ctx.marks.is_empty()).then_some(&gas.is_marked),
        );
        // What the kernels made of these cells counts for nothing. What the wall to the solid asks for is on the lower
        // face along z; and the exact solver should not labour over what is no state.
        let is_asked_for =
            self.outer(Side::ZMin) == Outer::Given || self.ctx.model.scheme.riemann == RiemannSolver::Exact;
        for (k, state) in gas.mixed.listed() {
            keep[k] = NOT_THEIRS;
            if is_asked_for {
                for (component, value) in state.w.into_iter().enumerate() {
                    half.component_mut(component)[k] = value;
                }
            }
        }
    }

    fn outer(&self, side: Side) -> Outer {
        if !self.ctx.mesh.tile_touches(self.tile, side) {
            return Outer::Block;
        }
        match self.ctx.model.boundaries.kind(side) {
            Boundary::Axis | Boundary::Wall | Boundary::Symmetry => Outer::Mirror,
            Boundary::NonReflecting | Boundary::FarField | Boundary::Inflow | Boundary::Interface => {
                Outer::Given
            }
            Boundary::Periodic => Outer::Block,
        }
    }

    /// What comes in through an open side is what was there in the beginning; a wall gives back what it got.
    fn impose_outer_shares(&self, shares: &mut [f64]) {
        let (frame, boundaries) = (self.tile.frame::<N>(), &self.ctx.model.boundaries);
        for side in Side::ALL.into_iter().filter(|side| self.outer(*side) == Outer::Given) {
            let id = self.ctx.mesh.first_of(self.tile);
            // The first ghosts at both ends, too, as the blocks have them that these cells belong to: tension asks for them.
            for along in -1..=frame.cells() as isize {
                let [inner, ghost] = crate::boundary::beside(side, frame, along);
                let own = usize::try_from(along).ok().filter(|own| *own < frame.cells());
                let given = own.and_then(|own| boundaries.initial_gas_share::<N>(id, side, own));
                shares[ghost] = given.unwrap_or(shares[inner]);
            }
        }
    }

    /// Solves the faces of mixed cells along one axis (0: z, 1: r).
    pub fn solve_faces(
        &self,
        axis: usize,
        cells: &Reconstruction<'_>,
        inverse_r: &[f64],
        jumps: Option<FaceJumps<'_>>,
        gas: &mut GasScratch,
        faces: &mut FaceRows,
    ) {
        let stride = self.tile.frame::<N>().stride();
        gas.mixed.solve_faces(axis, stride, cells, &self.rule(inverse_r), jumps, faces);
    }

    /// Makes the gas's mass fluxes from those of the mass, which must be final.
    pub fn gas_fluxes(&self, gas: &GasScratch, shares: &[f64], faces: [&mut FaceRows; 2]) {
        for (axis, faces) in faces.into_iter().enumerate() {
            gas_fluxes(shares, if axis == 0 { 1 } else { self.tile.frame::<N>().stride() }, faces);
            gas.mixed.put_gas_fluxes(axis, faces);
        }
    }

    /// Advances the gas's mass in a block.
    ///
    /// - `old`: conserved components without ghosts; `new`: m_g after the step, written.
    pub fn advance_gas(&self, old: &[f64], faces: [&FaceRows; 2], metric: &Metric<'_>, new: &mut [f64]) {
        update_gas::<N>(&old[GAS * N * N..(GAS + 1) * N * N], faces, metric, new);
    }

    /// Does the update of a block's mixed cells again, with the closure.
    ///
    /// - `new`: its new components, the gas's mass among them.
    pub fn update(
        &self,
        gas: &mut GasScratch,
        before: Before<'_>,
        faces: [&FaceRows; 2],
        new: &mut [f64],
        speeds: [&mut [f64]; 3],
        report: &mut BlockReport<N>,
    ) {
        let Before { number, old, padded: [pressure, phi], inverse_r, metric, capillary } = before;
        let row = |c: usize| &old[c * N * N..(c + 1) * N * N];
        let (old_rows, old_gas) = (std::array::from_fn(row), row(GAS));
        let (first, new_gas) = new[..(GAS + 1) * N * N].split_at_mut(GAS * N * N);
        let mut cells = NewCells { conserved: split_block::<N>(first), speeds };
        let old = OldCells { conserved: old_rows, padded: [pressure, phi], gas: [old_gas, new_gas] };
        let (windows, rule) =
            (gas.mixed.mixed(number), &CellRule { excess: capillary.excess(), ..self.rule(inverse_r) });
        let mut clipped = update_mixed::<N>(windows, &old, faces, metric, rule, &mut cells, &mut gas.marked);
        gas.marked.iter().for_each(|cell| report.marked.insert(*cell));
        if self.options.has_closure {
            self.expand(before, [row(PHI), old_gas], new_gas, &mut cells, report);
        }
        let [density, _, _, _, phi] = cells.conserved;
        let bounded = bound_gas(phi, density, new_gas);
        clipped += bounded.clipped;
        report.clips.clipped_fractions += clipped;
        report.clips.removed_traces += bounded.removed;
        if number == 0 {
            let (clips, dropped) = gas.mixed.clips();
            report.clips += clips;
            report.fallbacks += dropped;
        }
        report.has_gas = bounded.is_left;
        if bounded.has_missing {
            self.lift_phases(self.tile.first() + number, density, new_gas, report);
        }
    }

    /// Lets the gas of mixed cells expand that the floor would have to lift; these, too, are done again at first order first.
    /// Cells whose gas is not in tension, but whose liquid is, by surface tension, stay as they are.
    ///
    /// - `before`: φ and m_g before the step; `gas`: m_g after it.
    fn expand(
        &self,
        Before { padded: [pressure, _], metric, capillary, .. }: Before<'_>,
        before: [&[f64]; 2],
        gas: &[f64],
        cells: &mut NewCells<'_>,
        report: &mut BlockReport<N>,
    ) {
        if cells.speeds[2].iter().all(|added| *added == 0.0) {
            return;
        }
        for cell in 0..N * N {
            let added = cells.speeds[2][cell];
            let mut u: [f64; COUNT] = std::array::from_fn(|c| cells.conserved[c][cell]);
            if added == 0.0 || !self.ctx.model.mixture.has_gas_floor(u[PHI]) {
                continue;
            }
            u[ENERGY] -= added;
            let k = metric.origin + cell / N * metric.stride + cell % N;
            let mixture = &self.ctx.model.mixture;
            let borne = SinglePressure::of(capillary.jump(k), mixture).borne((u, gas[cell]), mixture);
            let [phi, mass] = before.map(|row| row[cell]);
            let old = Gas { pressure: pressure[k], phi, mass };
            let Some(after) = borne.or_else(|| expanded(u, gas[cell], old, mixture)) else { continue };
            for (row, value) in cells.conserved.iter_mut().zip(after.conserved) {
                row[cell] = value;
            }
            for (row, value) in cells.speeds.iter_mut().zip([after.speed_z, after.speed_r, after.floor]) {
                row[cell] = value;
            }
            if borne.is_none() {
                report.marked.insert(cell);
                report.clips.expanded_cells += 1;
            }
        }
    }

    /// Gives phases that have less than no mass what they lack, from the other phase: ρ stays.
    fn lift_phases(&self, slot: usize, density: &[f64], gas: &mut [f64], report: &mut BlockReport<N>) {
        let id = self.ctx.mesh.tree().leaves()[slot];
        for (cell, (gas, density)) in gas.iter_mut().zip(density).enumerate() {
            report.lift_phase(*density, gas, self.ctx.mesh.volume(id, cell / N));
        }
    }
}

#[cfg(test)]
mod tests {
    use mesh::{Adaptation, Domain, Geometry, Limiter};

    use crate::state::conserved::{GAS, PHI};
    use crate::{
        Boundary, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Phase, PhaseState, Region,
        Scales, Shape,
    };

    fn collapsing_bubble() -> FluidSolver<8> {
        let setup = FluidSetup {
            levels: 3,
            limiter: Limiter::Minmod,
            adaptation: Some(Adaptation::by_details(1e-3, 4)),
            scales: Scales { pressure: 5e7, density: 1e3 },
            ..FluidSetup::new(
                Domain { geometry: Geometry::Axisymmetric, z: [0.0, 4.0], r: [0.0, 2.0] },
                [16, 8],
                [Boundary::Wall, Boundary::NonReflecting, Boundary::Axis, Boundary::NonReflecting],
            )
        };
        let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0, 0.0] };
        let initial = InitialCondition {
            ambient: state(Phase::Liquid, 1000.0, 5e7),
            pressure: InitialPressure::Uniform,
            regions: vec![Region {
                shape: Shape::Sphere { centre: [1.0, 0.0], radius: 0.4 },
                state: state(Phase::Gas, 0.0266, 2118.0),
            }],
            pulses: vec![],
        };
        FluidSolver::new(&setup, &initial).expect("a fluid")
    }

    /// Neither phase's mass is left below zero; what it lacked comes from the other one, and is told.
    #[test]
    fn a_phase_with_less_than_no_mass_is_lifted_and_counted() {
        let mut fluid = collapsing_bubble();
        let dt = fluid.time_step_limit(0.45);
        let (mut added, before) = ([0.0; 2], fluid.totals());
        let mut changed = [0_u64; 2];
        for slot in 0..fluid.mesh().blocks() {
            let id = fluid.mesh().tree().leaves()[slot];
            let block = fluid.state_mut().block_mut(slot);
            // In the middle of blocks all around holds the same phase, and nothing moves.
            let (cell, cells) = (8 * 4 + 4, 64);
            let near = [cell - 17, cell - 2, cell + 2, cell + 17].map(|k| block[PHI * cells + k]);
            if near == [0.0; 4] {
                block[GAS * cells + cell] = -1e-4;
                added[0] += 1e-4 * fluid.mesh().volume(id, 4);
                changed[0] += 1;
            } else if near == [1.0; 4] {
                let more = 0.3 * block[cell];
                block[GAS * cells + cell] = block[cell] + more;
                added[1] += more * fluid.mesh().volume(id, 4);
                changed[1] += 1;
            }
        }
        assert!(changed.iter().all(|blocks| *blocks > 0), "there are blocks of both phases: {changed:?}");
        fluid.model_mut().has_gas.fill(true);
        fluid.step(dt).expect("a step");
        let fixups = fluid.fixups();
        assert!(fixups.clips.lifted_phases >= changed[0] + changed[1], "{fixups:?}");
        approx::assert_relative_eq!(fixups.gas_mass_added, added[0], max_relative = 1e-2);
        approx::assert_relative_eq!(fixups.liquid_mass_added, added[1], max_relative = 1e-2);
        for slot in 0..fluid.mesh().blocks() {
            for (rho, gas) in fluid.state().component(slot, 0).iter().zip(fluid.state().component(slot, GAS))
            {
                assert!(*gas >= -1e-9 * rho && *gas <= 1.1 * rho, "{gas} of {rho}");
            }
        }
        let into: f64 = fluid.ledger().mass.iter().sum();
        assert!((fluid.totals().mass - before.mass - into).abs() < 1e-13 * before.mass);
    }

    #[test]
    fn blocks_without_gas_step_as_if_gas_were_looked_for() {
        let [mut plain, mut searched] = [collapsing_bubble(), collapsing_bubble()];
        for step in 0..120 {
            let dt = plain.time_step_limit(0.45);
            assert_eq!(dt, searched.time_step_limit(0.45), "step {step}");
            searched.model_mut().has_gas.fill(true);
            for fluid in [&mut plain, &mut searched] {
                fluid.step(dt).expect("a step");
                fluid.adapt_if_due(dt, 1);
            }
            assert_eq!(plain.state(), searched.state(), "step {step}");
        }
        let with_gas = plain.model().has_gas.iter().filter(|has_gas| **has_gas).count();
        assert!(
            with_gas > 4 && 2 * with_gas < plain.model().has_gas.len(),
            "{with_gas} of {}",
            plain.model().has_gas.len()
        );
    }
}
