//! The return by the Johnson–Cook law for many cells at once (SIMD batches), without branches.
//!
//! The equation and the unknown, ln Δε_p, are those of `consistency.rs`, the logarithms and exponentials of a kind that vectorises. A
//! cell that has converged keeps its numbers, so that they do not depend on the company it is solved in. What needs more than
//! such steps (a melting cell, a law so steep that they leave the range) is left to the bracketed solver there.

use mesh::ln_of;
use multiversion::multiversion;

use super::chunk::Chunk;
use super::hardening::Hardening;
use super::powers::{NEAR, TERMS, binomial, exp, ln, lower, series, upper};

/// Cells solved together: enough to hide that one step waits for the one before.
pub(super) const LANES: usize = 32;

/// Steps after which a cell is left to the bracketed solver.
const MOST_STEPS: usize = 8;

/// Relative to the trial stress: residuals below this are rounding.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// A step in ln Δε_p after which cubic convergence leaves nothing: its cube is below rounding.
const LAST_STEP: f64 = 1e-5;

/// Smaller increments than this are left to the bracketed solver, as logarithms want normal numbers.
const SMALLEST: f64 = 1e-280;

/// Constants of the Johnson–Cook law over an elasticity, as the kernel needs them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PowerLaw {
    /// A and B, Pa; n.
    strength: f64,
    hardening: f64,
    exponent: f64,
    /// The binomial coefficients of n and of m, from the first power on.
    binomial: [f64; TERMS],
    softening_binomial: [f64; TERMS],
    /// C; ε̇₀, 1/s.
    rate_coefficient: f64,
    reference_rate: f64,
    /// m, and 1/(T_m − T_r), 1/K, which is 0 without heat.
    softening: f64,
    per_kelvin: f64,
    /// How near temperatures must be, relative to their rise, for a series to lead from one to the other.
    near_in_heat: f64,
    /// χ/(ρ c_p), K m³/J.
    heating: f64,
    three_mu: f64,
}

/// Cells in one order, rows of one length.
pub(super) struct LaneCells<'a> {
    /// q of the trial stresses, Pa.
    pub von_mises: &'a [f64],
    /// ε_p at the beginning.
    pub strain: &'a [f64],
    /// T − T_r at the beginning, K; empty without heat.
    pub rise: &'a [f64],
    /// Before: a guess of Δε_p, no guess where it is not positive. After: Δε_p, 0 where a cell stays elastic, [`UNSOLVED`] where it is
    /// left to the bracketed solver.
    pub increment: &'a mut [f64],
    /// Written: q at the end, Pa, where a cell flows.
    pub left: &'a mut [f64],
}

/// Marks cells that need the bracketed solver.
pub(super) const UNSOLVED: f64 = -1.0;

impl PowerLaw {
    /// Of a Johnson–Cook law. `heating`: χ/(ρ c_p), K m³/J.
    pub fn new(hardening: &Hardening, mu: f64, heating: f64) -> Option<Self> {
        let Hardening::JohnsonCook(law) = hardening else { return None };
        let heat = law.softening.as_ref();
        let softening = heat.map_or(1.0, |heat| heat.softening_exponent);
        Some(Self {
            binomial: binomial(law.hardening_exponent),
            softening_binomial: binomial(softening),
            strength: law.yield_strength,
            hardening: law.hardening_modulus,
            exponent: law.hardening_exponent,
            rate_coefficient: if law.rate.acts() { law.rate.rate_coefficient } else { 0.0 },
            reference_rate: law.rate.reference_rate,
            softening,
            // Beyond, the series has terms that are left out.
            near_in_heat: if softening <= TERMS as f64 { NEAR } else { 0.0 },
            per_kelvin: heat.map_or(0.0, |heat| 1.0 / heat.range()),
            heating,
            three_mu: 3.0 * mu,
        })
    }

    /// B ε_pⁿ, Pa.
    #[inline(always)]
    fn power(&self, strain: f64) -> f64 {
        let power = self.hardening * exp(self.exponent * ln(strain));
        if strain > 0.0 { power } else { 0.0 }
    }

    /// T*ᵐ; 0 up to T_r. `M1`: m is 1.
    #[inline(always)]
    fn lost<const M1: bool>(&self, homologous: f64) -> f64 {
        let lost = if M1 { homologous } else { exp(self.softening * ln(homologous)) };
        if homologous > 0.0 { lost } else { 0.0 }
    }

