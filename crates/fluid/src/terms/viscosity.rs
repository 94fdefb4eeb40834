//! Viscosity of both phases.

mod friction;
mod layered;
mod passes;
mod spread;
mod stress;
mod velocities;

use mesh::{Frame, Side};

use super::diffusion::{BY_STAGES, ThinGas, most_diffusivity, step_limit};
use super::super_stepping::{Spreading, View};
use super::{FinishedCells, GasMass, Term, TermBlock, WallCell, for_cells_without_mid_step};
use crate::state::conserved::MOMENTUM_R;
use crate::state::primitive::{PHI, PRESSURE, RHO};
use crate::step::clips::Clips;
use crate::step::face_rows::FaceRows;
use crate::step::update::Metric;
use crate::two_phase::{Compression, is_mixed, phase_densities};
use layered::{Layers, SHEET, take_for_layers};
use passes::OfCells;
use stress::{FaceStress, Motion, Parts, stresses};
use velocities::Velocities;

/// Viscosity of a phase, Pa s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PhaseViscosity {
    /// μ.
    pub shear: f64,
    /// κ, the bulk viscosity.
    pub bulk: f64,
}

/// Newtonian stress τ = μ(∇v + ∇vᵀ − ⅔ ∇·v I) + κ ∇·v I, with walls that the fluid sticks to.
///
/// Momentum and energy pass through faces, −τ and −τ·v; what the hoop stress leaves is a source of radial momentum. Gradients are
/// central differences of the states at mid-step, which have gained half a step of the stresses' divergence: second order in space and
/// time. Cells mixed of both phases have μ = φμ_g + (1 − φ)μ_l: what flow about a bubble prescribes is how fast it is deformed, and then
/// the work of mixed liquid is its share of the volume. What friction takes from the motion warms the cells and the phases that rub, each
/// by its share of the viscosity.
///
/// - valid for: μ, κ ≥ 0. errors: none.
/// - tested by: `tests/verification/viscosity.rs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscosity {
    /// Of the liquid.
    pub liquid: PhaseViscosity,
    /// Of the gas.
    pub gas: PhaseViscosity,
    /// What gas does that is too thin for a step.
    pub thin_gas: ThinGas,
}

impl Viscosity {
    /// μ and κ of a mixture, Pa s.
    #[inline(always)]
    fn at(&self, phi: f64) -> [f64; 2] {
        let gas = phi.clamp(0.0, 1.0);
        let mean = |liquid: f64, of_gas: f64| gas * of_gas + (1.0 - gas) * liquid;
        [mean(self.liquid.shear, self.gas.shear), mean(self.liquid.bulk, self.gas.bulk)]
    }

    /// 4μ/3 + κ of a mixture, and what layers of liquid in it resist besides, Pa s.
    #[inline(always)]
    fn stiffest(&self, phi: f64) -> f64 {
        let of_layers = if is_mixed(phi) { SHEET * (1.0 - phi) * self.liquid.shear } else { 0.0 };
        longitudinal(self.at(phi)) + of_layers
    }

