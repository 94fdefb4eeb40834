//! The load that a run has put on the wall, as the Gaussian pulse nearest to it.

use std::path::Path;

use hdf5::File;
use nalgebra::{Matrix4, Vector4};
use ndarray::iter::Iter;
use ndarray::{Array2, Ix1, s};
use serde_json::{Map, Value, json};

use crate::output::dataset_if_there;

/// Values that are looked at, at most; of more, every other row or cell and so on.
const MOST_VALUES: usize = 1 << 22;

/// Rows that are worth it to wake a thread.
const ROWS_AT_ONCE: usize = 64;

/// Steps of the fit, at most.
const MOST_STEPS: usize = 200;

/// P₀ exp(−(r/Δr)²) exp(−((t − t₀)/Δt)²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EquivalentLoad {
    /// P₀, Pa.
    pub amplitude: f64,
    /// Δr, m.
    pub radius: f64,
    /// Δt, s.
    pub duration: f64,
    /// t₀, s.
    pub time: f64,
    /// Root of the squares that are left, as a share of those of the pressure.
    pub misfit: f64,
}

/// Pressure above that far away on the wall, by time (rows) and radius.
pub struct WallPressure {
    /// s, ascending.
    pub times: Vec<f64>,
    /// m, ascending.
    pub radii: Vec<f64>,
    /// Pa.
    pub values: Array2<f64>,
}

/// The keys of the summary, from the histories of a run that is over; empty without a history of the wall's pressure.
pub fn summary(history: &Path) -> Map<String, Value> {
    let Some(wall) = read(history) else { return Map::new() };
    let load = wall.equivalent_load();
    let number = |of: fn(&EquivalentLoad) -> f64| json!(load.as_ref().map(of));
    Map::from_iter([
        ("load_amplitude".to_owned(), number(|load| load.amplitude)),
        ("load_radius".to_owned(), number(|load| load.radius)),
        ("load_duration".to_owned(), number(|load| load.duration)),
        ("load_time".to_owned(), number(|load| load.time)),
        ("load_misfit".to_owned(), number(|load| load.misfit)),
    ])
}

/// What a file has of the wall's pressure; nothing where it has none or cannot be read, which is told of elsewhere.
fn read(history: &Path) -> Option<WallPressure> {
    let file = File::open(history).ok()?;
    let named = |name: &str| dataset_if_there(&file, &format!("interface/{name}"));
    let pressure = named("pressure")?;
    let [rows, cells] = pressure.shape()[..] else { return None };
    let few = |stride: usize| rows.div_ceil(stride) * cells <= MOST_VALUES;
    let rows_apart = (1..).find(|stride| few(*stride) || *stride >= rows)?;
    let cells_apart = (cells.div_ceil(MOST_VALUES)).max(1);
    let times: Vec<f64> = named("time")?.read_raw().ok()?;
    let radii: Vec<f64> = named("r")?.read_raw().ok()?;
    let far: Vec<f64> = pressure.read_slice_1d(s![0, cells.checked_sub(1)?..]).ok()?.to_vec();
    let values: Array2<f64> = pressure.read_slice_2d(s![..;rows_apart, ..;cells_apart]).ok()?;
    let far = *far.first()?;
    Some(WallPressure {
        times: times.into_iter().step_by(rows_apart).collect(),
        radii: radii.into_iter().step_by(cells_apart).collect(),
        values: values.mapv(|pressure| pressure - far),
    })
    .filter(|wall| wall.values.dim() == (wall.times.len(), wall.radii.len()))
}

impl WallPressure {
    /// The pulse nearest to it in the sense of least squares over all times and cells alike.
    ///
    /// By Levenberg and Marquardt (D. W. Marquardt, SIAM J. 11 (1963), 431) in ln P₀, ln Δr, t₀ and ln Δt, from the largest value and its
    /// widths at half height. `None` if nothing presses on the wall, or it does so for less time than there is between two rows.
    pub fn equivalent_load(&self) -> Option<EquivalentLoad> {
        let squares: f64 = self.values.iter().map(|p| p * p).sum();
        let mut load = self.start()?;
        let (mut cost, mut damping) = (self.cost(&load), 1e-3);
        for _ in 0..MOST_STEPS {
            let (matrix, right) = self.normal_equations(&load);
            let Some(step) = damped_step(matrix, &right, damping) else { break };
            let next = load.moved(step);
            let next_cost = self.cost(&next);
            if next_cost <= cost {
                let small = step.iter().all(|change| change.abs() < 1e-10);
                (load, cost, damping) = (next, next_cost, damping * 0.1);
                if small {
                    break;
                }
            } else {
                damping *= 10.0;
                if damping > 1e12 {
                    break;
                }
            }
        }
        let load = EquivalentLoad { misfit: (cost / squares).sqrt(), ..load };
        let between = self.times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        let is_resolved = load.duration >= between && load.duration.is_finite() && load.radius.is_finite();
        is_resolved.then_some(load)
    }

