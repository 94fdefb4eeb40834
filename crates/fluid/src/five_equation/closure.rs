//! What the phases of a mixed cell do under compression: the K term.

use crate::Mixture;
use crate::elementary::{exp_and_less_one, ln_of};

/// Gas fractions within this distance of 0 and 1 count as pure: they are advected and make no closure of their own.
pub(crate) const PURE: f64 = crate::TRACE_GAS;

/// Volume change of a cell per step below which its volumes are relaxed by the linear rule.
const LINEAR_BELOW: f64 = 1e-3;

/// The lowest p + π of the gas that the closure works with, Pa: that of the pressure floor.
const LOWEST: f64 = 1e-4;

/// Whether a cell holds both phases.
#[inline(always)]
pub(crate) fn is_mixed(phi: f64) -> bool {
    (phi > PURE) & (phi < 1.0 - PURE)
}

/// A gas fraction bounded to [0, 1], but for the distance from it that counts as pure: prediction on a finer grid may
/// take it there, and to take that back without the energy would change the pressure.
#[inline(always)]
pub(crate) fn bounded(phi: f64) -> f64 {
    phi.clamp(-PURE, 1.0 + PURE)
}

/// What the phases of a mixture at one pressure do under compression.
///
/// Kapila et al. (2001); the mixture's bulk modulus is Wood's (1930): 1/K = φ/K_g + (1 − φ)/K_l with K_k = γ_k (p + π_k).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Compression {
    /// K, Pa.
    pub modulus: f64,
    /// K/K_g and K/K_l: the share of a volume's compression that the phase takes, relative to its own volume.
    pub gas: f64,
    pub liquid: f64,
}

impl Compression {
    /// At pressure `p` and gas fraction `phi`. With the closure off both phases take the same compression, and the
    /// modulus is that of the frozen mixture (Allaire, Clerc & Kokh 2002).
    #[inline(always)]
    pub fn at(p: f64, phi: f64, mixture: &Mixture, is_on: bool) -> Self {
        if !is_on {
            return Self { modulus: mixture.stiffness(p, phi), gas: 1.0, liquid: 1.0 };
        }
        let (gas, liquid) = (mixture.gas, mixture.liquid);
        let k_gas = gas.gamma * (p + gas.pi).max(LOWEST);
        let k_liquid = liquid.gamma * (p + liquid.pi).max(LOWEST);
        let modulus = k_gas * k_liquid / (phi * k_liquid + (1.0 - phi) * k_gas);
        Self { modulus, gas: modulus / k_gas, liquid: modulus / k_liquid }
    }

    /// (1 − φ)(1 − K/K_l) per unit of divergence: how much faster than the mixture the gas expands.
    #[inline(always)]
    pub fn expansion(&self, phi: f64) -> f64 {
        (1.0 - phi) * (1.0 - self.liquid)
    }

    /// The gas fraction behind the wave that compresses a mixture of fraction `phi` by the factor `ratio` = ρ*/ρ.
    ///
    /// The liquid's volume follows the density: (1 − φ)* = (1 − φ)[1 + (ρ*/ρ − 1)(1 − K/K_l)], at most 1. The energy
    /// flux of HLLC carries ρ*/ρ times the liquid's β₂; if the flux of φ did not, uniform flow would be unstable.
    #[inline(always)]
    pub fn star_fraction(&self, phi: f64, ratio: f64) -> f64 {
        let liquid = (1.0 - phi) * (1.0 + (ratio - 1.0) * (1.0 - self.liquid));
        1.0 - liquid.min(1.0)
    }
}

