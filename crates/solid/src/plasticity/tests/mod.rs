//! Tests of the room as a whole.

mod cavity;
mod limits;
mod random;
mod rows;
mod tangent;
mod uniaxial;

use super::{Hardening, JohnsonCook, Plasticity, RateFactor, Stress, Table, ThermalSoftening};
use crate::WaveSpeeds;

/// The aluminium and the steel of the reference solutions.
pub(super) const ALUMINIUM: WaveSpeeds = WaveSpeeds { density: 2700.0, c1: 6320.0, c2: 3130.0 };
pub(super) const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };

/// 6061-T6, with the softening exponent `m`.
pub(super) fn aluminium(m: f64) -> JohnsonCook {
    JohnsonCook::new(324e6, 114e6, 0.42)
        .expect("a law")
        .with_rate(RateFactor::new(0.002, 1.0).expect("a rate's factor"))
        .with_softening(ThermalSoftening::new(m, 925.0, 293.0, 896.0, 0.9).expect("softening"))
}

/// OFHC copper.
pub(super) fn copper() -> JohnsonCook {
    JohnsonCook::new(90e6, 292e6, 0.31)
        .expect("a law")
        .with_rate(RateFactor::new(0.025, 1.0).expect("a rate's factor"))
        .with_softening(ThermalSoftening::new(1.09, 1356.0, 298.0, 383.0, 0.9).expect("softening"))
}

/// One law of each kind, Johnson–Cook in its varieties, tables with and without rate.
pub(super) fn laws() -> Vec<Hardening> {
    let table = Table::new(&[[0.0, 2e8], [0.01, 2.5e8], [0.1, 4e8], [0.5, 4e8]]).expect("a table");
    vec![
        Hardening::perfect(2.5e8).expect("a law"),
        Hardening::linear(2.5e8, 3e9).expect("a law"),
        Hardening::JohnsonCook(copper()),
        Hardening::JohnsonCook(aluminium(1.34)),
        Hardening::JohnsonCook(aluminium(0.517)),
        Hardening::JohnsonCook(JohnsonCook::new(5e8, 8.3e8, 0.51).expect("a law")),
        Hardening::JohnsonCook(
            JohnsonCook::new(1e8, 2e8, 1e-3)
                .expect("a law")
                .with_rate(RateFactor::new(0.5, 1e-4).expect("a rate's factor")),
        ),
        Hardening::Table(table.clone()),
        Hardening::Table(table.with_rate(RateFactor::new(0.02, 1.0).expect("a rate's factor"))),
        Hardening::Table(Table::new(&[[0.2, 3e8]]).expect("a table")),
    ]
}

/// Each law, and its return in steel.
pub(super) fn in_steel() -> impl Iterator<Item = (Hardening, Plasticity)> {
    laws().into_iter().map(|law| (law.clone(), Plasticity::new(law, STEEL)))
}

/// A linear congruential generator (Knuth's constants).
pub(super) struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform within 0 and 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in the exponent between two powers of ten.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.unit())
    }

    /// The same with either sign.
    pub fn signed(&mut self, low: f64, high: f64) -> f64 {
        let sign = if self.unit() < 0.5 { -1.0 } else { 1.0 };
        sign * self.power(low, high)
    }

    /// A stress: components of 1e3 to 1e10 Pa upon a pressure of either sign.
    pub fn stress(&mut self) -> Stress {
        let mean = self.signed(5.0, 9.5);
        let size = self.power(3.0, 10.0);
        let mut part = || size * (2.0 * self.unit() - 1.0);
        let (zz, zr, rr, phiphi) = (part(), part(), part(), part());
        Stress { zz: mean + zz, zr, rr: mean + rr, phiphi: mean + phiphi }
    }
}