    /// The largest value with its widths at half height.
    fn start(&self) -> Option<EquivalentLoad> {
        let largest = (self.values.indexed_iter())
            .fold(((0, 0), 0.0), |best, (at, p)| if *p > best.1 { (at, *p) } else { best });
        let ((row, cell), amplitude) = largest;
        if !(amplitude > 0.0 && amplitude.is_finite()) || self.times.len() < 3 || self.radii.len() < 2 {
            return None;
        }
        let is_high = |row: usize, cell: usize| self.values[[row, cell]] >= 0.5 * amplitude;
        let first = (0..row).rev().find(|k| !is_high(*k, cell)).unwrap_or(0);
        let last = (row..self.times.len()).find(|k| !is_high(*k, cell)).unwrap_or(self.times.len() - 1);
        let upper = (cell..self.radii.len()).find(|k| !is_high(row, *k)).unwrap_or(self.radii.len() - 1);
        let lower = (0..cell).rev().find(|k| !is_high(row, *k)).unwrap_or(0);
        // Planar domains reach below r = 0, about which the pulse lies; the peak may be there.
        let outermost = self.radii[upper].abs().max(self.radii[lower].abs());
        let half = std::f64::consts::LN_2.sqrt();
        Some(EquivalentLoad {
            amplitude,
            radius: outermost / half,
            duration: 0.5 * (self.times[last] - self.times[first]) / half,
            time: self.times[row],
            misfit: 1.0,
        })
    }

    fn cost(&self, load: &EquivalentLoad) -> f64 {
        let (in_time, in_radius) = self.factors(load);
        self.sum_of_rows(|row, pressures| {
            let scale = load.amplitude * in_time[row][0];
            let squares =
                pressures.zip(&in_radius).map(|(p, [of_radius, _])| (p - scale * of_radius).powi(2));
            [squares.sum()]
        })[0]
    }

    /// The sum over all rows of what is made of each: its number and its pressures.
    fn sum_of_rows<const K: usize>(
        &self,
        of_row: impl Fn(usize, Iter<'_, f64, Ix1>) -> [f64; K] + Sync + Send,
    ) -> [f64; K] {
        let rows = mesh::map_in_order(self.times.len(), ROWS_AT_ONCE, |row| {
            of_row(row, self.values.row(row).into_iter())
        });
        // In their order, so that the sum does not depend on threads.
        rows.into_iter().fold([0.0; K], |sum, row| std::array::from_fn(|k| sum[k] + row[k]))
    }

    /// exp(−x²) and 2x, x being (t − t₀)/Δt of every row and r/Δr of every cell.
    fn factors(&self, load: &EquivalentLoad) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
        let factor = |x: f64| [(-x * x).exp(), 2.0 * x];
        let in_time = self.times.iter().map(|t| factor((t - load.time) / load.duration)).collect();
        (in_time, self.radii.iter().map(|r| factor(r / load.radius)).collect())
    }

    /// The normal equations of a step in ln P₀, ln Δr, t₀/Δt, ln Δt.
    ///
    /// The slopes are the model A T(t) R(r) times 1, ½ρ², τ and ½τ², with ρ = 2r/Δr and τ = 2(t − t₀)/Δt. So the sums over the cells of a
    /// row are the same for all rows but for the pressures', and two of those.
    fn normal_equations(&self, load: &EquivalentLoad) -> (Matrix4<f64>, Vector4<f64>) {
        let (in_time, in_radius) = self.factors(load);
        let bend = |twice: f64| 0.5 * twice * twice;
        // Σ R², Σ R² ½ρ², Σ R² (½ρ²)².
        let [even, once, twice] = in_radius.iter().fold([0.0; 3], |sums, [of_radius, rho]| {
            std::array::from_fn(|k| sums[k] + of_radius * of_radius * bend(*rho).powi(k as i32))
        });
        let left = self.sum_of_rows(|row, pressures| {
            let [of_time, tau] = in_time[row];
            let scale = load.amplitude * of_time;
            let [mut flat, mut bent] = [0.0; 2];
            for (p, [of_radius, rho]) in pressures.zip(&in_radius) {
                let weighted = of_radius * (p - scale * of_radius);
                flat += weighted;
                bent += weighted * bend(*rho);
            }
            [scale * flat, scale * bent, scale * flat * tau, scale * flat * bend(tau)]
        });
        let mut matrix = Matrix4::zeros();
        for [of_time, tau] in &in_time {
            let weight = (load.amplitude * of_time).powi(2);
            let along = Vector4::new(1.0, 1.0, *tau, bend(*tau));
            let across = Matrix4::from_fn(|i, j| match usize::from(i == 1) + usize::from(j == 1) {
                0 => even,
                1 => once,
                _ => twice,
            });
            matrix += weight * (along * along.transpose()).component_mul(&across);
        }
        (matrix, Vector4::from(left))
    }
}

impl EquivalentLoad {
    fn moved(self, step: Vector4<f64>) -> Self {
        let [amplitude, radius, time, duration] = step.into();
        Self {
            amplitude: self.amplitude * amplitude.exp(),
            radius: self.radius * radius.exp(),
            time: self.time + self.duration * time,
            duration: self.duration * duration.exp(),
            ..self
        }
    }
}

