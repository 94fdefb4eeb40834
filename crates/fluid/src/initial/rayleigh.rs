//! The liquid's pressure about gas bubbles as the flow that is about to start has it.
//!
//! A liquid that begins to move from rest, and whose compressibility does not matter yet, obeys ρ ∂t v = −∇p and
//! div v = 0: its pressure is harmonic. With the gas's pressure on the bubbles and the ambient one far away the
//! bubble's wall starts with Rayleigh's acceleration, and no wave leaves it.

use mesh::Geometry;
use nalgebra::{DMatrix, DVector};

use crate::{Boundary, InitialCondition, InitialPressure, Phase, Shape};

/// Terms of a bubble's series are doubled from the first number up to the second.
const TERMS: [usize; 2] = [16, 128];
/// Unknowns of the linear system at most, where there are so many bubbles that [`TERMS`] would exceed it.
const MOST_UNKNOWNS: usize = 2048;
/// Error on the bubbles' surfaces, relative to the largest difference of pressure, at which no terms are added.
const ENOUGH: f64 = 1e-10;
/// The largest such error with which the field still serves.
const BEARABLE: f64 = 1e-2;
/// Points on each surface at which the error is measured.
const CHECKS: usize = 256;

/// Why an initial condition has no such field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RayleighError {
    /// Discs in a plane have a logarithm for a field, and no pressure far away.
    #[error("it is about spheres, and the geometry is planar")]
    Planar,
    /// It is the liquid that has the field.
    #[error("it is the field of a liquid, and the ambient phase is gas")]
    GasAmbient,
    /// Without gas it would be uniform.
    #[error("it is the field about bubbles, and no region is gas")]
    NoGas,
    /// The field is made of spheres' fields.
    #[error("it needs spheres on the axis, and the gas of region {region} is none")]
    NotASphere {
        /// Number of the region, from 0.
        region: usize,
    },
    /// The sphere would need an image of itself.
    #[error(
        "it needs bubbles clear of the wall, and that of region {region} is {distance:?} m above it with a \
         radius of {radius:?} m"
    )]
    MeetsWall {
        /// Number of the region, from 0.
        region: usize,
        /// Distance of the centre from the wall, m.
        distance: f64,
        /// Radius, m.
        radius: f64,
    },
    /// A point would have two pressures.
    #[error("it needs bubbles clear of each other, and those of regions {first} and {second} overlap")]
    Overlap {
        /// Number of a region, from 0.
        first: usize,
        /// Number of the other.
        second: usize,
    },
    /// The series do not converge in the number of terms they may have.
    #[error(
        "the bubbles are too near to each other or to the wall for it: on their surfaces it would be wrong by \
         {error:.1e} of the largest difference of pressure"
    )]
    TooNear {
        /// The largest error on the surfaces, relative to the largest difference of pressure.
        error: f64,
    },
}

/// A bubble and its multipoles.
#[derive(Clone, Debug, PartialEq)]
struct Sphere {
    centre: f64,
    radius: f64,
    /// Of the gas minus that far away, Pa.
    excess: f64,
    /// Factor of (R/s)^(l+1) P_l(cos θ), Pa.
    multipoles: Vec<f64>,
}

/// The harmonic pressure about spheres on the axis, above a rigid wall or in free space.
///
/// p = p∞ + Σ_b Σ_l a_bl (f_bl(z, r) + f_bl(2 z_w − z, r)), f_bl = (R_b/s)^(l+1) P_l(cos θ): zonal multipoles about the
/// centre of each bubble (s the distance from it, θ the angle to +z) and their images in the wall z = z_w. The images
/// make ∂p/∂z = 0 on the wall to round-off, whatever the a_bl are; without a wall they are left out. The a_bl follow
/// from p = p_gas on each surface, on which the multipoles of the others, the images included, are a series of
/// s^k P_k by the addition theorem of solid harmonics (Hobson 1931, *The Theory of Spherical and Ellipsoidal Harmonics*,
/// §§ 89 f.; one bubble with its image: two equal conducting spheres at one potential, Maxwell 1873, art. 173). For each
/// b and k
///
/// a_bk + Σ_c Σ_l R_c^(l+1) R_b^k C(k + l, l) σ / D^(k+l+1) a_cl = δ_k0 (p_gas,b − p∞)
///
/// with D the distance between the centres and σ = (−1)^k for a source below, (−1)^l for one above, (−1)^(k+l) for an
/// image. The series converge geometrically, with ratio e^(−μ), cosh μ = d/R for a bubble in the distance d above the
/// wall (0.27 at d = 2R, 0.73 at 1.05R). Image charges would do the same for one bubble; for several of them their number
/// grows exponentially with the order, and that of multipoles does not.
///
/// Tests: Laplace's equation by differences, the gas's pressure on the surfaces, no gradient at the wall, one sphere
/// alone, the series of image charges.
#[derive(Clone, Debug, PartialEq)]
pub struct RayleighField {
    far: f64,
    wall: Option<f64>,
    spheres: Vec<Sphere>,
    error: f64,
}

