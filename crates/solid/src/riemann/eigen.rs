//! The characteristic structure of linear elasticity in two directions, as matrices.
//!
//! The specification of the waves: kernels use the closed form in `riemann.rs`, which is tested against this.

use crate::riemann::WaveSpeeds;
use nalgebra::{SMatrix, SVector};

/// Six by six.
pub type Matrix6 = SMatrix<f64, 6, 6>;

/// (v_z, v_r, σ_zz, σ_zr, σ_rr, σ_φφ), m/s and Pa.
pub type Vector6 = SVector<f64, 6>;

/// The axis across a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the axis of symmetry.
    Z,
    /// Away from it.
    R,
}

/// The matrix of one direction and its eigenvectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigensystem {
    /// A in ∂t U + A ∂n U = 0.
    pub matrix: Matrix6,
    /// Eigenvalues −c₁, −c₂, 0, 0, c₂, c₁, m/s.
    pub values: Vector6,
    /// Right eigenvectors as columns, in the order of `values`.
    pub right: Matrix6,
    /// Left eigenvectors as rows, the inverse of `right`.
    pub left: Matrix6,
}

impl Eigensystem {
    /// Matrix, eigenvalues and eigenvectors of the plane part of the elastic system in one direction.
    ///
    /// With n across and t along the face, m for the third: ρ̄∂t v_n = ∂n σ_nn, ρ̄∂t v_t = ∂n σ_nt,
    /// ∂t σ_nn = ρ̄c₁² ∂n v_n, ∂t σ_nt = ρ̄c₂² ∂n v_t, ∂t σ_tt = ∂t σ_mm = αρ̄c₁² ∂n v_n. A wave of speed λ =
    /// ∓c₁ has (v_n, σ_nn, σ_tt, σ_mm) = (1, ±Z₁, ±αZ₁, ±αZ₁), one of speed ∓c₂ has (v_t, σ_nt) = (1, ±Z₂);
    /// σ_tt and σ_mm alone stand still. LeVeque (2002) sect. 22.5. Paper: eqs. (19) and (20) in unscaled
    /// stresses.
    ///
    /// - `speeds`: the material. `direction`: z or r.
    /// - returns: the system, in the order of components of [`Vector6`]. Velocities and stresses differ by
    ///   the impedance, so the condition number of `right` is of that order.
    /// - valid for: positive density and 0 < c₂ < c₁.
    /// - errors: none.
    /// - tested by: A R = R Λ, L R = I, inverse and determinant, the flux differentiated by hand.
    #[must_use]
    pub fn new(speeds: WaveSpeeds, direction: Direction) -> Self {
        // Components: velocity and stress across, velocity and stress along, the other normal stress in the
        // plane.
        let [v_n, s_nn, v_t, s_nt, s_tt] = match direction {
            Direction::Z => [0, 2, 1, 3, 4],
            Direction::R => [1, 4, 0, 3, 2],
        };
        let s_mm = 5;
        let alpha = speeds.alpha();
        let (z1, z2) = (speeds.z1(), speeds.z2());

        let mut matrix = Matrix6::zeros();
        matrix[(v_n, s_nn)] = -1.0 / speeds.density;
        matrix[(v_t, s_nt)] = -1.0 / speeds.density;
        matrix[(s_nn, v_n)] = -speeds.p_modulus();
        matrix[(s_nt, v_t)] = -speeds.shear_modulus();
        matrix[(s_tt, v_n)] = -alpha * speeds.p_modulus();
        matrix[(s_mm, v_n)] = -alpha * speeds.p_modulus();

        let values = Vector6::new(-speeds.c1, -speeds.c2, 0.0, 0.0, speeds.c2, speeds.c1);
        let (mut right, mut left) = (Matrix6::zeros(), Matrix6::zeros());
        for (column, sign) in [(0, 1.0), (5, -1.0)] {
            right[(v_n, column)] = 1.0;
            right[(s_nn, column)] = sign * z1;
            right[(s_tt, column)] = sign * alpha * z1;
            right[(s_mm, column)] = sign * alpha * z1;
            left[(column, v_n)] = 0.5;
            left[(column, s_nn)] = sign * 0.5 / z1;
        }
        for (column, sign) in [(1, 1.0), (4, -1.0)] {
            right[(v_t, column)] = 1.0;
            right[(s_nt, column)] = sign * z2;
            left[(column, v_t)] = 0.5;
            left[(column, s_nt)] = sign * 0.5 / z2;
        }
        for (column, stress) in [(2, s_tt), (3, s_mm)] {
            right[(stress, column)] = 1.0;
            left[(column, stress)] = 1.0;
            left[(column, s_nn)] = -alpha;
        }
        Self { matrix, values, right, left }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const STEEL: WaveSpeeds = WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 };
    const PMMA: WaveSpeeds = WaveSpeeds { density: 1190.0, c1: 2690.0, c2: 1340.0 };