    /// The stresses on all faces of a block and of its first ghosts.
    ///
    /// - `work`: gets velocities, viscosities and stresses, in rows of padded cells.
    fn stresses<'w>(&self, block: &TermBlock<'_>, work: &'w mut Vec<f64>) -> Stresses<'w> {
        let len = block.state[RHO].len();
        work.resize(ROWS * len, 0.0);
        let mut rows = work.chunks_exact_mut(len);
        let mut next = || rows.next().expect("resized to that many");
        let [v_z, v_r, shear, bulk, spared, density, phi] = std::array::from_fn(|_| next());
        Velocities { v_z: &mut *v_z, v_r: &mut *v_r }.gather(block);
        passes::viscosities(self, block.state[PHI], shear, bulk);
        // What kernels left of mixed cells differs from block to block.
        for_cells_without_mid_step(block, |k| [shear[k], bulk[k]] = self.at(block.before[PHI][k]));
        let is_layered = spared_dilatation(block, spared);
        density.copy_from_slice(block.before[RHO]);
        phi.copy_from_slice(block.before[PHI]);
        mirror_beyond_sides(block, [&mut *shear, &mut *bulk, &mut *spared, &mut *density, &mut *phi]);
        let [z, r] = std::array::from_fn(|_| FaceStress { normal: next(), shear: next(), hoop: next() });
        let metric = block.metric;
        let most = most_diffusivity(metric.dt, metric.inverse_h);
        // Cells of one viscosity meet half-way, and where the lightest of them bears it no share of it has to be found.
        let are_one = passes::is_uniform(shear) && passes::is_uniform(bulk);
        let own = longitudinal([shear[metric.origin], bulk[metric.origin]]);
        let may_be_bounded = !(are_one && own <= most * passes::least(density));
        let motion = Motion {
            velocity: [&*v_z, &*v_r],
            shear: &*shear,
            bulk: &*bulk,
            density: &*density,
            stride: metric.stride,
            inverse_h: metric.inverse_h,
            inverse_r: block.inverse_r,
            most,
            may_be_bounded,
        };
        // From the outer ghosts' inner faces on, so that the first ghosts have all of theirs.
        let end = metric.origin + block.cells * metric.stride + block.cells;
        let (z_first, r_first) = (metric.origin - metric.stride - 2, metric.origin - 2 * metric.stride - 1);
        let mut stresses_of = Stresses { velocity: [v_z, v_r], parts: Parts { shear, bulk, are_one }, z, r };
        stresses(&motion, 0, z_first..end + 1, &mut stresses_of.z);
        stresses(&motion, 1, r_first..end + 1, &mut stresses_of.r);
        if is_layered {
            let layers = self.layers(phi, spared);
            take_for_layers(&motion, &layers, 0, z_first..end + 1, &mut stresses_of.z);
            take_for_layers(&motion, &layers, 1, r_first..end + 1, &mut stresses_of.r);
        }
        if let Some(view) = &block.spread {
            let Stresses { z, r, .. } = &mut stresses_of;
            let rows = [&mut *z.normal, &mut *z.shear, &mut *r.normal, &mut *r.shear, &mut *r.hoop];
            view.put(View::MOMENTUM, &mut { rows }, &Self::AXES);
        }
        stresses_of
    }
}

impl Viscosity {
    fn layers<'a>(&self, phi: &'a [f64], spared: &'a [f64]) -> Layers<'a> {
        Layers { liquid: [self.liquid.shear, self.liquid.bulk], phi, spared }
    }
}

/// Finds (1 − φ)(1 − K/K_l) of the padded cells at the beginning of the step, see [`Layers::spared`], and whether any has some.
fn spared_dilatation(block: &TermBlock<'_>, spared: &mut [f64]) -> bool {
    spared.fill(0.0);
    let (Some(mixture), GasMass::Shares(shares)) = (block.closure, block.gas) else { return false };
    let mut is_any = false;
    for (k, phi) in block.before[PHI].iter().enumerate().filter(|(_, phi)| is_mixed(**phi)) {
        // What surface tension adds to the gas's pressure is not known of all ghosts, and K of the gas is small beside K_l anyway.
        let pressure = block.before[PRESSURE][k];
        let densities = phase_densities(block.before[RHO][k], shares[k], *phi, mixture);
        spared[k] = Compression::at(pressure, *phi, densities, mixture, true).expansion(*phi);
        is_any = true;
    }
    is_any
}

/// Gives the ghosts beyond the domain what the cells in front of its sides have.
///
/// Where gas is at a side and liquid behind it, what is continued beyond is no state: a density below 0 would turn friction round.
fn mirror_beyond_sides<'r>(block: &TermBlock<'_>, rows: impl IntoIterator<Item = &'r mut [f64]>) {
    let frame = Frame::of(block.cells);
    for row in rows {
        for side in Side::FOR_GHOSTS.into_iter().filter(|side| block.sides[*side as usize].is_some()) {
            frame.reflect(row, side, 1.0);
        }
    }
}

/// The faces of a block on z_min, by the ghosts below them.
fn beside_wall(block: &TermBlock<'_>) -> impl Iterator<Item = usize> + use<> {
    let [origin, stride] = [block.metric.origin, block.metric.stride];
    (0..block.cells).map(move |j| origin + j * stride - 1)
}

/// Rows that the stresses of a block take: two velocities, two viscosities, what the liquid is spared, density, gas fraction, three numbers
/// on the faces of either direction.
const ROWS: usize = 13;

/// The rows as [`Viscosity::stresses`] has left them.
fn rows_of(work: &[f64], len: usize) -> [&[f64]; ROWS] {
    std::array::from_fn(|row| &work[row * len..(row + 1) * len])
}

