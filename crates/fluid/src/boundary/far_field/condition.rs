//! The state beyond a face of the far field.

use mesh::Side;

use super::{FarField, SourceHistory};
use crate::Mixture;
use crate::boundary::axis;

/// What the cell within has on a face in the middle of a step: ρ, v_z, v_r, p of liquid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inner(pub [f64; 4]);

/// When a step is made, and what the bubbles have done until then.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment<'a> {
    /// The middle of the step, s.
    pub middle: f64,
    /// Its length, s.
    pub dt: f64,
    pub history: &'a SourceHistory,
}

/// Normal velocity (outwards) and pressure beyond a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outer {
    pub velocity: f64,
    pub pressure: f64,
}

impl FarField {
    /// What lies beyond a face, such that it is the state on it: it meets what leaves on the inner characteristic.
    ///
    /// p + ρc u_n of the inner trace and u_n = Λ p'/(ρc) + (κ/ρ)(J + ½Δt p') + U of the far field, J at the step's beginning,
    /// make p' = (L − cκJ − ρcU)/(1 + Λ + ½cκΔt), with L = p + ρc u_n − p∞ + ½ρ|u|² less what the
    /// incident waves have of it.
    ///
    /// - `face`: its centre (z, r), m; `impulse`: J at the beginning of the step, Pa s.
    /// - valid for liquid: ρ > 0, p + π > 0. errors: none.
    /// - tested by: a spherical wave that leaves, a face at rest.
    pub(crate) fn outer(
        &self,
        side: Side,
        face: [f64; 2],
        inner: Inner,
        mixture: &Mixture,
        moment: Moment<'_>,
        impulse: f64,
    ) -> Outer {
        let Moment { middle, dt, history } = moment;
        let Inner([rho, v_z, v_r, p]) = inner;
        let c = (mixture.bulk_modulus(rho, p, 0.0, 0.0) / rho).sqrt();
        let impedance = rho * c;
        let admittance = self.admittance(face, side, middle, history);
        let incident = self.incident.at(face, middle);
        let [relative_z, relative_r] = [v_z - self.velocity[0], v_r - self.velocity[1]];
        let u_n = outward(side, [relative_z, relative_r]);
        let dynamic = 0.5 * rho * (relative_z * relative_z + relative_r * relative_r);
        let leaving = (p - self.pressure) + dynamic + impedance * u_n;
        let of_waves = incident.pressure + impedance * outward(side, incident.velocity);
        let flow = c * admittance.flow;
        let excess = ((leaving - of_waves) - (flow * impulse + impedance * admittance.correction))
            / (1.0 + admittance.wave + 0.5 * dt * flow);
        let pressure = self.pressure + excess + incident.pressure - dynamic;
        // In differences, so that nothing changes where nothing happens.
        let velocity = outward(side, [v_z, v_r]) + (p - pressure) / impedance;
        Outer { velocity, pressure }
    }

    /// What a step adds to the impulse J on a face, Pa s.
    ///
    /// - `flux`: normal velocity (outwards), tangential velocity and pressure that the flux has on the face; `rho`: density.
    pub(crate) fn gain(
        &self,
        side: Side,
        face: [f64; 2],
        rho: f64,
        [u_n, u_t, p]: [f64; 3],
        moment: Moment<'_>,
    ) -> f64 {
        let relative_n = u_n - outward(side, self.velocity);
        let relative_t = u_t - self.velocity[1 - axis(side)];
        let dynamic = 0.5 * rho * (relative_n * relative_n + relative_t * relative_t);
        moment.dt * ((p - self.pressure) + dynamic - self.incident.at(face, moment.middle).pressure)
    }

    /// The impulse J with which a face begins, such that its state is the initial one, Pa s.
    ///
    /// - `state`: ρ, v_z, v_r, p of the liquid there.
    pub(crate) fn initial_impulse(&self, side: Side, face: [f64; 2], state: Inner, mixture: &Mixture) -> f64 {
        let Inner([rho, v_z, v_r, p]) = state;
        let c = (mixture.bulk_modulus(rho, p, 0.0, 0.0) / rho).sqrt();
        let admittance = self.admittance(face, side, 0.0, &SourceHistory::default());
        if !(admittance.flow > 0.0) {
            return 0.0;
        }
        let incident = self.incident.at(face, 0.0);
        let [relative_z, relative_r] = [v_z - self.velocity[0], v_r - self.velocity[1]];
        let u_n = outward(side, [relative_z, relative_r]) - outward(side, incident.velocity);
        let dynamic = 0.5 * rho * (relative_z * relative_z + relative_r * relative_r);
        let excess = (p - self.pressure) + dynamic - incident.pressure;
        (rho * (u_n - admittance.correction) - admittance.wave * excess / c) / admittance.flow
    }
}

/// The component of a velocity (z, r) along the outward normal of a side.
fn outward(side: Side, [v_z, v_r]: [f64; 2]) -> f64 {
    match side {
        Side::ZMin => -v_z,
        Side::ZMax => v_z,
        Side::RMin => -v_r,
        Side::RMax => v_r,
    }
}
