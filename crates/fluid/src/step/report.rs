//! What one block tells of its step.

use mesh::{CellBits, Frame, Side, TileRows};
use serde::{Deserialize, Serialize};

use crate::boundary::far_field::face_centre;
use crate::boundary::{axis, beside, tangential};
use crate::phase_change::BlockExchange;
use crate::physics::FluidStep;
use crate::state::primitive::RHO;
use crate::step::clips::Clips;
use crate::step::face_rows::FaceRows;
use crate::step::update::Extremes;
use crate::two_phase::missing_mass;

/// What one block tells of its step.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct BlockReport<const N: usize> {
    pub(crate) extremes: Extremes,
    /// Whether there is gas in the block, or a trace of its mass.
    pub(crate) has_gas: bool,
    /// Cells that should be done again at first order: a phase was drained, or the pressure floor would act.
    pub(crate) marked: CellBits<N>,
    /// Cells that were done again.
    pub(crate) redone: u32,
    pub(crate) redone_volume: f64,
    /// Cells that fell back to first order.
    pub(crate) fallbacks: u32,
    /// How often other bounds acted.
    pub(crate) clips: Clips,
    /// Mass that the gas and the liquid got where they had less than none, kg (per radian in axial symmetry).
    pub(crate) phase_mass_added: [f64; 2],
    /// What changed phase.
    pub(crate) exchange: BlockExchange,
    /// Cells lifted to the pressure floor, their volume and the energy that took (per radian in axial symmetry), J.
    pub(crate) floored: u32,
    pub(crate) floored_volume: f64,
    pub(crate) floor_energy: f64,
    /// What passed the sides of the domain; of blocks that touch one, once they have made a step. Most blocks do not, and what
    /// is told of a block should be no more than it must: of blocks of 16² cells it would be a fifth of what the step reads.
    pub(crate) sides: Option<Box<SideReport<N>>>,
    /// What surface tension added: axial momentum and energy (per radian).
    pub(crate) tension: [f64; 2],
    /// A cell, j N + i, where an interface is at a wall and must not be.
    pub(crate) contact: Option<u32>,
    /// The largest diffusivity of the terms in any cell, m²/s.
    pub(crate) diffusivity: f64,
}

/// What a block tells of the sides of the domain that it touches.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SideReport<const N: usize> {
    /// What came in through each side: mass, axial momentum, energy, mass of the gas (per radian).
    pub(crate) inflow: [[f64; 4]; 4],
    /// Pressure on the faces of z_min, Pa; 0 in blocks that do not touch it.
    #[serde(with = "mesh::array")]
    pub(crate) wall_pressure: [f64; N],
    /// Shear stress σ_zr on the faces of z_min, Pa; 0 in blocks that do not touch it.
    #[serde(with = "mesh::array")]
    pub(crate) wall_shear: [f64; N],
    /// The heat that the wall on z_min gets on its faces, W/m², and its temperature there, K; 0 in blocks that do not touch it, or
    /// where nothing conducts.
    #[serde(with = "mesh::array")]
    pub(crate) wall_heat: [f64; N],
    /// See `wall_heat`.
    #[serde(with = "mesh::array")]
    pub(crate) wall_temperature: [f64; N],
    /// What the far field's impulse on the faces of each side has gained, Pa s.
    pub(crate) impulse: [FaceRow<N>; 4],
}

impl<const N: usize> Default for SideReport<N> {
    fn default() -> Self {
        Self {
            inflow: [[0.0; 4]; 4],
            wall_pressure: [0.0; N],
            wall_shear: [0.0; N],
            wall_heat: [0.0; N],
            wall_temperature: [0.0; N],
            impulse: [FaceRow([0.0; N]); 4],
        }
    }
}

/// A number on each face along a side of a block.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaceRow<const N: usize>(#[serde(with = "mesh::array")] pub [f64; N]);

impl<const N: usize> Clone for BlockReport<N> {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    /// Into the memory at hand: it is done for every block in every step.
    fn clone_from(&mut self, other: &Self) {
        let mut sides = self.sides.take();
        sides.clone_from(&other.sides);
        *self = Self { sides, ..*other };
    }
}

impl<const N: usize> BlockReport<N> {
    /// Whether there is anything in it to be added up over the run: what passed a side of the domain, or a fix-up.
    pub fn has_news(&self) -> bool {
        self.sides.is_some()
            || self.fallbacks + self.redone + self.floored > 0
            || self.phase_mass_added != [0.0; 2]
            || self.tension != [0.0; 2]
            || self.clips != Clips::default()
            || self.exchange != BlockExchange::default()
    }

    /// Takes down that a cell was lifted to the pressure floor.
    ///
    /// - `added`: the energy for it, J/m³; `volume`: the cell's.
    pub fn lift_pressure(&mut self, added: f64, volume: f64) {
        self.floored += 1;
        self.floored_volume += volume;
        self.floor_energy += added * volume;
    }