/// The gas fraction of a mixed cell at the end of a step.
///
/// Both phases' volumes are flux balances: the cell takes in −f of gas and −(D − f) of liquid, which makes a_g + a_l =
/// 1 − D of a cell of volume 1. They then relax isentropically to one pressure p' and the volume 1:
///
/// a_g ((p + π_g)/(p' + π_g))^(1/γ_g) + a_l ((p + π_l)/(p' + π_l))^(1/γ_l) = 1.
///
/// For small D by the linear rule φ − f + φD + (1 − φ)(1 − K/K_l)D, which keeps uniform flow uniform to round-off.
///
/// - `advected`: φ − f + φD, the fraction after pure advection; `phi`, `p`: at the beginning of the step.
/// - `volume`: D = Δt Σ A u_f/V; `gas`: f = Δt Σ A F_φ/V.
/// - returns: the gas fraction, for any D in [0, 1] but for the distance that counts as pure.
pub(crate) fn relaxed_fraction(
    advected: f64,
    phi: f64,
    p: f64,
    volume: f64,
    gas: f64,
    compression: &Compression,
    mixture: &Mixture,
) -> f64 {
    let (gas_left, liquid_left) = (phi - gas, (1.0 - phi) - (volume - gas));
    let is_vanishing = (phi < 0.5 && gas_left < PURE) || (phi > 0.5 && liquid_left < PURE);
    if is_vanishing {
        return bounded(advected);
    }
    if volume.abs() < LINEAR_BELOW {
        return bounded(advected + compression.expansion(phi) * volume);
    }
    isentropic_fraction(gas_left, liquid_left, p, mixture)
}

/// Newton's iteration on ln(sum of the volumes) against x = ln((p' + π_g)/(p + π_g)), which is monotone and nearly straight.
fn isentropic_fraction(gas: f64, liquid: f64, p: f64, mixture: &Mixture) -> f64 {
    const STEPS: usize = 30;
    /// The next step would be of the order of its square, which is less than the flux balances keep.
    const LAST_STEP: f64 = 1e-6;
    let (g, l) = (mixture.gas, mixture.liquid);
    let (over_g, over_l) = (1.0 / g.gamma, 1.0 / l.gamma);
    let (base_g, base_l) = ((p + g.pi).max(LOWEST), (p + l.pi).max(LOWEST));
    let softness = base_g / base_l;
    let (mut low, mut high) = (LOWEST_RATIO, HIGHEST_RATIO);
    let (mut x, mut gas_volume, mut liquid_volume) = (0.0, gas, liquid);
    // (p' + π_g)/(p + π_g), and the same of the liquid.
    let (mut gas_ratio, mut liquid_ratio) = (1.0, 1.0);
    for _ in 0..STEPS {
        let sum = gas_volume + liquid_volume;
        let excess = ln_of(sum, sum - 1.0);
        if excess > 0.0 {
            low = x;
        } else {
            high = x;
        }
        let slope =
            -(gas_volume * over_g + liquid_volume * over_l * softness * gas_ratio / liquid_ratio) / sum;
        let step = -excess / slope;
        if step.abs() <= LAST_STEP {
            let shrinks = step * over_g;
            return (gas_volume * (1.0 - shrinks * (1.0 - 0.5 * shrinks))).clamp(0.0, 1.0);
        }
        let next = x + step;
        x = if next > low && next < high { next } else { 0.5 * (low + high) };
        let (ratio, increment) = exp_and_less_one(x);
        let increment = softness * increment;
        (gas_ratio, liquid_ratio) = (ratio, 1.0 + increment);
        gas_volume = gas * exp_and_less_one(-x * over_g).0;
        liquid_volume = liquid * exp_and_less_one(-over_l * ln_of(liquid_ratio, increment)).0;
    }
    (gas_volume / (gas_volume + liquid_volume)).clamp(0.0, 1.0)
}

