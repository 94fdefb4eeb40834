//! The interface Riemann problem against exact and limiting solutions.

use super::*;
use approx::assert_relative_eq;

const Z_STEEL: f64 = 7800.0 * 5990.0;

/// Water of 1000 kg/m³.
fn water(pressure: f64, velocity: f64) -> FluidTrace {
    FluidTrace { pressure, velocity, density: 1000.0, gamma: 7.15, pi: 3e8 }
}

fn solid(pressure: f64, velocity: f64, impedance: f64) -> SolidTrace {
    SolidTrace { pressure, velocity, impedance }
}

/// Water that meets steel at rest: its speed towards the wall, its pressure, P of the steel, then p*, v*
/// towards the steel and rho*. Computed independently with 40 digits, printed to 15.
const IMPACT: [[f64; 6]; 8] = [
    [1.0, 1e5, 1e5, 1522155.22674801, 0.030438663300972, 1000.66144043524],
    [50.0, 1e5, 1e5, 75893853.8799865, 1.62223050982378, 1031.86247522241],
    [200.0, 1e5, 1e5, 366683297.223657, 7.84605319172247, 1112.00364491616],
    [500.0, 1e5, 1e5, 1283358025.3988, 27.4658196438251, 1210.65564351176],
    [1000.0, 1e5, 1e5, 3888764379.97447, 83.2298356229287, 1275.72613477453],
    [200.0, 5e7, 5e7, 437266803.063856, 8.28874626650949, 1104.85528946939],
    [0.0, 1e9, 1e5, 939521435.004776, 20.1066186165998, 993.359364067698],
    [-20.0, 5e7, 5e7, 20133252.8223681, -0.639243764771026, 987.602548219578],
];

#[test]
fn liquid_hits_steel() {
    for [speed, p0, p_solid, p, v, rho] in IMPACT {
        // The table counts velocities towards the wall, that is along -z.
        let fluid = water(p0, -speed);
        let star = exact_star(&fluid, &solid(p_solid, 0.0, Z_STEEL));
        let density = star_density(&fluid, star.pressure);
        assert_relative_eq!(star.pressure, p, max_relative = 1e-13);
        assert_relative_eq!(star.velocity, -v, max_relative = 1e-13);
        assert_relative_eq!(density, rho, max_relative = 1e-13);
        assert!(!star.floored && star.iterations <= 3, "{}", star.iterations);
    }
}

#[test]
fn coefficients_of_water_on_steel() {
    // p0, reflected pressure, transmitted stress, transmitted velocity per incident one.
    for (p0, reflected, transmitted, velocity) in [
        (1e5, 0.939202223844052, 1.93920222384405, 0.0607977761559478),
        (5e5, 0.939162951089852, 1.93916295108985, 0.0608370489101477),
        (5e7, 0.934501013557647, 1.93450101355765, 0.0654989864423531),
    ] {
        let z = water(p0, 0.0).impedance();
        // A pulse of amplitude p' along -z; the impedance stays that of the liquid at p0.
        let pulse = 1.0;
        let fluid = FluidTrace { pressure: p0 + pulse, pi: 3e8 - pulse, ..water(p0, -pulse / z) };
        let star = acoustic_star(&fluid, &solid(p0, 0.0, Z_STEEL));
        // Differences of p0 + 1 lose digits by p0.
        let tolerance = 4.0 * f64::EPSILON * p0;
        assert!((star.pressure - p0 - transmitted).abs() < tolerance);
        assert!((star.pressure - p0 - pulse - reflected).abs() < tolerance);
        assert_relative_eq!(star.velocity * z, -velocity, max_relative = tolerance + 1e-13);
    }
}

#[test]
fn rest_under_pressure_stays_bitwise() {
    for impedance in [15.0, 1e5, 1.5e6, Z_STEEL, 1e12] {
        for pressure in [1e5, 5e7, 123456789.123, -2e8, 0.1] {
            for velocity in [0.0, 3.7, -250.0] {
                let (fluid, wall) = (water(pressure, velocity), solid(pressure, velocity, impedance));
                for star in [acoustic_star(&fluid, &wall), exact_star(&fluid, &wall)] {
                    assert_eq!((star.pressure, star.velocity), (pressure, velocity));
                    assert!(!star.floored);
                    assert_eq!(star_density(&fluid, star.pressure), 1000.0);
                }
            }
        }
    }
}

