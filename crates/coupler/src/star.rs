//! The Riemann problem between the two media at the plane interface.
//!
//! The solid fills z < 0 and the fluid z > 0, velocities count along +z, and P := −σ_zz in the solid. The
//! wave that runs into the solid and the one that runs into the fluid connect the two traces to one pressure
//! p* and one velocity v*, which both sides take as their state at the wall; see the paper's transition
//! conditions (22).
//!
//! ```text
//! solid:  v = v_s + (P_s − p)/Z_s
//! fluid:  v = v_f + f(p),  f the shock or isentrope through the trace, in the limit (p − p_f)/Z_f
//! ```

use crate::wave_curve::{CurvePoint, CurveRoot, VACUUM_PRESSURE, WaveCurve, curve_root};

/// The fluid's state at the interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluidTrace {
    /// Pressure p, Pa.
    pub pressure: f64,
    /// Velocity along +z, away from the solid, m/s.
    pub velocity: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Adiabatic exponent γ > 1.
    pub gamma: f64,
    /// Stiffness π ≥ 0, Pa.
    pub pi: f64,
}

impl FluidTrace {
    /// Whether it is one of a stiffened gas: finite, density and p + π above zero, γ > 1, π ≥ 0.
    #[inline]
    #[must_use]
    pub fn is_state(&self) -> bool {
        let Self { pressure, velocity, density, gamma, pi } = *self;
        let in_range = density > 0.0 && pressure + pi > 0.0 && gamma > 1.0 && pi >= 0.0;
        // A sum is finite if all its terms are; of finite ones it may be infinite only far beyond any state.
        in_range && (pressure.abs() + velocity.abs() + density + gamma + pi).is_finite()
    }

    /// Sound speed c = √(γ(p + π)/ρ), m/s.
    #[inline]
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        (self.gamma * (self.pressure + self.pi) / self.density).sqrt()
    }

    /// Acoustic impedance ρc, Pa s/m.
    #[inline]
    #[must_use]
    pub fn impedance(&self) -> f64 {
        self.density * self.sound_speed()
    }

    /// The curve of the wave that runs into the fluid.
    #[inline]
    fn wave_curve(&self) -> WaveCurve {
        let Self { pressure, gamma, pi, .. } = *self;
        WaveCurve { pressure, gamma, pi, sound_speed: self.sound_speed() }
    }
}

/// The solid's state at the interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidTrace {
    /// P = −σ_zz, Pa.
    pub pressure: f64,
    /// Velocity along +z, towards the fluid, m/s.
    pub velocity: f64,
    /// Impedance ρ̄c₁ of the dilatational wave, Pa s/m.
    pub impedance: f64,
}

impl SolidTrace {
    /// Whether it is one of an elastic solid: finite, with an impedance above zero.
    #[inline]
    #[must_use]
    pub fn is_state(&self) -> bool {
        let Self { pressure, velocity, impedance } = *self;
        impedance > 0.0 && (pressure.abs() + velocity.abs() + impedance).is_finite()
    }
}

/// What both media have in common at the interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceStar {
    /// p* = −σ_zz*, Pa.
    pub pressure: f64,
    /// v*, along +z, m/s.
    pub velocity: f64,
    /// Newton steps taken; 0 in closed form.
    pub iterations: u32,
    /// The liquid would have to bear more than the tension π: it does not follow the wall. p* is −π, v* the
    /// solid's.
    pub floored: bool,
}

impl InterfaceStar {
    /// Whether pressure, velocity and their product, the power, are numbers.
    #[inline]
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.pressure.is_finite() && self.velocity.is_finite() && (self.pressure * self.velocity).is_finite()
    }
}

/// The star state with the fluid's curve replaced by its tangent.
///
/// Characteristics of linear acoustics: `v* = (Z_s v_s + Z_f v_f + P_s − p_f)/(Z_s + Z_f)` and
/// `p* = (Z_f P_s + Z_s p_f + Z_s Z_f (v_s − v_f))/(Z_s + Z_f)`; Toro (2009) sect. 9.3. Paper: conditions
/// (22).
///
/// - `fluid`, `solid`: traces at the wall, SI.
/// - returns: p* (Pa) and v* (m/s). Traces of equal pressure and velocity come back as they are, bitwise.
/// - valid for: positive density and impedance, p + π > 0.
/// - errors: none. Where p* would be −π or less `floored` is set, p* = −π and v* lies on the solid's line, as in
///   [`exact_star`].
/// - tested by: reflection and transmission coefficients, rest under pressure, both invariants, tearing.
#[inline]
#[must_use]
pub fn acoustic_star(fluid: &FluidTrace, solid: &SolidTrace) -> InterfaceStar {
    let (z_fluid, z_solid) = (fluid.impedance(), solid.impedance);
    // In increments on the fluid's trace, so that equal traces return themselves.
    let (jump_p, jump_v) = (solid.pressure - fluid.pressure, solid.velocity - fluid.velocity);
    let weight = 1.0 / (z_solid + z_fluid);
    let pressure = fluid.pressure + z_fluid * weight * (jump_p + z_solid * jump_v);
    if pressure <= -fluid.pi {
        return torn(fluid, solid);
    }
    let velocity = fluid.velocity + weight * (jump_p + z_solid * jump_v);
    InterfaceStar { pressure, velocity, iterations: 0, floored: false }
}

