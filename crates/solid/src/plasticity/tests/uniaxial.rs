//! One cell in uniaxial strain, from rates of 1 to 1e7 1/s.

use approx::assert_relative_eq;

use super::{ALUMINIUM, STEEL};
use crate::WaveSpeeds;
use crate::plasticity::{Hardening, JohnsonCook, Plasticity, RateFactor, Stress, Table, ThermalSoftening};

/// The elastic trial stress after a strain along z.
fn strained(stress: Stress, strain: f64, speeds: WaveSpeeds) -> Stress {
    let (along, across) = (speeds.p_modulus() * strain, speeds.lambda() * strain);
    Stress { zz: stress.zz + along, zr: stress.zr, rr: stress.rr + across, phiphi: stress.phiphi + across }
}

/// A law written again: (A + B ε_pⁿ)(1 + C ln max(1, ε̇/ε̇₀))(1 − T*ᵐ) without the library, n = 1 for lines.
#[derive(Clone, Copy)]
struct Law {
    a: f64,
    b: f64,
    n: f64,
    c: f64,
    reference_rate: f64,
    /// m, T_m − T_r, T_r, c_p, χ.
    heat: Option<[f64; 5]>,
}

impl Law {
    fn soft(&self, temperature: f64) -> f64 {
        self.heat.map_or(1.0, |[m, range, reference, ..]| {
            1.0 - ((temperature - reference) / range).clamp(0.0, 1.0).powf(m)
        })
    }

    fn static_stress(&self, strain: f64, temperature: f64) -> f64 {
        (self.a + self.b * strain.powf(self.n)) * self.soft(temperature)
    }

    fn stress(&self, strain: f64, rate: f64, temperature: f64) -> f64 {
        let fast = if self.c > 0.0 { 1.0 + self.c * (rate / self.reference_rate).max(1.0).ln() } else { 1.0 };
        self.static_stress(strain, temperature) * fast
    }

    /// ∂/∂ε_p and ∂/∂T of the stress at rate 0.
    fn slopes(&self, strain: f64, temperature: f64) -> [f64; 2] {
        let by_strain = self.b * self.n * strain.powf(self.n - 1.0) * self.soft(temperature);
        let by_heat = self.heat.map_or(0.0, |[m, range, reference, ..]| {
            let homologous = (temperature - reference) / range;
            -(self.a + self.b * strain.powf(self.n)) * m * homologous.powf(m - 1.0) / range
        });
        [by_strain, by_heat]
    }

    /// χ/(ρ c_p).
    fn heating(&self, density: f64) -> f64 {
        self.heat.map_or(0.0, |[_, _, _, capacity, share]| share / (density * capacity))
    }
}

/// Each law twice: ours, and written again.
fn cases() -> Vec<(&'static str, Hardening, Law)> {
    let line = |a: f64, b: f64, c: f64| Law { a, b, n: 1.0, c, reference_rate: 1.0, heat: None };
    let rate = |c| RateFactor::new(c, 1.0).expect("a rate's factor");
    let table = Table::new(&[[0.0, 2e8], [0.5, 6e8]]).expect("a table").with_rate(rate(0.02));
    let heat = |m, melting: f64, reference: f64, capacity| {
        ThermalSoftening::new(m, melting, reference, capacity, 0.9).expect("softening")
    };
    let law = |a, b, n| JohnsonCook::new(a, b, n).expect("a law");
    // With A, B, n; C; m, T_m, T_r, c_p.
    let hot = |name, [a, b, n]: [f64; 3], c, [m, melting, reference, capacity]: [f64; 4]| {
        let ours = law(a, b, n).with_rate(rate(c)).with_softening(heat(m, melting, reference, capacity));
        let again = Some([m, melting - reference, reference, capacity, 0.9]);
        (name, Hardening::JohnsonCook(ours), Law { a, b, n, c, reference_rate: 1.0, heat: again })
    };
    vec![
        ("perfect", Hardening::perfect(2.5e8).expect("a law"), line(2.5e8, 0.0, 0.0)),
        ("linear", Hardening::linear(2.5e8, 3e9).expect("a law"), line(2.5e8, 3e9, 0.0)),
        ("table", Hardening::Table(table), line(2e8, 8e8, 0.02)),
        (
            "power",
            Hardening::JohnsonCook(law(3e8, 1e9, 0.6)),
            Law { a: 3e8, b: 1e9, n: 0.6, c: 0.0, reference_rate: 1.0, heat: None },
        ),
        hot("johnson-cook", [324e6, 114e6, 0.42], 0.015, [1.34, 925.0, 293.0, 896.0]),
        hot("johnson-cook, m < 1", [305e6, 1161e6, 0.61], 0.05, [0.517, 1700.0, 293.0, 480.0]),
    ]
}

