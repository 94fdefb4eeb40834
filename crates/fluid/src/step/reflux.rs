//! Flux correction at level jumps: the finer side's fluxes pass for both.

use mesh::{CorrectedFace, FinerSide, FluxRegister, Frame, Mesh, Side};

use crate::components::carried::CarriedScratch;
use crate::physics::FluidStep;
use crate::state::conserved::{GAS, PHI};
use crate::step::face_rows::FaceRows;
use crate::step::report::BlockReport;

/// What is registered of a face: mass flux, normal momentum it carries, pressure, tangential momentum flux, energy
/// flux, velocity u_f of the face, u_f φ_f, mass flux of the gas.
///
/// u_f and u_f φ_f carry the gas fraction in its non-conservative form (27): u_f (φ_f − φ) is linear in both, and at
/// uniform p and u the energy flux is the same linear function of φ_f and ρ_f on every face, so means of fine
/// faces keep uniform p and u as single faces do.
pub(crate) const QUANTITIES: usize = 8;

/// Keeps the fluxes on those sides of a block that meet another level.
///
/// - `place`: its slot, and where it lies in the padded rows.
pub(crate) fn register_fluxes<const N: usize>(
    mesh: &Mesh<N>,
    place: (usize, Frame),
    z_faces: &FaceRows,
    r_faces: &FaceRows,
    carried: &[CarriedScratch],
    values: &mut [f64],
) {
    FluxRegister::<N>::record::<QUANTITIES>(mesh, place, values, 0, |side, k| {
        let faces = if matches!(side, Side::ZMin | Side::ZMax) { z_faces } else { r_faces };
        let velocity = faces.velocity[k];
        [
            faces.mass[k],
            faces.mass[k] * velocity,
            faces.pressure[k],
            faces.shear[k],
            faces.energy[k],
            velocity,
            velocity * faces.phi[k],
            faces.gas()[k],
        ]
    });
    for (number, carried) in carried.iter().enumerate() {
        FluxRegister::<N>::record::<1>(mesh, place, values, QUANTITIES + number, |side, k| {
            [carried.fluxes[usize::from(!matches!(side, Side::ZMin | Side::ZMax))][k]]
        });
    }
}

/// Corrects the cells of a block along its finer neighbours, after all blocks have made their step.
///
/// - `finer`: what those neighbours have passed in the meantime.
///
/// The formulas are those of `update.rs` for one face; the floors of pressure and of the phases' masses hold for the corrected cells,
/// too.
pub(crate) fn correct<const N: usize>(
    ctx: &FluidStep<'_, N>,
    finer: FinerSide<'_, N>,
    slot: usize,
    new: &mut [f64],
    report: &mut BlockReport<N>,
) {
    let phases = ctx.model.scheme.phases;
    let id = ctx.mesh.tree().leaves()[slot];
    let [h_z, h_r] = ctx.mesh.widths(id.level);
    let (dt_z, dt_r) = (ctx.dt / h_z, ctx.dt / h_r);
    let r_low = ctx.mesh.origin(id)[1];
    // Of a flux along r: the weight of its face over that of the cell's row.
    let weight = |side: Side, j: usize| {
        let face = r_low + if side == Side::RMin { 0.0 } else { N as f64 * h_r };
        ctx.mesh.weight(face) / ctx.mesh.weight(ctx.mesh.centre(id, 0, j)[1])
    };
    finer.for_corrected_faces(ctx.mesh, slot, 0, |face: CorrectedFace<QUANTITIES>| {
        let CorrectedFace { side, outward, cell: [i, j], difference } = face;
        let [mass, carried, pressure, shear, energy, velocity, velocity_phi, gas] = difference;
        let cell = |c: usize| (c * N + j) * N + i;
        let old = std::array::from_fn(|c| ctx.old.block(slot)[cell(c)]);
        let gas_of = |block: &[f64]| phases.gas_component().map_or(0.0, |gas| block[cell(gas)]);
        let old_gas = gas_of(ctx.old.block(slot));
        let phi = velocity_phi - velocity * (old[PHI] + phases.expansion(old, old_gas, &ctx.model.mixture));
        let changes = if matches!(side, Side::ZMin | Side::ZMax) {
            [mass, carried + pressure, shear, energy, phi, gas].map(|change| outward * dt_z * change)
        } else {
            let weight = weight(side, j);
            // The pressure's share of the radial momentum has no weight, see `update.rs`.
            let radial = weight * carried + pressure;
            [weight * mass, weight * shear, radial, weight * energy, weight * phi, weight * gas]
                .map(|change| outward * dt_r * change)
        };
        let u = std::array::from_fn(|c| new[cell(c)] - changes[c]);
        let new_gas = gas_of(new) - changes[GAS];
        let finished = phases.finish((u, new_gas), (old, old_gas), &ctx.model.mixture);
        report.extremes.add(&finished);
        if finished.floor > 0.0 {
            report.lift_pressure(finished.floor, ctx.mesh.volume(id, j));
        }
        for (c, value) in finished.conserved.into_iter().enumerate() {
            new[cell(c)] = value;
        }
        phases.correct_gas(new, j * N + i, changes[GAS], ctx.mesh.volume(id, j), report);
    });
    for (number, component) in ctx.model.carried_components().enumerate() {
        finer.for_corrected_faces(ctx.mesh, slot, QUANTITIES + number, |face: CorrectedFace<1>| {
            let CorrectedFace { side, outward, cell: [i, j], difference: [flux] } = face;
            let is_along_z = matches!(side, Side::ZMin | Side::ZMax);
            let change = if is_along_z { dt_z * flux } else { dt_r * weight(side, j) * flux };
            new[(component * N + j) * N + i] -= outward * change;
        });
    }
}
