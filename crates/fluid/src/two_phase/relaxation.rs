//! Pressure relaxation: both phases of a mixed cell come to one pressure at the end of a step.

use super::closure::{Compression, LOWEST, PURE, bounded};
use crate::Mixture;
use mesh::{exp_and_less_one, ln_of};

/// Volume change of a cell per step below which its volumes are relaxed by the linear rule.
const LINEAR_BELOW: f64 = 1e-3;

/// Mixed cells at the end of a step, before their phases have come to one pressure.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advected<const LANES: usize> {
    /// Gas fraction φ and pressure at the beginning of the step, Pa.
    pub phi: [f64; LANES],
    pub p: [f64; LANES],
    /// φ − f + φD, the fraction after pure advection.
    pub fraction: [f64; LANES],
    /// D = Δt Σ A u_f/V.
    pub volume: [f64; LANES],
    /// f = Δt Σ A F_φ/V.
    pub gas: [f64; LANES],
    /// ρ_g and ρ_l at the beginning of the step, kg/m³; zeros where there is no covolume.
    pub densities: [[f64; LANES]; 2],
    /// b_g m_g and b_l m_l at its end.
    pub bound: [[f64; LANES]; 2],
}

impl<const LANES: usize> Advected<LANES> {
    pub const ZERO: Self = {
        let zero = [0.0; LANES];
        let both = [zero; 2];
        Self { phi: zero, p: zero, fraction: zero, volume: zero, gas: zero, densities: both, bound: both }
    };
}

/// The gas fractions of mixed cells at the end of a step.
///
/// Both phases' volumes are flux balances: the cell takes in −f of gas and −(D − f) of liquid, which makes a_g + a_l =
/// 1 − D of a cell of volume 1. They then relax isentropically to one pressure p' and the volume 1:
///
/// a_g ((p + π_g)/(p' + π_g))^(1/γ_g) + a_l ((p + π_l)/(p' + π_l))^(1/γ_l) = 1,
///
/// where of volumes with a covolume only what is free, a_k − b_k m_k, goes with the pressure.
///
/// For small D by the linear rule φ − f + φD + (1 − φ)(1 − K/K_l)D, which keeps uniform flow uniform to round-off.
///
/// - returns: the gas fractions, for any D in [0, 1] but for the distance that counts as pure. What a cell gets does not
///   depend on those beside it.
#[inline(always)]
pub(crate) fn relaxed_fractions<const LANES: usize>(
    cells: &Advected<LANES>,
    mixture: &Mixture,
) -> [f64; LANES] {
    let mut relaxation = Relaxation::<LANES>::none();
    let mut fractions = [0.0; LANES];
    let mut others = 0;
    for k in 0..LANES {
        let (phi, p, volume) = (cells.phi[k], cells.p[k], cells.volume[k]);
        let (gas_left, liquid_left) = (phi - cells.gas[k], (1.0 - phi) - (volume - cells.gas[k]));
        let is_vanishing = ((phi < 0.5) & (gas_left < PURE)) | ((phi > 0.5) & (liquid_left < PURE));
        let is_linear = volume.abs() < LINEAR_BELOW;
        let densities = [cells.densities[0][k], cells.densities[1][k]];
        let expansion = Compression::at(p, phi, densities, mixture, true).expansion(phi) * volume;
        let change = if is_vanishing { 0.0 } else { expansion };
        fractions[k] = bounded(cells.fraction[k] + change);
        let is_done = is_vanishing | is_linear;
        relaxation.gas[k] = if is_done { 0.5 } else { gas_left };
        relaxation.liquid[k] = if is_done { 0.5 } else { liquid_left };
        // Not more than is there: what covolumes take of next to nothing means nothing.
        let bound = |bound: f64, volume: f64| if is_done { 0.0 } else { lesser(bound, MOST_BOUND * volume) };
        relaxation.bound[0][k] = bound(cells.bound[0][k], gas_left);
        relaxation.bound[1][k] = bound(cells.bound[1][k], liquid_left);
        relaxation.p[k] = p;
        relaxation.done[k] = if is_done { 1.0 } else { 0.0 };
        relaxation.fraction[k] = fractions[k];
        others += u32::from(!is_done);
    }
    if others == 0 {
        return fractions;
    }
    relaxation.run(mixture);
    relaxation.fraction
}

/// The gas fraction of one cell whose phases have relaxed isentropically from one pressure to the volume 1.
///
/// - `volumes`: a_g and a_l at the pressure `p`, Pa; `bound`: what of them is bound in covolumes.
pub(crate) fn isentropic_fraction(volumes: [f64; 2], bound: [f64; 2], p: f64, mixture: &Mixture) -> f64 {
    let mut cell = Relaxation {
        gas: [volumes[0]],
        liquid: [volumes[1]],
        bound: bound.map(|bound| [bound]),
        p: [p],
        done: [0.0],
        fraction: [f64::NAN],
    };
    cell.run(mixture);
    cell.fraction[0]
}

