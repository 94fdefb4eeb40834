//! How far a bubble will grow and when it collapses, so that a case's domain and times fit it.

use fluid::BubbleContent;

use super::parts::{DENSITY, WATER, sound};

/// Steps take this share of the time in which the radius changes by itself: four digits, which is more than a domain needs.
const SHARE: f64 = 2e-3;
/// More steps than two cycles of any bubble take.
const MOST_STEPS: usize = 400_000;

/// A turn of the radius.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Turn {
    /// When, s.
    pub time: f64,
    /// Radius, m.
    pub radius: f64,
}

/// A bubble that grows and collapses: its largest radius, its smallest one, the same of the second cycle, and so on.
///
/// Gilmore (1952): R V' (1 − V/c) + 3/2 V² (1 − V/3c) = H (1 + V/c) + R H'/c (1 − V/c), with enthalpy H and sound speed c on the
/// bubble's wall along the liquid's isentrope (p + π)/ρ^γ = const. Runge–Kutta's steps of fourth order.
///
/// - `start`: radius at t = 0, m; `equilibrium`: R_n of the gas, m; `left`: R_n after the first maximum, m.
/// - returns: `None` if there are not so many turns: a bubble that does not grow, or that does not collapse.
/// - tested by: Lechner's bubble (2020).
pub(super) fn turns<const TURNS: usize>(
    content: &BubbleContent,
    start: f64,
    equilibrium: f64,
    left: Option<f64>,
) -> Option<[Turn; TURNS]> {
    let mut turns = [Turn::default(); TURNS];
    let (mut found, mut time, mut rest) = (0, 0.0, equilibrium);
    let mut state = [start, 0.0];
    for _ in 0..MOST_STEPS {
        let rates = rate(content, rest, state);
        let [radius, speed] = state;
        let dt = SHARE * (radius / (speed.abs() + 1.0)).min((radius / rates[1].abs().max(1e-30)).sqrt());
        let next = step(content, rest, state, dt);
        if !(next[0] > 0.0 && next[1].is_finite()) {
            return None;
        }
        // Even turns are maxima.
        let turned =
            if found % 2 == 0 { next[1] <= 0.0 && speed > 0.0 } else { next[1] >= 0.0 && speed < 0.0 };
        (state, time) = (next, time + dt);
        if turned {
            turns[found] = Turn { time, radius: next[0] };
            found += 1;
            if found == 1 {
                rest = left.unwrap_or(rest);
            }
            if found == turns.len() {
                return Some(turns);
            }
        }
    }
    None
}

fn step(content: &BubbleContent, rest: f64, [radius, speed]: [f64; 2], dt: f64) -> [f64; 2] {
    let at = |share: f64, k: [f64; 2]| {
        rate(content, rest, [radius + share * dt * k[0], speed + share * dt * k[1]])
    };
    let k1 = at(0.0, [0.0; 2]);
    let k2 = at(0.5, k1);
    let k3 = at(0.5, k2);
    let k4 = at(1.0, k3);
    [(radius, 0), (speed, 1)].map(|(value, c)| value + dt / 6.0 * (k1[c] + 2.0 * (k2[c] + k3[c]) + k4[c]))
}

/// R' and V'.
fn rate(content: &BubbleContent, rest: f64, [radius, speed]: [f64; 2]) -> [f64; 2] {
    let (gamma, far) = (WATER.gamma, content.far_pressure);
    let pressure = content.gas_at(rest, radius).pressure;
    let change = -3.0 * content.gas.gamma * pressure * speed / radius;
    let reference = far + WATER.pi;
    let share = (pressure + WATER.pi) / reference;
    let enthalpy = gamma / (gamma - 1.0) * reference / DENSITY * (share.powf(1.0 - 1.0 / gamma) - 1.0);
    let c = (sound(far).powi(2) + (gamma - 1.0) * enthalpy).sqrt();
    let enthalpy_change = change / (DENSITY * share.powf(1.0 / gamma));
    let mach = speed / c;
    let pull = enthalpy * (1.0 + mach) + radius / c * enthalpy_change * (1.0 - mach)
        - 1.5 * speed * speed * (1.0 - mach / 3.0);
    [speed, pull / (radius * (1.0 - mach))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::scales::RAYLEIGH_FACTOR;
    use fluid::StiffenedGas;

    #[test]
    fn lechners_bubble_grows_to_half_a_millimetre() {
        let content = BubbleContent {
            far_pressure: 1e5,
            gas: StiffenedGas { gamma: 1.4, pi: 0.0 }.into(),
            surface_tension: 0.0,
            vapour_pressure: 0.0,
            temperature: 293.15,
        };
        let [largest, collapse, rebound, second] =
            turns(&content, 20e-6, 184.1e-6, Some(64e-6)).expect("four turns");
        assert!((480e-6..520e-6).contains(&largest.radius), "{largest:?}");
        // As long as it grew, by Rayleigh's time.
        let rayleigh = RAYLEIGH_FACTOR * largest.radius * (1000.0_f64 / 1e5).sqrt();
        assert!(((collapse.time - largest.time) / rayleigh - 1.0).abs() < 0.02, "{largest:?} {collapse:?}");
        let [_, _, whole, _] = turns(&content, 20e-6, 184.1e-6, None).expect("four turns");
        assert!(rebound.radius < 0.6 * whole.radius, "{rebound:?} {whole:?}");
        assert!(second.time > rebound.time && rebound.time > collapse.time);
        assert_eq!(turns::<4>(&content, 20e-6, 20e-6, None), None, "it rests");
    }
}
