//! The pressure on the wall as a harmonic function beneath it: what the stress of a half-space at rest is made of.

use super::bubbles::{Bubble, Meeting, largest_excess};
use super::least_squares::LeastSquares;

/// Lengths of pieces relative to the distance to the next bubble, or to the circle in which one meets the wall if that is more.
const FINENESS: f64 = 0.5;
/// No piece is shorter than this, relative to the largest radius.
const SMALLEST: f64 = 1e-6;
/// How far the pieces reach, relative to the largest distance of a bubble's far end from the wall.
const REACH: f64 = 1e3;
/// Height of a piece's source above the wall relative to the piece's length.
const HEIGHT: f64 = 1.0;
/// Where on a piece the pressure is met, and where the error is measured.
const MET: [f64; 4] = [0.125, 0.375, 0.625, 0.875];
const MEASURED: [f64; 3] = [0.01, 0.25, 0.5];

/// A harmonic function h beneath the wall that is p − p∞ on it and vanishes far away, with the mean m of h over the disc about the axis
/// that ends at the point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HarmonicBeneath {
    /// h, Pa.
    pub value: f64,
    /// (∂h/∂z, ∂h/∂r), Pa/m.
    pub gradient: [f64; 2],
    /// m = (2/r²) ∫₀^r h r' dr', Pa; h on the axis.
    pub disc_mean: f64,
    /// ∂m/∂z, Pa/m.
    pub disc_mean_along_z: f64,
}

/// The continuation of Rayleigh's pressure beneath a wall.
///
/// h = Σ Re[(α_k − iβ_k) / s_k], s_k = √(Z_k² + r²), Z_k = d + η_k + i b_k, with the depth d: charges at complex heights above the wall, as
/// those of the liquid (`Charges`), so each term is harmonic and smooth in the half-space beneath. They cluster towards the
/// circles in which bubbles meet the wall (Gopal & Trefethen 2019, SIAM J. Numer. Anal. 57, 2074); least squares give the strengths.
/// Of 1/s the mean over discs is 2/(s + Z), that of its derivative along z is 2/(s (s + Z)).
///
/// - units: m, Pa. valid: in and beneath the wall, beside no other side of the liquid. errors: none.
/// - tested by: the pressure on the wall, Laplace's equation and the means by differences, the multipole of one bubble.
#[derive(Clone, Debug, PartialEq)]
pub struct Beneath {
    sources: Vec<Source>,
    error: f64,
}

/// A charge above the wall: its height η and ring b, m, and α, β, Pa m.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    place: [f64; 2],
    strength: [f64; 2],
}

impl Beneath {
    /// Of an excess of pressure on the wall over the radius, Pa.
    pub(super) fn of(bubbles: &[Bubble], surface: f64, excess: impl Fn(f64) -> f64) -> Self {
        let largest = largest_excess(bubbles);
        let pieces = pieces(bubbles, surface);
        let sources = solved(bubbles, surface, &pieces, &excess).unwrap_or_default();
        let found = Self { sources, error: 0.0 };
        let off = |r: f64| (found.at(0.0, r).value - excess(r)).abs();
        let most = points(&pieces, &MEASURED).map(off).fold(0.0, f64::max);
        Self { error: if largest == 0.0 { 0.0 } else { most / largest }, ..found }
    }

    /// The largest difference to the pressure on the wall, relative to the largest difference between gas and liquid.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Its numbers so far beneath the wall, at a radius, m.
    pub fn at(&self, depth: f64, r: f64) -> HarmonicBeneath {
        let mut sum = HarmonicBeneath::default();
        for Source { place: [height, ring], strength: [alpha, beta] } in &self.sources {
            let part = |[re, im]: [f64; 2]| alpha * re + beta * im;
            let along = [depth + height, *ring];
            let distance = root(along, r);
            let value = inverse(distance);
            let cube = times(times(value, value), value);
            let below = inverse([distance[0] + along[0], distance[1] + along[1]]);
            sum.value += part(value);
            sum.gradient[0] += part(times(along, cube));
            sum.gradient[1] -= r * part(cube);
            sum.disc_mean += 2.0 * part(below);
            sum.disc_mean_along_z += 2.0 * part(times(value, below));
        }
        sum
    }
}

