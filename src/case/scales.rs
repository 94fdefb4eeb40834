//! Reference values of a case, to which the thresholds of adaptation are relative.

use fluid::{InitialCondition, NobleAbelStiffenedGas, PhaseState};
use solid::{Material, PotentialPulse};

use super::reader::{LARGEST, SMALLEST};
use super::{FluidCase, Inflow, LoadCase};

/// Rayleigh's collapse time of an empty bubble over R √(ρ/Δp), Γ(5/6) Γ(1/2)/(√6 Γ(4/3)) (Rayleigh 1917, Phil. Mag. 34, 94).
pub(super) const RAYLEIGH_FACTOR: f64 = 0.914_681_36;

/// Stress scale of a solid on which nothing acts, Pa.
const QUIET_STRESS: f64 = 1e6;

impl FluidCase {
    /// The speed of sound far away, m/s.
    pub fn ambient_sound(&self) -> f64 {
        let ambient = &self.initial.ambient;
        self.eos(ambient).sound_speed(ambient.density, ambient.pressure)
    }
}

/// The largest difference of pressure in a fluid, Pa: of regions, pulses and inflow to the ambient, and ρc times the
/// differences of velocity; where there is none, the ambient pressure.
///
/// - `eos`: that of the ambient phase.
pub(super) fn pressure(
    initial: &InitialCondition,
    inflow: Option<&Inflow>,
    eos: NobleAbelStiffenedGas,
) -> f64 {
    let ambient = &initial.ambient;
    let impedance = ambient.density * eos.sound_speed(ambient.density, ambient.pressure);
    let regions = initial.regions.iter().flat_map(|region| {
        let [v_z, v_r] = [0, 1].map(|k| region.state.velocity[k] - ambient.velocity[k]);
        [region.state.pressure - ambient.pressure, impedance * v_z.hypot(v_r)]
    });
    let pulses = initial.pulses.iter().map(|pulse| pulse.amplitude);
    let inflow = inflow.into_iter().flat_map(|inflow| &inflow.pressure).map(|row| row[1] - ambient.pressure);
    largest(regions.chain(pulses).chain(inflow)).or_else(|| largest([ambient.pressure])).unwrap_or(1.0)
}

/// The largest difference of density in a fluid, kg/m³; where no region differs, that of a wave of `pressure`.
///
/// - `eos`: that of the ambient phase.
pub(super) fn density(initial: &InitialCondition, pressure: f64, eos: NobleAbelStiffenedGas) -> f64 {
    let ambient: &PhaseState = &initial.ambient;
    let c = eos.sound_speed(ambient.density, ambient.pressure);
    largest(initial.regions.iter().map(|region| region.state.density - ambient.density))
        .or_else(|| largest([pressure / (c * c)]))
        .unwrap_or(1.0)
}

/// What acts on a solid from outside.
#[derive(Clone, Copy, Default)]
pub(super) struct Acting<'a> {
    /// The fluid's pressure scale, Pa.
    pub fluid: Option<f64>,
    pub load: Option<&'a LoadCase>,
}

/// The stress at the centre of u = ∇(Φ exp(−R²/a²)), of which the strains are −2Φ/a² there, Pa.
pub(super) fn pulse_stress(pulse: &PotentialPulse, material: &Material) -> f64 {
    let modulus = material.lambda() + 2.0 * material.mu();
    2.0 * modulus * pulse.amplitude / (pulse.width * pulse.width)
}

/// The largest stress in a solid, Pa: under a fluid the fluid's pressure scale, else that of its load and its pulses.
pub(super) fn stress(acting: Acting<'_>, pulses: &[PotentialPulse], material: &Material) -> f64 {
    let of_pulse = |pulse: &PotentialPulse| pulse_stress(pulse, material);
    let of_load = acting.load.map(LoadCase::largest);
    acting.fluid.or_else(|| largest(pulses.iter().map(of_pulse).chain(of_load))).unwrap_or(QUIET_STRESS)
}

/// The largest magnitude, as far as a case may name it; `None` if all are zero.
fn largest(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let largest = values.into_iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    (largest > 0.0).then_some(largest.clamp(SMALLEST, LARGEST))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::GaussianLoad;
    use fluid::{Phase, Pulse, PulseShape, Region, Shape};

    const WATER: NobleAbelStiffenedGas =
        NobleAbelStiffenedGas { gamma: 7.15, pi: 3e8, covolume: 0.0, heat: None };

    fn at_rest(pressure: f64) -> InitialCondition {
        let ambient = PhaseState { phase: Phase::Liquid, density: 1000.0, pressure, velocity: [0.0; 2] };
        InitialCondition {
            ambient,
            pressure: fluid::InitialPressure::Uniform,
            regions: vec![],
            pulses: vec![],
        }
    }

    #[test]
    fn scales_are_the_largest_differences() {
        let mut initial = at_rest(5e7);
        assert_eq!(pressure(&initial, None, WATER), 5e7);
        assert_eq!(pressure(&at_rest(0.0), None, WATER), 1.0);
        let gas = PhaseState { phase: Phase::Gas, density: 0.0266, pressure: 2118.0, velocity: [0.0; 2] };
        let shape = Shape::Sphere { centre: [0.03, 0.0], radius: 0.01 };
        initial.regions.push(Region { shape, state: gas });
        assert_eq!(pressure(&initial, None, WATER), 5e7 - 2118.0);
        assert_eq!(density(&initial, 5e7, WATER), 1000.0 - 0.0266);
        // Water of the same state, but moving: the pressure with which it hits the water at rest.
        initial.regions[0].state = PhaseState { velocity: [-30.0, 40.0], ..initial.ambient };
        let c2: f64 = 7.15 * 3.5e8 / 1000.0;
        assert!((pressure(&initial, None, WATER) / (1000.0 * c2.sqrt() * 50.0) - 1.0).abs() < 1e-14);
        assert_eq!(density(&initial, 1e6, WATER), 1e6 / (c2.sqrt() * c2.sqrt()));
        let inflow = Inflow { pressure: vec![[0.0, 5e7], [1.0, -2e8]] };
        assert_eq!(pressure(&initial, Some(&inflow), WATER), 2.5e8);
        initial.pulses.push(Pulse {
            shape: PulseShape::Sphere,
            centre: [0.0; 2],
            width: 1.0,
            amplitude: -3e8,
        });
        assert_eq!(pressure(&initial, Some(&inflow), WATER), 3e8);
    }

    #[test]
    fn a_solid_takes_the_fluids_scale_or_its_pulses() {
        let steel = Material::from_speeds(7800.0, 6000.0, 3000.0).expect("a material");
        let pulse = |amplitude| PotentialPulse { centre: [0.0; 2], width: 1e-3, amplitude };
        let nothing = Acting::default();
        assert_eq!(stress(Acting { fluid: Some(5e7), load: None }, &[pulse(1.0)], &steel), 5e7);
        assert_eq!(stress(nothing, &[], &steel), QUIET_STRESS);
        let load = GaussianLoad { amplitude: 2e6, radius: 1e-3, history: vec![[0.0, 0.0], [1e-6, -1.5]] };
        let load = LoadCase::Gaussian(load);
        assert_eq!(stress(Acting { fluid: None, load: Some(&load) }, &[], &steel), 3e6);
        let expected = 2.0 * 7800.0 * 3.6e7 * 3e-9 / 1e-6;
        assert!((stress(nothing, &[pulse(1e-9), pulse(-3e-9)], &steel) / expected - 1.0).abs() < 1e-12);
    }
}
