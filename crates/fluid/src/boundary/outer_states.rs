//! The states beyond the sides of the domain at mid-step.

use crate::state::COUNT;
use crate::state::primitive::PRESSURE;
use mesh::{Side, Tile, TileRows};

use crate::boundary::far_field::{FarField, Inner, face_centre};
use crate::boundary::{Boundaries, axis, beside, normal};
use crate::physics::FluidStep;
use crate::{Boundary, Mixture, Primitive, TRACE_GAS};

impl Boundaries {
    /// Puts the outer states into the ghost cells at mid-step: on open sides without slopes, at walls and on the
    /// axis the mirror images of the inner ones. (Their own predictor would not be that: beyond the outer wall
    /// the metric goes on. Nothing must pass a wall, to the last bit.)
    ///
    /// - `slopes`: differences across the cells along z and r.
    pub fn impose_outer<const N: usize>(
        &self,
        ctx: &FluidStep<'_, N>,
        tile: Tile,
        slopes: [&TileRows<N>; 2],
        half: &mut TileRows<N>,
        keep: &mut [f64],
    ) {
        let (mesh, mixture, frame) = (ctx.mesh, &ctx.model.mixture, half.frame());
        let id = mesh.first_of(tile);
        for side in Side::ALL {
            let inflow = match self.kind(side) {
                Boundary::Wall | Boundary::Symmetry | Boundary::Axis if mesh.tile_touches(tile, side) => {
                    mirror(side, half, keep);
                    if ctx.model.terms.acceleration()[axis(side)] != 0.0 {
                        meet_on_face(side, slopes[axis(side)], half, keep);
                    }
                    continue;
                }
                Boundary::NonReflecting | Boundary::FarField => None,
                Boundary::Inflow => self.inflow.as_ref(),
                _ => continue,
            };
            if !mesh.tile_touches(tile, side) {
                continue;
            }
            let first = id.first_face::<N>(side);
            let outwards = if matches!(side, Side::ZMin | Side::RMin) { -0.5 } else { 0.5 };
            // What is kept is the state of the cell: half a width on, the pressure is that of liquid at rest there.
            let per_density =
                outwards * ctx.model.terms.acceleration()[axis(side)] * mesh.widths(id.level)[axis(side)];
            let far_field = self.far_field.as_ref().filter(|_| self.kind(side) == Boundary::FarField);
            for along in 0..frame.cells() {
                let (mut state, _) = *self.initial.at(side, id.level, first + along);
                if per_density != 0.0 {
                    state.pressure += state.density * per_density;
                }
                let [inner, k] = beside(side, frame, along as isize);
                if let Some(history) = inflow {
                    state = entering(state, side, history.at(ctx.middle()), mixture);
                }
                if let Some(far_field) = far_field {
                    let reach = outwards * keep[inner];
                    let across = slopes[axis(side)];
                    let on_face = |c: usize| half.component(c)[inner] + reach * across.component(c)[inner];
                    let trace = Primitive::from_array(std::array::from_fn(on_face));
                    let face = (side, id.level, first + along);
                    state = far_state(far_field, ctx, face, trace, state).unwrap_or(state);
                }
                keep[k] = 0.0;
                for (component, value) in state.to_array().into_iter().enumerate() {
                    half.component_mut(component)[k] = value;
                }
            }
        }
    }
}