    /// Whether cells yield, and what they need to be solved; `dt`: s.
    #[inline(always)]
    fn begin<const L: usize, const M1: bool>(&self, chunk: &mut Chunk<L>, dt: f64) {
        for k in 0..L {
            let (q, strain) = (chunk.q[k], chunk.strain[k]);
            let homologous = chunk.rise[k] * self.per_kelvin;
            let (power, lost) = (self.power(strain), self.lost::<M1>(homologous));
            let soft = 1.0 - lost;
            let hardened = self.strength + power;
            let static_stress = hardened * soft;
            let high = q / self.three_mu;
            (chunk.base_strain[k], chunk.power[k]) = (strain, power);
            (chunk.base_rise[k], chunk.lost[k]) = (chunk.rise[k], lost);
            chunk.static_stress[k] = static_stress;
            let molten = homologous >= 1.0;
            // A stress that is no number stays.
            let elastic = !(q > static_stress) | (q.is_nan()) | !(dt > 0.0);
            let done = if molten { 3.0 } else { 0.0 };
            chunk.done[k] = if elastic & !molten { 2.0 } else { done };
            chunk.increment[k] = lower(chunk.increment[k], high);
        }
    }

    /// Guesses where there is none: the flow stress as a constant plus the logarithm of the rate, see `consistency.rs`. Without what
    /// hardens the guess is too large, and from there on Newton's steps do not overshoot.
    #[inline(always)]
    fn guess<const L: usize>(&self, chunk: &mut Chunk<L>, dt: f64) {
        let slowest = self.reference_rate * dt;
        for k in 0..L {
            let (q, static_stress) = (chunk.q[k], chunk.static_stress[k]);
            let alone = (q - static_stress) / self.three_mu;
            let scale = static_stress * self.rate_coefficient / self.three_mu;
            let exponent = ln(slowest / scale) + alone / scale;
            let grown = exp(upper(lower(exponent, 30.0), -700.0));
            let soft = if exponent < 30.0 { ln_of(1.0 + grown, grown) } else { exponent };
            let rough = soft * (1.0 - ln_of(1.0 + soft, soft) / (2.0 + soft));
            let rated = scale * rough * (1.0 + exponent - ln(rough)) / (1.0 + rough);
            let is_rated = (self.rate_coefficient > 0.0) & (alone > slowest) & (rated > 0.0);
            let guess = lower(if is_rated { rated } else { alone }, q / self.three_mu);
            let own = chunk.increment[k];
            chunk.increment[k] = if own > 0.0 { own } else { guess };
        }
    }

    /// Halley's steps in ln Δε_p until all cells are solved or given up.
    #[inline(always)]
    fn solve<const L: usize, const M1: bool>(&self, chunk: &mut Chunk<L>, dt: f64) {
        let log_slowest = (self.reference_rate * dt).ln();
        for k in 0..L {
            let increment = chunk.increment[k];
            let small = !(increment > SMALLEST);
            let open = chunk.done[k] == 0.0;
            chunk.done[k] = if open & small { 3.0 } else { chunk.done[k] };
            chunk.log[k] = ln(upper(increment, SMALLEST));
        }
        for _ in 0..MOST_STEPS {
            // What a cell gets does not depend on the others: they only say what need not be computed.
            let is_far =
                |chunk: &Chunk<L>, k: usize| !chunk.is_near(k) | !(M1 | self.is_near_in_heat(chunk, k));
            if chunk.open(is_far) > 0 {
                self.step::<L, M1, true>(chunk, log_slowest);
            } else {
                self.step::<L, M1, false>(chunk, log_slowest);
            }
            if chunk.open(|chunk, k| !(chunk.step[k].abs() < NEAR)) > 0 {
                self.take::<L, true>(chunk);
            } else {
                self.take::<L, false>(chunk);
            }
            if chunk.open(|_, _| true) == 0 {
                return;
            }
        }
    }

