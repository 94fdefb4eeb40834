//! A case made into solvers.

use std::sync::Arc;

use fluid::{
    Boundary, FarField, FluidError, FluidSetup, FluidSolver, Mixture, PressureHistory, SurfaceTension,
};
use mesh::{BLOCK, Domain, Entering};
use solid::{ElasticState, InitialStress, PotentialPulse, SolidSetup, SolidSolver, WaveSpeeds};

use crate::case::{Case, FluidCase, GridCase, SolidCase, TermsCase};
use crate::run::RunError;
use crate::run::carried::Carried;
use crate::run::coming_load::ComingLoad;
use crate::run::wall::Wall;

fn domain(case: &Case, grid: &GridCase) -> Domain {
    Domain { geometry: case.geometry, z: grid.z, r: grid.r }
}

/// What a case's open sides hold, where they have a far field.
fn far_field(case: &Case, fluid: &FluidCase, inflow: Option<&PressureHistory>) -> Option<FarField> {
    if !fluid.boundary.contains(&Boundary::FarField) {
        return None;
    }
    // A plane wave's from a solid; else the wall is rigid.
    let reflection = case.solid.as_ref().map_or(1.0, |solid| {
        let ambient = &fluid.initial.ambient;
        let sound = fluid.eos(ambient).sound_speed(ambient.density, ambient.pressure);
        let [own, other] = [ambient.density * sound, solid.material.impedance_p()];
        (other - own) / (other + own)
    });
    let (mixture, domain) = (Mixture::new(fluid.liquid, fluid.gas), domain(case, &fluid.grid));
    // A case is refused in reading if it has not the far field that it asks for.
    FarField::of(&fluid.initial, &mixture, &domain, fluid.boundary, inflow, reflection).ok()
}

/// The setup of a case's fluid.
pub fn fluid_setup(case: &Case, fluid: &FluidCase) -> FluidSetup {
    let inflow = fluid.inflow.as_ref().and_then(|inflow| PressureHistory::new(inflow.pressure.clone()));
    FluidSetup {
        domain: domain(case, &fluid.grid),
        coarsest: fluid.grid.cells,
        levels: fluid.grid.levels as u8 + fluid.near_wall.levels(),
        liquid: fluid.liquid,
        gas: fluid.gas,
        model: fluid.model,
        sharpening: fluid.sharpening,
        riemann: fluid.riemann,
        limiter: fluid.limiter,
        boundaries: fluid.boundary,
        far_field: far_field(case, fluid, inflow.as_ref()),
        inflow,
        adaptation: fluid.grid.adaptation.clone(),
        near_wall: fluid.near_wall,
        scales: scales(fluid),
        gravity: fluid.gravity,
        viscosity: fluid.terms.viscosity,
        conduction: fluid.terms.conduction,
        followed: fluid.followed_bubble(),
        surface_tension: surface_tension(fluid),
        phase_change: fluid.terms.phase_change,
        tracer: fluid.tracer,
    }
}

fn surface_tension(fluid: &FluidCase) -> Option<SurfaceTension> {
    let TermsCase { surface_tension, contact_angle, .. } = fluid.terms;
    surface_tension.map(|coefficient| SurfaceTension {
        coefficient,
        density: fluid.scale_density,
        may_touch_walls: contact_angle.is_some(),
    })
}

/// The fluid's reference values, with those of waves such that the threshold of interfaces, applied to them, is their own.
fn scales(fluid: &FluidCase) -> fluid::Scales {
    let epsilon = fluid.grid.adaptation.as_ref().map_or(fluid.wave_epsilon, |adaptation| adaptation.epsilon);
    let pressure = fluid.scale_pressure * (fluid.wave_epsilon / epsilon);
    fluid::Scales { pressure, density: fluid.scale_density }
}

/// A case's fluid, filled with its initial condition.
pub fn fluid_solver(case: &Case, fluid: &FluidCase) -> Result<FluidSolver<BLOCK>, FluidError> {
    FluidSolver::compiled(&fluid_setup(case, fluid), &fluid.initial)
}