/// The state beyond a face of a side with a far field; `None` where there is gas, which that is not about.
///
/// - `side`, level, number along the side: of the face. `trace`: what the cell within has on it; `initial`: what was beyond it
///   at t = 0, from where the liquid's isentrope leads to its density.
fn far_state<const N: usize>(
    far_field: &FarField,
    ctx: &FluidStep<'_, N>,
    (side, level, along): (Side, u8, usize),
    trace: Primitive,
    initial: Primitive,
) -> Option<Primitive> {
    let mixture = &ctx.model.mixture;
    let is_liquid = |state: &Primitive| state.phi.abs() <= TRACE_GAS;
    let is_state = trace.density > 0.0 && trace.pressure > mixture.pressure_floor(0.0);
    if !(is_liquid(&trace) && is_liquid(&initial) && is_state) {
        return None;
    }
    let impulse = ctx.model.far.impulses.at(side, level, along);
    let inner = Inner([trace.density, trace.v_z, trace.v_r, trace.pressure]);
    let centre = face_centre(ctx.mesh, side, level, along);
    let outer = far_field.outer(side, centre, inner, mixture, ctx.model.moment(ctx), impulse);
    let pressure = outer.pressure.max(mixture.pressure_floor(0.0));
    let density = mixture.liquid.isentropic_density(initial.density, initial.pressure, pressure);
    let velocity = if matches!(side, Side::ZMin | Side::RMin) { -outer.velocity } else { outer.velocity };
    let state = Primitive { density, pressure, phi: 0.0, ..trace };
    Some(if axis(side) == 0 {
        Primitive { v_z: velocity, ..state }
    } else {
        Primitive { v_r: velocity, ..state }
    })
}

/// The state behind a plane wave of pressure `p` that enters into `initial` through a side: isentropic, with
/// v = ∫dp/(ρc) ≈ (p − p₀)/(ρc) inwards.
fn entering(initial: Primitive, side: Side, p: f64, mixture: &Mixture) -> Primitive {
    // What enters is of one phase, whose part of the mass is φ.
    let at = mixture.law_at(initial.density, initial.phi, initial.phi);
    let ratio = (p + at.pi) / (initial.pressure + at.pi);
    let before = at.free_density(initial.density);
    let after = before * ratio.powf(1.0 / at.gamma);
    let sound = |p: f64, rho: f64| (at.gamma * (p + at.pi) / rho).sqrt();
    // Riemann invariant of the isentropic simple wave: v = 2 (c − c₀)/(γ − 1), with the sound speeds in the free volume.
    let jump = 2.0 / (at.gamma - 1.0) * (sound(p, after) - sound(initial.pressure, before));
    let density = at.density_of_free(after);
    let inwards = if matches!(side, Side::ZMin | Side::RMin) { jump } else { -jump };
    let (mut v_z, mut v_r) = (initial.v_z, initial.v_r);
    if axis(side) == 0 {
        v_z += inwards;
    } else {
        v_r += inwards;
    }
    Primitive { density, v_z, v_r, pressure: p, phi: initial.phi }
}

/// Makes the ghost cells next to a side the mirror images of the cells within, at mid-step.
fn mirror<const N: usize>(side: Side, half: &mut TileRows<N>, keep: &mut [f64]) {
    let frame = half.frame();
    for along in 0..frame.cells() {
        let [from, to] = beside(side, frame, along as isize);
        for component in 0..COUNT {
            let row = half.component_mut(component);
            row[to] = if component == normal(side) { -row[from] } else { row[from] };
        }
        keep[to] = keep[from];
    }
}

/// Gives the images of cells next to a side the pressure with which both meet on the face, where their slopes are no images: under an
/// acceleration the pressure has an odd part, too.
///
/// - `slopes`: differences across the cells, normal to the side.
fn meet_on_face<const N: usize>(side: Side, slopes: &TileRows<N>, half: &mut TileRows<N>, keep: &[f64]) {
    let frame = half.frame();
    let (slopes, pressure) = (slopes.component(PRESSURE), half.component_mut(PRESSURE));
    let towards_face = if matches!(side, Side::ZMin | Side::RMin) { -0.5 } else { 0.5 };
    for along in 0..frame.cells() {
        let [from, to] = beside(side, frame, along as isize);
        pressure[to] = pressure[from] + towards_face * keep[from] * (slopes[from] + slopes[to]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entering_wave_is_acoustic_when_weak() {
        let mixture = Mixture::water_and_air();
        let rest = Primitive { density: 1000.0, v_z: 0.0, v_r: 0.0, pressure: 1e5, phi: 0.0 };
        let state = entering(rest, Side::ZMax, 1e5 + 100.0, &mixture);
        let impedance = 1000.0 * (7.15_f64 * (1e5 + 3e8) / 1000.0).sqrt();
        approx::assert_relative_eq!(state.v_z, -100.0 / impedance, max_relative = 1e-5);
    }
}