    /// Gives a phase of a cell that has less than no mass what it lacks, from the other phase: ρ stays.
    ///
    /// - `gas`: mass of the gas, kg/m³; `volume`: the cell's.
    pub fn lift_phase(&mut self, density: f64, gas: &mut f64, volume: f64) {
        let missing = missing_mass(density, *gas);
        if missing == [0.0; 2] {
            return;
        }
        *gas += missing[0] - missing[1];
        self.clips.lifted_phases += 1;
        for (added, missing) in self.phase_mass_added.iter_mut().zip(missing) {
            *added += missing * volume;
        }
    }
}

/// Cells of the block that keep none of their slopes, and those that keep half, for want of admissible face states.
///
/// - `first`, `stride`: the place of the block's first cell, and the distance of its rows.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn count_kept<const N: usize>(keep: &[f64], first: usize, stride: usize) -> [u32; 2] {
    let (mut dropped, mut halved) = (0_u64, 0_u64);
    for row in keep[first..].chunks(stride).take(N) {
        for share in &row[..N] {
            // Mixed cells of the five-equation model hold −0: they have face states of their own.
            dropped += u64::from(share.to_bits() == 0);
            halved += u64::from(*share == 0.5);
        }
    }
    [dropped as u32, halved as u32]
}

/// What the far field's impulses gain on the faces of a block.
///
/// - `slot`, `at`: the block, and where it lies in the padded rows; `half`: the cells at mid-step.
pub(crate) fn far_field_gains<const N: usize>(
    ctx: &FluidStep<'_, N>,
    (slot, at): (usize, Frame),
    half: &TileRows<N>,
    z_faces: &FaceRows,
    r_faces: &FaceRows,
) -> [FaceRow<N>; 4] {
    let mut gains = [FaceRow([0.0; N]); 4];
    let Some(far_field) = ctx.model.boundaries.far_field() else { return gains };
    let id = ctx.mesh.tree().leaves()[slot];
    for side in Side::ALL {
        if !(ctx.model.boundaries.has_far_field(side) && ctx.mesh.touches(slot, side)) {
            continue;
        }
        let faces = if axis(side) == 0 { z_faces } else { r_faces };
        let is_low = matches!(side, Side::ZMin | Side::RMin);
        for along in 0..N {
            let [inner, ghost] = beside(side, at, along as isize);
            let k = if is_low { ghost } else { inner };
            let u_n = if is_low { -faces.velocity[k] } else { faces.velocity[k] };
            let [rho, u_t] = [RHO, tangential(side)].map(|component| half.component(component)[inner]);
            let centre = face_centre(ctx.mesh, side, id.level, id.first_face::<N>(side) + along);
            let state = [u_n, u_t, faces.pressure[k]];
            gains[side as usize].0[along] = far_field.gain(side, centre, rho, state, ctx.model.moment(ctx));
        }
    }
    gains
}

/// Mass, axial momentum, energy and mass of the gas that a block took in through the sides of the domain.
///
/// - `slot`, `at`: the block, and where it lies in the padded rows.
pub(crate) fn boundary_inflow<const N: usize>(
    ctx: &FluidStep<'_, N>,
    (slot, at): (usize, Frame),
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    face_weight: &[f64],
) -> [[f64; 4]; 4] {
    let mut inflow = [[0.0; 4]; 4];
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    for side in Side::ALL {
        if !ctx.mesh.touches(slot, side) {
            continue;
        }
        let total = &mut inflow[side as usize];
        for along in 0..N {
            let gains = match side {
                Side::ZMin | Side::ZMax => {
                    let i = if side == Side::ZMin { -1 } else { N as isize - 1 };
                    let k = at.index(i, along as isize);
                    let area = ctx.mesh.weight(ctx.mesh.centre(id, 0, along)[1]) * h_r;
                    let momentum = z_faces.mass[k] * z_faces.velocity[k] + z_faces.pressure[k];
                    [z_faces.mass[k], momentum, z_faces.energy[k], z_faces.gas()[k]].map(|flux| area * flux)
                }
                Side::RMin | Side::RMax => {
                    let j = if side == Side::RMin { -1 } else { N as isize - 1 };
                    let k = at.index(along as isize, j);
                    let area = face_weight[(j + 1) as usize] * h_z;
                    [r_faces.mass[k], r_faces.shear[k], r_faces.energy[k], r_faces.gas()[k]]
                        .map(|flux| area * flux)
                }
            };
            let sign = if matches!(side, Side::ZMin | Side::RMin) { ctx.dt } else { -ctx.dt };
            for (total, gain) in total.iter_mut().zip(gains) {
                *total += sign * gain;
            }
        }
    }
    inflow
}
