//! Pits under a Gaussian load in space and time, P exp(−(r/a)²) exp(−((t − t₀)/τ)²), against converged finite elements.

use std::f64::consts::TAU;

use mesh::{Adaptation, Domain};
use solid::plasticity::{Hardening, JohnsonCook, RateFactor, ThermalSoftening};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

use crate::helpers::*;
use crate::plastic_waves::{ALUMINIUM, press, press_locally};

struct Pit {
    name: &'static str,
    speeds: WaveSpeeds,
    law: Hardening,
    /// P (Pa), a (m), τ, t₀ (s).
    load: [f64; 4],
    /// Largest ε_p; ∫ ε_p dV, volume of ε_p > 1e-4, m³; plastic work, J; u_z on the axis at the end, m.
    expected: [f64; 5],
}

/// Relative errors of what is expected, with so many cells to a.
fn errors(pit: &Pit, cells: usize) -> [f64; 5] {
    const REACH: usize = 8;
    let [pressure, a, duration, peak] = pit.load;
    let boundaries = [Boundary::Absorbing, Boundary::Interface, Boundary::Axis, Boundary::Absorbing];
    let reach = REACH as f64 * a;
    let setup = SolidSetup {
        domain: Domain { geometry: AXIAL, z: [-reach, 0.0], r: [0.0, reach] },
        speeds: pit.speeds,
        plasticity: Some(pit.law.clone()),
        ..setup(AXIAL, [REACH * cells; 2], boundaries)
    };
    let mut solid = SolidSolver::<8>::new(setup, |_| ElasticState::default()).unwrap();
    let load = |r: f64, t: f64| pressure * (-(r / a).powi(2) - ((t - peak) / duration).powi(2)).exp();
    let end = peak + 3.5 * duration + 8.0 * a / pit.speeds.c1;
    let (mut depth, mut rate) = (0.0, 0.0_f64);
    press(&mut solid, end, load, |solid, dt| {
        depth += dt * solid.interface().states()[0].velocity;
        rate = solid.snapshot().plastic_strain_rate.into_iter().fold(rate, f64::max);
    });
    assert!(
        (rate / solid.plastic_ledger().rate_peak - 1.0).abs() < 1e-12,
        "the field is what the ledger has"
    );
    assert!(solid.snapshot().plastic_strain_rate.iter().all(|rate| *rate == 0.0), "nothing flows any more");
    below_the_surface(&solid, depth, cells);
    let found = [
        solid.plastic_strain_peak().expect("it has flowed").strain,
        TAU * solid.plastic_strain_integral(),
        solid.plastic_zone(1e-4).volume,
        TAU * solid.plastic_ledger().work,
        depth,
    ];
    std::array::from_fn(|k| found[k] / pit.expected[k] - 1.0)
}

/// u_z of the surface on the axis, continued by a parabola from the cells below; `widths`: theirs, m.
fn under_the_axis(solid: &SolidSolver<8>, [h_z, h_r]: [f64; 2]) -> f64 {
    let moved = |k: usize| {
        let (slot, i, j) =
            solid.mesh().locate([-(k as f64 + 0.5) * h_z, 0.5 * h_r]).expect("within the solid");
        solid.displacement(slot, i, j).expect("it can yield")[0]
    };
    let [first, second, third] = [0, 1, 2].map(moved);
    (15.0 * first - 10.0 * second + 3.0 * third) / 8.0
}

/// What is kept of the cells' own motion fits that of the surface and their strains.
fn below_the_surface(solid: &SolidSolver<8>, depth: f64, cells: usize) {
    let place = |point| solid.mesh().locate(point).expect("within the solid");
    let [h_z, h_r] = solid.mesh().widths(0);
    let continued = under_the_axis(solid, [h_z, h_r]);
    // The cells move otherwise than the surface by what the scheme dissipates: 5 % and 2 % at 10 and 20 cells at the most.
    assert!((continued / depth - 1.0).abs() < 0.6 / cells as f64, "{cells}: {continued:e} of {depth:e}");
    // u_r is odd in r: next to the axis it is small.
    let (slot, i, j) = place([-0.5 * h_z, 0.5 * h_r]);
    let first = solid.displacement(slot, i, j).expect("it can yield");
    assert!(first[1].abs() < 0.1 * first[0].abs(), "{first:?}");
    // No plastic volume: the divergence is the elastic one, −p/K.
    let (slot, i, j) = place([-4.5 * h_z, 4.5 * h_r]);
    let at = |i: usize, j: usize| solid.displacement(slot, i, j).expect("it can yield");
    let r = solid.mesh().centre(solid.mesh().tree().leaves()[slot], i, j)[1];
    let divergence = (at(i + 1, j)[0] - at(i - 1, j)[0]) / (2.0 * h_z)
        + (at(i, j + 1)[1] * (r + h_r) - at(i, j - 1)[1] * (r - h_r)) / (2.0 * h_r * r);
    let w = solid.cell(slot, i, j);
    let speeds = solid.setup().speeds;
    let bulk = speeds.p_modulus() - 4.0 / 3.0 * speeds.shear_modulus();
    let volume = (w.stress_zz + w.stress_rr + w.stress_phiphi) / (3.0 * bulk);
    let strain = solid.plastic_strain(slot, i, j);
    assert!((divergence - volume).abs() < 0.03 * strain, "{divergence:e} of {volume:e}, ε_p {strain:e}");
}