/// The stresses on the faces of a block.
struct Stresses<'a> {
    velocity: [&'a [f64]; 2],
    parts: Parts<'a>,
    z: FaceStress<'a>,
    r: FaceStress<'a>,
}

/// 4μ/3 + κ.
#[inline(always)]
fn longitudinal([shear, bulk]: [f64; 2]) -> f64 {
    4.0 / 3.0 * shear + bulk
}

impl Term for Viscosity {
    /// Half a step of ∇·τ/ρ, in the cells of the block and the first ghosts.
    fn predict(&self, block: &TermBlock<'_>, half: [&mut [f64]; 2], work: &mut Vec<f64>) {
        let Stresses { parts, z, r, .. } = self.stresses(block, work);
        let Metric { origin, stride, dt, inverse_h, .. } = *block.metric;
        let cells =
            OfCells { parts, density: block.state[RHO], inverse_r: block.inverse_r, inverse_h, stride };
        let on_faces = ([&*z.normal, &*z.shear], [&*r.normal, &*r.shear, &*r.hoop]);
        passes::gain(cells, (block.cells, origin, 0.5 * dt), on_faces, half);
    }

    fn add_fluxes(
        &self,
        block: &TermBlock<'_>,
        [z_faces, r_faces]: [&mut FaceRows; 2],
        work: &mut Vec<f64>,
    ) -> Clips {
        let stresses = self.stresses(block, work);
        let TermBlock { cells: n, metric, .. } = *block;
        if block.wall.is_some() {
            // What acts on the wall to the solid is in that wall's own fluxes.
            beside_wall(block).for_each(|k| (stresses.z.normal[k], stresses.z.shear[k]) = (0.0, 0.0));
        }
        let Stresses { velocity: [v_z, v_r], parts, z, r } = &stresses;
        let last = metric.origin + (n - 1) * metric.stride + n;
        let along_z = metric.origin - 1..last;
        let along_r = metric.origin - metric.stride..last;
        for (faces, stress, [u, w], step, range) in
            [(z_faces, z, [*v_z, *v_r], 1, along_z), (r_faces, r, [*v_r, *v_z], metric.stride, along_r)]
        {
            let [_, _, pressure, shear, energy, _] = faces.fluxes_mut();
            passes::pass(*parts, (range, step), [u, w], stress, [pressure, shear, energy]);
        }
        let bounded = match self.thin_gas {
            ThinGas::SuperTimeStepping => 0,
            ThinGas::Bounded | ThinGas::Resolved => self.count_bounded(block),
        };
        Clips { bounded_viscosities: bounded, ..Clips::default() }
    }

    /// (τ_rr − τ_φφ)/r. The flux of τ_rr has no weight, as the pressure's: see `update.rs`.
    fn add_sources(&self, block: &TermBlock<'_>, _: [&FaceRows; 2], work: &[f64], block_rows: &mut [f64]) {
        let TermBlock { cells: n, metric, inverse_r, .. } = *block;
        let [_, _, shear, bulk, _, _, _, _, _, _, normal, _, hoop] = rows_of(work, block.state[RHO].len());
        let are_one = passes::is_uniform(shear) && passes::is_uniform(bulk);
        let parts = Parts { shear, bulk, are_one };
        let momentum = &mut block_rows[MOMENTUM_R * n * n..][..n * n];
        passes::add_hoop((parts, inverse_r), (metric, n), [normal, hoop], momentum);
    }

    /// Gives each phase of mixed cells its share of what friction makes of the motion.
    fn finish(&self, cells: &mut FinishedCells<'_>, work: &[f64]) {
        self.finish_phases(cells, work);
    }

    /// The largest (4μ/3 + κ)/ρ that limits the step; of thin gas that does not, the liquid's part in a cell.
    fn diffusivity(&self, density: &[f64], phi: &[f64]) -> f64 {
        let gas = match self.thin_gas {
            ThinGas::Bounded => PhaseViscosity::default(),
            ThinGas::Resolved => self.gas,
            ThinGas::SuperTimeStepping => return Spreading::diffusivity(self, density, phi) / BY_STAGES,
        };
        let counted = Self { gas, ..*self };
        passes::stiffest_per_density(&counted, density, phi)
    }

    /// Δt (η/ρ)(1/h_z² + 1/h_r²) ≤ 3/8.
    fn step_limit(&self, widths: [f64; 2], diffusivity: f64) -> f64 {
        step_limit(widths, diffusivity)
    }

