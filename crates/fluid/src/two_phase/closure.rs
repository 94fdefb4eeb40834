//! What the phases of a mixed cell do under compression: the K term.

use crate::Mixture;

/// Gas fractions within this distance of 0 and 1 count as pure: they are advected and make no closure of their own.
pub(crate) const PURE: f64 = crate::TRACE_GAS;

/// The lowest p + π of the gas that the closure works with, Pa: that of the pressure floor.
pub(crate) const LOWEST: f64 = 1e-4;

/// Whether a cell holds both phases.
#[inline(always)]
pub(crate) fn is_mixed(phi: f64) -> bool {
    (phi > PURE) & (phi < 1.0 - PURE)
}

/// Gas fractions nearer than this to 0 or 1 may count as pure, see [`is_compliant`]; there is no step in them, either.
pub(crate) const THIN: f64 = 1e-4;

/// The relative difference of the moduli below which a thin cell counts as pure: its sound speed is then off by half as much, in the
/// few cells that traces make soft. Half and twice of it: `docs/verification/constants.md`.
const SAME_MODULUS: f64 = 1e-2;

/// Whether a cell holds both phases and gives way under compression as neither of them does, nor the frozen mixture.
///
/// Traces that interfaces leave behind make up more than half of the cells that hold both phases. Where they change the
/// bulk modulus by less than a hundredth, |K_frozen/K − 1| with the K of [`Compression`], the cell is served as a pure one.
/// At lower pressures the same trace of gas makes liquid soft, and then it counts. No branches, for rows of cells. Covolumes, which
/// make both phases stiffer by factors of order one, are left out.
#[inline(always)]
pub(crate) fn is_compliant(p: f64, phi: f64, mixture: &Mixture) -> bool {
    let (k_gas, k_liquid) = moduli(p, mixture);
    let softened = frozen_modulus(p, phi, mixture) * (phi * k_liquid + (1.0 - phi) * k_gas);
    let both = k_gas * k_liquid;
    let is_thin = phi.min(1.0 - phi) < THIN;
    is_mixed(phi) & (!is_thin | !((softened - both).abs() < SAME_MODULUS * both))
}

/// ρc² of the frozen mixture without covolumes.
#[inline(always)]
fn frozen_modulus(p: f64, phi: f64, mixture: &Mixture) -> f64 {
    mixture.bulk_modulus(0.0, p, phi, 0.0)
}

/// K_k = γ_k (p + π_k) of the gas and the liquid in their free volumes, Pa.
#[inline(always)]
fn moduli(p: f64, mixture: &Mixture) -> (f64, f64) {
    let (gas, liquid) = (mixture.gas, mixture.liquid);
    (gas.gamma * (p + gas.pi).max(LOWEST), liquid.gamma * (p + liquid.pi).max(LOWEST))
}

/// A gas fraction bounded to [0, 1], but for the distance from it that counts as pure: prediction on a finer grid may
/// take it there, and to take that back without the energy would change the pressure.
#[inline(always)]
pub(crate) fn bounded(phi: f64) -> f64 {
    phi.clamp(-PURE, 1.0 + PURE)
}

/// Whether a gas fraction is one of [`bounded`]'s bounds.
#[inline(always)]
pub(crate) fn is_bound(phi: f64) -> bool {
    (phi == -PURE) | (phi == 1.0 + PURE)
}

/// ρ_g and ρ_l of a cell or a face, where a closure asks for them: without a covolume they have no say, and are 0.
///
/// - `share`: the gas's part of the mass.
#[inline(always)]
pub(crate) fn phase_densities(rho: f64, share: f64, phi: f64, mixture: &Mixture) -> [f64; 2] {
    if !mixture.has_covolume() {
        return [0.0; 2];
    }
    let within = |volume: f64| if volume > PURE { volume } else { PURE };
    [rho * share / within(phi), rho * (1.0 - share) / within(1.0 - phi)]
}

/// What the phases of a mixture at one pressure do under compression.
///
/// Kapila et al. (2001); the mixture's bulk modulus is Wood's (1930): 1/K = φ/K_g + (1 − φ)/K_l with K_k = γ_k (p + π_k)/(1 − b_k ρ_k).
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
    ///
    /// - `densities`: ρ_g, ρ_l, kg/m³; without a say where there is no covolume.
    #[inline(always)]
    pub fn at(p: f64, phi: f64, densities: [f64; 2], mixture: &Mixture, is_on: bool) -> Self {
        if !is_on {
            let gas = phi * densities[0];
            let rho = gas + (1.0 - phi) * densities[1];
            let share = if rho > 0.0 { gas / rho } else { 0.0 };
            return Self { modulus: mixture.bulk_modulus(rho, p, phi, share), gas: 1.0, liquid: 1.0 };
        }
        let (k_gas, k_liquid) = moduli(p, mixture);
        let [free_g, free_l] = mixture.free_shares(densities);
        let modulus = k_gas * k_liquid / (phi * free_g * k_liquid + (1.0 - phi) * free_l * k_gas);
        Self { modulus, gas: modulus * free_g / k_gas, liquid: modulus * free_l / k_liquid }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_modulus_is_woods() {
        let (p, phi) = (1e5, 0.3);
        let c = Compression::at(p, phi, [0.0; 2], &Mixture::water_and_air(), true);
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
        let c = Compression::at(1e5, 0.3, [1.0, 1e3], &Mixture::water_and_air(), false);
        assert_eq!((c.gas, c.liquid, c.expansion(0.3)), (1.0, 1.0, 0.0));
        assert_eq!(c.modulus, Mixture::water_and_air().bulk_modulus(1e3, 1e5, 0.3, 0.0));
        approx::assert_relative_eq!(c.star_fraction(0.3, 1.7), 0.3, max_relative = 1e-15);
    }

    #[test]
    fn traces_count_where_they_make_a_cell_softer() {
        let m = Mixture::water_and_air();
        // K_l/K_g: the gas of 10⁻⁵ makes water at 10⁵ Pa a hundred and fifty times as soft as its share.
        for (p, phi, is) in [
            (1e5, 1e-5, true),
            (1e5, 1e-7, false),
            (5e7, 1e-5, false),
            (5e7, 0.9e-4, false),
            (5e7, 1.1e-4, true),
            (2118.0, 2e-6, true),
            (2118.0, 1.0 - 2e-6, true),
            (1e9, 1.0 - 2e-6, false),
            (-1e5, 2e-6, true),
            (f64::NAN, 2e-6, true),
        ] {
            assert_eq!(is_compliant(p, phi, &m), is, "{p} {phi}");
            let share =
                m.bulk_modulus(1e3, p, phi, 0.0) / Compression::at(p, phi, [0.0; 2], &m, true).modulus - 1.0;
            assert!(is || !is_mixed(phi) || share.abs() < SAME_MODULUS, "{p} {phi}: {share}");
        }
    }

    #[test]
    fn the_star_fraction_follows_the_density_and_stays_below_one() {
        let c = Compression::at(1e5, 0.5, [0.0; 2], &Mixture::water_and_air(), true);
        approx::assert_relative_eq!(c.star_fraction(0.5, 1.0), 0.5, max_relative = 1e-15);
        assert!(c.star_fraction(0.5, 1.5) < 0.26);
        assert_eq!(c.star_fraction(0.5, 5.0), 0.0);
    }
}
