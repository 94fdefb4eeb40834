//! The return in closed form: flow stresses that are a straight line over plastic strain.

use mesh::Blend;
use multiversion::multiversion;

use super::hardening::Hardening;
use super::stress::Stress;

/// Y = A + H ε_p, Pa, over an elasticity of 3μ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    strength: f64,
    modulus: f64,
    /// 1/(3μ + H).
    compliance: f64,
}

/// What a return on a line gives.
#[derive(Clone, Copy)]
pub(super) struct LineReturn {
    /// Whether the cell yields; nothing else means anything otherwise.
    pub yields: bool,
    pub stress: Stress,
    pub von_mises: f64,
    pub increment: f64,
}

impl Line {
    /// Of a perfect or linear law.
    pub fn new(hardening: &Hardening, mu: f64) -> Option<Self> {
        let (strength, modulus) = match hardening {
            Hardening::Perfect(law) => (law.yield_strength, 0.0),
            Hardening::Linear(law) => (law.yield_strength, law.hardening_modulus),
            Hardening::JohnsonCook(_) | Hardening::Table(_) => return None,
        };
        Some(Self { strength, modulus, compliance: 1.0 / (3.0 * mu + modulus) })
    }

    /// Whether H = 0.
    pub fn is_level(self) -> bool {
        self.modulus == 0.0
    }

    /// Δε_p = (q_trial − Y)/(3μ + H), free of branches.
    #[inline(always)]
    pub fn return_map(self, trial: Stress, strain: f64) -> LineReturn {
        let (squared, bound) = (trial.von_mises_squared(), self.strength + self.modulus * strain);
        let von_mises = squared.sqrt();
        let increment = (von_mises - bound) * self.compliance;
        let line = self.strength + self.modulus * (strain + increment);
        // Rounding must not put a stress that just yields outside of where it was.
        let left = if line < von_mises { line } else { von_mises };
        LineReturn {
            // Both: of two that round apart the squares may be ordered when the roots are equal.
            yields: (squared > bound * bound) & (von_mises > bound),
            stress: trial.with_deviator_times(left / von_mises),
            von_mises: left,
            increment,
        }
    }
}

/// The returns of some cells, rows as in [`super::PlasticRows`]; tells how many flowed.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
pub(super) fn return_batch(
    line: Line,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
    strain: &mut [f64],
    increment: &mut [f64],
    work: &mut [f64],
) -> usize {
    let n = strain.len();
    let (mut count, blend) = (0, Blend::new());
    let (zz, zr, rr, phiphi) = (&mut zz[..n], &mut zr[..n], &mut rr[..n], &mut phiphi[..n]);
    let (increment, work) = (&mut increment[..n], &mut work[..n]);
    for k in 0..n {
        let trial = Stress { zz: zz[k], zr: zr[k], rr: rr[k], phiphi: phiphi[k] };
        let returned = line.return_map(trial, strain[k]);
        let stress = returned.stress.or(blend, returned.yields, trial);
        (zz[k], zr[k], rr[k], phiphi[k]) = (stress.zz, stress.zr, stress.rr, stress.phiphi);
        let select = |new: f64, old: f64| blend.choose(returned.yields, new, old);
        strain[k] = select(strain[k] + returned.increment, strain[k]);
        increment[k] = select(returned.increment, 0.0);
        work[k] = select(returned.von_mises * returned.increment, 0.0);
        count += u64::from(returned.yields);
    }
    count as usize
}

/// Their stresses alone; plastic strains below zero count as none.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn return_stresses(
    line: Line,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
    strain: &[f64],
) {
    let strain = &strain[..zz.len()];
    return_each(line, zz, zr, rr, phiphi, |k| strain[k].max(0.0));
}

/// The same on a level line, where plastic strains have no say.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn return_stresses_to_level(
    line: Line,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
) {
    return_each(Line { modulus: 0.0, ..line }, zz, zr, rr, phiphi, |_| 0.0);
}

#[inline(always)]
fn return_each(
    line: Line,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
    strain: impl Fn(usize) -> f64,
) {
    let (n, blend) = (zz.len(), Blend::new());
    let (zr, rr, phiphi) = (&mut zr[..n], &mut rr[..n], &mut phiphi[..n]);
    for k in 0..n {
        let trial = Stress { zz: zz[k], zr: zr[k], rr: rr[k], phiphi: phiphi[k] };
        let returned = line.return_map(trial, strain(k));
        let stress = returned.stress.or(blend, returned.yields, trial);
        (zz[k], zr[k], rr[k], phiphi[k]) = (stress.zz, stress.zr, stress.rr, stress.phiphi);
    }
}
