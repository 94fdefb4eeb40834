//! The numbers in a cell.

use crate::Mixture;

/// Conserved components in the order in which fields hold them: ρ, ρv_z, ρv_r, ρE, φ, and m_g where phases have
/// densities of their own.
pub(crate) mod conserved {
    /// Density ρ.
    pub const RHO: usize = 0;
    /// Axial momentum ρv_z.
    pub const MOMENTUM_Z: usize = 1;
    /// Total energy per volume ρE.
    pub const ENERGY: usize = 3;
    /// Gas fraction φ (advected, not conserved).
    pub const PHI: usize = 4;
    /// How many all models have.
    pub const COUNT: usize = 5;
    /// Mass of the gas per volume m_g = φρ_g.
    pub const GAS: usize = 5;
}

/// Primitive variables of the one-density model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Primitive {
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Axial velocity v_z, m/s.
    pub v_z: f64,
    /// Radial velocity v_r, m/s.
    pub v_r: f64,
    /// Pressure p, Pa.
    pub pressure: f64,
    /// Gas fraction φ.
    pub phi: f64,
}

impl Primitive {
    /// In the order in which kernels hold them: ρ, v_z, v_r, p, φ.
    pub fn to_array(self) -> [f64; 5] {
        [self.density, self.v_z, self.v_r, self.pressure, self.phi]
    }

    /// The inverse of [`Primitive::to_array`].
    pub fn from_array([density, v_z, v_r, pressure, phi]: [f64; 5]) -> Self {
        Self { density, v_z, v_r, pressure, phi }
    }

    /// (ρ, ρv_z, ρv_r, ρE, φ) with ρE = β₁p + β₂ + ρv²/2, paper eqs. (8), (10).
    #[inline]
    pub fn to_conserved(self, mixture: &Mixture) -> [f64; 5] {
        let kinetic = 0.5 * self.density * (self.v_z * self.v_z + self.v_r * self.v_r);
        let internal = mixture.beta1(self.phi) * self.pressure + mixture.beta2(self.phi);
        [self.density, self.density * self.v_z, self.density * self.v_r, internal + kinetic, self.phi]
    }

    /// The inverse of [`Primitive::to_conserved`]; valid for ρ > 0.
    #[inline]
    pub fn from_conserved(u: [f64; 5], mixture: &Mixture) -> Self {
        Self::from_array(primitive(u, mixture))
    }
}

/// Primitive from conserved variables, for kernels.
#[inline(always)]
pub(crate) fn primitive([rho, mz, mr, energy, phi]: [f64; 5], mixture: &Mixture) -> [f64; 5] {
    let inverse = 1.0 / rho;
    let (v_z, v_r) = (mz * inverse, mr * inverse);
    let internal = energy - 0.5 * (mz * v_z + mr * v_r);
    [rho, v_z, v_r, (internal - mixture.beta2(phi)) / mixture.beta1(phi), phi]
}

/// What a cell holds at t = 0: the mixture, and the gas's part of its mass per volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Contents {
    pub state: Primitive,
    /// m_g, kg/m³.
    pub gas: f64,
}

impl From<Primitive> for Contents {
    /// Of a pure cell; a mixed one is taken to be of one density.
    fn from(state: Primitive) -> Self {
        Self { state, gas: state.phi * state.density }
    }
}
