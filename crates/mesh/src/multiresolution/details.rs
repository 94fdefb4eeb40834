//! The sizes of the details of two rows of cells.

use crate::multiresolution::{MOST_COMPONENTS, Multiresolution, deviations_among};

/// Two rows of a block, component by component.
pub(crate) struct DetailRows<const N: usize> {
    /// The cells, set by the caller.
    pub own: [[[f64; N]; 2]; MOST_COMPONENTS],
    /// Their details.
    pub details: [[[f64; N]; 2]; MOST_COMPONENTS],
    /// The sizes of their details.
    pub sizes: [[f64; N]; 2],
}

impl<const N: usize> DetailRows<N> {
    pub const ZERO: Self = {
        let zero = [[0.0; N]; 2];
        Self { own: [zero; MOST_COMPONENTS], details: [zero; MOST_COMPONENTS], sizes: zero }
    };

    /// The components of a cell, and of its detail.
    pub fn cell(&self, b: usize, i: usize) -> [[f64; MOST_COMPONENTS]; 2] {
        [&self.own, &self.details].map(|rows| std::array::from_fn(|component| rows[component][b][i]))
    }
}

/// Details, what cells are minus what is predicted, of two rows of a block and their sizes.
///
/// - `patch`: components of `len` cells on the level below with ghosts, `stride` apart along r; `from`: index of the
///   cell below and left of the first parent. `weights`: by component, see
///   [`crate::multiresolution::radial_weights`].
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(crate) fn details_of_rows<const N: usize, R: Multiresolution>(
    patch: &[f64],
    len: usize,
    from: usize,
    stride: usize,
    weights: &[[f64; 2]; MOST_COMPONENTS],
    rule: &R,
    rows: &mut DetailRows<N>,
) {
    let DetailRows { own, details, sizes } = rows;
    for (((own, details), cells), weights) in
        own.iter().zip(details.iter_mut()).zip(patch.chunks_exact(len)).zip(weights)
    {
        let row = |j: usize| &cells[from + j * stride..][..N / 2 + 2];
        details_of_component(own, details, [row(0), row(1), row(2)], *weights);
    }
    for b in 0..2 {
        for i in 0..N {
            let cell: [f64; MOST_COMPONENTS] = std::array::from_fn(|c| own[c][b][i]);
            let detail: [f64; MOST_COMPONENTS] = std::array::from_fn(|c| details[c][b][i]);
            sizes[b][i] = rule.significance(&cell, &detail);
        }
    }
}

#[inline(always)]
fn details_of_component<const N: usize>(
    own: &[[f64; N]; 2],
    details: &mut [[f64; N]; 2],
    [below, middle, above]: [&[f64]; 3],
    weights: [f64; 2],
) {
    for i in 0..N / 2 {
        let three = |row: &[f64]| [row[i], row[i + 1], row[i + 2]];
        let deviations = deviations_among([three(below), three(middle), three(above)], weights);
        for (child, deviation) in deviations.iter().enumerate() {
            let (a, b) = (2 * i + child % 2, child / 2);
            details[b][a] = own[b][a] - (middle[i + 1] + deviation);
        }
    }
}
