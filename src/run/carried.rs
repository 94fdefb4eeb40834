//! The stress with which a case's solid carries what presses on its surface at t = 0.

use std::borrow::Cow;

use fluid::{Beneath, RayleighField};
use mesh::{Domain, Side};
use solid::{Boundary, ElasticState, Harmonic, half_space_stress};

use crate::case::{Case, LoadCase, SolidCase};
use crate::output::run_directory::CASE;
use crate::run::RunError;

/// What presses on the surface from the start.
pub enum Carried {
    /// The same pressure everywhere, Pa.
    Uniform(f64),
    /// Rayleigh's, on a solid that goes on beyond its sides.
    HalfSpace(HalfSpace),
    /// Pa by radius, m. Each column of the solid carries what is above it: div σ = 0, so nothing moves.
    Columns(Box<dyn Fn(f64) -> f64 + Sync>),
}

/// A half-space under a pressure.
pub struct HalfSpace {
    /// Far away, Pa.
    ambient: f64,
    beneath: Beneath,
    /// z of the surface, m.
    surface: f64,
    poisson: f64,
}

impl Carried {
    /// Of a case: what its fluid begins with, or what is put on it that a run has recorded.
    ///
    /// - errors: [`RunError::Case`] where the case of the run that recorded it cannot be read.
    pub fn of(case: &Case, solid: &SolidCase) -> Result<Self, RunError> {
        let (ambient, surface) = (case.ambient_pressure(), solid.grid.z[1]);
        let Some((field, wall)) = rayleigh_field(case)? else {
            return Ok(match &case.coupling.load {
                Some(LoadCase::Recorded(load)) => Self::Columns(Box::new(load.at_start())),
                _ => Self::Uniform(ambient),
            });
        };
        // What a side that is none of these does to the static stress is not that of a half-space.
        let goes_on = |side: Side| {
            let kind = solid.boundary[side as usize];
            kind.is_open() || kind == Boundary::Fixed
        };
        let poisson = solid.material.poisson();
        Ok(match field.beneath().filter(|_| goes_on(Side::ZMin) && goes_on(Side::RMax)) {
            Some(beneath) => Self::HalfSpace(HalfSpace { ambient, beneath, surface, poisson }),
            None => Self::Columns(Box::new(move |r| field.pressure([wall, r]))),
        })
    }

    /// The stress at a point (z, r), m, without that across of the ambient pressure.
    pub fn stress(&self, [z, r]: [f64; 2]) -> ElasticState {
        let column = |pressure: f64| ElasticState { stress_zz: -pressure, ..ElasticState::default() };
        match self {
            Self::Uniform(pressure) => column(*pressure),
            Self::Columns(pressure) => column(pressure(r)),
            Self::HalfSpace(HalfSpace { ambient, beneath, surface, poisson }) => {
                let depth = surface - z;
                let found = beneath.at(depth, r);
                let harmonic = Harmonic {
                    value: found.value,
                    gradient: found.gradient,
                    disc_mean: found.disc_mean,
                    disc_mean_along_z: found.disc_mean_along_z,
                };
                let mut state = half_space_stress(&harmonic, depth, *poisson);
                state.stress_zz -= ambient;
                state
            }
        }
    }
}

/// The pressure with which the fluid begins above the wall, where it is not uniform, and z of that wall, m. Of a solid under a recorded
/// load: the fluid of the run that recorded it.
fn rayleigh_field(case: &Case) -> Result<Option<(RayleighField, f64)>, RunError> {
    let mut own = Cow::Borrowed(case);
    loop {
        if let Some(fluid) = &own.fluid {
            let domain = Domain { geometry: own.geometry, z: fluid.grid.z, r: fluid.grid.r };
            // A case is refused in reading if it has not the field that it asks for.
            let field =
                RayleighField::of(&fluid.initial, fluid.gravity, &domain, fluid.boundary).ok().flatten();
            return Ok(field.map(|field| (field, fluid.grid.z[0])));
        }
        // Runs that repeat each other's load in a circle have been refused in reading.
        let Some(LoadCase::Recorded(load)) = &own.coupling.load else { return Ok(None) };
        own = Cow::Owned(Case::load(&load.run().join(CASE), &[])?);
    }
}
