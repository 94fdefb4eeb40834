//! Drops and bubbles that oscillate: Lamb's frequency without viscosity, Prosperetti's frequency and damping with it.

use fluid::{FluidSolver, Phase, PhaseViscosity, RiemannSolver, ThinGas, Viscosity};
use nalgebra::{Complex, Matrix4};

use crate::helpers::*;
use crate::surface_tension::{GAS_DENSITY, TENSION, ball};

/// μ of the liquid, Pa s; the gas has a hundredth of it.
const VISCOSITY: f64 = 20.0;

/// The largest radius less the first one, over the radius: small enough for laws of small heights.
const HEIGHT: f64 = 0.05;

const BOTH: [Phase; 2] = [Phase::Liquid, Phase::Gas];

/// What is within a ball and around it.
fn of_sides<T>(inside: Phase, liquid: T, gas: T) -> [T; 2] {
    if inside == Phase::Gas { [gas, liquid] } else { [liquid, gas] }
}

/// Gives a ball of radius 1 m the flow of Lamb's mode n = 2: potentials ½ A (z² − ½ r²) within and ∝ P₂/s³ outside, with one normal
/// velocity on it. Cells have the momentum of the flow in them.
pub fn set_moving(fluid: &mut FluidSolver<8>, inside: Phase, rate: f64) {
    let densities = of_sides(inside, 1000.0, GAS_DENSITY);
    let flow = |z: f64, r: f64| {
        let s = z.hypot(r);
        if s < 1.0 {
            return (densities[0], [rate * z, -0.5 * rate * r]);
        }
        // −(A/3) ∇(P₂/s³), with P₂ = (3z² − s²)/(2s²).
        let (p2, per) = ((3.0 * z * z - s * s) / (2.0 * s * s), -rate / 3.0 / s.powi(5));
        (densities[1], [per * (2.0 * z - 5.0 * z * p2), per * (-r - 5.0 * r * p2)])
    };
    const PARTS: usize = 8;
    let offset = |part: usize| (part as f64 + 0.5) / PARTS as f64 - 0.5;
    for slot in 0..fluid.mesh().blocks() {
        let id = fluid.mesh().tree().leaves()[slot];
        let [h_z, h_r] = fluid.mesh().widths(id.level);
        for cell in 0..64 {
            let [z, r] = fluid.mesh().centre(id, cell % 8, cell / 8);
            let (mut mass, mut momentum) = (0.0, [0.0; 2]);
            for part in 0..PARTS * PARTS {
                let (density, v) = flow(z + offset(part % PARTS) * h_z, r + offset(part / PARTS) * h_r);
                mass += density;
                momentum = [momentum[0] + density * v[0], momentum[1] + density * v[1]];
            }
            let block = fluid.state_mut().block_mut(slot);
            let rho = block[cell];
            let [v_z, v_r] = momentum.map(|sum| sum / mass);
            block[64 + cell] = rho * v_z;
            block[128 + cell] = rho * v_r;
            block[192 + cell] += 0.5 * rho * (v_z * v_z + v_r * v_r);
        }
    }
}

/// ∫φ (z² − ½r²) r dr dz.
fn second_moment(fluid: &FluidSolver<8>) -> f64 {
    let [h_z, h_r] = fluid.mesh().widths(fluid.mesh().tree().finest());
    let mut sum = 0.0;
    each_cell(fluid, |[z, r], _, w| sum += w.phi * (z * z - 0.5 * r * r) * r * h_z * h_r);
    sum
}

/// Lamb's frequency of mode n = 2, 1/s: ω² = 24σ/((3ρ_i + 2ρ_o) R³).
fn lamb(inside: Phase) -> f64 {
    let [within, around] = of_sides(inside, 1000.0, GAS_DENSITY);
    (24.0 * TENSION / (3.0 * within + 2.0 * around)).sqrt()
}

/// Frequency over Lamb's, and the damping rate over the frequency.
///
/// The ball starts round and moving. The frequency is that of the first and the third time that it is round again, the damping that of
/// its first three extremes, both of differences, so that what is left of roundness has no say.
///
/// - `cells`: per radius; `viscosity`: of the liquid, Pa s.
fn oscillation(kind: Kind, inside: Phase, cells: usize, riemann: RiemannSolver, viscosity: f64) -> [f64; 2] {
    let half = if inside == Phase::Gas { 4.0 } else { 2.4 };
    let mut fluid = ball(kind, AXIAL, inside, (cells, half), [0.0; 2], |setup| {
        setup.riemann = riemann;
        let of = |shear: f64| PhaseViscosity { shear, bulk: 0.0 };
        let terms =
            Viscosity { liquid: of(viscosity), gas: of(0.01 * viscosity), thin_gas: ThinGas::Bounded };
        setup.viscosity = (viscosity > 0.0).then_some(terms);
    });
    set_moving(&mut fluid, inside, HEIGHT * lamb(inside));
    let start = second_moment(&fluid);
    let (mut last, mut extreme) = ([0.0; 2], 0.0_f64);
    let (mut crossings, mut extremes) = (vec![], vec![]);
    while crossings.len() < 3 {
        // A thousandth of a period.
        for _ in 0..4 {
            fluid.step_at(CFL).unwrap();
        }
        let moved = second_moment(&fluid) - start;
        if moved * last[1] < 0.0 {
            let [time, before] = last;
            crossings.push(time + (fluid.time() - time) * before / (before - moved));
            extremes.push(std::mem::take(&mut extreme));
        }
        if moved.abs() > extreme.abs() {
            extreme = moved;
        }
        assert!(fluid.time() * lamb(inside) < 15.0, "it comes back: {crossings:?}");
        last = [fluid.time(), moved];
    }
    let period = crossings[2] - crossings[0];
    let frequency = std::f64::consts::TAU / period;
    let falls = ((extremes[0] - extremes[1]) / (extremes[2] - extremes[1])).ln();
    [frequency / lamb(inside), falls / (0.5 * period) / frequency]
}

