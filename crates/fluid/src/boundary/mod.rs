//! What bounds the fluid: ghost cells before the slopes, outer states and wall fluxes after them.

pub(crate) mod far_field;
pub(crate) mod history;
pub(crate) mod inflow;
pub(crate) mod outer_states;
pub(crate) mod participant;
pub(crate) mod wall_trace;

use crate::state::PrimitiveCell;
use crate::state::primitive::VELOCITY;
use mesh::{BlockId, Domain, FaceState, Frame, Mesh, Side, SideStates, Tile, TileRows};

use crate::boundary::far_field::{FarField, Inner, SideImpulses, SourceHistory};
use crate::boundary::history::PressureHistory;
use crate::reconstruction::Reconstruction;
use crate::riemann::hllc::Face;
use crate::step::face_rows::FaceRows;
use crate::{Boundary, Mixture, Primitive, TRACE_GAS};

/// The four sides of the domain.
#[derive(Clone, Debug)]
pub(crate) struct Boundaries {
    kinds: [Boundary; 4],
    /// The initial state in the cells along each side, and the gas's part of its mass.
    pub(crate) initial: SideStates<(Primitive, f64)>,
    pub(crate) inflow: Option<PressureHistory>,
    pub(crate) far_field: Option<FarField>,
    /// The open sides that have gas beyond them.
    has_gas_beyond: [bool; 4],
}

impl Boundaries {
    pub fn new(
        kinds: [Boundary; 4],
        initial: SideStates<(Primitive, f64)>,
        inflow: Option<PressureHistory>,
        far_field: Option<FarField>,
    ) -> Self {
        let has_gas =
            |side: Side| initial.along(side).any(|(state, share)| state.phi != 0.0 || *share != 0.0);
        let has_gas_beyond = Side::ALL.map(|side| kinds[side as usize].is_open() && has_gas(side));
        Self { kinds, initial, inflow, far_field, has_gas_beyond }
    }

    /// Whether a block touches an open side of the domain that has gas beyond it.
    pub fn may_let_gas_in<const N: usize>(&self, mesh: &Mesh<N>, slot: usize) -> bool {
        Side::ALL.into_iter().any(|side| self.has_gas_beyond[side as usize] && mesh.touches(slot, side))
    }

    pub fn kind(&self, side: Side) -> Boundary {
        self.kinds[side as usize]
    }

    pub fn has_far_field(&self, side: Side) -> bool {
        self.kind(side) == Boundary::FarField
    }

    pub fn far_field(&self) -> Option<&FarField> {
        self.far_field.as_ref()
    }

    /// What the far field is to know of the bubbles: nothing yet.
    pub fn source_history(&self, domain: &Domain) -> SourceHistory {
        let of = |far_field| SourceHistory::new(far_field, domain, self.kinds);
        self.far_field.as_ref().map_or_else(SourceHistory::default, of)
    }

    /// The impulses with which the far field begins, such that the faces have the initial state.
    pub fn initial_impulses<const N: usize>(&self, mesh: &Mesh<N>, mixture: &Mixture) -> SideImpulses {
        let finest = mesh.tree().finest();
        SideImpulses::new(
            mesh,
            |side| self.has_far_field(side),
            |side, along, face| {
                let (Primitive { density, v_z, v_r, pressure, phi }, _) =
                    *self.initial.at(side, finest, along);
                let state = Inner([density, v_z, v_r, pressure]);
                let far_field = self.far_field.as_ref().filter(|_| phi.abs() <= TRACE_GAS);
                far_field.map_or(0.0, |far_field| far_field.initial_impulse(side, face, state, mixture))
            },
        )
    }

    /// Fills the ghosts of a tile beyond the domain, in primitive variables.
    ///
    /// - `own_components`: how many the two-phase model has; what follows are mass fractions.
    pub fn fill_ghosts<const N: usize>(
        &self,
        mesh: &Mesh<N>,
        tile: Tile,
        own_components: usize,
        cells: &mut TileRows<N>,
    ) {
        // r first: the z sides then find the ghosts beyond r filled and complete the corners.
        for side in Side::FOR_GHOSTS {
            if !mesh.tile_touches(tile, side) {
                continue;
            }
            let frame = cells.frame();
            for component in 0..cells.components() {
                let row = cells.component_mut(component);
                match self.kind(side) {
                    // What comes in through an open side has the mass fractions that are inside.
                    _ if component >= own_components => frame.reflect(row, side, 1.0),
                    Boundary::Axis | Boundary::Wall | Boundary::Symmetry => {
                        frame.reflect(row, side, if component == normal(side) { -1.0 } else { 1.0 });
                    }
                    Boundary::NonReflecting | Boundary::FarField | Boundary::Inflow | Boundary::Interface => {
                        frame.extrapolate(row, side);
                    }
                    Boundary::Periodic => unreachable!("a periodic side has neighbours"),
                }
            }
        }
    }