/// Both phases of some cells on their way to one pressure.
struct Relaxation<const LANES: usize> {
    /// Volumes a_g and a_l at pressure `p`.
    gas: [f64; LANES],
    liquid: [f64; LANES],
    /// What of them is bound in covolumes.
    bound: [[f64; LANES]; 2],
    p: [f64; LANES],
    /// 1 where the iteration has ended, else 0; the gas fraction there.
    done: [f64; LANES],
    fraction: [f64; LANES],
}

impl<const LANES: usize> Relaxation<LANES> {
    fn none() -> Self {
        let zero = [0.0; LANES];
        Self { gas: zero, liquid: zero, bound: [zero; 2], p: zero, done: zero, fraction: zero }
    }

    /// Newton's iteration on ln(sum of the volumes) against x = ln((p' + π_g)/(p + π_g)), which is monotone and nearly
    /// straight.
    #[inline(always)]
    fn run(&mut self, mixture: &Mixture) {
        const STEPS: usize = 30;
        /// The next step would be of the order of its square, which is less than the flux balances keep.
        const LAST_STEP: f64 = 1e-6;
        let (g, l) = (mixture.gas, mixture.liquid);
        let [bound_g, bound_l] = self.bound;
        let (over_g, over_l) = (1.0 / g.gamma, 1.0 / l.gamma);
        let one = [1.0; LANES];
        let mut softness = one;
        for k in 0..LANES {
            softness[k] = (self.p[k] + g.pi).max(LOWEST) / (self.p[k] + l.pi).max(LOWEST);
        }
        let (mut low, mut high) = ([LOWEST_RATIO; LANES], [HIGHEST_RATIO; LANES]);
        let (mut x, mut gas_volume, mut liquid_volume) = ([0.0; LANES], self.gas, self.liquid);
        // (p' + π_g)/(p + π_g), and the same of the liquid.
        let (mut gas_ratio, mut liquid_ratio) = (one, one);
        let mut next = [0.0; LANES];
        for _ in 0..STEPS {
            let mut ended = 0;
            for k in 0..LANES {
                let sum = gas_volume[k] + liquid_volume[k];
                let excess = ln_of(sum, sum - 1.0);
                let is_low = excess > 0.0;
                low[k] = if is_low { x[k] } else { low[k] };
                high[k] = if is_low { high[k] } else { x[k] };
                let (gas_free, liquid_free) = (gas_volume[k] - bound_g[k], liquid_volume[k] - bound_l[k]);
                let yielding =
                    gas_free * over_g + liquid_free * over_l * softness[k] * gas_ratio[k] / liquid_ratio[k];
                let step = excess * sum / yielding;
                next[k] = x[k] + step;
                let shrinks = step * over_g;
                let converged = step.abs() <= LAST_STEP;
                let relaxed = bound_g[k] + gas_free * (1.0 - shrinks * (1.0 - 0.5 * shrinks));

                let was_done = self.done[k] != 0.0;
                let is_done = was_done | converged;
                self.fraction[k] =
                    if converged & !was_done { relaxed.clamp(0.0, 1.0) } else { self.fraction[k] };
                self.done[k] = if is_done { 1.0 } else { 0.0 };
                ended += u64::from(is_done);
            }
            if ended == LANES as u64 {
                return;
            }
            for k in 0..LANES {
                let is_within = (next[k] > low[k]) & (next[k] < high[k]);
                x[k] = if is_within { next[k] } else { 0.5 * (low[k] + high[k]) };
                let (ratio, increment) = exp_and_less_one(x[k]);
                let increment = softness[k] * increment;
                (gas_ratio[k], liquid_ratio[k]) = (ratio, 1.0 + increment);
                gas_volume[k] = bound_g[k] + (self.gas[k] - bound_g[k]) * exp_and_less_one(-x[k] * over_g).0;
                liquid_volume[k] = bound_l[k]
                    + (self.liquid[k] - bound_l[k])
                        * exp_and_less_one(-over_l * ln_of(liquid_ratio[k], increment)).0;
            }
        }
        for k in 0..LANES {
            if self.done[k] == 0.0 {
                self.fraction[k] = (gas_volume[k] / (gas_volume[k] + liquid_volume[k])).clamp(0.0, 1.0);
            }
        }
    }
}

/// The most of a volume that may be bound in its covolume.
const MOST_BOUND: f64 = 0.999;

