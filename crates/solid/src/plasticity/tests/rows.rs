//! Rows against single cells.

use super::{Dice, STEEL, aluminium, in_steel, laws};
use crate::plasticity::{Hardening, PlasticRows, Plasticity, Returned, Stress, Table};

/// Columns zz, zr, rr, φφ, ε_p, T of `n` cells, of which about a share `beyond` yields.
fn columns(dice: &mut Dice, n: usize, beyond: f64) -> [Vec<f64>; 6] {
    let mut columns: [Vec<f64>; 6] = std::array::from_fn(|_| Vec::with_capacity(n));
    for _ in 0..n {
        // Some without any stress, as cells are where nothing has come yet.
        let elastic = if dice.unit() < 0.1 { 0.0 } else { 2e7 };
        let size = if dice.unit() < beyond { 2e9 } else { elastic };
        for column in &mut columns[..4] {
            column.push(size * (2.0 * dice.unit() - 1.0));
        }
        columns[4].push(0.1 * dice.unit());
        columns[5].push(250.0 + 300.0 * dice.unit());
    }
    columns
}

/// Returns them within a nanosecond; how many flowed.
fn return_columns(
    plasticity: &Plasticity,
    [stress_zz, stress_zr, stress_rr, stress_phiphi, strain, temperature]: &mut [Vec<f64>; 6],
    [increment, work]: [&mut [f64]; 2],
) -> usize {
    let temperature: &mut [f64] = if plasticity.has_heat() { temperature } else { &mut [] };
    let mut rows =
        PlasticRows { stress_zz, stress_zr, stress_rr, stress_phiphi, strain, temperature, increment, work };
    plasticity.return_rows(&mut rows, 1e-9)
}

#[test]
fn rows_return_what_single_cells_return() {
    let mut dice = Dice::new(11);
    for (hardening, plasticity) in in_steel() {
        for (n, beyond) in [(1, 1.0), (63, 0.5), (200, 0.05), (256, 0.0), (300, 1.0)] {
            let before = columns(&mut dice, n, beyond);
            let mut after = before.clone();
            let (mut increment, mut work) = (vec![0.0; n], vec![f64::NAN; n]);
            let count = return_columns(&plasticity, &mut after, [&mut increment, &mut work]);
            assert_eq!(count, increment.iter().filter(|increment| **increment > 0.0).count());
            assert_eq!(count == 0, beyond == 0.0);
            for k in 0..n {
                let [zz, zr, rr, phiphi, strain, temperature] = [0, 1, 2, 3, 4, 5].map(|c| before[c][k]);
                let warm = if plasticity.has_heat() { temperature } else { 0.0 };
                let single = plasticity.return_map(Stress { zz, zr, rr, phiphi }, strain, warm, 1e-9);
                let expected = match single {
                    None => [zz, zr, rr, phiphi, strain, temperature, 0.0, 0.0],
                    Some(returned) => {
                        let Stress { zz, zr, rr, phiphi } = returned.stress;
                        let temperature =
                            if plasticity.has_heat() { returned.temperature } else { temperature };
                        let Returned { strain, increment, plastic_work, .. } = returned;
                        [zz, zr, rr, phiphi, strain, temperature, increment, plastic_work]
                    }
                };
                let found = [0, 1, 2, 3, 4, 5].map(|c| after[c][k]);
                let found = found.into_iter().chain([increment[k], work[k]]);
                assert!(found.map(f64::to_bits).eq(expected.map(f64::to_bits)), "cell {k}: {hardening:?}");
            }
        }
    }
}

