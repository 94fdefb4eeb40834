//! Pieces that several kinds of cases have in common.

use fluid::StiffenedGas;

use super::super::scales::RAYLEIGH_FACTOR;

/// Water, with π in Pa.
pub(super) const WATER: StiffenedGas = StiffenedGas { gamma: 7.15, pi: 3e8 };
/// Water: kg/m³.
pub(super) const DENSITY: f64 = 1000.0;
/// By how much of R/d a rigid wall at the distance d lengthens the collapse (the image bubble's first-order term).
const WALL_LENGTHENS: f64 = 0.205;
/// Nearer than the last of these d/R the collapse is so many times as long as a free one: see `docs/verification/validation-jets.md`, of
/// bubbles that the wall cuts. One half on the wall is half a free one.
const NEAR_WALL: [[f64; 2]; 8] = [
    [0.0, 1.0],
    [0.1, 1.045],
    [0.3, 1.125],
    [0.6, 1.212],
    [0.85, 1.243],
    [1.05, 1.2],
    [1.2, 1.169],
    [1.5, 1.135],
];
/// By how much of √(Δp/ρ)/c the liquid's compressibility does: from 0.6 to 0.8 in this program's runs.
const SOUND_LENGTHENS: f64 = 0.7;
/// Gas constant of air, J/(kg K), and room temperature, K.
const AIR: [f64; 2] = [287.05, 293.15];
/// Water's vapour pressure at room temperature, Pa: what a bubble holds at the least.
pub(super) const VAPOUR: f64 = 2340.0;

/// A number as a case file has it, six digits of it.
pub(super) fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs()) {
        format!("{rounded:?}")
    } else {
        format!("{rounded:e}")
    }
}

/// A time with three digits.
fn time(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// A bubble of gas in water at another pressure.
#[derive(Clone, Copy)]
pub(super) struct Bubble {
    /// R, m.
    pub radius: f64,
    /// Far away, Pa.
    pub pressure: f64,
    /// Of the gas, Pa.
    pub gas_pressure: f64,
}

impl Bubble {
    /// Rayleigh's collapse time 0.91468 R √(ρ/Δp), s.
    pub fn rayleigh_time(&self) -> f64 {
        RAYLEIGH_FACTOR * self.radius * (DENSITY / (self.pressure - self.gas_pressure)).sqrt()
    }

    /// About when it collapses at so many radii from a wall (∞: none), s.
    pub fn collapse_time(&self, stand_off: f64) -> f64 {
        let mach = ((self.pressure - self.gas_pressure) / DENSITY).sqrt() / sound(self.pressure);
        self.rayleigh_time() * lengthened(stand_off) * (1.0 + SOUND_LENGTHENS * mach)
    }

    /// `[fluid.liquid]` to `[[fluid.region]]`, the bubble's centre at `height` over z = 0.
    pub fn keys(&self, height: f64) -> String {
        let media = media(self.pressure);
        let density = self.gas_pressure / (AIR[0] * AIR[1]);
        format!(
            "{media}
[[fluid.region]]
shape = \"sphere\"
centre = [{centre}, 0.0]
radius = {radius}
phase = \"gas\"
density = {density:<22} # air at 20 degrees Celsius
pressure = {gas}
",
            centre = number(height),
            radius = number(self.radius),
            density = number(density),
            gas = number(self.gas_pressure),
        )
    }
}

/// How many times as long as a free one a bubble takes at so many radii from a rigid wall (∞: none), growing or collapsing.
pub(super) fn lengthened(stand_off: f64) -> f64 {
    let after = NEAR_WALL.partition_point(|[distance, _]| *distance <= stand_off).max(1);
    let [near, at_near] = NEAR_WALL[after - 1];
    let Some([far, at_far]) = NEAR_WALL.get(after) else { return 1.0 + WALL_LENGTHENS / stand_off };
    at_near + (at_far - at_near) * (stand_off - near) / (far - near)
}

/// `[fluid.liquid]`, `[fluid.gas]` and `[fluid.ambient]`: water at a pressure, Pa, and a gas.
pub(super) fn media(pressure: f64) -> String {
    let (at_rest, StiffenedGas { gamma, pi, .. }) = (DENSITY, WATER);
    let pressure = number(pressure);
    format!(
        "
[fluid.liquid]                  # water, p = (gamma - 1) rho e - gamma pi
gamma = {gamma:?}
pi = {pi:e}

[fluid.gas]
gamma = 1.4

[fluid.ambient]
density = {at_rest:?}
pressure = {pressure}
"
    )
}

/// The sound speed of water at a pressure, m/s.
pub(super) fn sound(pressure: f64) -> f64 {
    WATER.sound_speed(DENSITY, pressure)
}

/// `[time]`: the end, and snapshots between 0 and it.
pub(super) fn times(end: f64, about: &str, snapshots: impl IntoIterator<Item = f64>) -> String {
    let end = time(end);
    let mut within: Vec<f64> = snapshots.into_iter().map(time).filter(|at| *at > 0.0 && *at < end).collect();
    within.sort_by(f64::total_cmp);
    within.dedup();
    let list: Vec<String> = within.into_iter().map(number).collect();
    format!("[time]\nend = {:<25} # {about}\nsnapshots = [{}]\n", number(end), list.join(", "))
}

/// Shares of a collapse at which the bubble is worth a look.
pub(super) const OF_COLLAPSE: [f64; 6] = [0.3, 0.6, 0.8, 0.9, 0.97, 1.0];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_they_were_meant() {
        for (value, text) in [
            (1e-3, "0.001"),
            (6.4e-4, "6.4e-4"),
            (2e7, "2e7"),
            (0.0, "0.0"),
            (-6.4e-3, "-0.0064"),
            (1.0 / 3.0, "0.333333"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn a_bubble_collapses_later_near_a_wall_and_in_compressible_liquid() {
        // Measured with this program: 7.822 us 1.5 radii above aluminium, 1 mm at 20 MPa; 5.058 us at 50 MPa above steel.
        for (pressure, measured) in [(2e7, 7.822e-6), (5e7, 5.058e-6)] {
            let bubble = Bubble { radius: 1e-3, pressure, gas_pressure: VAPOUR };
            assert!(
                (bubble.collapse_time(1.5) / measured - 1.0).abs() < 0.03,
                "{}",
                bubble.collapse_time(1.5)
            );
        }
        // Without gas or sound: Rayleigh's.
        let slow = Bubble { radius: 1e-3, pressure: 1e5, gas_pressure: 1e-3 };
        assert!((slow.rayleigh_time() / 91.468136e-6 - 1.0).abs() < 1e-6);
        assert!((slow.collapse_time(f64::INFINITY) / slow.rayleigh_time() - 1.0).abs() < 0.01);
    }
}