#[test]
fn exact_and_acoustic_star_agree_for_small_amplitudes() {
    for impedance in [1e4, 1.5e6, Z_STEEL] {
        for (dp, dv) in [(5e1, 0.0), (0.0, 1e-3), (-3e1, 2e-2), (3e1, -2e-2)] {
            let (fluid, wall) = (water(5e7, 0.0), solid(5e7 + dp, dv, impedance));
            let (linear, exact) = (acoustic_star(&fluid, &wall), exact_star(&fluid, &wall));
            // What differs is of second order in the amplitude over p + pi.
            let amplitude = dp.abs() + fluid.impedance() * dv.abs();
            let second = amplitude * amplitude / 3.5e8 + 1e-7;
            assert!((exact.pressure - linear.pressure).abs() < second, "{impedance} {dp} {dv}");
            let stiffer = impedance.max(fluid.impedance());
            assert!((exact.velocity - linear.velocity).abs() < second / stiffer, "{impedance} {dp} {dv}");
            // Both invariants that arrive at the wall are kept.
            let z = fluid.impedance();
            assert_relative_eq!(linear.pressure - z * linear.velocity, 5e7, max_relative = 1e-15);
            let arriving = wall.pressure + impedance * wall.velocity;
            assert_relative_eq!(
                linear.pressure + impedance * linear.velocity,
                arriving,
                max_relative = 1e-14
            );
        }
    }
}

