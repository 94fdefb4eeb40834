//! Viscosity in many stages within one step.

use super::layered::{SHEET, take_for_layers};
use super::passes::{self, OfCells};
use super::stress::{FaceStress, Motion, Parts, stresses};
use super::velocities::{Sides, Velocities};
use super::{
    PhaseViscosity, Stresses, Viscosity, beside_wall, longitudinal, mirror_beyond_sides, spared_dilatation,
};
use crate::Boundary;
use crate::state::primitive::{PHI, RHO};
use crate::terms::diffusion::largest_per_density;
use crate::terms::super_stepping::{Frame, Shape, Spreading, View};
use crate::terms::{TermBlock, WallCell, for_cells_without_mid_step};

impl Viscosity {
    /// The axes of the rows of stresses: τ_zz and τ_zr along z; τ_rr, τ_rz and τ_rr − τ_φφ along r.
    pub(super) const AXES: [usize; 5] = [0, 0, 1, 1, 1];

    /// 4μ/3 + κ, no less than those of either phase or of layers of liquid.
    fn most(&self) -> f64 {
        let of = |phase: PhaseViscosity| longitudinal([phase.shear, phase.bulk]);
        (of(self.liquid) + SHEET * self.liquid.shear).max(of(self.gas))
    }
}

/// The largest rate at which anything decays, over 4D(1/h_z² + 1/h_r²): next to the axis the hoop stress damps besides.
const BESIDE_AXIS: f64 = 0.5 / 0.43;

impl Spreading for Viscosity {
    /// Variables: v_z, v_r. Constants: μ, κ, ρ, φ, and what the liquid is spared.
    fn shape(&self) -> Shape {
        Shape { kind: View::MOMENTUM, variables: 2, constants: 5, axes: &Self::AXES }
    }

    /// (4μ/3 + κ)/ρ; of gas that of liquid over its density, which it may have on faces towards mixed cells.
    fn diffusivity(&self, density: &[f64], phi: &[f64]) -> f64 {
        let liquid = longitudinal([self.liquid.shear, self.liquid.bulk]);
        largest_per_density(density, phi, |phi| if phi > 1e-3 { self.most() } else { liquid })
    }

    fn begin(&self, block: &TermBlock<'_>, _work: &mut Vec<f64>, kept: [&mut [f64]; 2]) -> f64 {
        let [constants, values] = kept;
        let len = block.state[RHO].len();
        let (v_z, v_r) = values.split_at_mut(len);
        Velocities { v_z, v_r }.gather(block);
        for (k, phi) in block.state[PHI].iter().enumerate() {
            [constants[k], constants[len + k]] = self.at(*phi);
        }
        constants[2 * len..3 * len].copy_from_slice(block.state[RHO]);
        constants[3 * len..4 * len].copy_from_slice(block.before[PHI]);
        spared_dilatation(block, &mut constants[4 * len..]);
        for_cells_without_mid_step(block, |k| {
            [constants[k], constants[len + k]] = self.at(block.before[PHI][k]);
            constants[2 * len + k] = block.before[RHO][k];
        });
        mirror_beyond_sides(block, constants.chunks_exact_mut(len));
        let (metric, stride) = (block.metric, block.metric.stride);
        let across: f64 = metric.inverse_h.iter().map(|inverse| inverse * inverse).sum();
        let mut fastest = 0.0_f64;
        for j in 0..block.cells {
            for k in (0..block.cells).map(|i| metric.origin + j * stride + i) {
                let of = |k: usize| {
                    longitudinal([constants[k], constants[len + k]])
                        + SHEET * self.liquid.shear * constants[4 * len + k]
                };
                let beside = [k - 1, k + 1, k - stride, k + stride].map(of).into_iter().fold(0.0, f64::max);
                let on_face = (0.5 * (of(k) + beside)).max(of(k));
                fastest = fastest.max(4.0 * BESIDE_AXIS * on_face / constants[2 * len + k] * across);
            }
        }
        fastest
    }

    /// Friction on the wall to the solid is what both media agree upon.
    fn is_given(&self, kind: Boundary) -> bool {
        kind == Boundary::Interface
    }