/// The liquid bears −π at most; the wall goes on by itself.
fn torn(fluid: &FluidTrace, solid: &SolidTrace) -> InterfaceStar {
    let velocity = solid.velocity + (solid.pressure + fluid.pi) / solid.impedance;
    InterfaceStar { pressure: -fluid.pi, velocity, iterations: 0, floored: true }
}

/// The velocity f(p) that the wave into the fluid adds at pressure p ≥ −π.
pub(crate) fn wave_velocity(fluid: &FluidTrace, p: f64) -> f64 {
    fluid.wave_curve().at(p, (p + fluid.pi).max(VACUUM_PRESSURE), 0.0).f
}

/// The star state on the exact shock or isentrope of the stiffened gas.
///
/// The zero of G(p) = v_f + f(p) − v_s − (P_s − p)/Z_s; f as Toro (2009) eq. 4.7 in p + π. Paper: conditions
/// (22). It starts at the acoustic star and converges cubically, see [`crate::curve_root`].
///
/// - `fluid`, `solid`: traces at the wall, SI.
/// - returns: p* (Pa) and v* (m/s). Traces of equal pressure and velocity come back as they are, bitwise.
/// - valid for: positive density and impedance, γ > 1, π ≥ 0, p_f + π > 0 (debug-asserted). P_s may be of any
///   sign.
/// - errors: none. Where the wall recedes faster than the liquid expands (G(−π) ≥ 0) `floored` is set, p* =
///   −π and v* lies on the solid's line, so that the solid's state stays exact; the caller counts it.
/// - exactness: p* to |δp| ≈ ε (|p*| + |p_f| + |P_s| + Z_f |v|).
/// - tested by: liquid impact on steel, residual for other impedances, acoustic limit, rest bitwise, tearing.
#[must_use]
pub fn exact_star(fluid: &FluidTrace, solid: &SolidTrace) -> InterfaceStar {
    let pi = fluid.pi;
    debug_assert!(fluid.density > 0.0 && fluid.gamma > 1.0 && fluid.pressure + pi > 0.0, "{fluid:?}");
    debug_assert!(solid.impedance > 0.0, "{solid:?}");
    let dv = fluid.velocity - solid.velocity;
    let curve = fluid.wave_curve();
    // The solid's line is straight: it adds nothing to the curvature.
    let sum = |p: f64, shifted: f64| {
        let at = curve.at(p, shifted, 0.0);
        let f = at.f + (p - solid.pressure) / solid.impedance + dv;
        CurvePoint { f, slope: at.slope + shifted / solid.impedance, ..at }
    };
    let vacuum = VACUUM_PRESSURE - pi;
    if curve.at_vacuum() + (vacuum - solid.pressure) / solid.impedance + dv >= 0.0 {
        return torn(fluid, solid);
    }

    let start = acoustic_star(fluid, solid).pressure;
    // Far below the trace the tangent says nothing.
    let start = if start + pi > 0.1 * (fluid.pressure + pi) { start } else { fluid.pressure };
    let CurveRoot { p, shifted, iterations } = curve_root(start, pi, sum);

    // The remaining round-off between the two lines is shared by impedance: the stiffer one has the better
    // velocity.
    let at = curve.at(p, shifted, 0.0);
    let of_solid = solid.velocity + (solid.pressure - p) / solid.impedance;
    let of_fluid = fluid.velocity + at.f;
    let weight = shifted / (shifted + at.slope * solid.impedance);
    InterfaceStar {
        pressure: p,
        velocity: of_solid + (of_fluid - of_solid) * weight,
        iterations,
        floored: false,
    }
}

/// Density of the fluid at the wall behind its wave: on the Hugoniot above the trace's pressure, else on the
/// isentrope.
///
/// Toro (2009) eqs. 4.50 and 4.53 in p + π. The moving wall carries the mass flux ρ*v* over the fixed mesh.
///
/// - `fluid`: the trace, SI. `p`: pressure p* at the wall, Pa.
/// - returns: ρ*, kg/m³; the trace's density at its own pressure, bitwise; 0 at p = −π.
/// - valid for: positive density, γ > 1, p_f + π > 0, p ≥ −π; below that NaN.
/// - errors: none.
/// - tested by: liquid impact on steel, shock and isentrope of second-order contact.
#[inline]
#[must_use]
pub fn star_density(fluid: &FluidTrace, p: f64) -> f64 {
    fluid.density * fluid.wave_curve().density_ratio(p, p + fluid.pi)
}

#[cfg(test)]
mod tests;
