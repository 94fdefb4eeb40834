//! A column of water hits steel: the half-Riemann problem of liquid and elastic solid.

use std::ops::Range;

use crate::fixture::{grid, steel, water};
use crate::harness::Sides;

/// p* and v* over the plateau: mean and largest deviation from the mean.
///
/// - `solid`: what `[solid]` says besides; `steps`: those that count.
fn plateau(speed: f64, star: &str, solid: &str, steps: Range<usize>) -> ([f64; 2], [f64; 2]) {
    // Solid cells four times as wide: about the same Courant number on both sides.
    let mut sides = Sides::of_parts(&[
        "geometry = \"planar\"\n[time]\nend = 1e-3\ncfl = 0.8\n",
        &water(&grid([0.0, 0.0512], 0.064, [256, 16]), 1e5),
        &format!("velocity = [-{speed:?}, 0.0]\n"),
        "[fluid.boundary]\nr_min = \"wall\"\nr_max = \"wall\"\n",
        &steel(&grid([-0.1024, 0.0], 0.064, [128, 16])),
        "[solid.boundary]\nr_min = \"symmetry\"\nr_max = \"symmetry\"\n",
        solid,
        &format!("[coupling]\nstar = \"{star}\"\n"),
    ]);
    let mut walls = Vec::new();
    for step in 0..steps.end {
        sides.round(|fluid, _| {
            if step >= steps.start {
                walls.push([fluid.interface().states()[3].pressure, fluid.interface().states()[3].velocity]);
            }
        });
    }
    let mean = [0, 1].map(|c| walls.iter().map(|wall| wall[c]).sum::<f64>() / walls.len() as f64);
    let off = [0, 1].map(|c| walls.iter().map(|wall| (wall[c] - mean[c]).abs()).fold(0.0, f64::max));
    (mean, off)
}

#[test]
fn the_plateau_is_the_half_riemann_solution() {
    for star in ["exact", "acoustic"] {
        for (speed, exact) in
            [(200.0, [366_683_297.223_7, -7.846_053_192]), (500.0, [1_283_358_025.399, -27.465_819_64])]
        {
            let (mean, off) = plateau(speed, star, "", 61..140);
            for c in 0..2 {
                let error = mean[c] / exact[c] - 1.0;
                eprintln!(
                    "{speed} m/s, {star}: {} of {}: {error:.2e}, spread {:.2e}",
                    mean[c],
                    exact[c],
                    off[c] / exact[c].abs()
                );
                // The bar of the specification once the shock has left the interface cell.
                assert!(error.abs() < 1e-3, "{speed} m/s, {star}: {} of {}", mean[c], exact[c]);
                // The start-up overshoot of a captured shock has decayed by then.
                assert!(off[c] < 5e-3 * exact[c].abs(), "{speed} m/s, {star}: {off:?}");
            }
        }
    }
}

/// Behind the elastic precursor the steel yields: the plastic wave's impedance gives way more than the elastic one. The states
/// are those of V − f(p*) = v_s(p* − p₀), v_s straight up to the elastic limit and beyond it.
#[test]
fn the_plateau_on_steel_that_yields_is_that_of_both_waves() {
    let yielding = "[solid.plasticity]\nlaw = \"perfect\"\nyield_strength = 4e8\n";
    for star in ["exact", "acoustic"] {
        let (mean, off) = plateau(500.0, star, yielding, 100..180);
        for (c, exact) in [1.264_675_050_74e9, -31.923_171_947_7].into_iter().enumerate() {
            let error = mean[c] / exact - 1.0;
            eprintln!("{star}: {} of {exact}: {error:.2e}, spread {:.2e}", mean[c], off[c] / exact.abs());
            assert!(error.abs() < 1e-3, "{star}: {} of {exact}", mean[c]);
        }
    }
}