/// SplitMix64 (Steele, Lea & Flood 2014), uniform in [low, high).
fn uniform(state: &mut u64, low: f64, high: f64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn random_traces_meet_on_both_lines() {
    let mut state = 7;
    let (mut floored, mut most) = (0, 0);
    for _ in 0..20_000 {
        let gas = uniform(&mut state, 0.0, 1.0) < 0.3;
        let pi = if gas { 0.0 } else { 10f64.powf(uniform(&mut state, 3.0, 9.0)) };
        let low = if gas { 0.0 } else { -0.9 * pi };
        let fluid = FluidTrace {
            pressure: if uniform(&mut state, 0.0, 1.0) < 0.2 {
                low + uniform(&mut state, 1e-3, 1.0) * pi.max(1e5)
            } else {
                10f64.powf(uniform(&mut state, 1.0, 9.5))
            },
            velocity: 0.0,
            density: 10f64.powf(uniform(&mut state, -2.0, 3.2)),
            gamma: uniform(&mut state, 1.1, 7.15),
            pi,
        };
        let c = fluid.sound_speed();
        let fluid = FluidTrace { velocity: c * uniform(&mut state, -2.0, 1.0), ..fluid };
        let wall = solid(
            fluid.pressure + uniform(&mut state, -3e8, 3e8),
            uniform(&mut state, -100.0, 100.0),
            10f64.powf(uniform(&mut state, 2.0, 8.0)),
        );
        let star = exact_star(&fluid, &wall);
        let of_solid = wall.velocity + (wall.pressure - star.pressure) / wall.impedance;
        if star.floored {
            floored += 1;
            assert_eq!((star.pressure, star.velocity), (-pi, of_solid));
            continue;
        }
        most = most.max(star.iterations);
        // Toro (2009) eqs. 4.6 and 4.7 in their own form.
        let (gamma, base) = (fluid.gamma, fluid.pressure + pi);
        let shifted = star.pressure + pi;
        let f = if star.pressure > fluid.pressure {
            let a = 2.0 / ((gamma + 1.0) * fluid.density);
            (star.pressure - fluid.pressure) * (a / (shifted + (gamma - 1.0) / (gamma + 1.0) * base)).sqrt()
        } else {
            let m = (gamma - 1.0) / (2.0 * gamma);
            2.0 * c / (gamma - 1.0) * ((shifted / base).powf(m) - 1.0)
        };
        let of_fluid = fluid.velocity + f;
        // Round-off of the sums, and of p through both lines (steep where the liquid is about to tear).
        let density = star_density(&fluid, star.pressure);
        let steepness = 1.0 / (density * gamma * shifted).sqrt() + 1.0 / wall.impedance;
        let size = c + fluid.velocity.abs() + f.abs() + wall.velocity.abs();
        let terms = (wall.pressure.abs() + star.pressure.abs()) / wall.impedance;
        let bound = 64.0 * f64::EPSILON * (size + terms + star.pressure.abs() * steepness);
        assert!((of_fluid - of_solid).abs() <= bound, "{fluid:?} {wall:?} {star:?} {of_fluid} {of_solid}");
        assert!((star.velocity - of_solid).abs() <= bound && (star.velocity - of_fluid).abs() <= bound);
    }
    assert!(most <= 12, "{most}");
    assert!(floored > 200 && floored < 10_000, "{floored}");
}

#[test]
fn the_liquid_tears_off_a_wall_that_recedes_too_fast() {
    // 2c/(gamma - 1) = 476 m/s, and the wall has let go of 3e8 Pa.
    let wall = solid(1e5, -600.0, Z_STEEL);
    let star = exact_star(&water(1e5, 0.0), &wall);
    assert!(star.floored);
    assert_eq!((star.pressure, star.velocity), (-3e8, -600.0 + 3.001e8 / Z_STEEL));
    let held = exact_star(&water(1e5, 0.0), &solid(1e5, -450.0, Z_STEEL));
    assert!(!held.floored && held.pressure > -3e8 && held.pressure < -2.9e8, "{held:?}");
    assert_eq!(star_density(&water(1e5, 0.0), -3e8), 0.0);
}

#[test]
fn the_tangent_tears_where_it_would_pass_the_floor() {
    // The tangent bears p + π = Z_f Z_s/(Z_f + Z_s) Δv, so it tears at about 211 m/s.
    let fluid = water(1e5, 0.0);
    let wall = solid(1e5, -600.0, Z_STEEL);
    let star = acoustic_star(&fluid, &wall);
    assert_eq!(star, exact_star(&fluid, &wall));
    assert!(star.floored && star.pressure == -3e8);
    assert!(star_density(&fluid, star.pressure).is_finite());
    let held = acoustic_star(&fluid, &solid(1e5, -200.0, Z_STEEL));
    assert!(!held.floored && held.pressure > -3e8 && held.pressure < -2.5e8, "{held:?}");
    // Gas bears no tension at all.
    let gas = FluidTrace { pressure: 1e3, velocity: 0.0, density: 0.02, gamma: 1.4, pi: 0.0 };
    let star = acoustic_star(&gas, &solid(1e3, -2e3, Z_STEEL));
    assert!(star.floored && star.pressure == 0.0, "{star:?}");
}

#[test]
fn what_is_no_state_is_told_from_what_is() {
    assert!(water(-2.9e8, -600.0).is_state() && solid(-1e9, 3.0, Z_STEEL).is_state());
    let nan = f64::NAN;
    let good = water(1e5, 0.0);
    for bad in [
        FluidTrace { density: 0.0, ..good },
        FluidTrace { density: -1e-3, ..good },
        FluidTrace { density: nan, ..good },
        FluidTrace { density: f64::INFINITY, ..good },
        FluidTrace { pressure: -3e8, ..good },
        FluidTrace { pressure: nan, ..good },
        FluidTrace { velocity: nan, ..good },
        FluidTrace { velocity: f64::NEG_INFINITY, ..good },
        FluidTrace { gamma: 1.0, ..good },
        FluidTrace { gamma: nan, ..good },
        FluidTrace { pi: -1.0, ..good },
        FluidTrace { pi: f64::INFINITY, ..good },
    ] {
        assert!(!bad.is_state(), "{bad:?}");
    }
    for (pressure, velocity, impedance) in [
        (nan, 0.0, 1.0),
        (0.0, nan, 1.0),
        (0.0, f64::INFINITY, 1.0),
        (0.0, 0.0, 0.0),
        (0.0, 0.0, -1.0),
        (0.0, 0.0, nan),
        (0.0, 0.0, f64::INFINITY),
    ] {
        let bad = SolidTrace { pressure, velocity, impedance };
        assert!(!bad.is_state(), "{bad:?}");
    }
}

#[test]
fn shock_and_isentrope_touch_to_second_order() {
    let fluid = water(5e7, 0.0);
    let base = 3.5e8;
    let strength = |x: f64| star_density(&fluid, 5e7 + x * base);
    // rho/rho0 - 1 = x/gamma - (gamma - 1)/(2 gamma^2) x^2 + ... on both.
    for x in [1e-3, -1e-3] {
        let series = x / 7.15 - 6.15 / (2.0 * 7.15 * 7.15) * x * x;
        assert!((strength(x) / 1000.0 - 1.0 - series).abs() < 1e-9 * 0.1);
    }
}
