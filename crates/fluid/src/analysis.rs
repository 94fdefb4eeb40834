//! What multiresolution analysis must know of a fluid: which details matter, which predictions are admissible.

use std::ops::Range;

use mesh::{ComponentsOfCell, MOST_COMPONENTS, Multiresolution, Side};

use crate::state::conserved::{ENERGY, GAS, MOMENTUM_R, MOMENTUM_Z, PHI, RHO};
use crate::state::{ConservedCell, primitive_of};
use crate::two_phase::is_mixed;
use crate::{Boundary, Mixture, Primitive};

/// Reference values of the thresholds of adaptation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Pressure, Pa; velocities count with the local impedance ρc as pressures.
    pub pressure: f64,
    /// Density, kg/m³.
    pub density: f64,
}

/// The fluid's part in multiresolution analysis.
#[derive(Clone, Debug)]
pub struct Analysis {
    pub(crate) mixture: Mixture,
    pub(crate) boundaries: [Boundary; 4],
    pub(crate) scales: Scales,
    /// Whether the gas has a mass of its own, [`GAS`].
    pub(crate) has_phases: bool,
    /// The components that the mass carries besides: ρY with mass fractions Y.
    pub(crate) carried: Range<usize>,
    /// The only direction (z, r) in which waves count, if there is one.
    pub(crate) direction: Option<[f64; 2]>,
}

/// A gas fraction may leave [0, 1] by this much in prediction; more is limited. Traces of gas that advection left
/// behind would else switch prediction off.
const PHI_SLACK: f64 = 1e-7;

/// A mass fraction may leave [0, 1] by this much in prediction.
const FRACTION_SLACK: f64 = 1e-12;

/// Relative deviations of ρ and ρE below which no child can be inadmissible.
const HARMLESS: f64 = 1e-2;

impl Multiresolution for Analysis {
    fn parity(&self, side: Side, component: usize) -> Option<f64> {
        let normal_momentum = if matches!(side, Side::ZMin | Side::ZMax) { MOMENTUM_Z } else { MOMENTUM_R };
        let sign = if component == normal_momentum { -1.0 } else { 1.0 };
        self.boundaries[side as usize].is_mirror().then_some(sign)
    }

    fn counts_beside(&self, side: Side) -> bool {
        !matches!(self.boundaries[side as usize], Boundary::NonReflecting | Boundary::FarField)
    }

    fn towards(&self, direction: [f64; 2]) -> Option<Self> {
        Some(Self { direction: Some(direction), ..self.clone() })
    }

    fn share(&self, mean: &[f64], deviations: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        let (rho, energy, phi) = (mean[RHO], mean[ENERGY], mean[PHI]);
        // Of the phases' masses only pure cells' are harmless: all of one, or nothing.
        let is_small = |d: f64, own: f64| d == 0.0 || d.abs() < HARMLESS * own;
        let harmless = |d: &[f64; MOST_COMPONENTS]| {
            d[PHI] == 0.0
                && d[RHO].abs() < HARMLESS * rho
                && d[ENERGY].abs() < HARMLESS * energy
                && self
                    .carried
                    .clone()
                    .all(|c| is_small(d[c], mean[c]) && is_small(d[RHO] - d[c], rho - mean[c]))
                && (!self.has_phases
                    || (is_small(d[GAS], mean[GAS]) && is_small(d[RHO] - d[GAS], rho - mean[GAS])))
        };
        if deviations.iter().all(harmless) {
            return 1.0;
        }
        let mut share: f64 = 1.0;
        for d in deviations {
            if d[RHO] < -0.5 * rho {
                share = share.min(-0.5 * rho / d[RHO]);
            }
            let room = if d[PHI] > 0.0 { 1.0 + PHI_SLACK - phi } else { phi + PHI_SLACK };
            if d[PHI].abs() > room {
                share = share.min(room.max(0.0) / d[PHI].abs());
            }
            // Where phases have masses of their own, those of a pure cell's missing one go with its gas fraction.
            if self.has_phases && is_mixed(phi) {
                for (own, change) in [(mean[GAS], d[GAS]), (rho - mean[GAS], d[RHO] - d[GAS])] {
                    if change < -0.5 * own {
                        share = share.min(0.5 * own.max(0.0) / -change);
                    }
                }
            }
        }
        // Mass fractions stay in [0, 1].
        for d in deviations {
            for c in self.carried.clone() {
                for (own, change) in [(mean[c], d[c]), (rho - mean[c], d[RHO] - d[c])] {
                    if change < -own.max(0.0) - FRACTION_SLACK * rho {
                        share = share.min(own.max(0.0) / -change);
                    }
                }
            }
        }
        let above_floor = |d: &[f64; MOST_COMPONENTS]| {
            let at = |c: usize| mean[c] + share * d[c];
            let gas = if self.has_phases { at(GAS) } else { 0.0 };
            let [_, _, _, p, phi] = primitive_of::<true>(std::array::from_fn(at), gas, &self.mixture);
            let own = self.pressure(mean);
            let floor = self.mixture.pressure_floor(phi);
            p - floor > 0.2 * (own - self.mixture.pressure_floor(mean[PHI])).min(own - floor)
        };
        if deviations.iter().all(above_floor) { share } else { 0.0 }
    }