    fn systems() -> impl Iterator<Item = (WaveSpeeds, Direction, Eigensystem)> {
        [STEEL, PMMA].into_iter().flat_map(|speeds| {
            [Direction::Z, Direction::R].map(|at| (speeds, at, Eigensystem::new(speeds, at)))
        })
    }

    /// Scales stresses by Z1, so that all entries of the eigenvectors are of order one.
    fn scaling(speeds: WaveSpeeds) -> (Matrix6, Matrix6) {
        let scale = Vector6::from_fn(|row, _| if row < 2 { 1.0 } else { 1.0 / speeds.z1() });
        (Matrix6::from_diagonal(&scale), Matrix6::from_diagonal(&scale.map(|s| 1.0 / s)))
    }

    #[test]
    fn eigenvectors_satisfy_their_equation() {
        for (speeds, _, system) in systems() {
            let (down, up) = scaling(speeds);
            let matrix = down * system.matrix * up;
            let right = down * system.right;
            let residual = matrix * right - right * Matrix6::from_diagonal(&system.values);
            assert!(residual.abs().max() < 1e-14 * speeds.c1, "{residual}");
            let residual =
                system.left * up * matrix - Matrix6::from_diagonal(&system.values) * system.left * up;
            assert!(residual.abs().max() < 1e-14 * speeds.c1 * speeds.z1(), "{residual}");
        }
    }

    #[test]
    fn eigenvectors_are_a_basis() {
        for (speeds, _, system) in systems() {
            let identity = system.left * system.right;
            let scale = Vector6::from_fn(|row, _| if row == 2 || row == 3 { speeds.z1() } else { 1.0 });
            for row in 0..6 {
                for column in 0..6 {
                    let expected = if row == column { 1.0 } else { 0.0 };
                    assert!((identity[(row, column)] - expected).abs() < 1e-15 * scale[row]);
                }
            }
            let (down, up) = scaling(speeds);
            let right = down * system.right;
            let inverse = right.try_inverse().expect("eigenvectors are independent");
            assert_relative_eq!(inverse, system.left * up, epsilon = 1e-14 * speeds.z1());
            // det = (2)(2 c2/c1) per pair, times the two stresses that stand still in the scaled form.
            let expected = 4.0 * (speeds.c2 / speeds.c1) / (speeds.z1() * speeds.z1());
            assert_relative_eq!(right.determinant().abs(), expected, max_relative = 1e-13);
        }
    }

    #[test]
    fn eigenvalues_are_those_of_the_matrix() {
        for (speeds, _, system) in systems() {
            let (down, up) = scaling(speeds);
            let found = (down * system.matrix * up).complex_eigenvalues();
            let mut found: Vec<f64> = found.iter().map(|value| value.re).collect();
            found.sort_by(f64::total_cmp);
            for (value, expected) in found.iter().zip(system.values.iter()) {
                // The double eigenvalue 0 is split by the square root of round-off at worst.
                assert!((value - expected).abs() < 1e-7 * speeds.c1, "{value} {expected}");
            }
        }
    }

    #[test]
    fn matrix_is_the_derivative_of_the_flux() {
        // Eq. (20) in unscaled stresses, written out by component: U_t = F_z(U)_z + F_r(U)_r + source.
        for (speeds, direction, system) in systems() {
            let (rho, alpha) = (speeds.density, speeds.alpha());
            let (p_modulus, mu) = (speeds.p_modulus(), speeds.shear_modulus());
            let u = Vector6::new(1.5, -0.7, 2e8, -3e7, 1.1e8, -4e7);
            let [v_z, v_r, zz, zr, rr] = [u[0], u[1], u[2], u[3], u[4]];
            let flux = match direction {
                Direction::Z => Vector6::new(
                    zz / rho,
                    zr / rho,
                    p_modulus * v_z,
                    mu * v_r,
                    alpha * p_modulus * v_z,
                    alpha * p_modulus * v_z,
                ),
                Direction::R => Vector6::new(
                    zr / rho,
                    rr / rho,
                    alpha * p_modulus * v_r,
                    mu * v_z,
                    p_modulus * v_r,
                    alpha * p_modulus * v_r,
                ),
            };
            assert_relative_eq!(-(system.matrix * u), flux, max_relative = 1e-15);
        }
    }
}