/// Frequency over Lamb's and damping rate over frequency of the normal mode n = 2 of a viscous ball in a viscous fluid.
///
/// Prosperetti (1980), Phys. Fluids 23, 1109. With e^{st}, R = 1: potentials r² and r⁻³ and vortical flow of i₂(qr) and k₂(qr), q² = sρ/μ,
/// on the two sides; both velocities and the shear stress are continuous, the normal stress jumps by σ(n − 1)(n + 2)η.
fn prosperetti(inside: Phase, viscosity: f64) -> [f64; 2] {
    let rho = of_sides(inside, 1000.0, GAS_DENSITY);
    let mu = of_sides(inside, viscosity, 0.01 * viscosity);
    let real = |x: f64| Complex::new(x, 0.0);
    // U and V of u = U P₂ and u_θ = V dP₂/dθ on the ball, and their derivatives; `d`: of ln T, with T = i₂ or k₂.
    let vortical = |q: Complex<f64>, d: Complex<f64>| {
        let second = q * q + 6.0 - d * 2.0;
        [real(6.0), d + 1.0, (d - 1.0) * 6.0, second + d - 1.0]
    };
    let determinant = |s: Complex<f64>| {
        let [x, y] = [0, 1].map(|side| (s * rho[side] / mu[side]).sqrt());
        let t = x.tanh();
        let within = x * x * (x - t) / ((x * x + 3.0) * t - x * 3.0) - 3.0;
        let around = -y * y * (y + 1.0) / (y * y + y * 3.0 + 3.0) - 3.0;
        let columns = [
            [2.0, 1.0, 2.0, 1.0].map(real),
            vortical(x, within),
            [-3.0, 1.0, 12.0, -4.0].map(real),
            vortical(y, around),
        ];
        Matrix4::from_fn(|row, column| {
            let [u, v, u_r, v_r] = columns[column];
            let (side, sign) = if column < 2 { (0, 1.0) } else { (1, -1.0) };
            let potential = if column % 2 == 0 { s * rho[side] } else { real(0.0) };
            let rise = if side == 0 { u * (4.0 * TENSION) } else { real(0.0) };
            match row {
                0 => u * sign,
                1 => v * sign,
                2 => (v_r - v + u) * (mu[side] * sign),
                _ => s * (potential + u_r * (2.0 * mu[side])) * sign + rise,
            }
        })
        .determinant()
    };
    // The secant rule from Lamb's frequency and damping in the liquid.
    let rate = if inside == Phase::Gas { 20.0 } else { 5.0 } * viscosity / 1000.0;
    let (mut s, mut before) = (Complex::new(-rate, lamb(inside)), Complex::new(-0.8 * rate, lamb(inside)));
    for _ in 0..50 {
        let (now, then) = (determinant(s), determinant(before));
        if now == then || (s - before).norm() < 1e-14 * s.norm() {
            break;
        }
        (s, before) = (s - now * (s - before) / (now - then), s);
    }
    [s.im / lamb(inside), -s.re / s.im]
}

#[test]
fn prosperettis_mode_is_the_pole_of_the_initial_value_problem() {
    // By another program in 30 digits, from the poles of the Laplace transform of the initial value problem.
    for (inside, mode) in [(Phase::Liquid, [0.994836, 0.034673]), (Phase::Gas, [0.978696, 0.098218])] {
        let [frequency, damping] = prosperetti(inside, VISCOSITY);
        approx::assert_relative_eq!(frequency, mode[0], max_relative = 1e-5);
        approx::assert_relative_eq!(damping, mode[1], max_relative = 1e-4);
    }
}

/// The default scheme, 20 cells per radius; the study has the other half of the four cases.
#[test]
fn a_drop_has_lambs_frequency_and_a_viscous_bubble_prosperettis() {
    for (inside, viscosity) in [(Phase::Liquid, 0.0), (Phase::Gas, VISCOSITY)] {
        let [frequency, damping] = oscillation(SHARP, inside, 20, RiemannSolver::Hllc, viscosity);
        let exact = if viscosity > 0.0 { prosperetti(inside, viscosity) } else { [1.0, 0.0] };
        eprintln!("{inside:?}: {frequency:.4}, {damping:.4}; exact {exact:.4?}");
        assert!((frequency / exact[0] - 1.0).abs() < 0.01, "{inside:?} {frequency} {exact:?}");
        assert!((damping - exact[1]).abs() < 0.015, "{inside:?} {damping} {exact:?}");
    }
}

#[test]
#[ignore = "a study of minutes: docs/theory/surface-tension.md has its numbers"]
fn study_of_oscillations() {
    for &(name, kind) in rows(&[("sharp", SHARP), ("mixture", MIXTURE)]) {
        for inside in BOTH {
            for &viscosity in rows(&[0.0, VISCOSITY]) {
                let exact = if viscosity > 0.0 { prosperetti(inside, viscosity) } else { [1.0, 0.0] };
                for riemann in [RiemannSolver::Hllc, RiemannSolver::HllcLowMach] {
                    let is_default = kind == SHARP && riemann == RiemannSolver::Hllc;
                    for &cells in rows(if is_default { &[10, 20, 40] } else { &[10, 20] }) {
                        let [frequency, damping] = oscillation(kind, inside, cells, riemann, viscosity);
                        eprintln!(
                            "{name} {inside:?} {viscosity} {riemann:?} {cells}: {frequency:.4}, {damping:+.4}, exact {exact:.4?}"
                        );
                    }
                }
            }
        }
    }
}
