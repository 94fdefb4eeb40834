//! What open sides hold while liquid flows to a bubble and back: the far field of that flow.
//!
//! A side that holds the incoming characteristic at a constant lets waves out, and is wrong for flow that is nearly
//! incompressible: behind the front of an outgoing spherical wave liquid flows in, the *afterflow*, and that it would hold up.
//! The flow about bubbles is that of sources in them, whose potential has a relation of its own between pressure and
//! velocity on every face. See docs/theory/far-field.md.

mod condition;
mod history;
mod impulse;
mod incident;

use std::f64::consts::PI;

use mesh::{Domain, Geometry, Side};
use serde::{Deserialize, Serialize};

use crate::{
    Boundary, BubbleCuts, InitialCondition, InitialPressure, Mixture, Phase, PhaseState, PressureHistory,
    Primitive, RayleighField, Region, Shape,
};

pub(crate) use condition::{Inner, Moment};
use history::Motion;
pub(crate) use history::SourceHistory;
pub(crate) use impulse::{SideImpulses, face_centre};
use incident::Incident;

/// What the far field remembers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct FarFieldMemory {
    /// Along the open sides.
    pub impulses: SideImpulses,
    /// What the bubbles have done lately.
    pub sources: SourceHistory,
}

/// Why open sides of a fluid have no far field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum FarFieldError {
    /// The potential of a source in a plane has no value far away.
    #[error("it is that of sources in space, and the geometry is planar")]
    Planar,
    /// It is the liquid that flows.
    #[error("it is that of a liquid, and the ambient phase is gas")]
    GasAmbient,
    /// Nothing draws liquid in.
    #[error("it is that of bubbles, and no region is gas")]
    NoGas,
    /// The sources are taken to be on the axis.
    #[error("it is that of bubbles on the axis, and the gas of region {region} does not touch it")]
    OffAxis {
        /// Number of the region, from 0.
        region: usize,
    },
    /// Flow in a tube is along it.
    #[error("it spreads in space, and r_max is closed or an inflow")]
    Tube,
    /// Flow between plates, or along a row of images, spreads in two dimensions.
    #[error("it spreads in half of space at least, and z_min and z_max are both walls, or periodic")]
    Layer,
    /// The pressure far away is one number.
    #[error("its pressure far away is one number, and gravity makes it one of height")]
    Gravity,
}

/// A bubble on the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    /// Where it is at t = 0, m.
    z: f64,
    /// How much it draws in, of whatever unit.
    strength: f64,
    /// The second derivative of its volume with which it starts, m³/s²: that of the harmonic pressure, else none.
    acceleration: f64,
}

impl Source {
    /// What it does at a time, number `k` of the bubbles. Before the start it did as the harmonic pressure has it: this is then
    /// what sound that left it has spread.
    fn motion(&self, history: &SourceHistory, k: usize, time: f64) -> Motion {
        history.at(k, time).unwrap_or(Motion {
            moved: 0.0,
            rate: self.acceleration * time,
            acceleration: self.acceleration,
        })
    }
}

/// How a side yields to the pressure on it: u_n = Λ p'/(ρc) + κJ/ρ + U.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Admittance {
    /// Λ, of waves.
    pub wave: f64,
    /// κ, 1/m, of the flow behind them.
    pub flow: f64,
    /// U, m/s: what the sources' own motion corrects.
    pub correction: f64,
}

