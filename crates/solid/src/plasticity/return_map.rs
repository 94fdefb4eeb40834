//! The radial return of a trial stress onto the yield surface.

use super::closed::{Line, LineReturn};
use super::consistency::Trial;
use super::flow::Flow;
use super::hardening::Hardening;
use super::lanes::{PowerLaw, UNSOLVED};
use super::polyline::Polyline;
use super::screen::Screen;
use super::stress::Stress;
use crate::WaveSpeeds;

/// An isotropic elastoplastic material: a hardening law over linear elasticity.
#[derive(Clone, Debug, PartialEq)]
pub struct Plasticity {
    hardening: Hardening,
    pub(super) screen: Screen,
    /// Of laws in closed form.
    pub(super) line: Option<Line>,
    pub(super) polyline: Option<Polyline>,
    /// Of laws that are solved many cells at once.
    pub(super) power: Option<PowerLaw>,
    mu: f64,
    /// χ/(ρ c_p), K m³/J.
    heating: f64,
    /// T_r, K; 0 for laws without heat.
    reference: f64,
}

/// What a cell's return gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Returned {
    /// The stress at the end of the step, Pa.
    pub stress: Stress,
    /// Its von Mises stress q, Pa.
    pub von_mises: f64,
    /// Plastic strain ε_p at the end of the step.
    pub strain: f64,
    /// Temperature at the end of the step, K; as it came in where the law has no heat.
    pub temperature: f64,
    /// Δε_p ≥ 0.
    pub increment: f64,
    /// Backward Euler's plastic work q Δε_p, J/m³: what heats, and what a balance of energy has to count. The deviator loses
    /// (q_trial² − q²)/(6μ), which is 3/2 μ Δε_p² more; by about as much the elastic trial gained more than was given, as the stresses
    /// on the faces are those of a material that flows.
    pub plastic_work: f64,
}

impl Plasticity {
    /// A hardening law over the elasticity of these wave speeds.
    pub fn new(hardening: Hardening, speeds: WaveSpeeds) -> Self {
        let heating = hardening
            .softening()
            .map_or(0.0, |heat| heat.taylor_quinney / (speeds.density * heat.heat_capacity));
        Self {
            screen: Screen::new(&hardening),
            line: Line::new(&hardening, speeds.shear_modulus()),
            polyline: Polyline::new(&hardening, speeds.shear_modulus()),
            power: PowerLaw::new(&hardening, speeds.shear_modulus(), heating),
            mu: speeds.shear_modulus(),
            heating,
            reference: hardening.reference_temperature().unwrap_or(0.0),
            hardening,
        }
    }

    /// The hardening law.
    pub fn hardening(&self) -> &Hardening {
        &self.hardening
    }

    /// Shear modulus μ, Pa.
    pub fn mu(&self) -> f64 {
        self.mu
    }

    /// Whether its returns need an iteration that a guess shortens.
    pub(crate) fn wants_guess(&self) -> bool {
        self.power.is_some()
    }

    /// Whether it has neither rate nor heat and is straight between points: stresses and plastic strain are all that a return needs.
    pub(crate) fn is_on_lines(&self) -> bool {
        self.line.is_some() || self.polyline.is_some()
    }

    /// Whether the flow stress depends on the plastic strain.
    pub(crate) fn needs_strain(&self) -> bool {
        self.line.is_none_or(|line| !line.is_level())
    }

    /// χ/(ρ c_p), K m³/J.
    pub(super) fn heating(&self) -> f64 {
        self.heating
    }

    /// T_r, K; 0 for laws without heat.
    pub(crate) fn reference(&self) -> f64 {
        self.reference
    }

    /// Whether temperature is a part of the state.
    pub fn has_heat(&self) -> bool {
        self.hardening.softening().is_some()
    }

    /// Radial return: from an elastic trial stress to the stress, plastic strain and temperature at the end of a step.
    ///
    /// Wilkins (1964); Simo & Hughes (1998) sect. 3.3 (return mapping by backward Euler, consistency condition at the
    /// end of the step). Paper: none. Where the trial stress lies outside the yield surface of rate 0,
    ///
    /// q = q_trial − 3μ Δε_p = Y(ε_p + Δε_p, Δε_p/Δt, T + χ q Δε_p/(ρ c_p)),  s = (q/q_trial) s_trial.
    ///
    /// - `trial`: stress after an elastic step, Pa. `strain`: plastic strain ε_p ≥ 0 and `temperature`: T, K (ignored by
    ///   laws without heat), both at the beginning. `dt`: s, not negative. At 0 a law with rate does not flow (no stress
    ///   relaxes in no time), one without returns as in any step.
    /// - returns: `None` where the cell stays elastic, nothing changes then; else the state at the end. Its mean stress
    ///   is the trial's to round-off, q is Y to 1e-12 of the trial's q.
    /// - valid for: stresses below 1e150 Pa, small strains. A law that softens by heat may have several solutions in a
    ///   step that melts; one of them is found. Where m < 1 and T − T_r is but rounding of T, Y is known no better than
    ///   T*^m is.
    /// - errors: none. No finite argument gives NaN. A stress that is NaN stays.
    /// - tested by: bisection of the equations, ordinary differential equations, random states, limits, a spherical cavity.
    #[inline]
    pub fn return_map(&self, trial: Stress, strain: f64, temperature: f64, dt: f64) -> Option<Returned> {
        if let Some(line) = self.line {
            let LineReturn { yields, stress, von_mises, increment } = line.return_map(trial, strain);
            return yields
                .then(|| self.returned(stress, von_mises, strain + increment, temperature, increment));
        }
        if let Some(law) = &self.polyline {
            let von_mises = self.beyond(trial, strain, temperature)?;
            return law.single(von_mises, strain).map(|(increment, left)| {
                let stress = trial.with_deviator_times(left / von_mises);
                self.returned(stress, left, strain + increment, temperature, increment)
            });
        }
        let Some(law) = &self.power else { return self.return_bracketed(trial, strain, temperature, dt) };
        let von_mises = self.beyond(trial, strain, temperature)?;
        let (increment, left) = law.single(von_mises, strain, temperature - self.reference, law.time(dt));
        if increment == UNSOLVED {
            self.flow_back(trial, von_mises, strain, temperature, dt)
        } else {
            (increment > 0.0).then(|| {
                let stress = trial.with_deviator_times(left / von_mises);
                self.returned(stress, left, strain + increment, temperature, increment)
            })
        }
    }

