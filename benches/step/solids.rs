//! Solids that yield, and those that do not.

use std::time::Instant;

use mesh::{Domain, Geometry, Limiter};
use solid::plasticity::{Hardening, JohnsonCook, RateFactor, Table, ThermalSoftening};
use solid::{ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

use super::{CFL, Failure};

/// Samples of each of a pair of solvers.
const PAIRS: usize = 60;
/// Steps in a sample.
const STEPS: usize = 2;

/// How the solid yields.
#[derive(Clone, Copy)]
pub struct Yielding {
    /// As in case files.
    pub law: &'static str,
    /// Whether it is so weak that everything that moves flows, or so strong that nothing does.
    pub flows: bool,
}

impl Yielding {
    fn hardening(self) -> Result<Hardening, Failure> {
        let strength = if self.flows { 1.0 } else { 1e12 };
        Ok(match self.law {
            "perfect" => Hardening::perfect(strength)?,
            "linear" => Hardening::linear(strength, strength)?,
            "table" => Hardening::Table(Table::new(&[[0.0, strength], [0.1, 2.0 * strength]])?),
            _ => {
                let heat = ThermalSoftening::new(1.0, 1700.0, 293.0, 480.0, 0.9)?;
                let law = JohnsonCook::new(strength, strength, 0.3)?;
                Hardening::JohnsonCook(law.with_rate(RateFactor::new(0.02, 1.0)?).with_softening(heat))
            }
        })
    }
}

/// Steel with a smooth axial stress at rest, free above.
pub fn solid_with_a_pulse<const N: usize>(
    cells: usize,
    limiter: Limiter,
    yielding: Option<Yielding>,
) -> Result<SolidSolver<N>, Failure> {
    use solid::Boundary::{Axis, Free, NonReflecting};
    let setup = SolidSetup {
        domain: Domain { geometry: Geometry::Axisymmetric, z: [-0.04, 0.01], r: [0.0, 0.05] },
        coarsest: [cells, cells],
        levels: 0,
        speeds: WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 },
        yield_strength: 250e6,
        plasticity: yielding.map(Yielding::hardening).transpose()?,
        limiter,
        boundaries: [NonReflecting, Free, Axis, NonReflecting],
        adaptation: None,
        stress_scale: 1e6,
        weight: None,
        load: None,
    };
    // What flows dies away within a few steps: such a solid is strained all the while, at 100 1/s.
    let strain_rate = if yielding.is_some_and(|yielding| yielding.flows) { 100.0 } else { 0.0 };
    Ok(SolidSolver::new(setup, |[z, r]| ElasticState {
        v_z: strain_rate * z,
        stress_zz: 1e5 * (-((z + 0.01) * (z + 0.01) + r * r) / 1e-5).exp(),
        ..ElasticState::default()
    })?)
}

/// A solid that yields on so many by so many cells, and how long its step takes against that of an elastic one.
///
/// Both are timed by turns: a machine that others use, too, is then as slow for both.
///
/// - returns: medians; ns per cell and step, and the ratio.
pub fn over_elastic(yielding: Yielding, cells: usize) -> Result<[f64; 2], Failure> {
    let mut own = solid_with_a_pulse::<16>(cells, Limiter::Mc, Some(yielding))?;
    let mut elastic = solid_with_a_pulse::<16>(cells, Limiter::Mc, None)?;
    let mut samples = [[0.0; PAIRS]; 2];
    for sample in 0..PAIRS {
        let [own, elastic] = [time(&mut own)?, time(&mut elastic)?];
        samples[0][sample] = own * 1e9 / (STEPS * cells * cells) as f64;
        samples[1][sample] = own / elastic;
    }
    Ok(samples.map(|mut values| {
        values.sort_by(f64::total_cmp);
        values[PAIRS / 2]
    }))
}

/// Of some steps, s.
fn time(solid: &mut SolidSolver<16>) -> Result<f64, Failure> {
    let mut start = Instant::now();
    for step in 0..=STEPS {
        if step == 1 {
            // The first one has brought the cells into the caches again.
            start = Instant::now();
        }
        let dt = solid.time_step_limit(CFL);
        solid.step(dt)?;
    }
    Ok(start.elapsed().as_secs_f64())
}