    /// The gas's part of the mass that open sides hold outside a face, so many from a block's first one; `None` at other sides.
    pub fn initial_gas_share<const N: usize>(&self, id: BlockId, side: Side, along: usize) -> Option<f64> {
        let first = id.first_face::<N>(side);
        self.kind(side).is_open().then(|| self.initial.at(side, id.level, first + along).1)
    }

    /// Replaces the fluxes through the wall between fluid and solid by those that the wall's state makes.
    ///
    /// On the fixed mesh the wall's motion carries fluid through the face: mass ρ*v*, momentum p* + ρ*v*²,
    /// energy (1 + β₁) p*v* + β₂ v* + ½ρ*v*|v|², gas fraction with v*. Without it the liquid would not feel the
    /// wall give way.
    ///
    /// - `wall`: the states of the wall's faces, in the order of r; `frame`: of the cells.
    pub fn impose_wall(
        wall: &[FaceState],
        frame: Frame,
        cells: &Reconstruction<'_>,
        mixture: &Mixture,
        faces: &mut FaceRows,
    ) {
        for (j, state) in wall.iter().enumerate() {
            let inner = frame.index(0, j as isize);
            let share = if cells.with_gas { cells.gas_shares[inner] } else { 0.0 };
            faces.set(inner - 1, wall_face(cells.face_state(inner, -1.0), share, *state, mixture));
        }
    }
}

/// The flux through a wall that moves with `wall.velocity`, see [`Boundaries::impose_wall`].
///
/// - `share`: the gas's part of the mass; without a say where there is no covolume.
fn wall_face(trace: PrimitiveCell, share: f64, wall: FaceState, mixture: &Mixture) -> Face {
    let [density, v_n, v_t, pressure, phi] = trace;
    // As in the trace that the other side got: on the wall the reconstruction may leave the unit interval.
    let phi = phi.clamp(0.0, 1.0);
    let at = mixture.law_at(density, phi, share);
    let fluid = coupler::FluidTrace {
        pressure,
        velocity: v_n,
        density: at.free_density(density),
        gamma: at.gamma,
        pi: at.pi,
    };
    let star = at.density_of_free(coupler::star_density(&fluid, wall.pressure));
    let mass = star * wall.velocity;
    let kinetic = 0.5 * mass * (wall.velocity * wall.velocity + v_t * v_t);
    let [beta1, beta2] = mixture.free_betas::<true>(phi, star, star * share);
    // The enthalpy that passes is the pressure's work's; friction does its own besides.
    let sliding = if wall.shear == 0.0 { 0.0 } else { wall.shear * wall.tangential_velocity };
    let work = if sliding == 0.0 { wall.power } else { wall.power + sliding };
    let carried = (1.0 + beta1) * work + beta2 * wall.velocity + kinetic;
    let energy = if sliding == 0.0 { carried } else { carried - sliding };
    let shear = if wall.shear == 0.0 { mass * v_t } else { mass * v_t - wall.shear };
    Face {
        mass,
        velocity: wall.velocity,
        pressure: wall.pressure,
        shear,
        energy,
        phi,
        compression: star / density,
    }
}

/// The axis normal to a side: 0 (z) or 1 (r).
pub(crate) fn axis(side: Side) -> usize {
    if matches!(side, Side::ZMin | Side::ZMax) { 0 } else { 1 }
}

/// Component of the velocity, or of the momentum, normal to a side.
pub(crate) fn normal(side: Side) -> usize {
    VELOCITY[axis(side)]
}

/// Component of the velocity, or of the momentum, along a side.
pub(crate) fn tangential(side: Side) -> usize {
    VELOCITY[1 - axis(side)]
}

/// The padded cell next to a side, `along` cells from its beginning, and the ghost beyond.
pub(crate) fn beside(side: Side, frame: Frame, along: isize) -> [usize; 2] {
    [0, -1].map(|depth| frame.below(side, depth, along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_at_rest_passes_pressure_only_and_a_moving_one_the_physical_flux() {
        let mixture = Mixture::water_and_air();
        let trace = [1000.0, 0.0, 3.0, 5e7, 0.0];
        let rest = wall_face(trace, 0.0, FaceState::from([5e7, 0.0, 0.0]), &mixture);
        assert_eq!((rest.mass, rest.pressure, rest.energy, rest.shear), (0.0, 5e7, 0.0, 0.0));
        // A wall that moves with the fluid at its pressure passes the fluid's own flux.
        let trace = [1000.0, 2.0, 3.0, 5e7, 0.0];
        let moving = wall_face(trace, 0.0, FaceState::from([5e7, 2.0, 1e8]), &mixture);
        let own = crate::riemann::hllc::flux_hllc(trace, trace, &mixture);
        approx::assert_relative_eq!(moving.mass, own.mass, max_relative = 1e-14);
        approx::assert_relative_eq!(moving.energy, own.energy, max_relative = 1e-14);
    }
}
