//! The wave curve of a stiffened gas, and the root of sums of such curves.
//!
//! Both Riemann problems stand on it: that between two fluids, and that between the fluid and the solid.
//!
//! In P = p + π a stiffened gas is an ideal one, so its shock and isentrope through (ρ_K, u_K, p_K) are those of
//! Toro (2009) ch. 4. With x = (p − p_K)/P_K, R = P/P_K and c_K² = γP_K/ρ_K the velocity changes by
//!
//! ```text
//! f_K(p) = (c_K/γ) x / √(1 + (γ + 1)/(2γ) x)              shock, x > 0
//! f_K(p) = 2c_K/(γ − 1) (R^((γ − 1)/2γ) − 1)              rarefaction, x ≤ 0
//! ```
//!
//! A star pressure is the zero of a sum G(p) of such curves and of straight lines that rise.
//!
//! The iteration works in P = p + π of the softest curve, which vanishes where that fluid tears. G is concave in P and
//! convex in ln P (each f_K is, as its two derivatives show). So a Newton step in P ends at or below the root and
//! one in ln P at or above it, from wherever they start: two bounds per evaluation. The iterate taken between
//! them is the Newton step in P^θ, with θ in (0, 1] such that G is linear in P^θ to second order. It
//! converges cubically, and in one step for two rarefactions of one gas. Where it leaves the bounds it is set
//! on the bound, from which the Newton steps narrow them again, so convergence is certain.

/// Iterations after which [`curve_root`] returns what it has. Two million random states took 12 at most.
pub const MAX_ITERATIONS: u32 = 40;

/// Below this P the fluid has torn: the exponents leave the range of f64. Pa.
pub const VACUUM_PRESSURE: f64 = 1e-290;

/// A step in ln P after which the cubic convergence leaves an error below 1e-24 of P.
const LAST_STEP: f64 = 1e-9;

/// ln((p₂ + π)/(p₁ + π)) without loss of digits for p₂ near p₁ as well as for p₂ near −π.
///
/// - `shifted_new`: p₂ + π, Pa. `increment`: p₂ − p₁, Pa. `shifted`: p₁ + π, Pa.
/// - returns: the logarithm; −∞ at `shifted_new` = 0.
#[inline]
#[must_use]
pub fn ln_pressure_ratio(shifted_new: f64, increment: f64, shifted: f64) -> f64 {
    let relative = increment / shifted;
    if relative > -0.5 { relative.ln_1p() } else { (shifted_new / shifted).ln() }
}

/// A value and its derivatives by P, times P and P².
#[derive(Clone, Copy, Debug)]
pub struct CurvePoint {
    /// The value: a velocity, m/s.
    pub f: f64,
    /// P df/dP, m/s.
    pub slope: f64,
    /// P² d²f/dP², m/s.
    pub curvature: f64,
}

/// The stiffened gas before the wave, without a covolume.
#[derive(Clone, Copy, Debug)]
pub struct WaveCurve {
    /// Pressure p_K, Pa.
    pub pressure: f64,
    /// Adiabatic exponent γ > 1.
    pub gamma: f64,
    /// Stiffness π ≥ 0, Pa.
    pub pi: f64,
    /// Sound speed c_K, m/s.
    pub sound_speed: f64,
}

impl WaveCurve {
    /// The velocity f_K(p) that the wave adds, as the head of this file has it, with derivatives by P.
    ///
    /// Toro (2009) eqs. 4.6 and 4.7 in p + π.
    ///
    /// - `p`: where, Pa. `shifted`: P = p + π − `offset` there, Pa.
    /// - `offset`: π_K less the π that P counts from, Pa; not negative.
    #[inline]
    #[must_use]
    pub fn at(&self, p: f64, shifted: f64, offset: f64) -> CurvePoint {
        let own = shifted + offset;
        let base = self.pressure + self.pi;
        let (gamma, c) = (self.gamma, self.sound_speed);
        let a = (gamma + 1.0) / (2.0 * gamma);
        let increment = p - self.pressure;
        let x = increment / base;
        if x > 0.0 {
            // Toro (2009) eq. 4.6, scaled; derivatives by x.
            let root2 = 1.0 / (1.0 + a * x);
            let scale = c / gamma * root2.sqrt();
            let lever = shifted / base;
            CurvePoint {
                f: scale * x,
                slope: scale * root2 * (1.0 + 0.5 * a * x) * lever,
                curvature: -scale * root2 * root2 * a * (1.0 + 0.25 * a * x) * lever * lever,
            }
        } else {
            // Toro (2009) eq. 4.6, second line. d/dP of R^m is m R^m/P.
            let exponent = (gamma - 1.0) / (2.0 * gamma) * ln_pressure_ratio(own, increment, base);
            let lever = shifted / own;
            let slope = c / gamma * exponent.exp() * lever;
            CurvePoint {
                f: 2.0 * c / (gamma - 1.0) * exponent.exp_m1(),
                slope,
                curvature: -a * slope * lever,
            }
        }
    }