const RATES: [f64; 4] = [1.0, 1e3, 1e5, 1e7];
/// Strains of a test: while the overstress builds up, and long after.
const SPANS: [f64; 2] = [1.5e-3, 0.02];
/// Where it begins: on the yield surface of rate 0, strained and warmed, under pressure.
const BEGIN: [f64; 2] = [0.01, 320.0];
const PRESSURE: f64 = 1e8;

/// The stress at the beginning, in compression.
fn beginning(law: &Law) -> Stress {
    let q = law.static_stress(BEGIN[0], BEGIN[1]);
    Stress { zz: -PRESSURE - q, zr: 0.0, rr: -PRESSURE, phiphi: -PRESSURE }
}

/// q, ε_p, T at the end of `steps` returns in equal steps.
fn stepped(hardening: &Hardening, law: &Law, rate: f64, span: f64, steps: u32) -> [f64; 3] {
    let plasticity = Plasticity::new(hardening.clone(), ALUMINIUM);
    let (mut stress, [mut strain, mut temperature]) = (beginning(law), BEGIN);
    let step = span / f64::from(steps);
    for _ in 0..steps {
        stress = strained(stress, -step, ALUMINIUM);
        if let Some(returned) = plasticity.return_map(stress, strain, temperature, step / rate) {
            stress = returned.stress;
            (strain, temperature) = (returned.strain, returned.temperature);
        }
    }
    [stress.von_mises_squared().sqrt(), strain, temperature]
}