    /// The largest of |δp|/p_ref, ρc|δv|/p_ref, |δρ|/ρ_ref, |δφ| and the |δY| of what is carried, with the linearised
    /// β₁ δp = δ(ρE) − v·δ(ρv) + ½v² δρ − (β₁'p + β₂') δφ + what covolumes bind of both phases' δm, and ρ δv = δ(ρv) − v δρ.
    ///
    /// Where only waves in the direction n count: ½|δp + ρc n·δv|/p_ref instead of the first two, the Riemann invariant that such
    /// waves change and those against it do not, and |δρ − δp/c²|/ρ_ref, which no wave changes.
    #[inline(always)]
    fn significance(&self, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        let [gas, d_gas] = if self.has_phases { [cell[GAS], detail[GAS]] } else { [0.0; 2] };
        let [rho, m_z, m_r, energy, phi] = leading(cell);
        let [d_rho, d_mz, d_mr, d_energy, d_phi] = leading(detail);
        let mixture = &self.mixture;
        // It is asked for every cell: divisions and roots are most of what it costs, so there are as few as can be.
        let volume = 1.0 / rho;
        let (v_z, v_r) = (m_z * volume, m_r * volume);
        let kinetic = 0.5 * (v_z * v_z + v_r * v_r);
        let [beta1, beta2] = mixture.free_betas::<true>(phi, rho, gas);
        let per_beta1 = 1.0 / beta1;
        let p = (energy - rho * kinetic - beta2) * per_beta1;
        let d_bound = mixture.bound_energy(p, d_rho, d_gas);
        let per_phi = (mixture.beta1(1.0) - mixture.beta1(0.0)) * p + mixture.beta2(1.0) - mixture.beta2(0.0);
        let d_p =
            (d_energy - v_z * d_mz - v_r * d_mr + kinetic * d_rho - per_phi * d_phi + d_bound) * per_beta1;
        let (rho_d_vz, rho_d_vr) = (d_mz - v_z * d_rho, d_mr - v_r * d_rho);
        // ρc² with the β₁ of the free volumes, see `Mixture::bulk_modulus`.
        let modulus = ((1.0 + mixture.beta1(phi)) * p + mixture.beta2(phi)) * per_beta1;
        // (ρc)², and below of velocities |ρc δv|² = c² |ρ δv|²: one root for both.
        let squared_impedance = (rho * modulus).max(0.0);
        let [by_pressure, by_density] = match self.direction {
            None => {
                let squared =
                    (rho_d_vz * rho_d_vz + rho_d_vr * rho_d_vr) * (squared_impedance * volume * volume);
                [d_p.abs().max(squared.sqrt()), d_rho.abs()]
            }
            Some([n_z, n_r]) => {
                let along = (n_z * rho_d_vz + n_r * rho_d_vr) * volume;
                let in_wave = d_p * (rho * rho) / squared_impedance;
                [0.5 * (d_p + squared_impedance.sqrt() * along).abs(), (d_rho - in_wave).abs()]
            }
        };
        let [per_pressure, per_density] = [1.0 / self.scales.pressure, 1.0 / self.scales.density];
        let by_flow = (by_pressure * per_pressure).max(by_density * per_density).max(d_phi.abs());
        // A loop of known length: the one over cells would not become SIMD batches around any other.
        let mut largest = by_flow;
        for c in GAS..MOST_COMPONENTS {
            let counts = if self.carried.contains(&c) { volume } else { 0.0 };
            largest = largest.max((detail[c] - cell[c] * volume * d_rho).abs() * counts);
        }
        largest
    }

    /// That of the gas fraction: the interface between gas and liquid is on the finest level wherever it goes.
    fn significance_everywhere(&self, _: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        detail[PHI].abs()
    }
}

