//! Harmonic functions about the axis from charges in complex places.

/// On which side of the rings the charges are single-valued.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cut {
    /// The discs that the rings bound are cuts: for rings in gas.
    Disc,
    /// The planes beyond the rings are: for rings beyond the sides.
    Beyond,
}

/// Charges on the axis at the complex heights ζ = a + ib, (α + βi) of them each.
///
/// 1/√((z − ζ)² + r²) is harmonic wherever it is smooth, being a point charge's potential moved along the axis by an imaginary
/// length; its real and imaginary parts are the potentials of two distributions on the ring (a, b) and a cut that ends there. So a
/// sum of them is a function of which the values on the axis are rational, with poles at the ζ and their conjugates, and an
/// axisymmetric potential follows from those values (Whittaker & Watson 1927, § 18.3). It costs two roots, where a ring's charge costs an
/// elliptic integral.
///
/// - units: lengths m; α, β in Pa m. errors: none, infinite on a ring.
/// - tested by: Laplace's equation and gradients by differences, a charge on the axis, far away.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Charges {
    cut: Cut,
    each: Vec<Charge>,
    /// (a, b, α, β) of [`LANES`] charges at a time.
    packed: Vec<[[f64; LANES]; 4]>,
}

/// How many charges are summed side by side.
const LANES: usize = 8;

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Charge {
    /// (a, b), m; b ≥ 0.
    pub place: [f64; 2],
    /// Distance from the liquid, m.
    pub depth: f64,
    /// Number of the bubble that it is in, if it is in one.
    pub bubble: Option<usize>,
    /// (α, β), Pa m: factors of the real and of the imaginary part.
    pub strength: [f64; 2],
}

impl Charges {
    pub(super) fn new(each: Vec<Charge>, cut: Cut) -> Self {
        Self { cut, each, packed: Vec::new() }
    }

    pub(super) fn each(&self) -> &[Charge] {
        &self.each
    }

    /// Gives each its strength, in their order.
    pub(super) fn set(&mut self, strengths: &[[f64; 2]]) {
        for (charge, strength) in self.each.iter_mut().zip(strengths) {
            charge.strength = *strength;
        }
        self.pack();
    }

    /// Leaves out those whose potential in the liquid is below this, Pa.
    pub(super) fn drop_below(&mut self, least: f64) {
        self.each.retain(|Charge { depth, strength: [alpha, beta], .. }| alpha.hypot(*beta) > least * depth);
        self.pack();
    }

    fn pack(&mut self) {
        let pack = |some: &[Charge]| {
            // Those that fill the last pack up are where others are, and of strength zero.
            let part = |of: fn(&Charge) -> f64, rest: f64| -> [f64; LANES] {
                std::array::from_fn(|lane| some.get(lane).map_or(rest * of(&some[0]), of))
            };
            [
                part(|charge| charge.place[0], 1.0),
                part(|charge| charge.place[1], 1.0),
                part(|charge| charge.strength[0], 0.0),
                part(|charge| charge.strength[1], 0.0),
            ]
        };
        self.packed = self.each.chunks(LANES).map(pack).collect();
    }

    /// The factor of (z − ζ)² + r² under the root.
    fn sign(&self) -> f64 {
        match self.cut {
            Cut::Disc => 1.0,
            Cut::Beyond => -1.0,
        }
    }

    /// The potential of all that have been given strengths, Pa.
    pub(super) fn sum(&self, point: [f64; 2]) -> f64 {
        let sums = sums(&self.packed, self.sign(), point);
        sums.iter().sum()
    }

    /// The potentials of α = 1 and of β = 1 in a place, 1/m.
    pub(super) fn units(&self, place: [f64; 2], point: [f64; 2]) -> [f64; 2] {
        unit(self.sign(), place, point)
    }

    /// Their gradients (∂/∂z, ∂/∂r), 1/m².
    ///
    /// With w = 1/√q, q = (z − ζ)² + r²: ∂w/∂z = −(z − ζ) w³, ∂w/∂r = −r w³; of 1/√(−q) both with the other sign.
    pub(super) fn unit_gradients(&self, [a, b]: [f64; 2], point: [f64; 2]) -> [[f64; 2]; 2] {
        let times = |[c, d]: [f64; 2], [e, f]: [f64; 2]| [c * e - d * f, c * f + d * e];
        let w = self.units([a, b], point);
        let cube = times(times(w, w), w).map(|part| -self.sign() * part);
        let along = times([point[0] - a, -b], cube);
        [[along[0], point[1] * cube[0]], [along[1], point[1] * cube[1]]]
    }
}