impl RayleighField {
    /// The field that an initial condition begins with; `None` if its pressure is to be uniform.
    ///
    /// - `z_min`, `side`: where the fluid begins, and what bounds it there; the field has a wall's images above a wall
    ///   and above a solid.
    /// - errors: [`RayleighError`] where there is no such field.
    pub fn of(
        initial: &InitialCondition,
        geometry: Geometry,
        z_min: f64,
        side: Boundary,
    ) -> Result<Option<Self>, RayleighError> {
        match initial.pressure {
            InitialPressure::Uniform => Ok(None),
            InitialPressure::Rayleigh => {
                let has_wall = matches!(side, Boundary::Wall | Boundary::Interface);
                Self::new(initial, geometry, has_wall.then_some(z_min)).map(Some)
            }
        }
    }

    /// The field about the gas regions of an initial condition, whatever it says of its pressure.
    ///
    /// - `wall`: z of the rigid wall below the bubbles, m.
    /// - errors: [`RayleighError`] where there is no such field.
    pub fn new(
        initial: &InitialCondition,
        geometry: Geometry,
        wall: Option<f64>,
    ) -> Result<Self, RayleighError> {
        let spheres = spheres(initial, geometry, wall)?;
        let mut field = Self { far: initial.ambient.pressure, wall, spheres, error: 0.0 };
        let most = TERMS[1].min(MOST_UNKNOWNS / field.spheres.len()).max(1);
        let mut terms = TERMS[0].min(most);
        loop {
            field.solve(terms);
            field.error = field.error_on_surfaces();
            if field.error < ENOUGH || terms == most {
                break;
            }
            terms = (2 * terms).min(most);
        }
        if !(field.error < BEARABLE) {
            return Err(RayleighError::TooNear { error: field.error });
        }
        field.drop_small_terms();
        Ok(field)
    }

    /// Pressure at a point (z, r), Pa; within a bubble that of its gas.
    pub fn pressure(&self, point: [f64; 2]) -> f64 {
        let inside = self.spheres.iter().find(|sphere| sphere.distance_and_cosine(point)[0] < sphere.radius);
        self.far + inside.map_or_else(|| self.excess(point), |sphere| sphere.excess)
    }

    /// R a₀ of each bubble, Pa m, in the order of the gas regions: far away p − p∞ is the sum of these over the distances.
    pub fn monopoles(&self) -> Vec<f64> {
        self.spheres.iter().map(|sphere| sphere.radius * sphere.multipoles[0]).collect()
    }

    /// The largest error on the bubbles' surfaces, relative to the largest difference of pressure.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The sum of all multipoles and images, Pa.
    fn excess(&self, [z, r]: [f64; 2]) -> f64 {
        let at = |point| self.spheres.iter().map(|sphere| sphere.sum(point)).sum::<f64>();
        at([z, r]) + self.wall.map_or(0.0, |wall| at([2.0 * wall - z, r]))
    }

    /// Sets the multipoles to the solution of the linear system with so many terms a sphere.
    fn solve(&mut self, terms: usize) {
        let count = self.spheres.len();
        let mut matrix = DMatrix::<f64>::identity(count * terms, count * terms);
        let mut right = DVector::zeros(count * terms);
        for (b, sphere) in self.spheres.iter().enumerate() {
            right[b * terms] = sphere.excess;
            for (c, source) in self.spheres.iter().enumerate() {
                let mut add = |distance: f64, sign: fn(usize, usize) -> usize| {
                    let [x, y] = [source.radius / distance, sphere.radius / distance];
                    // C(k + l, l) x^(l+1) y^k, from one l to the next.
                    let mut first = x;
                    for k in 0..terms {
                        let mut value = first;
                        for l in 0..terms {
                            let signed = if sign(k, l).is_multiple_of(2) { value } else { -value };
                            matrix[(b * terms + k, c * terms + l)] += signed;
                            value *= x * (k + l + 1) as f64 / (l + 1) as f64;
                        }
                        first *= y;
                    }
                };
                let offset = sphere.centre - source.centre;
                if c != b {
                    add(offset.abs(), if offset > 0.0 { |k, _| k } else { |_, l| l });
                }
                if let Some(wall) = self.wall {
                    add(sphere.centre + source.centre - 2.0 * wall, |k, l| k + l);
                }
            }
        }
        // Spheres apart from each other make it regular; if round-off says otherwise, the error shows it.
        let solution = matrix.lu().solve(&right).unwrap_or(right);
        for (b, sphere) in self.spheres.iter_mut().enumerate() {
            sphere.multipoles = solution.as_slice()[b * terms..(b + 1) * terms].to_vec();
        }
    }