    fn bounded(&self, block: &TermBlock<'_>, work: &mut Vec<f64>, fluxes: &mut [f64]) {
        let Stresses { velocity: [_, v_r], z, r, .. } = self.stresses(block, work);
        for k in beside_wall(block).filter(|_| block.wall.is_some()) {
            // The ghost below goes as the fluid does, the other way about the wall's velocity.
            let wall = 0.5 * (v_r[k] + v_r[k + 1]);
            let by_waves = [v_r[k + 1] - wall, v_r[k + 2] - wall];
            let cell = WallCell {
                density: block.before[RHO][k + 1],
                phi: [block.before[PHI][k + 1], block.before[PHI][k + 2]],
                by_waves,
                slip: by_waves[0],
                dt: block.metric.dt,
                inverse_h: block.metric.inverse_h,
            };
            // Across that wall passes its pressure alone.
            (z.normal[k], z.shear[k]) = (0.0, self.wall_shear_in_stages(cell));
        }
        let rows = [z.normal, z.shear, r.normal, r.shear, r.hoop];
        let len = block.state[RHO].len();
        fluxes.chunks_exact_mut(len).zip(rows).for_each(|(to, from)| to.copy_from_slice(from));
    }

    fn conduct(&self, frame: &Frame, constants: &[f64], values: &mut [f64], fluxes: &mut [f64]) {
        let len = frame.inverse_r.len();
        let (v_z, v_r) = values.split_at_mut(len);
        let sides = Sides {
            cells: frame.cells,
            origin: frame.origin,
            stride: frame.stride,
            kinds: frame.sides,
            wall: frame.wall.as_deref(),
        };
        Velocities { v_z: &mut *v_z, v_r: &mut *v_r }.complete_all(&sides);
        let row = |number: usize| &constants[number * len..(number + 1) * len];
        let motion = Motion {
            velocity: [v_z, v_r],
            shear: row(0),
            bulk: row(1),
            density: row(2),
            stride: frame.stride,
            inverse_h: frame.inverse_h,
            inverse_r: &frame.inverse_r,
            most: f64::INFINITY,
            may_be_bounded: false,
        };
        let mut rows = fluxes.chunks_exact_mut(len);
        let [z_normal, z_shear, r_normal, r_shear, hoop] =
            std::array::from_fn(|_| rows.next().expect("as many as there are axes"));
        let end = frame.origin + (frame.cells - 1) * frame.stride + frame.cells;
        // Along z nothing asks for the hoop stress: what is written there is written over.
        let mut z = FaceStress { normal: z_normal, shear: z_shear, hoop: &mut *hoop };
        let layers = self.layers(row(3), row(4));
        let is_layered = layers.spared.iter().any(|spared| *spared != 0.0);
        stresses(&motion, 0, frame.origin - 1..end, &mut z);
        if is_layered {
            take_for_layers(&motion, &layers, 0, frame.origin - 1..end, &mut z);
        }
        let mut r = FaceStress { normal: r_normal, shear: r_shear, hoop };
        stresses(&motion, 1, frame.origin - frame.stride..end, &mut r);
        if is_layered {
            take_for_layers(&motion, &layers, 1, frame.origin - frame.stride..end, &mut r);
        }
    }

    fn change(&self, frame: &Frame, constants: &[f64], fluxes: &[f64], rates: &mut [f64]) {
        let len = frame.inverse_r.len();
        let row = |number: usize| &fluxes[number * len..(number + 1) * len];
        let [z_normal, z_shear, r_normal, r_shear, hoop] = [0, 1, 2, 3, 4].map(row);
        let parts = Parts { shear: &constants[..len], bulk: &constants[len..2 * len], are_one: false };
        let density = &constants[2 * len..3 * len];
        let Frame { inverse_h, stride, .. } = *frame;
        let cells = OfCells { parts, density, inverse_r: &frame.inverse_r, inverse_h, stride };
        let on_faces = ([z_normal, z_shear], [r_normal, r_shear, hoop]);
        let (along_z, along_r) = rates.split_at_mut(len);
        passes::accelerations(cells, (frame.cells, frame.origin), on_faces, [along_z, along_r]);
    }
}