    fn spreading(&self) -> Option<&dyn Spreading> {
        (self.thin_gas == ThinGas::SuperTimeStepping).then_some(self)
    }

    /// μ(v_r − v_wall)/(h_z/2); in stages see [`Viscosity::wall_shear_in_stages`].
    fn wall_shear(&self, cell: WallCell) -> f64 {
        if self.thin_gas == ThinGas::SuperTimeStepping {
            return self.wall_shear_in_stages(cell);
        }
        let WallCell { density, phi: [phi, _], slip, dt, inverse_h, .. } = cell;
        let viscosity = self.at(phi);
        let most = density * most_diffusivity(dt, inverse_h);
        let share = stress::share(most, longitudinal(viscosity));
        2.0 * share * viscosity[0] * slip * inverse_h[0]
    }
}

impl Viscosity {
    /// The mean shear stress on a wall in a step in which momentum spreads over many cells, Pa.
    ///
    /// The velocity near the wall is a line, of the stress τ between the first two cells, and what the first cell is off that, which spreads
    /// as in Stokes' first problem: τ + (v − τ h/(2μ)) G, where half a cell resists with h/(2μ) and what is behind it with √(π Δt/(4ρμ)). In
    /// one step no more is stopped than has the mass of eight cells. With short steps it is 2μv/h.
    ///
    /// The line's part lies between 0 and twice 2μv/h: a wall takes from the motion along it. Where gas meets liquid on the wall the two cells may be on
    /// no line, and what they differ by would drive them.
    fn wall_shear_in_stages(&self, cell: WallCell) -> f64 {
        let WallCell { density, phi, by_waves: [first, second], dt, inverse_h: [inverse_h, _], .. } = cell;
        let [own, other] = phi.map(|phi| self.at(phi)[0]);
        if own <= 0.0 {
            return 0.0;
        }
        let resistance = 0.5 / (inverse_h * own);
        let most = 2.0 * first / resistance;
        let line = 0.5 * (own + other) * (second - first) * inverse_h;
        let line = line.clamp(most.min(0.0), most.max(0.0));
        let behind = (std::f64::consts::FRAC_PI_4 * dt / (density * own)).sqrt();
        let conductance = (1.0 / (resistance + behind)).min(8.0 * density / (inverse_h * dt));
        line + (first - line * resistance) * conductance
    }

    /// How many cells of a block are more viscous than the step is stable with.
    fn count_bounded(&self, block: &TermBlock<'_>) -> u64 {
        let TermBlock { cells: n, metric, .. } = *block;
        let most = most_diffusivity(metric.dt, metric.inverse_h);
        (0..n)
            .map(|j| metric.origin + j * metric.stride)
            .map(|first| [PHI, RHO].map(|component| &block.state[component][first..first + n]))
            .map(|[phi, density]| passes::count_beyond(self, most, density, phi))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_takes_from_the_motion_along_it() {
        let of = |shear: f64| PhaseViscosity { shear, bulk: 0.0 };
        let viscosity = Viscosity { liquid: of(1e-3), gas: of(10.0), thin_gas: ThinGas::SuperTimeStepping };
        let inverse_h = [3e4, 3e4];
        for phi in [[1.0, 1.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]] {
            for by_waves in [[1.0, 3.0], [1.0, 2.5], [1.0, -50.0], [-1.0, 50.0], [1e-3, 100.0], [-2.0, 0.0]] {
                let [slip, _] = by_waves;
                let density = if phi[0] < 0.5 { 1e3 } else { 1.0 };
                let cell = WallCell { density, phi, by_waves, slip, dt: 1e-8, inverse_h };
                let shear = viscosity.wall_shear(cell);
                let sticking = 2.0 * viscosity.at(phi[0])[0] * slip * inverse_h[0];
                let share = shear / sticking;
                assert!(share > 0.0 && share <= 2.0, "{phi:?} {by_waves:?}: {share}");
            }
        }
        // On a line through the wall it is the line's own, in however long a step.
        let cell =
            WallCell { density: 1.0, phi: [1.0; 2], by_waves: [1.0, 3.0], slip: 1.0, dt: 1e-6, inverse_h };
        approx::assert_relative_eq!(viscosity.wall_shear(cell), 20.0 * inverse_h[0], max_relative = 1e-12);
    }
}
