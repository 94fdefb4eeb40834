//! What must hold in every cell and in every sum when a solid yields: level jumps, subcycling and adaptation included.

use mesh::{Adaptation, Domain};
use solid::plasticity::{Hardening, JohnsonCook, RateFactor, ThermalSoftening};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver, von_mises};

use crate::helpers::*;
use crate::plastic_waves::press_locally;

const STRENGTH: f64 = 4e8;

/// Steel under a Gaussian load on its surface, two levels finer where it matters.
fn dented(hardening: Option<Hardening>, adapts: bool) -> SolidSolver<8> {
    let boundaries = [Boundary::NonReflecting, Boundary::Interface, Boundary::Axis, Boundary::NonReflecting];
    let setup = SolidSetup {
        domain: Domain { geometry: AXIAL, z: [-1.0, 0.0], r: [0.0, 1.0] },
        levels: if adapts { 3 } else { 0 },
        adaptation: adapts.then(|| Adaptation::by_details(3e-3, 2)),
        plasticity: hardening,
        stress_scale: 1e9,
        ..setup(AXIAL, if adapts { [8, 8] } else { [32, 32] }, boundaries)
    };
    SolidSolver::new(setup, |_| ElasticState::default()).unwrap()
}

/// Whole steps with subcycling under A exp(−r²/b²) f(t); `after` is called at the end of each step of the finest level.
fn press(solid: &mut SolidSolver<8>, amplitude: f64, steps: usize, mut after: impl FnMut(&SolidSolver<8>)) {
    // On and off again within 60 µs.
    let load = |r: f64, t: f64| {
        let factor = (std::f64::consts::PI * t / 6e-5).sin().max(0.0);
        amplitude * factor * (-(r / 0.15).powi(2)).exp()
    };
    press_locally(solid, steps, load, |solid, _| after(solid));
}

/// The largest q/Y of a cell, at no rate.
fn beyond(solid: &SolidSolver<8>, hardening: &Hardening) -> f64 {
    let mut largest = 0.0_f64;
    for slot in 0..solid.mesh().blocks() {
        for k in 0..64 {
            let (i, j) = (k % 8, k / 8);
            let w = solid.cell(slot, i, j);
            let mises = von_mises(w.stress_zz, w.stress_zr, w.stress_rr, w.stress_phiphi);
            let strain = solid.plastic_strain(slot, i, j);
            assert!(strain >= 0.0, "{strain}");
            largest = largest.max(mises / hardening.yield_stress(strain, 0.0, solid.temperature(slot, i, j)));
        }
    }
    largest
}

/// What was given less the energy in the domain and the plastic work, J/rad.
fn dissipated(solid: &SolidSolver<8>) -> f64 {
    let totals = solid.totals();
    let given: f64 = solid.ledger().energy.iter().sum();
    given - totals.kinetic - totals.elastic - solid.plastic_ledger().work
}

#[test]
fn no_cell_is_ever_outside_its_yield_surface_and_all_plastic_work_is_counted() {
    for modulus in [0.0, 8e9] {
        let hardening = if modulus == 0.0 {
            Hardening::perfect(STRENGTH).unwrap()
        } else {
            Hardening::linear(STRENGTH, modulus).unwrap()
        };
        let mut solid = dented(Some(hardening.clone()), true);
        let (mut worst, mut meshes, mut lost) = (0.0_f64, vec![], vec![]);
        press(&mut solid, 2e9, 40, |solid| {
            worst = worst.max(beyond(solid, &hardening));
            if solid.clock().is_over() {
                lost.push((solid.mesh().generation(), dissipated(solid)));
            }
            if meshes.last() != Some(&solid.mesh().generation()) {
                meshes.push(solid.mesh().generation());
            }
        });
        let ledger = *solid.plastic_ledger();
        let (integral, levels) = (solid.plastic_strain_integral(), solid.mesh().levels_present());
        eprintln!(
            "H = {modulus:e}: q/Y - 1 = {:.1e}, {} meshes, levels {levels:?}, {ledger:?}",
            worst - 1.0,
            meshes.len()
        );
        assert!(meshes.len() > 5 && levels[0] < levels[1], "{meshes:?} {levels:?}");
        assert!(ledger.after_corrections > 0 && ledger.returns > ledger.after_corrections);
        assert!(worst > 0.999 && worst < 1.0 + 1e-10, "{worst}");
        assert!(solid.plastic_strain_max() > 1e-3, "{}", solid.plastic_strain_max());
        if modulus == 0.0 {
            // With a constant strength the work is the strength times the plastic strain, wherever that has come from.
            let off = ledger.work / (STRENGTH * integral) - 1.0;
            eprintln!("plastic work off by {off:.1e}");
            assert!(off.abs() < 1e-12, "{off}");
        }
        // The scheme itself takes energy in every step, and not much; slopes in finer cells give some.
        let (given, last) = (solid.ledger().energy[1], lost[lost.len() - 1].1);
        let on_one_grid = lost.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let grown = on_one_grid.map(|pair| pair[1].1 - pair[0].1).fold(f64::INFINITY, f64::min);
        eprintln!(
            "given {given:e}, plastic work {:e}, lost {last:e}, in a step at least {grown:e}",
            ledger.work
        );
        assert!(lost.len() > 20 && ledger.work > 0.1 * given && last < 0.1 * given);
        assert!(grown > -1e-9 * given, "{grown:e} of {given:e}");
    }
}

#[test]
fn what_yields_goes_on_bitwise_and_whatever_the_threads() {
    let law = JohnsonCook::new(STRENGTH, 5e8, 0.4).unwrap();
    let law = law
        .with_rate(RateFactor::new(0.02, 1.0).unwrap())
        .with_softening(ThermalSoftening::new(1.0, 1700.0, 293.0, 480.0, 0.9).unwrap());
    let start = || dented(Some(Hardening::JohnsonCook(law)), true);
    let mut solid = start();
    press(&mut solid, 2e9, 15, |_| ());
    assert!(solid.plastic_strain_max() > 1e-4 && solid.temperature_max() > 293.0);
    let mut again = start();
    again.restore(solid.saved()).unwrap();
    press(&mut solid, 2e9, 10, |_| ());
    press(&mut again, 2e9, 10, |_| ());
    assert!(*again.state() == *solid.state() && again.plastic_ledger() == solid.plastic_ledger());
    let follows = |solid: &SolidSolver<8>| (solid.displacements(), solid.snapshot().plastic_strain_rate);
    assert!(follows(&again) == follows(&solid));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let (state, ledger, followers) = pool.install(|| {
        let mut other = start();
        press(&mut other, 2e9, 25, |_| ());
        (other.state().clone(), *other.plastic_ledger(), follows(&other))
    });
    assert!(state == *solid.state() && ledger == *solid.plastic_ledger() && followers == follows(&solid));
}

#[test]
fn what_could_yield_but_does_not_is_elastic_to_the_last_bit() {
    for adapts in [false, true] {
        let mut elastic = dented(None, adapts);
        let mut plastic = dented(Some(Hardening::linear(STRENGTH, 1e9).unwrap()), adapts);
        press(&mut elastic, 2e8, 25, |_| ());
        press(&mut plastic, 2e8, 25, |_| ());
        assert_eq!(elastic.mesh().tree().leaves(), plastic.mesh().tree().leaves());
        for slot in 0..elastic.mesh().blocks() {
            assert!(elastic.state().block(slot) == &plastic.state().block(slot)[..6 * 64], "{slot}");
        }
        assert_eq!(*plastic.plastic_ledger(), solid::PlasticLedger::default());
        assert!(elastic.mises_peak().stress > 1e7);
    }
}
