//! Relaxation of the strong scheme's fixed-point iteration.

/// Aitken's dynamic relaxation of x = H(x) for a vector of interface values.
///
/// x_{k+1} = x_k + ω_k r_k with r_k = H(x_k) − x_k and ω_k = −ω_{k−1} r_{k−1}·(r_k − r_{k−1})/|r_k − r_{k−1}|² (Irons & Tuck 1969;
/// Küttler & Wall 2008, eq. 44). The first step of an iteration takes the last factor of the iteration before, as far as
/// it damps.
#[derive(Clone, Debug, PartialEq)]
pub struct Aitken {
    factor: f64,
    residual: Vec<f64>,
}

impl Default for Aitken {
    fn default() -> Self {
        Self { factor: 1.0, residual: Vec::new() }
    }
}

impl Aitken {
    /// A factor that an iteration may begin with: neither does it begin by amplifying, nor at a standstill.
    const FIRST: [f64; 2] = [0.05, 1.0];

    /// Begins an iteration.
    pub fn begin(&mut self) {
        let [least, most] = Self::FIRST;
        self.factor = self.factor.abs().clamp(least, most);
        self.residual.clear();
    }

    /// Replaces the iterate `x` by the next one.
    ///
    /// - `image`: H(x), as long as `x`.
    pub fn relax(&mut self, x: &mut [f64], image: &[f64]) {
        if self.residual.len() == x.len() {
            let (mut product, mut square) = (0.0, 0.0);
            for ((last, image), x) in self.residual.iter().zip(image).zip(x.iter()) {
                let change = (image - x) - last;
                product += last * change;
                square += change * change;
            }
            // Two equal residuals say nothing of the factor.
            if square > 0.0 {
                self.factor *= -product / square;
            }
        }
        self.residual.clear();
        for (x, image) in x.iter_mut().zip(image) {
            let residual = image - *x;
            self.residual.push(residual);
            *x += self.factor * residual;
        }
    }

    /// The factor of the next iteration's first step, before it is bounded; with [`Aitken::from_factor`] all that lasts
    /// from one iteration to the next.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// As it was when its factor was read between two iterations.
    #[must_use]
    pub fn from_factor(factor: f64) -> Self {
        Self { factor, residual: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Repeats x ← H(x) for H(x)_i = a_i x_i + 1 from zero; returns the number of steps until all residuals are small.
    fn steps(slopes: &[f64], aitken: &mut Aitken) -> usize {
        let mut x = vec![0.0; slopes.len()];
        aitken.begin();
        for step in 0..1000 {
            let image: Vec<f64> = x.iter().zip(slopes).map(|(x, a)| a * x + 1.0).collect();
            if x.iter().zip(&image).all(|(x, image)| (x - image).abs() < 1e-10) {
                return step;
            }
            aitken.relax(&mut x, &image);
        }
        panic!("no convergence: {x:?}");
    }

    #[test]
    fn one_slope_is_solved_by_the_secant_even_where_the_iteration_diverges() {
        for slope in [0.5, -0.5, -3.0, -40.0] {
            assert!(steps(&[slope; 4], &mut Aitken::default()) <= 2, "{slope}");
        }
    }

    #[test]
    fn several_slopes_converge_where_plain_iteration_would_not() {
        assert!(steps(&[-0.2, -1.5, -1.1, -0.9], &mut Aitken::default()) < 60);
    }

    #[test]
    fn the_next_iteration_begins_with_the_factor_of_the_last_if_it_damps() {
        let mut aitken = Aitken::default();
        steps(&[-3.0; 2], &mut aitken);
        assert!((aitken.factor() - 0.25).abs() < 1e-12);
        // With the right factor from the start one step is enough.
        assert_eq!(steps(&[-3.0; 2], &mut aitken), 1);
        let mut restored = Aitken::from_factor(aitken.factor());
        assert_eq!(steps(&[-3.0; 2], &mut restored), 1);
        steps(&[0.5; 2], &mut aitken);
        assert!(aitken.factor() > 1.0);
        aitken.begin();
        assert_eq!(aitken.factor(), 1.0);
    }
}