/// The far field of the bubbles of a case, and the waves that are known to pass over it.
///
/// Sources that grow by V̇_k, bubbles and their images in a wall, have the potential φ = −Σ f_k(t − s_k/c)/s_k, f_k = V̇_k/4π, at
/// the distances s_k, and p' = −ρ ∂φ/∂t: so the impulse J = ∫p' dt on a face is −ρφ. If the f_k had fixed ratios q_k, then on a
/// face with the outward normal n, with W = Σ q_k/s_k and cos θ_k = n·(x − x_k)/s_k,
///
/// u_n = ∂φ/∂n = Λ p'/(ρc) + κJ/ρ,   Λ = Σ (q_k/s_k) cos θ_k/W,   κ = Σ (q_k/s_k²) cos θ_k/W
///
/// whatever f is: the condition of Bayliss & Turkel (1980) of first order for spherical waves, integrated once, exact for one
/// source and for incompressible flow. But sound of an image comes later, and bubbles move and collapse one after the other. What
/// their volumes tell of it corrects that,
///
/// U = Σ (f_k/s_k + f'_k/c) cos θ_k/s_k − κ Σ f_k/s_k − (Λ/c) Σ f'_k/s_k,
///
/// so that it is exact for any of them. U vanishes for one source: how large the flow is the face learns from its own pressure,
/// and an error of the f_k counts only as far as the sources differ.
///
/// p' is what is unsteady of the pressure, p − p∞ + ½ρ|u − u∞|² (Bernoulli), without that of the incident waves. Λ and κ are a
/// resistance beside an inductance: passive, so that they make no energy, and p returns to p∞ in a time of about s/c.
#[derive(Clone, Debug, PartialEq)]
pub struct FarField {
    pressure: f64,
    velocity: [f64; 2],
    /// The lowest first.
    bubbles: Vec<Source>,
    cuts: BubbleCuts,
    wall: Option<f64>,
    incident: Incident,
}

impl FarField {
    /// The far field of an initial condition.
    ///
    /// - `boundaries`: in the order of [`Side::ALL`]; `inflow`: what enters through sides of kind [`Boundary::Inflow`].
    /// - `reflection`: how much of the pressure of a wave a wall throws back, 1 of a rigid one.
    /// - errors: [`FarFieldError`] where there is none.
    pub fn of(
        initial: &InitialCondition,
        mixture: &Mixture,
        domain: &Domain,
        boundaries: [Boundary; 4],
        inflow: Option<&PressureHistory>,
        reflection: f64,
    ) -> Result<Self, FarFieldError> {
        let wall = wall(domain, boundaries)?;
        if domain.geometry == Geometry::Planar {
            return Err(FarFieldError::Planar);
        }
        if initial.ambient.phase == Phase::Gas {
            return Err(FarFieldError::GasAmbient);
        }
        let bubbles = bubbles(initial, domain, boundaries)?;
        let incident =
            Incident::of(initial, mixture.liquid, domain, boundaries, inflow, wall.zip(Some(reflection)));
        let PhaseState { density, pressure, velocity: [v_z, v_r], .. } = initial.ambient;
        // By way of the conserved variables, as the cells have it: rest then stays at rest to the last bit.
        let ambient = Primitive { density, v_z, v_r, pressure, phi: 0.0 }.to_conserved(0.0, mixture);
        let Primitive { pressure, v_z, v_r, .. } = Primitive::from_conserved(ambient, 0.0, mixture);
        let cuts = BubbleCuts::of(initial);
        Ok(Self { pressure, velocity: [v_z, v_r], bubbles, cuts, wall, incident })
    }

    /// What a face at (z, r) on a side yields at a time.
    pub(crate) fn admittance(
        &self,
        [z, r]: [f64; 2],
        side: Side,
        time: f64,
        history: &SourceHistory,
    ) -> Admittance {
        let sound = self.incident.sound();
        let distance = |place: f64| (z - place).hypot(r);
        let (mut weight, mut wave, mut flow) = (0.0, 0.0, 0.0);
        // ∂φ/∂n, −φ and −∂φ/∂t of the sources.
        let (mut velocity, mut potential, mut rate) = (0.0, 0.0, 0.0);
        let planes = [None, self.wall].into_iter().take(if self.wall.is_some() { 2 } else { 1 });
        for (k, bubble, plane) in
            planes.flat_map(|plane| self.bubbles.iter().enumerate().map(move |(k, b)| (k, b, plane)))
        {
            let image = |place: f64| plane.map_or(place, |wall| 2.0 * wall - place);
            // What it did when sound left it that is here now.
            let motion = bubble.motion(history, k, time - distance(image(bubble.z)) / sound);
            let place = image(bubble.z + motion.moved);
            let s = distance(place);
            let outward = match side {
                Side::ZMin => place - z,
                Side::ZMax => z - place,
                Side::RMin => -r,
                Side::RMax => r,
            };
            let (share, cosine) = (bubble.strength / s, outward / s);
            weight += share;
            wave += share * cosine;
            flow += share * cosine / s;
            let [f, f_dot] = [motion.rate, motion.acceleration].map(|of_volume| of_volume / (4.0 * PI));
            velocity += (f / s + f_dot / sound) * cosine / s;
            potential += f / s;
            rate += f_dot / s;
        }
        // A source in the plane of the side does not cross it, nor one beyond it.
        let [wave, flow] = [wave, flow].map(|sum| (sum / weight).max(0.0));
        Admittance { wave, flow, correction: velocity - flow * potential - wave * rate / sound }
    }