/// Stresses alone are those of whole returns, of strains below zero those of none.
#[test]
fn stresses_alone_are_those_of_rows() {
    let mut dice = Dice::new(31);
    let mut on_lines = 0;
    for (hardening, plasticity) in in_steel() {
        for (n, beyond) in [(1, 1.0), (63, 0.5), (200, 0.05), (300, 1.0)] {
            let mut rows = columns(&mut dice, n, beyond);
            rows[4].iter_mut().step_by(3).for_each(|strain| *strain *= -1.0);
            let [mut zz, mut zr, mut rr, mut phiphi, strain, _] = rows.clone();
            let known = if plasticity.needs_strain() { &strain[..] } else { &[] };
            let done = plasticity.return_stresses([&mut zz, &mut zr, &mut rr, &mut phiphi], known);
            assert_eq!(done, plasticity.is_on_lines(), "{hardening:?}");
            on_lines += usize::from(done);
            if done {
                rows[4].iter_mut().for_each(|strain| *strain = strain.max(0.0));
                return_columns(&plasticity, &mut rows, [&mut vec![0.0; n], &mut vec![0.0; n]]);
            }
            assert_eq!([zz, zr, rr, phiphi], rows[..4], "{hardening:?}");
        }
    }
    assert!(on_lines >= 12, "{on_lines}");
}

/// Whatever the guess, the increment is the same but for rounding.
#[test]
fn guesses_change_nothing_but_rounding() {
    let mut dice = Dice::new(17);
    let mut worst = 0.0_f64;
    for (hardening, plasticity) in in_steel() {
        let (mut before, n) = (columns(&mut dice, 320, 1.0), 320);
        // Below melting, where a law that softens has one solution.
        before[5].iter_mut().for_each(|temperature| *temperature = temperature.min(400.0));
        let returned = |guess: &dyn Fn(usize) -> f64| {
            let mut after = before.clone();
            let (mut increment, mut work): (Vec<f64>, _) = ((0..n).map(guess).collect(), vec![0.0; n]);
            return_columns(&plasticity, &mut after, [&mut increment, &mut work]);
            increment
        };
        let alone = returned(&|_| 0.0);
        for factor in [1e-12, 0.3, 0.999, 1.0, 1.5, 40.0] {
            for (k, increment) in returned(&|k| factor * alone[k]).into_iter().enumerate() {
                let off = (increment - alone[k]).abs() / alone[k].max(1e-30);
                worst = worst.max(off);
                assert!(off < 1e-11, "{hardening:?}, cell {k}: {increment:e} {:e}", alone[k]);
            }
        }
    }
    println!("off by {worst:.1e}");
}

/// The returns of many cells at once are those of the bracketed solver, on both sides of the kinks that rate and heat make.
#[test]
fn quick_returns_are_those_of_the_bracketed_solver() {
    let mut dice = Dice::new(23);
    for hardening in laws().into_iter().chain([1.0, 20.0].map(|m| Hardening::JohnsonCook(aluminium(m)))) {
        let plasticity = Plasticity::new(hardening.clone(), STEEL);
        let (Some(law), cold) = (&plasticity.power, plasticity.reference()) else { continue };
        let (mut worst, mut solved) = (0.0_f64, 0);
        for _ in 0..20_000 {
            let strain = if dice.unit() < 0.2 { 0.0 } else { dice.power(-9.0, -0.5) };
            // Some are a little colder than where heat begins to matter, as neighbours of a level jump can be.
            let temperature = if dice.unit() < 0.3 { cold } else { cold + dice.signed(-6.0, 2.0) };
            let dt = dice.power(-12.0, -6.0);
            let q = hardening.yield_stress(strain, 0.0, temperature) * (1.0 + dice.power(-15.0, 1.0));
            let (increment, left) = law.single(q, strain, temperature - cold, dt);
            let exact =
                plasticity.flow_back(Stress { zz: q, ..Stress::default() }, q, strain, temperature, dt);
            let Some(exact) = exact.filter(|_| increment > 0.0) else { continue };
            solved += 1;
            let (mu, what) =
                (plasticity.mu(), format!("{hardening:?} at {strain:e}, {temperature} K, {dt:e} s"));
            let rise = temperature - cold + plasticity.heating() * left * increment;
            let stress = hardening.flow_at_rise(strain + increment, increment / dt, rise).stress;
            let off = (left - stress).abs().max((q - 3.0 * mu * increment - left).abs()) / q;
            worst = worst.max(off);
            assert!(off < 1e-12, "{what}: {increment:e} leaves {off:e}");
            // Where heat begins to matter with an infinite slope, there may be two solutions.
            let is_only = temperature >= cold
                || hardening.softening().is_none_or(|heat| heat.softening_exponent >= 1.0);
            let apart = 3.0 * mu * (increment - exact.increment).abs() / q;
            assert!(apart < 1e-12 || !is_only, "{what}: {increment:e}, not {:e}", exact.increment);
        }
        println!("{solved} solved, off by {worst:.1e}");
        assert!(solved > 15_000, "{hardening:?}: {solved}");
    }
}