#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Bounds of ln((p' + π_g)/(p + π_g)): twenty orders of magnitude either way.
const LOWEST_RATIO: f64 = -46.0;
const HIGHEST_RATIO: f64 = 46.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn relaxed_fraction(phi: f64, p: f64, volume: f64, gas: f64) -> f64 {
        let cell = Advected {
            phi: [phi],
            p: [p],
            fraction: [phi - gas + phi * volume],
            volume: [volume],
            gas: [gas],
            ..Advected::ZERO
        };
        relaxed_fractions(&cell, &Mixture::water_and_air())[0]
    }

    #[test]
    fn the_linear_rule_is_the_isentropic_one_for_small_changes() {
        for phi in [1e-3, 0.3, 0.9, 0.9999] {
            for p in [2118.0, 1e6, 1e9] {
                // Small also for the gas's share of the cell.
                let (volume, gas) = (1e-4 * phi, 0.3e-4 * phi);
                let linear = relaxed_fraction(phi, p, volume, gas);
                let volumes = [phi - gas, 1.0 - phi - volume + gas];
                let full = isentropic_fraction(volumes, [0.0; 2], p, &Mixture::water_and_air());
                assert!(
                    (linear - full).abs() < 3e-6 * phi.max(1.0 - phi) + 2e-6,
                    "{phi} {p}: {linear} {full}"
                );
            }
        }
    }

    #[test]
    fn volumes_relax_to_one_pressure() {
        for (phi, p, volume, gas) in [
            (0.4, 2118.0, -0.2, -0.1),
            (0.99, 5e7, 0.3, 0.295),
            (0.05, 1e5, 0.04, -0.1),
            (0.5, 1e10, -0.45, 0.1),
        ] {
            let new = relaxed_fraction(phi, p, volume, gas);
            let (left_g, left_l) = (phi - gas, 1.0 - phi - volume + gas);
            // p' from the gas's isentrope; the liquid's must give the rest of the cell.
            let after = p * (left_g / new).powf(1.4);
            let liquid = left_l * ((p + 3e8) / (after + 3e8)).powf(1.0 / 7.15);
            // The pressure loses digits in the power of γ.
            approx::assert_relative_eq!(new + liquid, 1.0, max_relative = 1e-10);
        }
    }

    /// The iteration's last step bounds the fraction to [0, 1]; a fraction at a bound would say that this had lost a phase.
    #[test]
    fn no_phase_is_lost_in_a_million_states() {
        let mut random = 1_u64;
        let mut within = |low: f64, high: f64| {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (low.ln() + (high / low).ln() * (random >> 11) as f64 / (1_u64 << 53) as f64).exp()
        };
        for _ in 0..125_000 {
            let mut cells = Relaxation::<8>::none();
            cells.gas = std::array::from_fn(|_| within(PURE, 2.0));
            cells.liquid = std::array::from_fn(|_| within(PURE, 2.0));
            cells.p = std::array::from_fn(|_| within(LOWEST, 1e11));
            cells.fraction = [f64::NAN; 8];
            cells.run(&Mixture::water_and_air());
            let is_kept = |fraction: &f64| *fraction > 0.0 && *fraction < 1.0;
            assert!(cells.fraction.iter().all(is_kept), "{:?} {:?} {:?}", cells.gas, cells.liquid, cells.p);
        }
    }

    #[test]
    fn a_cell_does_not_depend_on_those_beside_it() {
        let cells: Vec<[f64; 4]> = (0..8)
            .map(f64::from)
            .map(|k| [0.05 + 0.11 * k, 10_f64.powf(k), -0.4 + 0.1 * k, 0.03 * k - 0.1])
            .collect();
        let at = |c: usize| std::array::from_fn::<f64, 8, _>(|k| cells[k][c]);
        let [phi, p, volume, gas] = [at(0), at(1), at(2), at(3)];
        let fraction = std::array::from_fn(|k| phi[k] - gas[k] + phi[k] * volume[k]);
        let together = relaxed_fractions(
            &Advected { phi, p, fraction, volume, gas, ..Advected::ZERO },
            &Mixture::water_and_air(),
        );
        for (k, [phi, p, volume, gas]) in cells.into_iter().enumerate() {
            assert_eq!(together[k], relaxed_fraction(phi, p, volume, gas));
        }
    }

    #[test]
    fn nothing_leaves_the_unit_interval() {
        for phi in [2e-6, 0.1, 0.5, 1.0 - 2e-6] {
            for volume in [-3.0, -0.5, -1e-4, 0.0, 1e-4, 0.5] {
                for gas in [-1.0, -1e-7, 0.0, 1e-7, 0.05] {
                    let new = relaxed_fraction(phi, 1e5, volume, gas);
                    assert!((-PURE..=1.0 + PURE).contains(&new), "{phi} {volume} {gas}: {new}");
                }
            }
        }
    }
}
