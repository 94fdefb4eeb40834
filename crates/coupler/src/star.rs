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

/// Newton steps after which [`exact_star`] returns what it has. A million random traces took 12 at most.
pub const MAX_ITERATIONS: u32 = 40;

/// Below this p + π the liquid has torn; the exponents leave the range of f64. Pa.
const TORN: f64 = 1e-290;

/// A step in ln(p + π) after which the cubic convergence leaves an error below 1e-24 of it.
const LAST_STEP: f64 = 1e-9;

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

/// f(p) and its derivatives by p, times (p + π) and (p + π)².
#[derive(Clone, Copy)]
struct Curve {
    f: f64,
    slope: f64,
    curvature: f64,
}

/// ln((p + π)/(p_f + π)), exact near the trace and near −π.
#[inline]
fn ln_ratio(fluid: &FluidTrace, p: f64, shifted: f64) -> f64 {
    let base = fluid.pressure + fluid.pi;
    let x = (p - fluid.pressure) / base;
    if x > -0.5 { x.ln_1p() } else { (shifted / base).ln() }
}

/// The velocity that the wave into the fluid adds at pressure p: Toro (2009) eq. 4.7 in p + π = `shifted`.
#[inline]
fn curve(fluid: &FluidTrace, p: f64, shifted: f64) -> Curve {
    let (gamma, c) = (fluid.gamma, fluid.sound_speed());
    let base = fluid.pressure + fluid.pi;
    let a = (gamma + 1.0) / (2.0 * gamma);
    let x = (p - fluid.pressure) / base;
    if x > 0.0 {
        let root2 = 1.0 / (1.0 + a * x);
        let scale = c / gamma * root2.sqrt();
        let lever = shifted / base;
        Curve {
            f: scale * x,
            slope: scale * root2 * (1.0 + 0.5 * a * x) * lever,
            curvature: -scale * root2 * root2 * a * (1.0 + 0.25 * a * x) * lever * lever,
        }
    } else {
        let exponent = (gamma - 1.0) / (2.0 * gamma) * ln_ratio(fluid, p, shifted);
        let slope = c / gamma * exponent.exp();
        Curve { f: 2.0 * c / (gamma - 1.0) * exponent.exp_m1(), slope, curvature: -a * slope }
    }
}

/// The velocity f(p) that the wave into the fluid adds at pressure p ≥ −π.
pub(crate) fn wave_velocity(fluid: &FluidTrace, p: f64) -> f64 {
    curve(fluid, p, (p + fluid.pi).max(TORN)).f
}

/// The star state on the exact shock or isentrope of the stiffened gas.
///
/// The zero of G(p) = v_f + f(p) − v_s − (P_s − p)/Z_s; f as Toro (2009) eq. 4.7 in p + π. Paper: conditions
/// (22). G is concave in p and convex in ln(p + π), so Newton steps in the one bound the root from below and
/// in the other from above; the iterate is the Newton step in the power of p + π in which G is linear to
/// second order, kept between them. It starts at the acoustic star and converges cubically.
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
    let g = |curve: &Curve, p: f64| curve.f + (p - solid.pressure) / solid.impedance + dv;

    if g(&curve(fluid, TORN - pi, TORN), TORN - pi) >= 0.0 {
        return torn(fluid, solid);
    }

    let start = acoustic_star(fluid, solid).pressure;
    // Far below the trace the tangent says nothing.
    let mut p = if start + pi > 0.1 * (fluid.pressure + pi) { start } else { fluid.pressure };
    let mut shifted = p + pi;
    let (mut lowest, mut highest) = (TORN, f64::INFINITY);
    let mut iterations = 0;
    loop {
        iterations += 1;
        let at = curve(fluid, p, shifted);
        let slope = at.slope + shifted / solid.impedance;
        let x = g(&at, p) / slope;
        let theta = (1.0 + at.curvature / slope).clamp(1e-6, 1.0);
        lowest = lowest.max(shifted * (1.0 - x) * (1.0 - 1e-12));
        highest = highest.min(shifted * (-x).exp() * (1.0 + 1e-12));
        let power = if theta * x < 1.0 { (-theta * x).ln_1p() / theta } else { f64::NEG_INFINITY };
        let candidate = shifted * power.exp();
        let step = if candidate < lowest {
            // The bound of the torn liquid is none; then down with ln(p + pi), which cannot overshoot.
            if lowest > TORN { (lowest / shifted).ln() } else { -x }
        } else if candidate > highest {
            (highest / shifted).ln()
        } else {
            power
        };
        // Of p and p + pi the smaller is carried, the other one follows.
        let ahead = shifted * step.exp();
        if (ahead - pi).abs() < ahead {
            p += shifted * step.exp_m1();
            shifted = p + pi;
        } else {
            shifted = ahead;
            p = shifted - pi;
        }
        // Cubic: what is left is about step³ (p + pi).
        let left_over = step.abs().powi(3) * shifted;
        let done = step.abs() <= LAST_STEP || left_over <= 0.1 * f64::EPSILON * p.abs().min(shifted);
        if done || iterations >= MAX_ITERATIONS {
            break;
        }
    }

    // The remaining round-off between the two lines is shared by impedance: the stiffer one has the better
    // velocity.
    let at = curve(fluid, p, shifted);
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
    let x = (p - fluid.pressure) / (fluid.pressure + fluid.pi);
    let gamma = fluid.gamma;
    if x > 0.0 {
        fluid.density * ((2.0 * gamma + (gamma + 1.0) * x) / (2.0 * gamma + (gamma - 1.0) * x))
    } else {
        fluid.density * (ln_ratio(fluid, p, p + fluid.pi) / gamma).exp()
    }
}

#[cfg(test)]
mod tests;
