//! The numbers in a cell.

pub(crate) mod finished;

use crate::Mixture;

/// How many variables all models have.
pub(crate) const COUNT: usize = 5;

/// The variables of a cell or on a face as kernels hold them, in the places that [`conserved`] names.
pub type ConservedCell = [f64; COUNT];

/// The same in the places that [`primitive`] names.
pub type PrimitiveCell = [f64; COUNT];

/// Conserved components in the order in which fields hold them: ρ, ρv_z, ρv_r, ρE, φ, and m_g where phases have
/// densities of their own.
pub(crate) mod conserved {
    /// Density ρ.
    pub const RHO: usize = 0;
    /// Axial momentum ρv_z.
    pub const MOMENTUM_Z: usize = 1;
    /// Radial momentum ρv_r.
    pub const MOMENTUM_R: usize = 2;
    /// Total energy per volume ρE.
    pub const ENERGY: usize = 3;
    /// Gas fraction φ (advected, not conserved).
    pub const PHI: usize = 4;
    /// Mass of the gas per volume m_g = φρ_g.
    pub const GAS: usize = 5;
}

/// Primitive variables in the order in which kernels hold them: ρ, v_z, v_r, p, φ. Density, gas fraction and the gas's mass are in
/// the places of the conserved ones, and momenta become velocities in theirs.
pub(crate) mod primitive {
    pub use super::conserved::{GAS, PHI, RHO};
    /// Axial velocity v_z.
    pub const V_Z: usize = 1;
    /// Radial velocity v_r.
    pub const V_R: usize = 2;
    /// Pressure p.
    pub const PRESSURE: usize = 3;
    /// The velocity along an axis (0: z, 1: r).
    pub const VELOCITY: [usize; 2] = [V_Z, V_R];
    /// Of states on faces: velocity normal to the face.
    pub const V_N: usize = 1;
    /// Of states on faces: velocity along the face.
    pub const V_T: usize = 2;
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
    pub fn to_array(self) -> PrimitiveCell {
        [self.density, self.v_z, self.v_r, self.pressure, self.phi]
    }

    /// The inverse of [`Primitive::to_array`].
    pub fn from_array([density, v_z, v_r, pressure, phi]: PrimitiveCell) -> Self {
        Self { density, v_z, v_r, pressure, phi }
    }

    /// (ρ, ρv_z, ρv_r, ρE, φ) with ρE = β₁p + β₂ + ρv²/2, paper eqs. (8), (10), β₁ and β₂ of the free volumes.
    ///
    /// - `gas`: m_g, kg/m³; without a say where no phase has a covolume.
    #[inline]
    pub fn to_conserved(self, gas: f64, mixture: &Mixture) -> ConservedCell {
        let kinetic = 0.5 * self.density * (self.v_z * self.v_z + self.v_r * self.v_r);
        let [beta1, beta2] = mixture.free_betas::<true>(self.phi, self.density, gas);
        let internal = beta1 * self.pressure + beta2;
        [self.density, self.density * self.v_z, self.density * self.v_r, internal + kinetic, self.phi]
    }

    /// The inverse of [`Primitive::to_conserved`]; valid for ρ > 0.
    #[inline]
    pub fn from_conserved(u: ConservedCell, gas: f64, mixture: &Mixture) -> Self {
        Self::from_array(primitive_of::<true>(u, gas, mixture))
    }
}

/// Primitive from conserved variables, for kernels.
///
/// - `B`: whether there may be a covolume; `gas`: m_g, kg/m³, without a say if not.
#[inline(always)]
pub(crate) fn primitive_of<const B: bool>(
    [rho, mz, mr, energy, phi]: ConservedCell,
    gas: f64,
    mixture: &Mixture,
) -> PrimitiveCell {
    let inverse = 1.0 / rho;
    let (v_z, v_r) = (mz * inverse, mr * inverse);
    let internal = energy - 0.5 * (mz * v_z + mr * v_r);
    let [beta1, beta2] = mixture.free_betas::<B>(phi, rho, gas);
    [rho, v_z, v_r, (internal - beta2) / beta1, phi]
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