/// The same by the ordinary differential equations q′ = 2μ ε̇ − 3μ ε̇_p, T′ = χ q ε̇_p/(ρ c_p), in Runge's steps of fourth
/// order: ε̇_p from the overstress where it is fast enough to count, else from consistency, q = Y.
fn integrated(law: &Law, rate: f64, span: f64, steps: u32) -> [f64; 3] {
    let (mu, heating) = (ALUMINIUM.shear_modulus(), law.heating(ALUMINIUM.density));
    let right = |[q, strain, temperature]: [f64; 3]| {
        let [by_strain, by_heat] = law.slopes(strain, temperature);
        let consistent = 2.0 * mu * rate / (3.0 * mu + by_strain + by_heat * heating * q);
        let plastic = if law.c == 0.0 || consistent < law.reference_rate {
            consistent
        } else {
            law.reference_rate * ((q / law.static_stress(strain, temperature) - 1.0) / law.c).exp()
        };
        // By strain, not by time.
        [2.0 * mu - 3.0 * mu * plastic / rate, plastic / rate, heating * q * plastic / rate]
    };
    let h = span / f64::from(steps);
    let mut y = [law.static_stress(BEGIN[0], BEGIN[1]), BEGIN[0], BEGIN[1]];
    let moved = |y: [f64; 3], k: [f64; 3], by: f64| std::array::from_fn(|c| y[c] + by * k[c]);
    for _ in 0..steps {
        let a = right(y);
        let b = right(moved(y, a, 0.5 * h));
        let c = right(moved(y, b, 0.5 * h));
        let d = right(moved(y, c, h));
        y = std::array::from_fn(|k| y[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
    }
    y
}

/// The largest relative difference.
fn apart(one: [f64; 3], other: [f64; 3]) -> f64 {
    // Of temperature the rise counts.
    let rise = (one[2] - other[2]).abs() / (other[2] - BEGIN[1]).abs().max(1.0);
    ((one[0] / other[0] - 1.0).abs()).max((one[1] / other[1] - 1.0).abs()).max(rise)
}

#[test]
fn returns_solve_the_equations_of_backward_euler() {
    let mut worst = 0.0_f64;
    for (name, hardening, law) in cases() {
        let plasticity = Plasticity::new(hardening, ALUMINIUM);
        let heating = law.heating(ALUMINIUM.density);
        for rate in RATES {
            let (mut stress, [mut strain, mut temperature]) = (beginning(&law), BEGIN);
            let (step, three_mu) = (SPANS[1] / 300.0, 3.0 * ALUMINIUM.shear_modulus());
            for _ in 0..300 {
                stress = strained(stress, -step, ALUMINIUM);
                let (q, dt) = (stress.von_mises_squared().sqrt(), step / rate);
                let (mut low, mut high) = (0.0, q / three_mu);
                for _ in 0..200 {
                    let x = 0.5 * (low + high);
                    let line = q - three_mu * x;
                    let heated = temperature + heating * line * x;
                    if line > law.stress(strain + x, x / dt, heated) { low = x } else { high = x }
                }
                let returned = plasticity.return_map(stress, strain, temperature, dt).expect("it flows");
                let error = (returned.increment - low).abs() / (q / three_mu);
                worst = worst.max(error);
                assert!(error < 1e-14, "{name} at {rate:e}: {} for {low}", returned.increment);
                assert_relative_eq!(returned.von_mises, q - three_mu * low, max_relative = 1e-12);
                stress = returned.stress;
                (strain, temperature) = (returned.strain, returned.temperature);
            }
        }
    }
    println!("largest difference {worst:.1e} of q/3mu");
}

#[test]
fn steps_converge_to_the_differential_equations() {
    for (name, hardening, law) in cases() {
        for (rate, span) in RATES.into_iter().flat_map(|rate| SPANS.map(|span| (rate, span))) {
            let exact = integrated(&law, rate, span, 80_000);
            let sure = apart(integrated(&law, rate, span, 40_000), exact);
            // Romberg's table of first order and on.
            let mut row: Vec<[f64; 3]> = Vec::new();
            let mut errors = Vec::new();
            for level in 0..7 {
                let mut next = vec![stepped(&hardening, &law, rate, span, 1000 << level)];
                errors.push(apart(next[0], exact));
                for (k, before) in row.iter().enumerate() {
                    let gain = f64::from((1u32 << (k + 1)) - 1);
                    let finer = next[k];
                    next.push(std::array::from_fn(|c| finer[c] + (finer[c] - before[c]) / gain));
                }
                row = next;
            }
            let extrapolated = row.iter().map(|entry| apart(*entry, exact)).fold(f64::INFINITY, f64::min);
            let last = errors.len() - 1;
            let order = (errors[last - 1] / errors[last]).log2();
            println!(
                "{name} at {rate:e} over {span}: reference {sure:.0e}, error {:.1e} to {:.1e}, order {order:.3}, \
                 extrapolated {extrapolated:.0e}",
                errors[0], errors[last]
            );
            assert!(sure < 1e-9, "{name} at {rate:e}: the reference is off by {sure:e}");
            assert!(errors[last] < 1e-10 || (order - 1.0).abs() < 0.02, "{name} at {rate:e}: order {order}");
            assert!(extrapolated < 1e-8, "{name} at {rate:e}: {extrapolated:e}");
        }
    }
}

#[test]
fn linear_hardening_has_its_plastic_modulus() {
    for (speeds, hardening) in [(STEEL, 0.0), (STEEL, 8e9), (ALUMINIUM, 3e9)] {
        let plasticity = Plasticity::new(Hardening::linear(4e8, hardening).expect("a law"), speeds);
        let mu = speeds.shear_modulus();
        let bulk = speeds.lambda() + 2.0 / 3.0 * mu;
        let modulus = bulk + 4.0 / 3.0 * mu * hardening / (3.0 * mu + hardening);
        // To the elastic limit, then on, in steps of any length.
        let limit = 4e8 / (2.0 * mu);
        let mut stress = strained(Stress { zz: -1e5, zr: 0.0, rr: -1e5, phiphi: -1e5 }, -limit, speeds);
        let (begin, mut strain, mut total) = (stress.zz, 0.0, 0.0);
        for step in [1e-3, 1e-4, 7e-3, 2e-2] {
            total += step;
            stress = strained(stress, -step, speeds);
            let returned = plasticity.return_map(stress, strain, 0.0, 1e-9).expect("it flows");
            (stress, strain) = (returned.stress, returned.strain);
            assert_relative_eq!(stress.zz, begin - modulus * total, max_relative = 1e-12);
            let flowed = 2.0 * mu / (3.0 * mu + hardening) * total;
            assert_relative_eq!(strain, flowed, max_relative = 1e-12);
        }
    }
}