/// Intervals of the radius, from the axis on.
fn pieces(bubbles: &[Bubble], surface: f64) -> Vec<[f64; 2]> {
    let circle = |bubble: &Bubble| match bubble.meets(2.0 * surface - bubble.centre, bubble.radius) {
        Meeting::Circle([_, across]) => across,
        Meeting::Apart | Meeting::Within => bubble.radius * f64::from(u8::from(bubble.centre == surface)),
    };
    let circles: Vec<f64> = bubbles.iter().map(circle).collect();
    let nearest = |r: f64| {
        let surfaces = (bubbles.iter())
            .map(|bubble| ((surface - bubble.centre).hypot(r) - bubble.radius).abs())
            .fold(f64::INFINITY, f64::min);
        circles
            .iter()
            .map(|own| (r - own).abs())
            .fold(f64::INFINITY, f64::min)
            .min(r.max(surfaces))
            .max(surfaces)
    };
    let largest = |of: fn(&Bubble) -> f64| bubbles.iter().map(of).fold(0.0, f64::max);
    let smallest = SMALLEST * largest(|bubble| bubble.radius);
    let end = REACH * bubbles.iter().map(|b| b.centre - surface + b.radius).fold(0.0, f64::max);
    let mut pieces = Vec::new();
    let mut from = 0.0;
    while from < end {
        let mut to = from + (FINENESS * nearest(from)).max(smallest);
        // A circle is where one piece ends and the next begins.
        if let Some(own) = circles.iter().find(|own| from < **own && to > **own - smallest) {
            to = *own;
        }
        pieces.push([from, to]);
        from = to;
    }
    pieces
}

fn points(pieces: &[[f64; 2]], shares: &[f64]) -> impl Iterator<Item = f64> {
    pieces.iter().flat_map(move |[from, to]| shares.iter().map(move |share| from + share * (to - from)))
}

/// The sources that meet an excess of pressure on the pieces best: one above each, one about each bubble's far end.
fn solved(
    bubbles: &[Bubble],
    surface: f64,
    pieces: &[[f64; 2]],
    excess: &impl Fn(f64) -> f64,
) -> Option<Vec<Source>> {
    let above = |[from, to]: &[f64; 2]| [HEIGHT * (to - from), 0.5 * (from + to)];
    let within = |bubble: &Bubble| [bubble.centre - surface + bubble.radius, bubble.radius];
    let places: Vec<_> = pieces.iter().map(above).chain(bubbles.iter().map(within)).collect();
    let mut system = LeastSquares::new(MET.len() * pieces.len(), 2 * places.len());
    for (equation, r) in points(pieces, &MET).enumerate() {
        system.set(equation, places.iter().flat_map(|place| inverse(root(*place, r))), excess(r));
    }
    let (strengths, sources) = (system.solve()?, places.into_iter());
    let strengths = strengths.as_chunks::<2>().0.iter();
    Some(sources.zip(strengths).map(|(place, strength)| Source { place, strength: *strength }).collect())
}

/// √(Z² + r²) with a positive real part.
fn root([x, y]: [f64; 2], r: f64) -> [f64; 2] {
    let (re, im) = (x * x + (r - y) * (r + y), 2.0 * x * y);
    let large = (0.5 * (re.hypot(im) + re.abs())).sqrt();
    let small = 0.5 * im.abs() / large;
    let [real, imaginary] = if re >= 0.0 { [large, small] } else { [small, large] };
    [real, imaginary.copysign(im)]
}

fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

fn inverse([a, b]: [f64; 2]) -> [f64; 2] {
    let size = a * a + b * b;
    [a / size, -b / size]
}
