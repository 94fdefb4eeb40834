//! Least squares that keep what the equations leave undetermined small.

use nalgebra::{DMatrix, DVector};

/// Weight of the equations that keep it small.
const RIDGE: f64 = 1e-13;

/// A linear system with at least as many equations as unknowns.
#[derive(Clone, Debug)]
pub(super) struct LeastSquares {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    equations: usize,
}

impl LeastSquares {
    /// All zero.
    pub(super) fn new(equations: usize, unknowns: usize) -> Self {
        let rows = equations + unknowns;
        Self { matrix: DMatrix::zeros(rows, unknowns), right: DVector::zeros(rows), equations }
    }

    /// Sets one equation: Σ factor · unknown = value.
    pub(super) fn set(&mut self, equation: usize, factors: impl IntoIterator<Item = f64>, value: f64) {
        for (unknown, factor) in factors.into_iter().enumerate() {
            self.matrix[(equation, unknown)] = factor;
        }
        self.right[equation] = value;
    }

    /// What meets the equations best, by QR of columns that are made equally large, with [`RIDGE`] of each unknown as further equations.
    ///
    /// `None` where round-off makes it singular all the same.
    pub(super) fn solve(mut self) -> Option<Vec<f64>> {
        let unknowns = self.matrix.ncols();
        let typical = (self.equations as f64).sqrt();
        let scales: Vec<f64> = (0..unknowns).map(|j| self.matrix.column(j).norm() / typical).collect();
        for (j, scale) in scales.iter().enumerate() {
            self.matrix.column_mut(j).scale_mut(1.0 / scale);
            self.matrix[(self.equations + j, j)] = RIDGE * typical;
        }
        let factors = self.matrix.qr();
        factors.q_tr_mul(&mut self.right);
        let mut solution = self.right.rows(0, unknowns).into_owned();
        let is_regular = factors.unpack_r().solve_upper_triangular_mut(&mut solution);
        is_regular.then(|| solution.iter().zip(&scales).map(|(value, scale)| value / scale).collect())
    }
}
