//! What a cell holds of both phases.

use super::saturation::Saturation;

/// Gas fractions nearer than this to 0 and 1 are of one phase: the traces that interfaces leave behind change nothing.
pub(crate) const HELD: f64 = 1e-3;

/// Whether a cell holds both phases.
#[inline(always)]
pub(crate) fn holds_both(phi: f64) -> bool {
    (phi > HELD) & (phi < 1.0 - HELD)
}

/// What a cell holds, per volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Holding {
    /// ρ, kg/m³.
    pub density: f64,
    /// m_g, kg/m³, the vapour's included.
    pub gas: f64,
    /// m_v, from 0 to m_g, kg/m³.
    pub vapour: f64,
    /// ρe without reference energies, J/m³.
    pub internal: f64,
    /// φ.
    pub phi: f64,
}

/// What a change of phase makes of a cell: its mass and momentum stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Changed {
    /// The mass that evaporates, per volume, kg/m³; what condenses is negative.
    pub evaporated: f64,
    /// φ after it.
    pub phi: f64,
}

impl Holding {
    /// m_l, kg/m³.
    pub fn liquid(&self) -> f64 {
        self.density - self.gas
    }

    /// The cell after a mass has evaporated: ρe without references gains (q_l − q_v) of it, so that with them it stays.
    pub fn with(&self, changed: Changed, saturation: &Saturation) -> Self {
        let Changed { evaporated, phi } = changed;
        Self {
            density: self.density,
            gas: self.gas + evaporated,
            vapour: self.vapour + evaporated,
            internal: self.internal + saturation.reference_difference() * evaporated,
            phi,
        }
    }

    /// The pressure of both phases, Pa.
    pub fn pressure(&self, saturation: &Saturation) -> f64 {
        let [beta1, beta2] = saturation.mixture.free_betas::<true>(self.phi, self.density, self.gas);
        (self.internal - beta2) / beta1
    }

    /// Temperature of the liquid at a pressure, K.
    pub fn liquid_temperature(&self, pressure: f64, saturation: &Saturation) -> f64 {
        saturation.liquid_temperature(self.liquid(), 1.0 - self.phi, pressure)
    }

    /// Temperature of the gas at a pressure, K.
    pub fn gas_temperature(&self, pressure: f64, saturation: &Saturation) -> f64 {
        let law = saturation.mixture.gas;
        pressure * self.phi / ((law.gamma - 1.0) * saturation.gas_heat.capacity * self.gas)
    }
}
