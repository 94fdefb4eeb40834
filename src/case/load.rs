//! What presses on the surface of a solid without a fluid.

use super::recorded_load::RecordedLoad;

/// `[coupling.load]`.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadCase {
    /// A pulse of a given shape.
    Gaussian(GaussianLoad),
    /// What another run's wall got.
    Recorded(RecordedLoad),
}

/// The pressure A exp(−r²/b²) f(t).
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianLoad {
    /// A, Pa.
    pub amplitude: f64,
    /// b, m.
    pub radius: f64,
    /// Times (s, ascending) and factors f, linear in between, constant before and after.
    pub history: Vec<[f64; 2]>,
}

impl LoadCase {
    /// Its largest difference from the pressure that the solid's initial stress carries, Pa.
    pub fn largest(&self) -> f64 {
        match self {
            Self::Gaussian(load) => {
                let largest = load.history.iter().fold(0.0, |most: f64, row| most.max(row[1].abs()));
                load.amplitude.abs() * largest
            }
            Self::Recorded(load) => load.largest(),
        }
    }

    /// The width of the wave that it makes, m, where the case says it.
    pub fn width(&self) -> Option<f64> {
        match self {
            Self::Gaussian(load) => Some(load.radius),
            Self::Recorded(_) => None,
        }
    }

    /// When it has become what it stays, s.
    pub fn loaded_until(&self) -> f64 {
        match self {
            Self::Gaussian(load) => load.loaded_until(),
            Self::Recorded(load) => load.end(),
        }
    }
}

impl GaussianLoad {
    fn loaded_until(&self) -> f64 {
        let rows = &self.history;
        let last = rows.last().map_or(0.0, |row| row[1]);
        let changing = rows.iter().rposition(|row| row[1] != last);
        changing.map_or(0.0, |before| rows[before + 1][0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_ends_where_it_changes_for_the_last_time() {
        let until = |history: &[[f64; 2]]| {
            let load = GaussianLoad { amplitude: 1.0, radius: 1.0, history: history.to_vec() };
            LoadCase::Gaussian(load).loaded_until()
        };
        assert_eq!(until(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [9.0, 0.0]]), 2.0);
        assert_eq!(until(&[[0.0, 0.0], [1.0, 1.0]]), 1.0);
        assert_eq!(until(&[[3.0, 1.0], [4.0, 1.0]]), 0.0);
    }
}