    /// The nearest distance of a bubble's centre at t = 0 from a side, m.
    pub fn distance(&self, domain: &Domain, side: Side) -> f64 {
        let to = |bubble: &Source| match side {
            Side::ZMin => bubble.z - domain.z[0],
            Side::ZMax => domain.z[1] - bubble.z,
            Side::RMin => domain.r[0],
            Side::RMax => domain.r[1],
        };
        self.bubbles.iter().map(to).fold(f64::INFINITY, f64::min)
    }
}

/// Where the wall is whose images the sources have; `None` in free space.
fn wall(domain: &Domain, boundaries: [Boundary; 4]) -> Result<Option<f64>, FarFieldError> {
    let kind = |side: Side| boundaries[side as usize];
    if !matches!(kind(Side::RMax), Boundary::FarField | Boundary::NonReflecting) {
        return Err(FarFieldError::Tube);
    }
    let is_closed = |side: Side| kind(side).is_wall();
    match (is_closed(Side::ZMin), is_closed(Side::ZMax)) {
        (true, true) => Err(FarFieldError::Layer),
        _ if kind(Side::ZMin) == Boundary::Periodic => Err(FarFieldError::Layer),
        (true, false) => Ok(Some(domain.z[0])),
        (false, true) => Ok(Some(domain.z[1])),
        (false, false) => Ok(None),
    }
}

/// The bubbles of an initial condition as sources.
///
/// How much each draws in is what its part of the harmonic pressure says, of a bubble that the wall cuts that of the part above;
/// where there is none (boxes), or nothing that drives it yet, R |Δp|, or R.
fn bubbles(
    initial: &InitialCondition,
    domain: &Domain,
    boundaries: [Boundary; 4],
) -> Result<Vec<Source>, FarFieldError> {
    let gas: Vec<(usize, &Region)> =
        (initial.regions.iter().enumerate()).filter(|(_, region)| region.state.phase == Phase::Gas).collect();
    if gas.is_empty() {
        return Err(FarFieldError::NoGas);
    }
    let place = |(region, painted): &(usize, &Region)| match painted.shape {
        Shape::Sphere { centre: [z, 0.0], radius } => Ok((z, radius)),
        // The radius of the ball of the same volume.
        Shape::Box { z: [low, high], r: [0.0, radius] } => {
            Ok((0.5 * (low + high), (0.75 * radius * radius * (high - low)).cbrt()))
        }
        _ => Err(FarFieldError::OffAxis { region: *region }),
    };
    let places = gas.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    let harmonic = RayleighField::between(initial, domain, boundaries);
    let of_field = harmonic.map_or_else(|_| Vec::new(), |field| field.monopoles());
    let of_pressure: Vec<f64> = (gas.iter().zip(&places))
        .map(|((_, region), (_, radius))| radius * (region.state.pressure - initial.ambient.pressure))
        .collect();
    let of_radius: Vec<f64> = places.iter().map(|(_, radius)| *radius).collect();
    let drives = |strengths: &&Vec<f64>| strengths.iter().any(|strength| *strength != 0.0);
    let strengths = [&of_field, &of_pressure].into_iter().find(drives).unwrap_or(&of_radius);
    // p' = ρ f'/s with f' = V̈/4π.
    let starts = initial.pressure == InitialPressure::Rayleigh && !of_field.is_empty();
    let per_strength = 4.0 * PI / initial.ambient.density;
    let source = |(place, strength): (&(f64, f64), &f64)| Source {
        z: place.0,
        strength: strength.abs(),
        acceleration: if starts { per_strength * strength } else { 0.0 },
    };
    let mut bubbles: Vec<Source> = places.iter().zip(strengths).map(source).collect();
    bubbles.sort_by(|a, b| a.z.total_cmp(&b.z));
    Ok(bubbles)
}

#[cfg(test)]
mod tests;
