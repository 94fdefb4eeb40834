//! The plastic increment of laws that need an iteration: one equation, bracketed, solved to round-off.

use super::flow::Flow;
use super::hardening::Hardening;

/// A trial state that lies outside the yield surface.
pub(super) struct Trial<'a> {
    pub hardening: &'a Hardening,
    /// von Mises stress of the trial state, Pa.
    pub von_mises: f64,
    /// Plastic strain at the beginning of the step.
    pub strain: f64,
    /// T − T_r at the beginning of the step, K.
    pub rise: f64,
    /// Time step, s.
    pub dt: f64,
    /// 3μ, Pa.
    pub three_mu: f64,
    /// χ/(ρ c_p), K m³/J.
    pub heating: f64,
    /// The flow stress at rate 0, Pa.
    pub static_flow: Flow,
}

/// Relative to the trial stress: residuals below this are rounding.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// Beyond this, relative to the trial stress, flow stress and return line miss each other: a jump of the flow stress.
const JUMP: f64 = 1e-13;

/// Bisection alone needs 64, and Newton between them halves the residual at least.
const LIMIT: usize = 200;

impl Trial<'_> {
    /// Temperature rise above T_r and its derivative by ln Δε_p, K, with the heat of backward Euler's q Δε_p.
    #[inline]
    fn heated(&self, increment: f64) -> (f64, f64) {
        let left = (self.von_mises - self.three_mu * increment).max(0.0);
        let heat = self.heating * increment;
        (self.rise + heat * left, heat * (left - self.three_mu * increment))
    }

    /// Flow stress at the end of the step and its derivative by ln Δε_p, Pa.
    #[inline]
    fn flow(&self, increment: f64) -> (f64, f64) {
        let strain = self.strain + increment;
        let (rise, d_rise) = self.heated(increment);
        let flow = self.hardening.flow_at_rise(strain, increment / self.dt, rise);
        let by_heat = if rise > 0.0 { flow.per_log_rise * (d_rise / rise) } else { 0.0 };
        (flow.stress, flow.per_log_strain * (increment / strain) + flow.per_log_rate + by_heat)
    }

    /// Δε_p > 0 and the von Mises stress q at the end of the step, with q = Y(ε_p + Δε_p, Δε_p/Δt, T + χ q Δε_p/(ρ c_p))
    /// and q = q_trial − 3μ Δε_p.
    ///
    /// Newton's method in ln Δε_p, in which laws of powers and of logarithms are nearly straight; where it leaves the
    /// bracket or is slow, bisection in ln Δε_p, by the bits of the number, which needs at most 64 steps from any
    /// bracket. Where the law is so steep that no number lies between too soft and too hard (n near 0), the stress is
    /// that of the return line, inside the surface.
    pub fn solve(&self) -> (f64, f64) {
        let q = self.von_mises;
        let (mut low, mut high) = (0.0, q / self.three_mu);
        let mut increment = self.guess().max(f64::MIN_POSITIVE).min(high);
        let mut last = f64::INFINITY;
        for count in 0..LIMIT {
            let (stress, slope) = self.flow(increment);
            let line = q - self.three_mu * increment;
            let residual = line - stress;
            if residual.abs() <= ROUND_OFF * q {
                return (increment, stress);
            }
            if residual > 0.0 {
                low = increment;
            } else {
                high = increment;
            }
            let step = residual / (self.three_mu * increment + slope);
            let newton = increment * step.exp();
            let halved = residual.abs() <= 0.5 * last;
            last = residual.abs();
            if step.abs() < 0.5 * f64::EPSILON {
                return (increment, self.settle(stress, line));
            }
            if middle(low, high) == low {
                break;
            }
            let inside = newton > low && newton < high;
            increment = if inside && (halved || count < 3) { newton } else { middle(low, high) };
        }
        let (stress, _) = self.flow(high);
        (high, self.settle(stress, q - self.three_mu * high))
    }

    /// The increment if the flow stress were a straight line over it plus the logarithm of the rate:
    /// x + a ln(x/x₀) = X for x above x₀, which a rate of ε̇₀ gives, so x = a W(x₀/a e^{X/a}) with Lambert's function.
    fn guess(&self) -> f64 {
        let Flow { stress, per_log_strain, per_log_rise, .. } = self.static_flow;
        let mut slope = self.three_mu;
        if self.strain > 0.0 {
            slope += per_log_strain / self.strain;
        }
        if self.rise > 0.0 {
            slope += per_log_rise / self.rise * self.heating * stress;
        }
        let slope = slope.max(0.5 * self.three_mu);
        let alone = (self.von_mises - stress) / slope;
        let Some(rate) = self.hardening.rate() else { return alone };
        let slowest = rate.reference_rate * self.dt;
        if !(alone > slowest) {
            return alone;
        }
        let scale = stress * rate.rate_coefficient / slope;
        let exponent = (slowest / scale).ln() + alone / scale;
        // Winitzki's W(z), good to 2 %, then a step of Newton's for w + ln w = ln z.
        let soft = if exponent < 30.0 { exponent.exp().ln_1p() } else { exponent };
        let rough = soft * (1.0 - soft.ln_1p() / (2.0 + soft));
        scale * rough * (1.0 + exponent - rough.ln()) / (1.0 + rough)
    }

    /// The stress at the end: on the yield surface, unless that jumps past the return line.
    fn settle(&self, stress: f64, line: f64) -> f64 {
        if stress - line <= JUMP * self.von_mises { stress } else { line.max(0.0) }
    }
}

/// The number half way between two that are not negative, as their bits count: their geometric mean, nearly.
fn middle(low: f64, high: f64) -> f64 {
    let (low, high) = (low.to_bits(), high.to_bits());
    f64::from_bits(low + (high - low) / 2)
}