/// The variables that all models have.
#[inline(always)]
fn leading(cell: &[f64]) -> ConservedCell {
    *cell.first_chunk().expect("all models have them")
}

impl Analysis {
    fn pressure(&self, mean: &[f64]) -> f64 {
        let gas = if self.has_phases { mean[GAS] } else { 0.0 };
        Primitive::from_conserved(leading(mean), gas, &self.mixture).pressure
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StiffenedGas;
    use crate::riemann::exact_riemann::tests::Random;
    use crate::state::COUNT;

    fn analysis() -> Analysis {
        Analysis {
            mixture: Mixture::new(
                StiffenedGas { gamma: 7.15, pi: 3e8 },
                StiffenedGas { gamma: 1.4, pi: 0.0 },
            ),
            boundaries: [Boundary::Wall; 4],
            scales: Scales { pressure: 1e7, density: 1000.0 },
            has_phases: false,
            carried: 5..5,
            direction: None,
        }
    }

    /// The size of a change from one cell to another, which have no more than all models do.
    fn size(rule: &Analysis, before: ConservedCell, after: ConservedCell) -> f64 {
        let all = |cell: ConservedCell| std::array::from_fn(|c| cell.get(c).copied().unwrap_or(0.0));
        rule.significance(&all(before), &all(std::array::from_fn(|c| after[c] - before[c])))
    }

    fn conserved(density: f64, velocity: f64, pressure: f64, phi: f64) -> ConservedCell {
        let mixture = analysis().mixture;
        Primitive { density, v_z: velocity, v_r: 0.0, pressure, phi }.to_conserved(0.0, &mixture)
    }

    #[test]
    fn a_small_change_of_pressure_counts_relative_to_its_reference() {
        let (a, b) = (conserved(1000.0, 20.0, 5e7, 0.0), conserved(1000.0, 20.0, 5e7 + 1e4, 0.0));
        approx::assert_relative_eq!(size(&analysis(), a, b), 1e-3, max_relative = 1e-9);
        // A velocity counts as the pressure of the wave that has it.
        let b = conserved(1000.0, 20.01, 5e7, 0.0);
        let impedance = (1000.0 * 7.15 * 3.5e8_f64).sqrt();
        approx::assert_relative_eq!(size(&analysis(), a, b), 0.01 * impedance / 1e7, max_relative = 1e-3);
    }

    #[test]
    fn towards_a_region_only_waves_count_that_run_there() {
        let direction = [0.6, -0.8];
        let directed = analysis().towards(direction).expect("it has directions");
        let before = conserved(1000.0, 20.0, 5e7, 0.0);
        let mixture = analysis().mixture;
        let squared = 7.15 * 3.5e8 / 1000.0;
        // A plane sound wave of 10 kPa that runs at this angle from the direction.
        let size_of = |angle: f64| {
            let (sin, cos) = f64::sin_cos(angle);
            let along = [cos * direction[0] - sin * direction[1], sin * direction[0] + cos * direction[1]];
            let by_velocity = 1e4 / (1000.0 * f64::sqrt(squared));
            let after = Primitive {
                density: 1000.0 + 1e4 / squared,
                v_z: 20.0 + along[0] * by_velocity,
                v_r: along[1] * by_velocity,
                pressure: 5e7 + 1e4,
                phi: 0.0,
            };
            size(&directed, before, after.to_conserved(0.0, &mixture))
        };
        for degrees in [0.0_f64, 60.0, 90.0, 120.0, 180.0, 270.0] {
            let angle = degrees.to_radians();
            approx::assert_abs_diff_eq!(size_of(angle), 1e-3 * 0.5 * (1.0 + angle.cos()), epsilon = 2e-7);
        }
        // A contact is no wave.
        let after = conserved(990.0, 20.0, 5e7, 0.0);
        approx::assert_relative_eq!(size(&directed, before, after), 0.01, max_relative = 1e-6);
    }

    /// [`Analysis::significance`] as its formula has it, quantity by quantity.
    fn plain_significance(rule: &Analysis, cell: &ComponentsOfCell, detail: &ComponentsOfCell) -> f64 {
        let mixture = &rule.mixture;
        let [gas, d_gas] = if rule.has_phases { [cell[GAS], detail[GAS]] } else { [0.0; 2] };
        let [rho, v_z, v_r, p, phi] = primitive_of::<true>(leading(cell), gas, mixture);
        let [d_rho, d_mz, d_mr, d_energy, d_phi] = leading(detail);
        let [beta1, _] = mixture.free_betas::<true>(phi, rho, gas);
        let [per_phi, at_liquid] = [1.0, 0.0].map(|phi| mixture.beta1(phi) * p + mixture.beta2(phi));
        let d_p = (d_energy - v_z * d_mz - v_r * d_mr + 0.5 * (v_z * v_z + v_r * v_r) * d_rho
            - (per_phi - at_liquid) * d_phi
            + mixture.bound_energy(p, d_rho, d_gas))
            / beta1;
        let [d_vz, d_vr] = [(d_mz - v_z * d_rho) / rho, (d_mr - v_r * d_rho) / rho];
        let sound = (mixture.bulk_modulus(rho, p, phi, gas / rho) / rho).sqrt();
        let [by_pressure, by_density] = match rule.direction {
            None => [d_p.abs().max(rho * sound * d_vz.hypot(d_vr)), d_rho.abs()],
            Some([n_z, n_r]) => {
                let along = n_z * d_vz + n_r * d_vr;
                [0.5 * (d_p + rho * sound * along).abs(), (d_rho - d_p / (sound * sound)).abs()]
            }
        };
        let fractions = rule.carried.clone().map(|c| ((detail[c] - cell[c] / rho * d_rho) / rho).abs());
        let [by_pressure, by_density] =
            [by_pressure / rule.scales.pressure, by_density / rule.scales.density];
        fractions.fold(by_pressure.max(by_density).max(d_phi.abs()), f64::max)
    }

    #[test]
    fn few_divisions_make_what_the_formula_does() {
        let mut random = Random(7);
        let [liquid, gas] = [StiffenedGas { gamma: 7.15, pi: 3e8 }, StiffenedGas { gamma: 1.4, pi: 0.0 }];
        let with_covolume =
            |law: StiffenedGas, covolume| crate::NobleAbelStiffenedGas { covolume, ..law.into() };
        let mixtures =
            [Mixture::new(liquid, gas), Mixture::new(with_covolume(liquid, 6e-4), with_covolume(gas, 1e-3))];
        for round in 0..400 {
            let (has_phases, carried) = (round % 2 == 0, [5..5, 5..7, 6..8][round / 2 % 3].clone());
            let rule = Analysis {
                mixture: mixtures[round % 3 % 2],
                has_phases,
                carried: if has_phases { 6..carried.end.max(6) } else { carried },
                direction: [None, Some([0.6, -0.8])][round % 5 % 2],
                ..analysis()
            };
            let phi = random.uniform(0.0, 1.0);
            let gas = phi * random.uniform(1.0, 300.0);
            let density = gas + (1.0 - phi) * random.uniform(500.0, 1000.0);
            let state = Primitive {
                density,
                v_z: random.uniform(-300.0, 300.0),
                v_r: random.uniform(-300.0, 300.0),
                pressure: random.uniform(1e4, 1e8),
                phi,
            };
            let mut cell = [0.0; MOST_COMPONENTS];
            cell[..5].copy_from_slice(&state.to_conserved(gas, &rule.mixture));
            if rule.has_phases {
                cell[GAS] = gas;
            }
            rule.carried.clone().for_each(|c| cell[c] = density * random.uniform(0.0, 1.0));
            let detail = cell.map(|own| random.uniform(-0.1, 0.1) * own);
            let plain = plain_significance(&rule, &cell, &detail);
            assert!(plain > 1e-6, "{plain}");
            approx::assert_relative_eq!(rule.significance(&cell, &detail), plain, max_relative = 1e-9);
        }
    }

    #[test]
    fn children_of_gas_beside_liquid_stay_gas_and_positive() {
        let (gas, liquid) = (conserved(0.0266, 0.0, 2118.0, 1.0), conserved(1000.0, 0.0, 5e7, 0.0));
        let mut deviations = [[0.0; MOST_COMPONENTS]; 4];
        for (child, d) in deviations.iter_mut().enumerate() {
            for c in 0..COUNT {
                d[c] = if child % 2 == 0 { -0.125 } else { 0.125 } * (liquid[c] - gas[c]);
            }
        }
        for mean in [gas, liquid] {
            let share = analysis().share(&mean, &deviations);
            for d in &deviations {
                let child: ConservedCell = std::array::from_fn(|c| mean[c] + share * d[c]);
                let w = Primitive::from_conserved(child, 0.0, &analysis().mixture);
                assert!(w.density > 0.0 && w.pressure > 100.0, "{w:?}");
                assert!((-1e-6..=1.0 + 1e-6).contains(&w.phi), "{w:?}");
            }
        }
    }
}