    /// f_K at P = [`VACUUM_PRESSURE`]: the largest velocity away from the wave that the gas can get, m/s.
    #[inline]
    #[must_use]
    pub fn at_vacuum(&self) -> f64 {
        // From here on R^((γ − 1)/2γ), e⁻⁴⁰ at most, is lost beside 1 in f64.
        const EXPONENT: f64 = 0.06;
        let base = self.pressure + self.pi;
        if base >= 1.0 && self.gamma - 1.0 >= EXPONENT * (2.0 * self.gamma) {
            return -(2.0 * self.sound_speed / (self.gamma - 1.0));
        }
        self.at(VACUUM_PRESSURE - self.pi, VACUUM_PRESSURE, 0.0).f
    }

    /// Density behind the wave by that before it: on the Hugoniot above the gas's own pressure, else on the isentrope.
    ///
    /// Toro (2009) eqs. 4.50 and 4.53 in p + π.
    ///
    /// - `p`: where, Pa. `own`: p + π_K there, Pa.
    /// - returns: ρ*/ρ_K; 1 to the last bit at p = p_K, 0 at p = −π.
    #[inline]
    #[must_use]
    pub fn density_ratio(&self, p: f64, own: f64) -> f64 {
        let (gamma, base) = (self.gamma, self.pressure + self.pi);
        let increment = p - self.pressure;
        let x = increment / base;
        if x > 0.0 {
            (2.0 * gamma + (gamma + 1.0) * x) / (2.0 * gamma + (gamma - 1.0) * x)
        } else {
            (ln_pressure_ratio(own, increment, base) / gamma).exp()
        }
    }
}

/// Where a sum of curves vanishes.
#[derive(Clone, Copy, Debug)]
pub struct CurveRoot {
    /// The pressure p, Pa.
    pub p: f64,
    /// P = p + π in full relative precision, Pa.
    pub shifted: f64,
    /// Evaluations that it took.
    pub iterations: u32,
}

/// The pressure at which a sum of wave curves and rising straight lines vanishes. See the head of this file.
///
/// - `start`: the first guess of p, Pa, above −π. `pi`: what P = p + π counts from, Pa.
/// - `sum`: G at (p, P) with its derivatives by P times P and P²: concave in P, convex in ln P, negative in the vacuum.
/// - returns: the root, to the round-off of the data.
/// - errors: none; after [`MAX_ITERATIONS`] it returns what it has.
#[inline]
pub fn curve_root(start: f64, pi: f64, sum: impl Fn(f64, f64) -> CurvePoint) -> CurveRoot {
    let mut p = start;
    let mut shifted = p + pi;
    let (mut lowest, mut highest) = (VACUUM_PRESSURE, f64::INFINITY);
    let mut iterations = 0;
    loop {
        iterations += 1;
        let at = sum(p, shifted);
        let (step, growth) = newton_power_step(
            at.f / at.slope,
            1.0 + at.curvature / at.slope,
            shifted,
            &mut lowest,
            &mut highest,
        );
        // p and P differ by pi; the smaller of the two is carried, the other one follows.
        let ahead = shifted * growth;
        if (ahead - pi).abs() < ahead {
            p += shifted * step.exp_m1();
            shifted = p + pi;
        } else {
            shifted = ahead;
            p = shifted - pi;
        }
        // Cubic: what is left is about step³ P.
        let left_over = step.abs().powi(3) * shifted;
        let done = step.abs() <= LAST_STEP || left_over <= 0.1 * f64::EPSILON * p.abs().min(shifted);
        if done || iterations >= MAX_ITERATIONS {
            return CurveRoot { p, shifted, iterations };
        }
    }
}

/// One step of the iteration, in ln P.
///
/// The Newton step in P^θ, kept within the bounds that the Newton steps in P and ln P are.
///
/// - `x`: G/(P G'). `theta`: 1 + P G''/G', in (0, 1] but for round-off. `shifted`: P, Pa.
/// - `lowest`, `highest`: bounds of the root so far, Pa; narrowed.
/// - returns: the change of ln P, and what P grows by.
#[inline]
fn newton_power_step(x: f64, theta: f64, shifted: f64, lowest: &mut f64, highest: &mut f64) -> (f64, f64) {
    // A flatter power than this only arises by round-off; it costs digits and gains nothing.
    let theta = theta.clamp(1e-6, 1.0);
    let slack = 1e-12; // round-off of the bounds themselves
    *lowest = lowest.max(shifted * (1.0 - x) * (1.0 - slack));
    *highest = highest.min(shifted * (-x).exp() * (1.0 + slack));
    let power = if theta * x < 1.0 { (-theta * x).ln_1p() / theta } else { f64::NEG_INFINITY };
    let growth = power.exp();
    let candidate = shifted * growth;
    let bounded = if candidate < *lowest {
        // The vacuum is no useful bound; then down with ln P, which cannot overshoot.
        if *lowest > VACUUM_PRESSURE { (*lowest / shifted).ln() } else { -x }
    } else if candidate > *highest {
        (*highest / shifted).ln()
    } else {
        return (power, growth);
    };
    (bounded, bounded.exp())
}