    /// The same by the bracketed solver, for laws without a closed form.
    #[inline]
    pub(super) fn return_bracketed(
        &self,
        trial: Stress,
        strain: f64,
        temperature: f64,
        dt: f64,
    ) -> Option<Returned> {
        let von_mises = self.beyond(trial, strain, temperature)?;
        self.flow_back(trial, von_mises, strain, temperature, dt)
    }

    /// q of a trial stress that may lie outside, Pa.
    #[inline]
    fn beyond(&self, trial: Stress, strain: f64, temperature: f64) -> Option<f64> {
        let squared = trial.von_mises_squared();
        let beyond = if self.has_heat() {
            self.screen.is_beyond_hot(squared, strain, temperature)
        } else {
            self.screen.is_beyond(squared, strain)
        };
        beyond.then(|| squared.sqrt())
    }

    /// The modulus that a wave along z meets while the material flows: C_zzzz of the elastoplastic tangent,
    ///
    /// λ + 2μ − 9 μ² s_zz² / (q² (3μ + H)),  H = dY/dε_p at the end of the step, with what rate and heat do in it.
    ///
    /// Simo & Hughes (1998) eq. (2.2.22). Behind a plane wave, s_zz = ⅔ q, it is that of the plastic wave, K + 4μ/3 · H/(3μ + H).
    /// Paper: none.
    ///
    /// - `p_modulus`: λ + 2μ, Pa. `end`: what [`Plasticity::return_map`] gave over `dt` > 0, s.
    /// - returns: Pa, between K and λ + 2μ; a law that softens counts as perfect, as its waves are no waves.
    /// - errors: none.  tested by: the plane wave's modulus, differences of returns.
    #[must_use]
    pub fn tangent_modulus(&self, p_modulus: f64, end: &Returned, dt: f64) -> f64 {
        let q = end.von_mises;
        if !(q > 0.0 && end.increment > 0.0) {
            return p_modulus;
        }
        let rise = end.temperature - self.reference;
        let flow = self.hardening.flow_at_rise(end.strain, end.increment / dt, rise);
        let mut slope = flow.per_log_strain / end.strain + flow.per_log_rate / end.increment;
        if rise > 0.0 {
            slope += flow.per_log_rise / rise * self.heating * q;
        }
        let ratio = end.stress.deviator_zz() / q;
        p_modulus - 9.0 * (self.mu * ratio).powi(2) / (3.0 * self.mu + slope.max(0.0))
    }

    /// The return of what may lie outside; `von_mises` is the trial's q, Pa.
    pub(super) fn flow_back(
        &self,
        trial: Stress,
        von_mises: f64,
        strain: f64,
        temperature: f64,
        dt: f64,
    ) -> Option<Returned> {
        let rise = temperature - self.reference;
        let static_flow = self.hardening.flow_at_rise(strain, 0.0, rise);
        let strength = static_flow.stress;
        if !(von_mises > strength) {
            return None;
        }
        let (increment, left) = self.iterate(von_mises, strain, rise, dt, static_flow)?;
        let left = left.min(von_mises);
        let stress = trial.with_deviator_times(left / von_mises);
        Some(self.returned(stress, left, strain + increment, temperature, increment))
    }

    /// With works and heat.
    #[inline(always)]
    pub(super) fn returned(
        &self,
        stress: Stress,
        von_mises: f64,
        strain: f64,
        temperature: f64,
        increment: f64,
    ) -> Returned {
        let plastic_work = von_mises * increment;
        Returned {
            stress,
            von_mises,
            strain,
            temperature: temperature + self.heating * plastic_work,
            increment,
            plastic_work,
        }
    }

    /// Δε_p and q of the laws without a closed form.
    fn iterate(
        &self,
        von_mises: f64,
        strain: f64,
        rise: f64,
        dt: f64,
        static_flow: Flow,
    ) -> Option<(f64, f64)> {
        let three_mu = 3.0 * self.mu;
        if static_flow.stress == 0.0 {
            // Molten: all of the deviator becomes plastic strain.
            return Some((von_mises / three_mu, 0.0));
        }
        if dt == 0.0 && self.hardening.rate().is_some() {
            return None;
        }
        // Without a rate's factor the rate does not matter, but 0/0 would.
        let dt = if dt == 0.0 { 1.0 } else { dt };
        let hardening = &self.hardening;
        let heating = self.heating;
        Some(Trial { hardening, von_mises, strain, rise, dt, three_mu, heating, static_flow }.solve())
    }
}