/// Bounds of ln((p' + π_g)/(p + π_g)): twenty orders of magnitude either way.
const LOWEST_RATIO: f64 = -46.0;
const HIGHEST_RATIO: f64 = 46.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StiffenedGas;

    fn mixture() -> Mixture {
        Mixture::new(StiffenedGas { gamma: 7.15, pi: 3e8 }, StiffenedGas { gamma: 1.4, pi: 0.0 })
    }

    #[test]
    fn the_modulus_is_woods() {
        let (p, phi) = (1e5, 0.3);
        let c = Compression::at(p, phi, &mixture(), true);
        approx::assert_relative_eq!(
            1.0 / c.modulus,
            0.3 / 1.4e5 + 0.7 / (7.15 * (1e5 + 3e8)),
            max_relative = 1e-14
        );
        // φ K/K_g + (1 − φ) K/K_l = 1: both phases together take all of the compression.
        approx::assert_relative_eq!(phi * c.gas + (1.0 - phi) * c.liquid, 1.0, max_relative = 1e-14);
        approx::assert_relative_eq!(c.expansion(phi), phi * (c.gas - 1.0), max_relative = 1e-12);
    }

    #[test]
    fn off_it_is_the_frozen_mixture() {
        let c = Compression::at(1e5, 0.3, &mixture(), false);
        assert_eq!((c.gas, c.liquid, c.expansion(0.3)), (1.0, 1.0, 0.0));
        assert_eq!(c.modulus, mixture().stiffness(1e5, 0.3));
        approx::assert_relative_eq!(c.star_fraction(0.3, 1.7), 0.3, max_relative = 1e-15);
    }

    #[test]
    fn the_linear_rule_is_the_isentropic_one_for_small_changes() {
        let m = mixture();
        for phi in [1e-3, 0.3, 0.9, 0.9999] {
            for p in [2118.0, 1e6, 1e9] {
                let c = Compression::at(p, phi, &m, true);
                // Small also for the gas's share of the cell.
                let (volume, gas) = (1e-4 * phi, 0.3e-4 * phi);
                let linear = relaxed_fraction(phi - gas + phi * volume, phi, p, volume, gas, &c, &m);
                let full = isentropic_fraction(phi - gas, 1.0 - phi - volume + gas, p, &m);
                assert!(
                    (linear - full).abs() < 3e-6 * phi.max(1.0 - phi) + 2e-6,
                    "{phi} {p}: {linear} {full}"
                );
            }
        }
    }

    #[test]
    fn volumes_relax_to_one_pressure() {
        let m = mixture();
        for (phi, p, volume, gas) in [
            (0.4, 2118.0, -0.2, -0.1),
            (0.99, 5e7, 0.3, 0.295),
            (0.05, 1e5, 0.04, -0.1),
            (0.5, 1e10, -0.45, 0.1),
        ] {
            let c = Compression::at(p, phi, &m, true);
            let new = relaxed_fraction(phi - gas + phi * volume, phi, p, volume, gas, &c, &m);
            let (left_g, left_l) = (phi - gas, 1.0 - phi - volume + gas);
            // p' from the gas's isentrope; the liquid's must give the rest of the cell.
            let after = p * (left_g / new).powf(1.4);
            let liquid = left_l * ((p + 3e8) / (after + 3e8)).powf(1.0 / 7.15);
            // The pressure loses digits in the power of γ.
            approx::assert_relative_eq!(new + liquid, 1.0, max_relative = 1e-10);
        }
    }

    #[test]
    fn nothing_leaves_the_unit_interval() {
        let m = mixture();
        for phi in [2e-6, 0.1, 0.5, 1.0 - 2e-6] {
            for volume in [-3.0, -0.5, -1e-4, 0.0, 1e-4, 0.5] {
                for gas in [-1.0, -1e-7, 0.0, 1e-7, 0.05] {
                    let c = Compression::at(1e5, phi, &m, true);
                    let new = relaxed_fraction(phi - gas + phi * volume, phi, 1e5, volume, gas, &c, &m);
                    assert!((-PURE..=1.0 + PURE).contains(&new), "{phi} {volume} {gas}: {new}");
                }
            }
        }
    }

    #[test]
    fn the_star_fraction_follows_the_density_and_stays_below_one() {
        let c = Compression::at(1e5, 0.5, &mixture(), true);
        approx::assert_relative_eq!(c.star_fraction(0.5, 1.0), 0.5, max_relative = 1e-15);
        assert!(c.star_fraction(0.5, 1.5) < 0.26);
        assert_eq!(c.star_fraction(0.5, 5.0), 0.0);
    }
}
