//! The von Mises yield criterion.

/// The von Mises comparison stress of an axisymmetric stress state.
///
/// `σ_vM = √(½((σ_zz − σ_rr)² + (σ_zz − σ_φφ)² + (σ_rr − σ_φφ)²) + 3σ_zr²)`; von Mises (1913). Paper: eq.
/// (44).
///
/// - `sigma_zz`, `sigma_zr`, `sigma_rr`, `sigma_phiphi`: the stresses, Pa, positive in tension.
/// - returns: σ_vM ≥ 0, Pa; 0 under hydrostatic pressure, exactly.
/// - valid for: any finite stresses below 1e150 Pa.
/// - errors: none.
/// - tested by: table of ten tensors, eigenvalues of the tensor, invariance under pressure.
#[inline]
#[must_use]
pub fn von_mises(sigma_zz: f64, sigma_zr: f64, sigma_rr: f64, sigma_phiphi: f64) -> f64 {
    von_mises_squared(sigma_zz, sigma_zr, sigma_rr, sigma_phiphi).sqrt()
}

/// Its square, Pa².
#[inline(always)]
pub(crate) fn von_mises_squared(sigma_zz: f64, sigma_zr: f64, sigma_rr: f64, sigma_phiphi: f64) -> f64 {
    let (zz_rr, zz_pp, rr_pp) = (sigma_zz - sigma_rr, sigma_zz - sigma_phiphi, sigma_rr - sigma_phiphi);
    0.5 * (zz_rr * zz_rr + zz_pp * zz_pp + rr_pp * rr_pp) + 3.0 * sigma_zr * sigma_zr
}

/// The yield function Φ = σ_vM − Y₀ without hardening.
///
/// von Mises (1913). Paper: eqs. (45) and (46).
///
/// - `von_mises`: comparison stress σ_vM, Pa. `yield_strength`: Y₀, Pa.
/// - returns: Φ, Pa; negative in the elastic range, ≥ 0 where the material yields.
/// - valid for: any finite arguments.
/// - errors: none.
/// - tested by: uniaxial stress at and about the yield strength.
#[inline]
#[must_use]
pub fn yield_function(von_mises: f64, yield_strength: f64) -> f64 {
    von_mises - yield_strength
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    /// sigma_rr, sigma_zz, sigma_phiphi, sigma_zr, von Mises stress; computed independently, 15 digits.
    const MISES: [[f64; 5]; 10] = [
        [100000000.0, 0.0, 0.0, 0.0, 100000000.0],
        [0.0, 0.0, -100000000.0, 0.0, 100000000.0],
        [-1000000000.0, -1000000000.0, -1000000000.0, 0.0, 0.0],
        [200000000.0, -200000000.0, 0.0, 0.0, 346410161.513775],
        [300000000.0, 100000000.0, -200000000.0, 50000000.0, 444409720.865779],
        [1.0, 2.0, 3.0, 4.0, 7.14142842854285],
        [124240000.0, -146865000.0, -274236000.0, -270108000.0, 585770605.794623],
        [-191991000.0, -326345000.0, -360586000.0, -252471000.0, 463733410.737247],
        [-428201000.0, 369205000.0, -364925000.0, 12715000.0, 768042012.282531],
        [34965000.0, -514463000.0, -70584000.0, -8528000.0, 505211166.706556],
    ];

    #[test]
    fn table_of_tensors() {
        for [rr, zz, phiphi, zr, expected] in MISES {
            assert_relative_eq!(von_mises(zz, zr, rr, phiphi), expected, max_relative = 2e-15);
        }
    }

    #[test]
    fn principal_stresses_give_the_same_value() {
        for [rr, zz, phiphi, zr, _] in MISES {
            let tensor = Matrix3::new(zz, zr, 0.0, zr, rr, 0.0, 0.0, 0.0, phiphi);
            let s = tensor.symmetric_eigenvalues();
            let principal = von_mises(s[0], 0.0, s[1], s[2]);
            let size = tensor.abs().max();
            assert!((von_mises(zz, zr, rr, phiphi) - principal).abs() < 1e-14 * size);
        }
    }

    #[test]
    fn yield_begins_at_the_yield_strength() {
        let strength = 250e6;
        assert_eq!(yield_function(von_mises(-strength, 0.0, 0.0, 0.0), strength), 0.0);
        assert!(yield_function(von_mises(-249e6, 0.0, 0.0, 0.0), strength) < 0.0);
        // Pure shear yields at Y/sqrt(3).
        let shear = von_mises(0.0, strength / 3f64.sqrt(), 0.0, 0.0);
        assert_relative_eq!(shear, strength, max_relative = 1e-15);
    }
}