    /// The largest difference to the gas's pressure on the surfaces, relative to the largest difference of pressure.
    fn error_on_surfaces(&self) -> f64 {
        let largest = self.largest_excess();
        if largest == 0.0 {
            return 0.0;
        }
        let mut error = 0.0_f64;
        for sphere in &self.spheres {
            for k in 0..=CHECKS {
                let (sin, cos) = (std::f64::consts::PI * k as f64 / CHECKS as f64).sin_cos();
                let point = [sphere.centre + sphere.radius * cos, sphere.radius * sin];
                let off = (self.excess(point) - sphere.excess).abs() / largest;
                error = if off.is_nan() { f64::INFINITY } else { error.max(off) };
            }
        }
        error
    }

    fn largest_excess(&self) -> f64 {
        self.spheres.iter().fold(0.0, |largest: f64, sphere| largest.max(sphere.excess.abs()))
    }

    /// Shortens the series by what nobody would see, as the field is evaluated in every cell.
    fn drop_small_terms(&mut self) {
        let least = 0.01 * ENOUGH * self.largest_excess();
        for sphere in &mut self.spheres {
            let kept = sphere.multipoles.iter().rposition(|a| a.abs() > least).map_or(1, |last| last + 1);
            sphere.multipoles.truncate(kept);
        }
    }
}

impl Sphere {
    /// Distance from the centre, and cosine of the angle to +z.
    fn distance_and_cosine(&self, [z, r]: [f64; 2]) -> [f64; 2] {
        let s = (z - self.centre).hypot(r);
        [s, if s > 0.0 { (z - self.centre) / s } else { 1.0 }]
    }

    /// Σ a_l (R/s)^(l+1) P_l(cos θ), by (l + 1) P_(l+1) = (2l + 1) x P_l − l P_(l−1).
    fn sum(&self, point: [f64; 2]) -> f64 {
        let [s, x] = self.distance_and_cosine(point);
        let ratio = self.radius / s;
        let (mut before, mut legendre, mut power, mut sum) = (0.0, 1.0, ratio, 0.0);
        for (l, a) in self.multipoles.iter().enumerate() {
            sum += a * power * legendre;
            let l = l as f64;
            (before, legendre) = (legendre, ((2.0 * l + 1.0) * x * legendre - l * before) / (l + 1.0));
            power *= ratio;
        }
        sum
    }
}

/// The gas regions as spheres, without multipoles; checks what the field needs of them.
fn spheres(
    initial: &InitialCondition,
    geometry: Geometry,
    wall: Option<f64>,
) -> Result<Vec<Sphere>, RayleighError> {
    if geometry == Geometry::Planar {
        return Err(RayleighError::Planar);
    }
    if initial.ambient.phase == Phase::Gas {
        return Err(RayleighError::GasAmbient);
    }
    let mut spheres: Vec<(usize, Sphere)> = Vec::new();
    let gas = initial.regions.iter().enumerate().filter(|(_, region)| region.state.phase == Phase::Gas);
    for (region, painted) in gas {
        let Shape::Sphere { centre: [centre, 0.0], radius } = painted.shape else {
            return Err(RayleighError::NotASphere { region });
        };
        if let Some(distance) = wall.map(|wall| centre - wall)
            && distance <= radius
        {
            return Err(RayleighError::MeetsWall { region, distance, radius });
        }
        if let Some((first, _)) =
            spheres.iter().find(|(_, other)| (centre - other.centre).abs() <= radius + other.radius)
        {
            return Err(RayleighError::Overlap { first: *first, second: region });
        }
        let excess = painted.state.pressure - initial.ambient.pressure;
        spheres.push((region, Sphere { centre, radius, excess, multipoles: Vec::new() }));
    }
    if spheres.is_empty() {
        return Err(RayleighError::NoGas);
    }
    Ok(spheres.into_iter().map(|(_, sphere)| sphere).collect())
}

#[cfg(test)]
mod tests;
