//! Pits under a Gaussian load as a user makes them, by a case and its summary, against converged finite elements.

use std::path::Path;

use crate::harness::case;
use crate::hits::{number, run};

/// ρ (kg/m³), c₁, c₂ (m/s).
const ALUMINIUM: [f64; 3] = [2700.0, 6320.0, 3130.0];
const STEEL: [f64; 3] = [7800.0, 5990.0, 3458.0];

struct Pit<'a> {
    law: &'a str,
    material: [f64; 3],
    /// P (Pa), a (m), τ, t₀ (s) of P exp(−(r/a)²) exp(−((t − t₀)/τ)²).
    load: [f64; 4],
    /// Depth on the axis, radius at half depth, m; largest ε_p.
    expected: [f64; 3],
}

const HARDENS: &str =
    "law = \"johnson-cook\"\nyield_strength = 3.24e8\nhardening_modulus = 1.14e8\nhardening_exponent = 0.42";

impl Pit<'_> {
    /// Three levels, the finest cells a tenth of a wide.
    fn text(&self, limiter: &str) -> String {
        let [amplitude, a, duration, peak] = self.load;
        let [density, c1, c2] = self.material;
        let points: Vec<_> = (0..=200)
            .map(|k| {
                let t = f64::from(k) / 200.0 * (peak + 5.0 * duration);
                let factor = if k % 200 == 0 { 0.0 } else { (-((t - peak) / duration).powi(2)).exp() };
                format!("[{t:e}, {factor:e}]")
            })
            .collect();
        let (reach, end) = (12.8 * a, peak + 3.5 * duration + 8.0 * a / c1);
        format!(
            "[time]\nend = {end:e}\n[solid]\nz = [{:e}, 0.0]\nr = [0.0, {reach:e}]\ncells = [32, 32]\nlevels = 2\n\
             limiter = \"{limiter}\"\nmaterial = {{ density = {density}, c1 = {c1}, c2 = {c2} }}\n\
             [solid.plasticity]\n{}\n[coupling]\nscheme = \"load\"\n\
             [coupling.load]\namplitude = {amplitude:e}\nradius = {a:e}\nhistory = [{}]\n",
            -reach,
            self.law,
            points.join(", ")
        )
    }
}

#[test]
fn ten_cells_to_the_loads_radius_make_the_pit_of_converged_finite_elements() {
    let rated = format!(
        "{HARDENS}\nrate_coefficient = 0.002\nreference_rate = 1.0\nsoftening_exponent = 1.34\nmelting_temperature = 925.0\n\
         reference_temperature = 293.0\nheat_capacity = 885.0\ntaylor_quinney = 0.9"
    );
    let pits = [
        Pit {
            law: "law = \"perfect\"\nyield_strength = 2.5e8",
            material: ALUMINIUM,
            load: [7.5e8, 2e-4, 5e-8, 2e-7],
            expected: [1.67484e-6, 1.06332e-4, 0.0167644],
        },
        Pit {
            law: "law = \"linear\"\nyield_strength = 4e8\nhardening_modulus = 3e9",
            material: STEEL,
            load: [1.2e9, 1e-4, 4e-8, 1.6e-7],
            expected: [6.90224e-7, 5.55602e-5, 0.00977838],
        },
        Pit {
            law: "law = \"linear\"\nyield_strength = 2.5e8\nhardening_modulus = 2e9",
            material: ALUMINIUM,
            load: [1e9, 2e-4, 4e-8, 1.6e-7],
            expected: [2.92707e-6, 1.15886e-4, 0.0266656],
        },
        Pit {
            law: &rated,
            material: ALUMINIUM,
            load: [1.2e9, 2e-4, 5e-8, 2e-7],
            expected: [3.6187e-6, 1.13125e-4, 0.0335078],
        },
        Pit {
            law: HARDENS,
            material: ALUMINIUM,
            load: [1.2e9, 2e-4, 5e-8, 2e-7],
            expected: [3.77059e-6, 1.13415e-4, 0.034992],
        },
    ];
    for pit in &pits {
        for (limiter, strain_within) in [("mc", 0.03), ("none", 0.025)] {
            let place = tempfile::tempdir().unwrap();
            let summary = run(&case(&pit.text(limiter)), place.path());
            let keys = ["pit_depth_axis", "pit_radius", "plastic_strain_peak"];
            let off: Vec<f64> = keys
                .iter()
                .zip(pit.expected)
                .map(|(key, wanted)| number(&summary, key) / wanted - 1.0)
                .collect();
            eprintln!("{}, {limiter}: depth, radius, ε_p {off:.4?}", pit.law.replace('\n', ", "));
            let bars = [0.03, 0.03, strain_within];
            assert!(off.iter().zip(bars).all(|(off, bar)| off.abs() < bar), "{}: {off:?}", pit.law);
            // On the axis itself, below the surface.
            let [z, r] =
                [0, 1].map(|k| summary["plastic_strain_peak_position"][k].as_f64().expect("it has flowed"));
            assert!(r == 0.0 && z < -0.2 * pit.load[1] && z > -0.5 * pit.load[1], "({z}, {r})");
        }
    }
}

/// A load of 0.8 µs on steel that yields: depth of its pit, plastic work, largest ε_p. `initial`: the wall that it meets.
fn abrupt(amplitude: f64, grid: &str, initial: Option<&Path>, at: &Path) -> [f64; 3] {
    let initial = initial.map_or(String::new(), |run| format!("initial = \"{}\"\n", run.display()));
    let text = format!(
        "[time]\nend = 6e-6\nsnapshots = []\n[solid]\nz = [-0.016, 0.0]\nr = [0.0, 0.016]\n{grid}\n{initial}material = \"structural-steel\"\n\
         [solid.plasticity]\nlaw = \"perfect\"\n[coupling]\nscheme = \"load\"\n\
         [coupling.load]\namplitude = {amplitude:e}\nradius = 1e-3\nhistory = [[0, 0], [4e-7, 1], [8e-7, 0]]\n"
    );
    let summary = run(&case(&text), at);
    ["pit_depth", "plastic_work", "plastic_strain_peak"].map(|key| number(&summary, key))
}

/// Details of the stress say nothing of a load before it has acted. On the cells that a solid at rest has, 30 % of the pit were lost, whatever
/// the threshold.
#[test]
fn a_load_finds_fine_cells() {
    let place = tempfile::tempdir().unwrap();
    let at = |name: &str| place.path().join(name);
    let off = |adapted: [f64; 3], uniform: [f64; 3]| -> Vec<f64> {
        adapted.iter().zip(uniform).map(|(a, b)| a / b - 1.0).collect()
    };
    let uniform = abrupt(1.5e9, "cells = [128, 128]\nadapt = false", None, &at("uniform"));
    for (number, grid) in
        ["cells = [16, 16]\nlevels = 3", "cells = [32, 32]\nlevels = 2"].into_iter().enumerate()
    {
        let off = off(abrupt(1.5e9, grid, None, &at(&number.to_string())), uniform);
        eprintln!("{}: depth, work, ε_p off by {off:?}", grid.replace('\n', ", "));
        assert!(off.iter().all(|off| off.abs() < 1e-5), "{off:?}");
    }
    // A wall on which something has acted before that leaves nothing, and no fine cells either.
    let grid = "cells = [16, 16]\nlevels = 3";
    abrupt(1.0, grid, None, &at("quiet"));
    let off = off(abrupt(1.5e9, grid, Some(&at("quiet")), &at("again")), uniform);
    eprintln!("on an earlier wall: off by {off:?}");
    assert!(off.iter().all(|off| off.abs() < 1e-5), "{off:?}");
}