    /// Halley's step of each cell, with the second derivative of the flow stress; Newton's where it would be large. `FAR`: some strains are
    /// not near to those whose powers are known.
    #[inline(always)]
    fn step<const L: usize, const M1: bool, const FAR: bool>(&self, chunk: &mut Chunk<L>, log_slowest: f64) {
        for k in 0..L {
            let (q, x, log) = (chunk.q[k], chunk.increment[k], chunk.log[k]);
            let (strain, elastic) = (chunk.strain[k] + x, self.three_mu * x);
            let line = q - elastic;
            let power = self.power_at::<L, FAR>(chunk, k);
            let share = x / strain;
            let d_power = self.exponent * power * share;
            let dd_power = d_power * (1.0 + (self.exponent - 1.0) * share);
            let hardened = self.strength + power;
            let over = log - log_slowest;
            let (over, d_fast) = if over > 0.0 { (over, self.rate_coefficient) } else { (0.0, 0.0) };
            let fast = 1.0 + self.rate_coefficient * over;
            let (heat, kept) = (self.heating * x, upper(line, 0.0));
            let rise = chunk.rise[k] + heat * kept;
            let homologous = rise * self.per_kelvin;
            let lost = self.lost_at::<L, M1, FAR>(chunk, k, rise);
            let soft = 1.0 - lost;
            let is_warm = homologous > 0.0;
            let per_rise = heat / rise;
            let (a, b) = ((kept - elastic) * per_rise, (kept - 3.0 * elastic) * per_rise);
            let d_soft = -self.softening * lost * a;
            let dd_soft = -self.softening * lost * (b + (self.softening - 1.0) * a * a);
            let (d_soft, dd_soft) = if is_warm { (d_soft, dd_soft) } else { (0.0, 0.0) };

            let stress = hardened * fast * soft;
            let both = d_power * fast + hardened * d_fast;
            let slope = both * soft + hardened * fast * d_soft;
            let curvature = (dd_power * fast + 2.0 * d_power * d_fast) * soft
                + 2.0 * both * d_soft
                + hardened * fast * dd_soft;
            let residual = line - stress;
            let steep = elastic + slope;
            let newton = residual / steep;
            let bend = 0.5 * newton * (elastic + curvature);
            let step = residual / (steep + if bend.abs() < 0.25 * steep { bend } else { 0.0 });

            let is_round = residual.abs() <= ROUND_OFF * q;
            let is_lost = !(step.abs() < 50.0) | (homologous >= 1.0);
            // A step past a kink, of the rate or of the heat, is of slopes that do not hold there.
            let next = x + x * step;
            let next_rise = chunk.rise[k] + self.heating * next * (q - self.three_mu * next);
            let is_smooth =
                ((log > log_slowest) == (log + step > log_slowest)) & (is_warm == (next_rise > 0.0));
            let verdict = if (step.abs() < LAST_STEP) & is_smooth { 1.0 } else { 0.0 };
            let verdict = if is_round { 1.5 } else { verdict };
            let end = stress + step * (slope + 0.5 * step * curvature);
            chunk.verdict[k] = if is_lost { 3.0 } else { verdict };
            chunk.step[k] = if is_round { 0.0 } else { step };
            chunk.next_left[k] = if is_round { stress } else { end };
        }
    }

    /// Whether the power of a cell's temperature can be made of that which is known.
    #[inline(always)]
    fn is_near_in_heat<const L: usize>(&self, chunk: &Chunk<L>, k: usize) -> bool {
        let (x, base) = (chunk.increment[k], chunk.base_rise[k]);
        let rise = chunk.rise[k] + self.heating * x * upper(chunk.q[k] - self.three_mu * x, 0.0);
        (rise - base).abs() < self.near_in_heat * base
    }

    /// B ε_pⁿ with the increment of a cell, Pa: by a series about the last strain where it was made of logarithm and exponential.
    #[inline(always)]
    fn power_at<const L: usize, const FAR: bool>(&self, chunk: &mut Chunk<L>, k: usize) -> f64 {
        let (x, base, base_strain) = (chunk.increment[k], chunk.base[k], chunk.base_strain[k]);
        let ratio = (x - base) / base_strain;
        let series = series(&self.binomial, ratio);
        let near = chunk.power[k] + chunk.power[k] * (ratio * series);
        if !FAR {
            return near;
        }
        let strain = chunk.strain[k] + x;
        let far = self.hardening * exp(self.exponent * ln(strain));
        let is_near = chunk.is_near(k);
        chunk.base[k] = if is_near { base } else { x };
        chunk.base_strain[k] = if is_near { base_strain } else { strain };
        chunk.power[k] = if is_near { chunk.power[k] } else { far };
        if is_near { near } else { far }
    }

    /// T*ᵐ at `rise` = T − T_r, likewise; 0 up to T_r.
    #[inline(always)]
    fn lost_at<const L: usize, const M1: bool, const FAR: bool>(
        &self,
        chunk: &mut Chunk<L>,
        k: usize,
        rise: f64,
    ) -> f64 {
        if M1 {
            return self.lost::<M1>(rise * self.per_kelvin);
        }
        let base = chunk.base_rise[k];
        let ratio = (rise - base) / base;
        let near = chunk.lost[k] + chunk.lost[k] * (ratio * series(&self.softening_binomial, ratio));
        if !FAR {
            return near;
        }
        let far = self.lost::<M1>(rise * self.per_kelvin);
        let is_near = (rise - base).abs() < self.near_in_heat * base;
        chunk.base_rise[k] = if is_near { base } else { rise };
        chunk.lost[k] = if is_near { chunk.lost[k] } else { far };
        if is_near { near } else { far }
    }

