//! Prediction of polynomials, and the order of details.

use std::sync::atomic::{AtomicU64, Ordering};

use mesh::{
    ComponentsOfCell, Domain, Field, GHOSTS, Geometry, MOST_COMPONENTS, MOST_IN_FIELD, Mesh, Multiresolution,
    Origin, Padded, Patch, ScratchPool, Side,
};
use proptest::prelude::*;

use crate::common::*;

/// Cell averages of a quadratic polynomial of random coefficients.
fn parabola(coefficients: [f64; 6]) -> impl Fn([f64; 2], [f64; 2]) -> f64 {
    move |[z, r], [h_z, h_r]| {
        let [a, b, c, d, e, f] = coefficients;
        a + b * z + c * r + d * (z * z + h_z * h_z / 12.0) + e * z * r + f * (r * r + h_r * h_r / 12.0)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..Default::default() })]

    /// Catches wrong coefficients of the parabolas and of their product, children in the wrong order.
    #[test]
    fn parabolas_are_predicted_exactly_in_the_first_and_in_the_last_component(plan in plans(4)) {
        let plan = Plan { domain: Domain { geometry: Geometry::Planar, ..plan.domain }, periodic: [false; 2], ..plan };
        let mut random = Random(plan.seed);
        let mesh = plan.grown(&mut random);
        let average = parabola(std::array::from_fn(|_| 2.0 * random.unit() - 1.0));
        let mut field = Field::zeros(mesh.blocks(), N * N, MOST_IN_FIELD);
        let looked_at = [0, MOST_IN_FIELD - 1];
        looked_at.iter().for_each(|component| sample(&mesh, &mut field, *component, &average));

        let (mut padded, mut patch) = (Padded::zeros(MOST_IN_FIELD), Patch::zeros(MOST_IN_FIELD));
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            if is_at_boundary(&mesh, slot) {
                continue;
            }
            padded.assemble(&mesh, &field, slot, &SILENT, &mut patch);
            let ([z, r], widths) = (mesh.centre(*id, 0, 0), mesh.widths(id.level));
            let range = || -(GHOSTS as isize)..(N + GHOSTS) as isize;
            for (i, j) in range().flat_map(|j| range().map(move |i| (i, j))) {
                let exact = average([z + i as f64 * widths[0], r + j as f64 * widths[1]], widths);
                for component in looked_at {
                    let off = padded.component(component)[Padded::<N>::index(i, j)] - exact;
                    assert!(off.abs() < 1e-13, "{id:?}: ghost ({i}, {j}) of {component} is off by {off:e}");
                }
            }
        }

        let wanted = random_levels(&mesh, &mut random, [0.5, 0.3]);
        let Some(adapted) = towards(&mesh, &wanted) else { return Ok(()) };
        let scratch = ScratchPool::new(|| Patch::zeros(MOST_IN_FIELD));
        let new = adapted.remap(&mesh, &field, &SILENT, &scratch);
        let mut exact = new.clone();
        looked_at.iter().for_each(|component| sample(&adapted.mesh, &mut exact, *component, &average));
        for (slot, origin) in adapted.origins.iter().enumerate() {
            if matches!(origin, Origin::ChildOf(old, _) if is_at_boundary(&mesh, *old)) {
                continue;
            }
            for (cell, exact) in new.block(slot).iter().zip(exact.block(slot)) {
                assert!((cell - exact).abs() < 1e-13, "{origin:?}: {cell} for {exact}");
            }
        }
    }
}

/// Remembers the largest detail of the first component where the others, the cell's centre, lie in a rectangle.
struct Largest {
    z: [f64; 2],
    r: [f64; 2],
    parity: Option<f64>,
    detail: AtomicU64,
}

impl Multiresolution for Largest {
    fn parity(&self, side: Side, _: usize) -> Option<f64> {
        self.parity.filter(|_| side == Side::RMin)
    }

    fn share(&self, _: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        1.0
    }

    fn significance(&self, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        let within = |x: f64, [low, high]: [f64; 2]| low <= x && x < high;
        if within(cell[1], self.z) && within(cell[2], self.r) {
            self.detail.fetch_max(detail[0].abs().to_bits(), Ordering::Relaxed);
        }
        f64::INFINITY
    }
}