/// Real and imaginary part of 1/√(±((z − ζ)² + r²)), of the root with a positive real part.
#[inline(always)]
fn unit(sign: f64, [a, b]: [f64; 2], [z, r]: [f64; 2]) -> [f64; 2] {
    let dz = z - a;
    let (x, y) = (sign * (dz * dz + (r - b) * (r + b)), sign * (-2.0 * b * dz));
    let size = (x * x + y * y).sqrt();
    let large = (0.5 * (size + x.abs())).sqrt();
    let small = 0.5 * y.abs() / large;
    let (real, imaginary) = if x >= 0.0 { (large, small) } else { (small, large) };
    let inverse = 1.0 / size;
    [real * inverse, -(imaginary.copysign(y) * inverse)]
}

/// The potentials, lane by lane.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
fn sums(packed: &[[[f64; LANES]; 4]], sign: f64, point: [f64; 2]) -> [f64; LANES] {
    let mut sums = [0.0; LANES];
    for [a, b, alpha, beta] in packed {
        for lane in 0..LANES {
            let [real, imaginary] = unit(sign, [a[lane], b[lane]], point);
            sums[lane] += alpha[lane] * real + beta[lane] * imaginary;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    fn charges(cut: Cut, place: [f64; 2], strength: [f64; 2]) -> Charges {
        let mut charges =
            Charges::new(vec![Charge { place, depth: 1.0, bubble: None, strength: [0.0; 2] }], cut);
        charges.set(&[strength]);
        charges
    }

    #[test]
    fn a_real_place_is_a_point_charge_and_any_is_one_from_far_away() {
        let point = charges(Cut::Disc, [0.3, 0.0], [2.0, 5.0]).sum([1.3, 0.7]);
        assert!((point - 2.0 / 1.0_f64.hypot(0.7)).abs() < 1e-14, "{point}");
        for far in [[1e6, 0.0], [-6e5, 8e5], [0.0, 1e6]] {
            let got = 1e6 * charges(Cut::Disc, [0.3, 0.4], [2.0, 5.0]).sum(far);
            assert!((got - 2.0).abs() < 1e-5, "{far:?}: {got}");
        }
        // A wrong branch would change the sign across the plane of the ring.
        let ring = charges(Cut::Disc, [0.0, 0.5], [1.0, 0.0]);
        assert!((ring.sum([1e-9, 0.6]) - ring.sum([-1e-9, 0.6])).abs() < 1e-6);
        assert!((ring.sum([1e-9, 0.4]) - ring.sum([-1e-9, 0.4])).abs() < 1e-6);
        let odd = charges(Cut::Disc, [0.0, 0.5], [0.0, 1.0]);
        assert!((odd.sum([1e-9, 0.4]) + odd.sum([-1e-9, 0.4])).abs() < 1e-6 && odd.sum([1e-9, 0.4]) > 1.0);
        let beyond = charges(Cut::Beyond, [0.0, 0.5], [0.0, 1.0]);
        assert!((beyond.sum([1e-9, 0.4]) - beyond.sum([-1e-9, 0.4])).abs() < 1e-6);
    }

    #[test]
    fn gradients_are_those_of_the_potential_which_is_harmonic() {
        let (h, place) = (1e-4, [0.2, 0.6]);
        for cut in [Cut::Disc, Cut::Beyond] {
            for (part, strength) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                let one = charges(cut, place, strength);
                for [z, r] in [[0.5, 0.3], [-0.4, 0.9], [0.25, 0.2], [1.5, 0.1]] {
                    let p = |dz: f64, dr: f64| one.sum([z + dz * h, r + dr * h]);
                    let got = one.unit_gradients(place, [z, r])[part];
                    let want =
                        [p(1.0, 0.0) - p(-1.0, 0.0), p(0.0, 1.0) - p(0.0, -1.0)].map(|rise| rise / (2.0 * h));
                    for axis in 0..2 {
                        assert!(
                            (got[axis] - want[axis]).abs() < 1e-5,
                            "{cut:?} ({z}, {r}): {got:?} {want:?}"
                        );
                    }
                    let along = p(1.0, 0.0) + p(-1.0, 0.0) + p(0.0, 1.0) + p(0.0, -1.0) - 4.0 * p(0.0, 0.0);
                    let laplacian = along / (h * h) + want[1] / r;
                    assert!(laplacian.abs() < 1e-4, "{cut:?} ({z}, {r}): {laplacian:e}");
                }
            }
        }
    }
}
