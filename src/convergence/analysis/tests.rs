use super::*;

fn of(values: &[f64]) -> Analysis {
    analyse(&values.iter().map(|value| Some(*value)).collect::<Vec<_>>())
}

/// f₀ + c h^p on grids of h = 1, ½, ¼ …
fn series(limit: f64, factor: f64, order: f64, grids: i32) -> Vec<f64> {
    (0..grids).map(|grid| limit + factor * 0.5_f64.powi(grid).powf(order)).collect()
}

#[test]
fn a_power_of_the_cells_width_gives_its_order_and_its_limit() {
    for (limit, factor, order) in
        [(4e8, -3e7, 1.0), (1.0, 0.4, 0.5), (-2.0, 3.0, 1.37), (5e-5, 1e-6, 2.0), (7.0, 1.0, 3.3)]
    {
        for grids in [3, 4, 5] {
            let values = series(limit, factor, order, grids);
            let found = of(&values);
            assert_eq!(found.convergence, Convergence::Monotone);
            let error = found.order.map_or(f64::NAN, |p| (p - order).abs());
            assert!(error < 1e-9, "{order}: {found:?}");
            let error = found.richardson.map_or(f64::NAN, |value| (value / limit - 1.0).abs());
            assert!(error < 1e-12, "{limit}: {found:?}");
            // Fs |f₂ − f₁|/(r^p − 1) is Fs times the true error, as long as the order is within its bounds.
            let fine = values[values.len() - 1];
            let true_error = (fine - limit).abs();
            let own = found.uncertainties[values.len() - 1].unwrap_or(f64::NAN);
            if order <= 2.0 {
                assert!((own / (1.25 * true_error) - 1.0).abs() < 1e-9, "{found:?}");
                let of_first = found.uncertainties[0].unwrap_or(f64::NAN);
                assert!((of_first / (1.25 * factor.abs()) - 1.0).abs() < 1e-8, "{found:?}");
            } else {
                assert!(own > 1.25 * true_error && found.order_used == Some(2.0), "{found:?}");
            }
            let share = found.gci.unwrap_or(f64::NAN) / (own / fine.abs());
            assert!((share - 1.0).abs() < 1e-14 && found.safety_factor == Some(1.25));
        }
    }
}

#[test]
fn below_an_order_of_a_half_nothing_is_extrapolated_and_the_index_takes_a_half() {
    for order in [0.1, 0.45, 0.499] {
        let values = series(1.0, 0.1, order, 3);
        let found = of(&values);
        assert_eq!((found.convergence, found.richardson), (Convergence::Slow, None), "{order}");
        assert_eq!(found.order_used, Some(0.5));
        assert!(found.order.is_some_and(|own| (own - order).abs() < 1e-9));
        let want = 1.25 * (values[2] - values[1]).abs() / (2.0_f64.sqrt() - 1.0);
        assert!(found.uncertainties[2].is_some_and(|own| (own / want - 1.0).abs() < 1e-12));
    }
}

#[test]
fn what_does_not_converge_monotonically_has_a_name_and_no_order() {
    for (values, expected) in [
        ([1.0, 2.0, 1.5], Convergence::Oscillatory),
        ([1.0, 2.0, 0.5], Convergence::OscillatoryDivergent),
        ([1.0, 2.0, 1.0], Convergence::OscillatoryDivergent),
        ([1.0, 2.0, 4.0], Convergence::Divergent),
        ([1.0, 2.0, 3.0], Convergence::Divergent),
        ([2.0, 2.0, 3.0], Convergence::Divergent),
        ([1.0, 2.0, 2.0], Convergence::Coincident),
    ] {
        let found = of(&values);
        assert_eq!(found.convergence, expected, "{values:?}");
        let Analysis { order, richardson, order_used, safety_factor, gci, uncertainties, spread, .. } = found;
        assert_eq!([order, richardson, order_used, safety_factor, gci], [None; 5], "{values:?}");
        assert_eq!((uncertainties, spread.is_some()), (vec![None; 3], true));
    }
    assert_eq!(of(&[1.0, 2.0, 1.5]).spread, Some(1.0));
    let same = of(&[3.0, 3.0, 3.0 + 1e-15]);
    assert_eq!((same.convergence, same.gci, same.order), (Convergence::Unchanged, Some(0.0), None));
    assert_eq!(of(&[0.0; 3]).gci, None, "nothing is a share of 0");
}

#[test]
fn two_grids_have_an_assumed_order_and_fewer_have_nothing() {
    let found = of(&[1.0, 2.0]);
    assert_eq!((found.convergence, found.order, found.richardson), (Convergence::TwoGrids, None, None));
    assert_eq!((found.order_used, found.safety_factor), (Some(2.0), Some(3.0)));
    assert_eq!((found.gci, found.uncertainties), (Some(0.5), vec![Some(4.0), Some(1.0)]));
    for values in [&[Some(1.0)][..], &[None, None], &[], &[None, Some(2.0), Some(f64::NAN)]] {
        let found = analyse(values);
        assert_eq!(
            (found.convergence, found.gci, found.spread),
            (Convergence::Unknown, None, None),
            "{values:?}"
        );
    }
}

#[test]
fn a_grid_that_failed_leaves_the_others() {
    let values = series(1.0, 0.4, 1.0, 5);
    // One of the coarse ones: the three finest count.
    let found = analyse(&[None, Some(values[1]), Some(values[2]), Some(values[3])]);
    assert_eq!((found.convergence, found.grids), (Convergence::Monotone, vec![1, 2, 3]));
    // Every second one: r = 4.
    let found = analyse(&[Some(values[0]), None, Some(values[2]), None, Some(values[4])]);
    assert!(found.order.is_some_and(|order| (order - 1.0).abs() < 1e-12), "{found:?}");
    assert!(found.uncertainties[0].is_some_and(|own| (own - 0.5).abs() < 1e-12), "{found:?}");
    // At unequal distances: the two finest with their own ratio.
    let found = analyse(&[Some(values[0]), None, Some(values[2]), Some(values[3])]);
    assert_eq!((found.convergence, found.grids), (Convergence::TwoGrids, vec![2, 3]));
    let found = analyse(&[Some(1.0), None, Some(2.5)]);
    assert!(found.gci.is_some_and(|gci| (gci - 3.0 * 1.5 / 15.0 / 2.5).abs() < 1e-15), "{found:?}");
}

#[test]
fn nothing_that_is_not_finite_is_passed_off_as_a_number() {
    for values in [
        [f64::MAX, -f64::MAX, f64::MAX],
        [1e-308, 2e-308, 2.5e-308],
        [0.0, f64::MAX, 1.1e308],
        [-1.0, -0.5, 0.0],
    ] {
        let Analysis { order, richardson, order_used, safety_factor, gci, uncertainties, spread, .. } =
            of(&values);
        let numbers = [order, richardson, order_used, safety_factor, gci, spread];
        assert!(
            numbers.iter().chain(&uncertainties).flatten().all(|number| number.is_finite()),
            "{values:?}"
        );
    }
}