/// The setup of a case's solid.
pub fn solid_setup(case: &Case, solid: &SolidCase) -> SolidSetup {
    let coming = case.coupling.load.as_ref().and_then(ComingLoad::of);
    SolidSetup {
        domain: domain(case, &solid.grid),
        coarsest: solid.grid.cells,
        levels: solid.grid.levels as u8,
        speeds: WaveSpeeds {
            density: solid.material.density(),
            c1: solid.material.c1(),
            c2: solid.material.c2(),
        },
        yield_strength: solid.yield_strength().unwrap_or(f64::INFINITY),
        plasticity: solid.plasticity.clone(),
        limiter: solid.limiter,
        boundaries: solid.boundary,
        adaptation: solid.grid.adaptation.clone(),
        stress_scale: solid.scale_stress,
        weight: solid.weight,
        load: coming.map(|load| Arc::new(load) as Arc<dyn Entering>),
    }
}

/// A case's solid: the stress that carries the fluid's pressure on the wall, and its pulses.
///
/// Where that pressure varies along the wall it is the stress of a half-space at rest: nothing moves before the fluid does.
pub fn solid_solver(case: &Case, solid: &SolidCase) -> Result<SolidSolver<BLOCK>, RunError> {
    Ok(solid_and_displacement(case, solid)?.0)
}

/// (u_z, u_r) on the faces of a surface, m.
pub type SurfaceProfile = Vec<[f64; 2]>;

/// The same with the displacement (u_z, u_r) of its surface on the faces of the finest level at t = 0, m, of a wall that has been hit before.
pub fn solid_and_displacement(
    case: &Case,
    solid: &SolidCase,
) -> Result<(SolidSolver<BLOCK>, Option<SurfaceProfile>), RunError> {
    let pressure = case.ambient_pressure();
    let carried = Carried::of(case, solid)?;
    let setup = solid_setup(case, solid);
    let (lambda, mu) = (solid.material.lambda(), solid.material.mu());
    let wall = Wall::of(case, solid)?;
    // A wall that has been hit before carries its weight already.
    let weight = solid.weight.filter(|_| wall.is_none());
    let initial = |point: [f64; 2]| {
        let mut state = carried.stress(point);
        if let Some(weight) = weight {
            state.stress_zz += weight.stress(solid.material.density(), point[0]);
        }
        if solid.initial_stress == InitialStress::Hydrostatic {
            state.stress_rr -= pressure;
            state.stress_phiphi -= pressure;
        }
        for pulse in &solid.pulses {
            add_pulse(pulse, point, lambda, mu, &mut state);
        }
        state
    };
    match wall {
        Some(wall) => {
            let displacement = wall.displacement().to_vec();
            Ok((wall.solver(setup, initial)?, Some(displacement)))
        }
        None => {
            Ok((SolidSolver::compiled_under_load(setup, &initial, &|point| carried.stress(point))?, None))
        }
    }
}

/// Adds the stress of the displacement u = ∇(Φ exp(−R²/a²)), R the distance to the centre on the axis.
///
/// With g = exp(−R²/a²) and the distances (ζ, r): u_z,z = Φ g (4ζ²/a⁴ − 2/a²) and so on, u_r/r = −2Φg/a².
fn add_pulse(pulse: &PotentialPulse, [z, r]: [f64; 2], lambda: f64, mu: f64, state: &mut ElasticState) {
    let (zeta, a2) = (z - pulse.centre[0], pulse.width * pulse.width);
    let r = r - pulse.centre[1];
    let g = pulse.amplitude * (-(zeta * zeta + r * r) / a2).exp();
    let axial = g * (4.0 * zeta * zeta / (a2 * a2) - 2.0 / a2);
    let radial = g * (4.0 * r * r / (a2 * a2) - 2.0 / a2);
    let hoop = -2.0 * g / a2;
    let dilatation = lambda * (axial + radial + hoop);
    state.stress_zz += dilatation + 2.0 * mu * axial;
    state.stress_rr += dilatation + 2.0 * mu * radial;
    state.stress_phiphi += dilatation + 2.0 * mu * hoop;
    state.stress_zr += 2.0 * mu * g * 4.0 * zeta * r / (a2 * a2);
}
