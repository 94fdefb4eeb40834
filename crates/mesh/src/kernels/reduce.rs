//! Reductions over rows.

/// The largest of a row's numbers, at least 0; NaN is skipped. In lanes, so that it vectorises and
/// no comparison waits for the one before.
#[inline(always)]
pub fn maximum(row: &[f64]) -> f64 {
    const LANES: usize = 32;
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let mut lanes = [0.0_f64; LANES];
    let chunks = row.chunks_exact(LANES);
    let rest = chunks.remainder();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = larger(*value, *lane);
        }
    }
    let (first, second) = lanes.split_at_mut(LANES / 2);
    first.iter_mut().zip(second).for_each(|(lane, other)| *lane = larger(*other, *lane));
    let (first, second) = first.split_at_mut(LANES / 4);
    first.iter_mut().zip(second).for_each(|(lane, other)| *lane = larger(*other, *lane));
    first.iter().chain(rest).fold(0.0, |most, value| larger(*value, most))
}

/// The sum of a row's numbers. In lanes, so that it vectorises and no addition waits for the one before.
#[inline(always)]
pub fn sum(row: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (chunks, rest) = row.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for chunk in chunks {
        lanes.iter_mut().zip(chunk).for_each(|(lane, value)| *lane += value);
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    rest.iter().fold(((a + e) + (c + g)) + ((b + f) + (d + h)), |sum, value| sum + value)
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_sum_is_that_of_all() {
        for n in 0..40 {
            let row: Vec<f64> = (1..=n).map(f64::from).collect();
            assert_eq!(super::sum(&row), f64::from(n * (n + 1) / 2));
        }
    }

    #[test]
    fn the_maximum_is_found_wherever_it_stands() {
        for n in [1, 7, 31, 32, 33, 70] {
            for at in 0..n {
                let mut row = vec![0.5; n];
                row[at] = 2.0;
                assert_eq!(super::maximum(&row), 2.0);
            }
        }
        assert_eq!(super::maximum(&[-1.0, f64::NAN]), 0.0);
    }
}
