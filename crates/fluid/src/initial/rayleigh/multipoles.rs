//! The field of bubbles clear of each other and of the wall: zonal multipoles about their centres.

use nalgebra::{DMatrix, DVector};

use super::bubbles::{Bubble, largest_excess};

/// Terms of a bubble's series are doubled from the first number up to the second.
const TERMS: [usize; 2] = [16, 128];
/// Unknowns of the linear system at most, where there are so many bubbles that [`TERMS`] would exceed it.
pub(super) const MOST_UNKNOWNS: usize = 2048;
/// Error on the bubbles' surfaces, relative to the largest difference of pressure, at which no terms are added.
const ENOUGH: f64 = 1e-10;
/// Points on each surface at which the error is measured.
const CHECKS: usize = 256;

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

/// The harmonic pressure about spheres on the axis, clear of each other, above a rigid wall or in free space.
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
pub(super) struct Multipoles {
    wall: Option<f64>,
    spheres: Vec<Sphere>,
}

impl Multipoles {
    /// The field about bubbles, and the largest error on their surfaces, relative to the largest difference of pressure.
    ///
    /// - `wall`: z of the rigid wall below them, m.
    pub(super) fn about(bubbles: &[Bubble], wall: Option<f64>) -> (Self, f64) {
        let sphere = |&Bubble { centre, radius, excess, .. }: &Bubble| Sphere {
            centre,
            radius,
            excess,
            multipoles: Vec::new(),
        };
        let mut field = Self { wall, spheres: bubbles.iter().map(sphere).collect() };
        let largest = largest_excess(bubbles);
        let most = TERMS[1].min(MOST_UNKNOWNS / field.spheres.len()).max(1);
        let mut terms = TERMS[0].min(most);
        let error = loop {
            field.solve(terms);
            let error = field.error_on_surfaces(largest);
            if error < ENOUGH || terms == most {
                break error;
            }
            terms = (2 * terms).min(most);
        };
        field.drop_small_terms(largest);
        (field, error)
    }

    /// R a₀ of each bubble, Pa m.
    pub(super) fn monopoles(&self) -> Vec<f64> {
        self.spheres.iter().map(|sphere| sphere.radius * sphere.multipoles[0]).collect()
    }

    /// The sum of all multipoles and images, Pa.
    pub(super) fn excess(&self, [z, r]: [f64; 2]) -> f64 {
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
    fn error_on_surfaces(&self, largest: f64) -> f64 {
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

    /// Shortens the series by what nobody would see, as the field is evaluated in every cell.
    fn drop_small_terms(&mut self, largest: f64) {
        let least = 0.01 * ENOUGH * largest;
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