/// Solves (A + damping diag A) x = b; A is symmetric. `None` if it is not positive.
fn damped_step(mut matrix: Matrix4<f64>, right: &Vector4<f64>, damping: f64) -> Option<Vector4<f64>> {
    (0..4).for_each(|i| matrix[(i, i)] *= 1.0 + damping);
    Some(matrix.cholesky()?.solve(right))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pressures on 120 cells to 2 mm and at 401 times to 4 µs.
    fn wall(pressure: impl Fn(f64, f64) -> f64) -> WallPressure {
        let radii: Vec<f64> = (0..120).map(|k| (f64::from(k) + 0.5) * 2e-3 / 120.0).collect();
        let times: Vec<f64> = (0..401).map(|k| f64::from(k) * 1e-8).collect();
        let values = Array2::from_shape_fn((401, 120), |(row, cell)| pressure(radii[cell], times[row]));
        WallPressure { times, radii, values }
    }

    fn pulse([amplitude, radius, time, duration]: [f64; 4]) -> impl Fn(f64, f64) -> f64 {
        move |r, t| amplitude * (-(r / radius).powi(2) - ((t - time) / duration).powi(2)).exp()
    }

    fn near(load: EquivalentLoad, [amplitude, radius, time, duration]: [f64; 4], tolerance: f64) {
        for (found, expected) in
            [(load.amplitude, amplitude), (load.radius, radius), (load.time, time), (load.duration, duration)]
        {
            assert!((found / expected - 1.0).abs() < tolerance, "{load:?}, {expected:e}");
        }
    }

    #[test]
    fn a_gaussian_pulse_comes_back() {
        // Wide and narrow, long and short; one that has begun before the history; the narrowest has less than two cells in it.
        for truth in [
            [1e9, 2e-4, 1.5e-6, 2e-7],
            [3e5, 1.5e-3, 2e-6, 9e-7],
            [2e9, 3e-5, 1e-6, 2e-8],
            [1e8, 4e-4, 1e-7, 4e-7],
        ] {
            let load = wall(pulse(truth)).equivalent_load().expect("a load");
            near(load, truth, 1e-8);
            assert!(load.misfit < 1e-8, "{load:?}");
        }
    }

    #[test]
    fn noise_and_a_slow_rise_beside_it_change_it_little() {
        let truth = [1e9, 2e-4, 1.5e-6, 2e-7];
        let exact = pulse(truth);
        let noise = |r: f64, t: f64| ((r * 7.3e6).sin() * (t * 4.1e9).cos()) * 3e7;
        let load = wall(|r, t| exact(r, t) + noise(r, t) + 2e6 * t / 4e-6).equivalent_load().expect("a load");
        near(load, truth, 1e-2);
        assert!(load.misfit > 0.01 && load.misfit < 0.5, "{load:?}");
    }

    #[test]
    fn the_larger_of_two_pulses_is_found() {
        let (first, second) = (pulse([5e8, 3e-4, 1e-6, 1e-7]), pulse([1e9, 2e-4, 3e-6, 1.5e-7]));
        let load = wall(|r, t| first(r, t) + second(r, t)).equivalent_load().expect("a load");
        near(load, [1e9, 2e-4, 3e-6, 1.5e-7], 1e-3);
    }

    /// A wall of a planar domain that reaches below r = 0.
    fn strip(cells: u32, low: f64, pressure: impl Fn(f64, f64) -> f64) -> WallPressure {
        let radii: Vec<f64> = (0..cells).map(|k| low + (f64::from(k) + 0.5) * 2e-3 / 120.0).collect();
        let times: Vec<f64> = (0..401).map(|k| f64::from(k) * 1e-8).collect();
        let values =
            Array2::from_shape_fn((401, radii.len()), |(row, cell)| pressure(radii[cell], times[row]));
        WallPressure { times, radii, values }
    }

    #[test]
    fn a_peak_below_the_axis_of_a_planar_domain_has_a_width() {
        let exact = pulse([1e9, 2e-4, 1.5e-6, 2e-7]);
        // Half of the height ends in the cell whose centre is r = 0: the width there is none.
        let torn = strip(121, -121e-3 / 120.0, |r, t| exact(r, t) * if r < -1e-9 { 1.0 } else { 0.4 });
        let load = torn.equivalent_load().expect("a load");
        assert!((load.radius / 2e-4 - 1.0).abs() < 0.05 && load.misfit < 0.5, "{load:?}");
        // All of it is below r = 0.
        let aside = strip(240, -2e-3, |r, t| exact(r + 1e-3, t));
        let load = aside.equivalent_load().expect("a load");
        assert!(load.radius > 0.0 && load.misfit < 1.0, "{load:?}");
    }

    #[test]
    fn nothing_has_no_equivalent() {
        assert_eq!(wall(|_, _| 0.0).equivalent_load(), None);
        assert_eq!(wall(|_, _| -1e5).equivalent_load(), None);
        assert_eq!(wall(|_, _| f64::NAN).equivalent_load(), None);
        // A spike in one row.
        assert_eq!(wall(|r, t| if t == 1e-6 { 1e9 * (-r * 1e3).exp() } else { 0.0 }).equivalent_load(), None);
    }
}
