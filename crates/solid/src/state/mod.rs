//! The numbers in a cell.

/// Components of the solid's state, in the order in which fields hold them.
pub(crate) mod component {
    /// Axial velocity v_z.
    pub const V_Z: usize = 0;
    /// Radial velocity v_r.
    pub const V_R: usize = 1;
    /// The normal stresses on z- and r-faces: σ_zz, σ_rr.
    pub const S_NORMAL: [usize; 2] = [2, 4];
    /// Shear stress σ_zr.
    pub const S_ZR: usize = 3;
    /// Hoop stress σ_φφ; out of plane in planar geometry.
    pub const S_PHIPHI: usize = 5;
    /// How many.
    pub const COUNT: usize = 6;
}

/// Velocity and stress at a point, stresses positive in tension.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElasticState {
    /// Axial velocity, m/s.
    pub v_z: f64,
    /// Radial velocity, m/s.
    pub v_r: f64,
    /// σ_zz, Pa.
    pub stress_zz: f64,
    /// σ_zr, Pa.
    pub stress_zr: f64,
    /// σ_rr, Pa.
    pub stress_rr: f64,
    /// σ_φφ, Pa.
    pub stress_phiphi: f64,
}

impl ElasticState {
    /// In the order in which fields hold it: v_z, v_r, σ_zz, σ_zr, σ_rr, σ_φφ.
    pub fn to_array(self) -> [f64; 6] {
        [self.v_z, self.v_r, self.stress_zz, self.stress_zr, self.stress_rr, self.stress_phiphi]
    }

    /// The inverse of [`ElasticState::to_array`].
    pub fn from_array([v_z, v_r, stress_zz, stress_zr, stress_rr, stress_phiphi]: [f64; 6]) -> Self {
        Self { v_z, v_r, stress_zz, stress_zr, stress_rr, stress_phiphi }
    }
}
