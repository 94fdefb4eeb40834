//! A spherical pulse above steel against the exact solution: reflection at all angles, head waves, the Scholte wave.
//!
//! Ten cells per width of the pulse, half of what `docs/verification/spherical-pulse.md` has its table at.

use crate::fixture::{grid, pulse, solid, water};
use crate::harness::{STEEL, Sides, case};

/// What the pressure and the stresses change by at the receivers of [`RECEIVERS`], over time.
const EXACT: &str = include_str!("data/pulse_above_steel.csv");

/// What a receiver reads.
#[derive(Clone, Copy)]
enum Reads {
    Pressure,
    StressZz,
    StressRr,
}

/// Place (r, z) in mm, quantity, and the largest misfit: a fifth above what is measured.
const RECEIVERS: [([f64; 2], Reads, f64); 8] = [
    ([0.0, 4.0], Reads::Pressure, 0.018),
    ([2.0, 0.2], Reads::Pressure, 0.008),
    ([4.0, 1.0], Reads::Pressure, 0.02),
    ([8.0, 0.1], Reads::Pressure, 0.018),
    ([0.0, -1.0], Reads::StressZz, 0.007),
    ([2.0, -1.0], Reads::StressZz, 0.0065),
    ([2.0, -1.0], Reads::StressRr, 0.009),
    ([4.0, -2.0], Reads::StressZz, 0.0075),
];
/// The receiver at which the P head wave comes 2 µs before the direct one.
const HEAD: usize = 3;

/// Until the direct wave comes to the receiver [`HEAD`] nothing has come back from the sides.
fn text() -> String {
    let lines = |z, along| grid(z, 19.2e-3, [along, 80]) + "levels = 3\n";
    let text = [
        "[time]\nend = 4.78e-6\n",
        &water(&lines([0.0, 7.68e-3], 32), 1e5),
        &pulse(2e-3),
        &solid(&lines([-15.36e-3, 0.0], 64), STEEL),
        "initial_stress = \"hydrostatic\"\n",
    ];
    text.concat()
}

/// Times, and a series for each receiver.
type Record = (Vec<f64>, Vec<Vec<f64>>);

fn exact() -> Record {
    let mut rows = EXACT.lines().filter(|line| !line.starts_with('#')).skip(1).map(|line| {
        line.split(',').map(|number| number.parse::<f64>().expect("a number")).collect::<Vec<f64>>()
    });
    let (mut times, mut series) = (vec![], vec![vec![]; RECEIVERS.len()]);
    for row in &mut rows {
        times.push(row[0]);
        series.iter_mut().zip(&row[1..]).for_each(|(series, value)| series.push(*value));
    }
    (times, series)
}

fn recorded(text: &str) -> Record {
    let mut sides = Sides::of(&case(text));
    let (mut times, mut series) = (vec![], vec![vec![]; RECEIVERS.len()]);
    let mut record = |fluid: &crate::harness::Fluid, solid: &crate::harness::Solid| {
        times.push(fluid.time());
        for (series, ([r, z], reads, _)) in series.iter_mut().zip(RECEIVERS) {
            let place = [1e-3 * z, 1e-3 * r];
            series.push(match reads {
                Reads::Pressure => fluid.sample(place).expect("within the fluid").pressure - 1e5,
                Reads::StressZz => solid.sample(place).expect("within the solid").stress_zz + 1e5,
                Reads::StressRr => solid.sample(place).expect("within the solid").stress_rr + 1e5,
            });
        }
    };
    sides.run(&mut record);
    record(sides.fluid.solver(), sides.solid.solver());
    (times, series)
}

/// Linear in between.
fn at(times: &[f64], values: &[f64], time: f64) -> f64 {
    let k = times.partition_point(|other| *other < time).clamp(1, times.len() - 1);
    values[k - 1] + (values[k] - values[k - 1]) * (time - times[k - 1]) / (times[k] - times[k - 1])
}

/// ‖y − y₀‖/‖y₀‖ at the exact solution's times.
fn misfit((times, values): (&[f64], &[f64]), (exact_times, exact): (&[f64], &[f64])) -> f64 {
    let end = times[times.len() - 1];
    let pairs = exact_times.iter().zip(exact).filter(|(time, _)| **time <= end);
    let (error, size) = pairs.fold((0.0, 0.0), |(error, size), (time, exact)| {
        (error + (at(times, values, *time) - exact).powi(2), size + exact * exact)
    });
    (error / size).sqrt()
}

/// When a series first passes half of its first extremum of more than a tenth of its largest value.
fn arrival((times, values): (&[f64], &[f64])) -> f64 {
    let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let size = |k: usize| values[k].abs();
    let first = (1..values.len() - 1)
        .find(|k| size(*k) > 0.1 * largest && size(*k) >= size(k - 1) && size(*k) > size(k + 1))
        .expect("an extremum");
    let half = 0.5 * values[first];
    let k = (1..=first).find(|k| values[*k] / half >= 1.0).expect("half of it");
    times[k - 1] + (times[k] - times[k - 1]) * (half - values[k - 1]) / (values[k] - values[k - 1])
}

#[test]
fn a_spherical_pulse_above_steel_is_the_exact_one() {
    let (exact, ours) = (exact(), recorded(&text()));
    for (k, ([r, z], _, most)) in RECEIVERS.into_iter().enumerate() {
        let off = misfit((&ours.0, &ours.1[k]), (&exact.0, &exact.1[k]));
        eprintln!("({r}, {z}) mm: {:.2} %", 100.0 * off);
        assert!(off < most, "({r}, {z}) mm: {off}");
    }
    let [ours, exact] = [&ours, &exact].map(|(times, series)| arrival((times, &series[HEAD])));
    eprintln!("head wave at {ours:e} s, exact {exact:e} s: {:+.3} %", 100.0 * (ours / exact - 1.0));
    assert!((ours / exact - 1.0).abs() < 1.5e-3);
}