/// The closed form of tables ends where the bracketed solver does, however many points a step passes.
#[test]
fn returns_on_tables_are_those_of_the_bracketed_solver() {
    let mut dice = Dice::new(29);
    let (mut worst, mut passed) = (0.0_f64, 0);
    for number in 0..200 {
        let mut point = [if number % 2 == 0 { 0.0 } else { dice.power(-6.0, -1.0) }, dice.power(6.0, 9.0)];
        let mut points = vec![point];
        for _ in 0..number % 12 {
            let flat = dice.unit() < 0.2;
            point =
                [point[0] + dice.power(-6.0, -0.5), point[1] + if flat { 0.0 } else { dice.power(3.0, 9.0) }];
            points.push(point);
        }
        let hardening = Hardening::Table(Table::new(&points).expect("a table"));
        let plasticity = Plasticity::new(hardening.clone(), STEEL);
        for _ in 0..200 {
            let strain = match dice.unit() {
                unit if unit < 0.2 => 0.0,
                // At a point itself, too.
                unit if unit < 0.4 => points[(unit * 1e6) as usize % points.len()][0],
                _ => dice.power(-9.0, 0.0),
            };
            let bound = hardening.yield_stress(strain, 0.0, 0.0);
            let q = bound * (1.0 + dice.power(-13.0, 3.0));
            let trial = Stress { zz: q, ..Stress::default() };
            let what = format!("{points:?} at {strain:e}, {q:e} Pa");
            let [found, wanted] = [
                plasticity.return_map(trial, strain, 0.0, 1e-9),
                plasticity.return_bracketed(trial, strain, 0.0, 1e-9),
            ]
            .map(|returned| returned.unwrap_or_else(|| panic!("{what}")));
            let (flow, mu) = (hardening.flow(found.strain, 0.0, 0.0), plasticity.mu());
            let off = [
                found.von_mises - flow.stress,
                q - 3.0 * mu * found.increment - found.von_mises,
                3.0 * mu * (found.increment - wanted.increment),
            ]
            // The strain's own rounding costs what the slope makes of it.
            .map(|off| off.abs() / (q + 3.0 * mu * strain + flow.per_log_strain));
            worst = off.into_iter().fold(worst, f64::max);
            assert!(worst < 1e-14, "{what}: {found:?}, not {wanted:?}");
            passed += points.iter().filter(|[at, _]| strain < *at && *at < found.strain).count();
        }
    }
    println!("off by {worst:.1e}, {passed} points passed");
    assert!(passed > 1000, "{passed}");
}

#[test]
fn the_quick_look_never_overlooks_a_cell_that_yields() {
    let mut dice = Dice::new(3);
    for (hardening, plasticity) in in_steel() {
        for _ in 0..5000 {
            let (strain, temperature) = (dice.power(-9.0, 0.5), 250.0 + 1200.0 * dice.unit());
            let strength = hardening.yield_stress(strain, 0.0, temperature);
            let q = strength * (1.0 + 1e-9) + 1.0;
            let trial = Stress { zz: q, ..Stress::default() };
            let returned = plasticity.return_map(trial, strain, temperature, 1e-9);
            assert!(returned.is_some(), "{hardening:?} at {strain:e}, {temperature} K");
        }
    }
}