/// Volume-weighted cell average by Gauss's rule of five points.
pub fn average(geometry: Geometry, function: impl Fn(f64, f64) -> f64) -> impl Fn([f64; 2], [f64; 2]) -> f64 {
    let (a, b) = (0.538_469_310_105_683_1, 0.906_179_845_938_664);
    let (u, v, w) = (0.236_926_885_056_189_1, 0.478_628_670_499_366_5, 0.568_888_888_888_888_9);
    let rule = [(-b, u), (-a, v), (0.0, w), (a, v), (b, u)];
    move |[z, r], [h_z, h_r]| {
        let (mut sum, mut volume) = (0.0, 0.0);
        for (y, weight_r) in rule {
            let at = r + 0.5 * h_r * y;
            let weight = weight_r * if geometry == Geometry::Planar { 1.0 } else { at };
            for (x, weight_z) in rule {
                sum += weight * weight_z * function(z + 0.5 * h_z * x, at);
                volume += weight * weight_z;
            }
        }
        sum / volume
    }
}

/// Largest details in a rectangle on uniform meshes of 32, 64, … cells.
fn details(
    geometry: Geometry,
    function: impl Fn(f64, f64) -> f64 + Copy,
    [z, r]: [[f64; 2]; 2],
    parity: Option<f64>,
) -> Vec<f64> {
    (2..=5u8)
        .map(|level| {
            let domain = Domain { geometry, z: [0.0, 1.0], r: [0.0, 1.0] };
            let mesh = Mesh::<N>::uniform(domain, [N, N], level, [true, false]).unwrap();
            let mut field = Field::zeros(mesh.blocks(), N * N, 3);
            sample(&mesh, &mut field, 0, average(geometry, function));
            sample(&mesh, &mut field, 1, |centre, _| centre[0]);
            sample(&mesh, &mut field, 2, |centre, _| centre[1]);
            let rule = Largest { z, r, parity, detail: AtomicU64::new(0) };
            let scratch = ScratchPool::new(|| Patch::zeros(3));
            let adapted = mesh.adapted(&field, &rule, &EVERYWHERE, &scratch, |_| 0.0, |_| 0);
            assert!(adapted.is_none(), "all is significant");
            f64::from_bits(rule.detail.into_inner())
        })
        .collect()
}

/// The smallest factor by which a halving of the cells divides the details, the coarsest pair left out.
fn smallest_factor(details: &[f64]) -> f64 {
    let factors: Vec<f64> = details.windows(2).map(|pair| pair[0] / pair[1]).collect();
    eprintln!("details {details:?} fall by {factors:.2?}");
    factors[1..].iter().fold(f64::INFINITY, |least, factor| least.min(*factor))
}

/// Smooth, periodic along z, even about the axis.
fn wave(z: f64, r: f64) -> f64 {
    (std::f64::consts::TAU * z + 0.3).sin() * (1.0 + (2.5 * r * r).cos())
}

const ALONG: [f64; 2] = [0.0, 1.0];

#[test]
fn details_of_a_smooth_function_are_of_third_order() {
    let planar = smallest_factor(&details(Geometry::Planar, wave, [ALONG, [0.2, 0.8]], None));
    assert!(planar >= 7.0, "planar: {planar}");
    let ring = smallest_factor(&details(Geometry::Axisymmetric, wave, [ALONG, [0.2, 0.8]], None));
    assert!(ring >= 7.0, "away from the axis: {ring}");
}

#[test]
fn details_at_the_axis_are_of_second_order_at_least() {
    let even = smallest_factor(&details(Geometry::Axisymmetric, wave, [ALONG, [0.0, 0.05]], Some(1.0)));
    assert!(even >= 3.5, "even about the axis: {even}");
    let odd = |z: f64, r: f64| r * wave(z, r);
    let odd = smallest_factor(&details(Geometry::Axisymmetric, odd, [ALONG, [0.0, 0.05]], Some(-1.0)));
    println!("odd about the axis: {odd}");
    let side = smallest_factor(&details(Geometry::Planar, wave, [ALONG, [0.9, 1.0]], None));
    assert!(side >= 3.5, "at a side with continuation: {side}");
}