#[test]
fn pits_have_the_plastic_strain_and_depth_of_converged_finite_elements() {
    let heat = ThermalSoftening::new(1.34, 925.0, 293.0, 885.0, 0.9).unwrap();
    let hardens = JohnsonCook::new(3.24e8, 1.14e8, 0.42).unwrap();
    let rated = hardens.with_rate(RateFactor::new(0.002, 1.0).unwrap()).with_softening(heat);
    let pits = [
        Pit {
            name: "aluminium, perfect",
            speeds: ALUMINIUM,
            law: Hardening::perfect(2.5e8).unwrap(),
            load: [7.5e8, 2e-4, 5e-8, 2e-7],
            expected: [0.0167644, 1.59592e-13, 4.91108e-11, 3.98951e-5, -1.6705e-6],
        },
        Pit {
            name: "steel, linear",
            speeds: STEEL,
            law: Hardening::linear(4e8, 3e9).unwrap(),
            load: [1.2e9, 1e-4, 4e-8, 1.6e-7],
            expected: [0.00977838, 1.70076e-14, 8.45469e-12, 6.89986e-6, -6.89469e-7],
        },
        Pit {
            name: "aluminium, linear",
            speeds: ALUMINIUM,
            law: Hardening::linear(2.5e8, 2e9).unwrap(),
            load: [1e9, 2e-4, 4e-8, 1.6e-7],
            expected: [0.0266656, 3.42498e-13, 8.00503e-11, 8.87295e-5, -2.91627e-6],
        },
        Pit {
            name: "aluminium, Johnson-Cook",
            speeds: ALUMINIUM,
            law: Hardening::JohnsonCook(rated),
            load: [1.2e9, 2e-4, 5e-8, 2e-7],
            expected: [0.0335078, 4.17512e-13, 7.71401e-11, 1.43436e-4, -3.60872e-6],
        },
        Pit {
            name: "aluminium, hardening alone",
            speeds: ALUMINIUM,
            law: Hardening::JohnsonCook(hardens),
            load: [1.2e9, 2e-4, 5e-8, 2e-7],
            expected: [0.034992, 4.44412e-13, 8.00573e-11, 1.49253e-4, -3.7608e-6],
        },
    ];
    for pit in &pits {
        let all = [10, 20].map(|cells| errors(pit, cells));
        for (cells, errors) in [10, 20].into_iter().zip(&all) {
            eprintln!("{}, {cells} cells: {errors:.4?}", pit.name);
        }
        // The largest plastic strain is that of the field, the volume is counted in cells; the rest are integrals.
        for (k, bars) in
            [[0.025, 0.015], [0.03, 0.01], [0.04, 0.025], [0.03, 0.01], [0.03, 0.015]].iter().enumerate()
        {
            for (errors, bar) in all.iter().zip(bars) {
                assert!(errors[k].abs() < *bar, "{}: {k}: {all:?}", pit.name);
            }
        }
        assert!(all[1][1].abs() < 0.35 * all[0][1].abs(), "{}: second order: {all:?}", pit.name);
    }
}

/// The cells' displacement of an adaptive solid whose levels make steps of their own, against that of one whose finest cells are everywhere,
/// and against what its surface has gone.
#[test]
fn displacement_is_as_good_where_the_grid_adapts_and_levels_step_by_themselves() {
    let (a, duration, peak) = (2e-4, 5e-8, 2e-7);
    let load = |r: f64, t: f64| 7.5e8 * (-(r / a).powi(2) - ((t - peak) / duration).powi(2)).exp();
    let start = |levels: u8| {
        let boundaries = [Boundary::Absorbing, Boundary::Interface, Boundary::Axis, Boundary::Absorbing];
        let setup = SolidSetup {
            domain: Domain { geometry: AXIAL, z: [-6.4 * a, 0.0], r: [0.0, 6.4 * a] },
            levels,
            adaptation: Some(Adaptation::by_details(1e-3, 2)).filter(|_| levels > 0),
            plasticity: Some(Hardening::perfect(2.5e8).unwrap()),
            speeds: ALUMINIUM,
            stress_scale: 1e9,
            ..setup(AXIAL, [64 >> levels; 2], boundaries)
        };
        SolidSolver::<8>::new(setup, |_| ElasticState::default()).unwrap()
    };
    let points = [[-0.1, 0.1], [-0.5, 0.7], [-1.3, 0.1], [-0.1, 1.6], [-2.1, 1.3], [-3.0, 3.0]];
    let displacements = |solid: &SolidSolver<8>| {
        points.map(|point| {
            let (slot, i, j) = solid.mesh().locate(point.map(|x| x * a)).unwrap();
            solid.displacement(slot, i, j).unwrap()
        })
    };
    let (mut uniform, mut adaptive) = (start(0), start(3));
    let (mut depth, mut jumps) = (0.0, 0);
    for end in [2e-7, 3e-7, 5e-7, 6e-7] {
        while adaptive.time() < end {
            press_locally(&mut adaptive, 1, load, |solid, dt| {
                if dt > 0.0 {
                    depth += dt * solid.interface().states()[0].velocity;
                }
            });
            let [low, high] = adaptive.mesh().levels_present();
            jumps += usize::from(low < high);
        }
        press(&mut uniform, adaptive.time(), load, |_, _| ());
        for ((point, own), whole) in points.iter().zip(displacements(&adaptive)).zip(displacements(&uniform))
        {
            let off = [own[0] - whole[0], own[1] - whole[1]].map(|off| (off / depth).abs());
            eprintln!("{point:?} at {end:e} s: off {off:.4?}");
            // What adaptation leaves out is 0.8 %. Where whole steps were counted, it was 3.6 %.
            assert!(off.iter().all(|off| *off < 0.012), "{point:?} at {end:e} s: {own:?} of {whole:?}");
        }
        let continued = under_the_axis(&adaptive, uniform.mesh().widths(0));
        assert!((continued / depth - 1.0).abs() < 0.05, "{continued:e} of {depth:e} at {end:e} s");
    }
    assert!(jumps > 50 && adaptive.cell_updates() < adaptive.common_updates(), "{jumps}");
}