    /// Takes the steps. `WIDE`: some are not small.
    #[inline(always)]
    fn take<const L: usize, const WIDE: bool>(&self, chunk: &mut Chunk<L>) {
        for k in 0..L {
            let (q, x, step) = (chunk.q[k], chunk.increment[k], chunk.step[k]);
            let mut series = 1.0 / 5040.0;
            for factorial in [720.0, 120.0, 24.0, 6.0, 2.0, 1.0] {
                series = 1.0 / factorial + step * series;
            }
            let near = x + x * (step * series);
            let next = if WIDE {
                let far = x * exp(upper(lower(step, 50.0), -50.0));
                if step.abs() < NEAR { near } else { far }
            } else {
                near
            };
            let is_open = chunk.done[k] == 0.0;
            let is_lost = !(next > SMALLEST) | !(self.three_mu * next <= q);
            let verdict = if is_lost { 3.0 } else { chunk.verdict[k] };
            let verdict = if verdict == 1.5 { 1.0 } else { verdict };
            chunk.done[k] = if is_open { verdict } else { chunk.done[k] };
            chunk.increment[k] = if is_open { next } else { x };
            chunk.log[k] = if is_open { chunk.log[k] + step } else { chunk.log[k] };
            chunk.left[k] = if is_open { lower(chunk.next_left[k], q) } else { chunk.left[k] };
        }
    }

    /// A chunk of cells, from `first` on; what is beyond the rows' end counts as elastic.
    #[inline(always)]
    fn chunk<const L: usize, const M1: bool>(&self, cells: &mut LaneCells<'_>, first: usize, dt: f64) {
        const { assert!(L > 0) };
        let n = L.min(cells.von_mises.len() - first);
        let mut chunk = Chunk::<L>::ZERO;
        chunk.q[..n].copy_from_slice(&cells.von_mises[first..][..n]);
        chunk.strain[..n].copy_from_slice(&cells.strain[first..][..n]);
        chunk.increment[..n].copy_from_slice(&cells.increment[first..][..n]);
        if !cells.rise.is_empty() {
            chunk.rise[..n].copy_from_slice(&cells.rise[first..][..n]);
        }
        self.begin::<L, M1>(&mut chunk, dt);
        if chunk.open(|chunk, k| !(chunk.increment[k] > 0.0)) > 0 {
            self.guess(&mut chunk, dt);
        }
        if chunk.open(|_, _| true) > 0 {
            self.solve::<L, M1>(&mut chunk, dt);
        }
        for k in 0..L {
            let done = chunk.done[k];
            let solved = if done == 1.0 { chunk.increment[k] } else { UNSOLVED };
            chunk.increment[k] = if done == 2.0 { 0.0 } else { solved };
        }
        cells.increment[first..][..n].copy_from_slice(&chunk.increment[..n]);
        cells.left[first..][..n].copy_from_slice(&chunk.left[..n]);
    }

    /// One cell, bitwise as among others.
    ///
    /// - returns: Δε_p and q at the end as [`LaneCells`] has them.
    pub fn single(&self, von_mises: f64, strain: f64, rise: f64, dt: f64) -> (f64, f64) {
        let (mut increment, mut left) = ([0.0], [0.0]);
        let mut cells = LaneCells {
            von_mises: &[von_mises],
            strain: &[strain],
            rise: &[rise],
            increment: &mut increment,
            left: &mut left,
        };
        if self.softening == 1.0 {
            self.chunk::<1, true>(&mut cells, 0, dt);
        } else {
            self.chunk::<1, false>(&mut cells, 0, dt);
        }
        (increment[0], left[0])
    }

    /// The time that the increments count over, s; 0 where nothing flows in no time.
    pub fn time(&self, dt: f64) -> f64 {
        // Without a rate's factor the rate does not matter, but 0/0 would.
        if dt == 0.0 && self.rate_coefficient == 0.0 { 1.0 } else { dt }
    }
}

/// The increments of rows of cells; see [`PowerLaw::time`] for `dt`.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn return_lanes(law: &PowerLaw, mut cells: LaneCells<'_>, dt: f64) {
    let law = *law;
    for first in (0..cells.von_mises.len()).step_by(LANES) {
        if law.softening == 1.0 {
            law.chunk::<LANES, true>(&mut cells, first, dt);
        } else {
            law.chunk::<LANES, false>(&mut cells, first, dt);
        }
    }
}
