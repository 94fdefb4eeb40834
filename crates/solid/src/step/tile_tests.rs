//! Blocks made in one sweep, four as one or each by itself, come to what their stages one after the other come to, to the last bit.

use mesh::{Adaptation, Domain, Geometry, Limiter, Tile};

use crate::Boundary::{Absorbing, Axis, Fixed, Free, NonReflecting, Periodic, Symmetry};
use crate::physics::Ways;
use crate::plasticity::{Hardening, JohnsonCook, RateFactor, Table, ThermalSoftening};
use crate::{Boundary, ElasticState, SolidSetup, SolidSolver, WaveSpeeds};

const N: usize = 8;

/// What is stepped.
#[derive(Clone, Debug)]
struct Choice {
    limiter: Limiter,
    geometry: Geometry,
    boundaries: [Boundary; 4],
    plasticity: Option<Hardening>,
    local_steps: bool,
}

/// A pulse on a grid with jumps of levels, after some steps; with how many tiles of four the last of them was made, and how many blocks
/// have yielded.
fn stepped(choice: &Choice, ways: Ways) -> (SolidSolver<N>, [usize; 2]) {
    let setup = SolidSetup {
        domain: Domain { geometry: choice.geometry, z: [-4.0, 0.0], r: [0.0, 4.0] },
        coarsest: [32, 32],
        levels: 3,
        speeds: WaveSpeeds { density: 7800.0, c1: 5990.0, c2: 3458.0 },
        yield_strength: 250e6,
        plasticity: choice.plasticity.clone(),
        limiter: choice.limiter,
        boundaries: choice.boundaries,
        adaptation: Some(Adaptation::by_details(1e-3, 4)),
        stress_scale: 1e8,
        weight: None,
        load: None,
    };
    let pulse = |[z, r]: [f64; 2], [z_0, r_0]: [f64; 2], width: f64| {
        (-((z - z_0) * (z - z_0) + (r - r_0) * (r - r_0)) / (width * width)).exp()
    };
    let initial = |at: [f64; 2]| ElasticState {
        v_z: 3.0 + 2.0 * pulse(at, [-1.0, 0.3], 0.5),
        v_r: -pulse(at, [-3.6, 3.6], 0.4),
        stress_zz: -3e8 * pulse(at, [-0.5, 0.0], 0.4),
        stress_zr: 2e7 * pulse(at, [-3.0, 3.0], 0.6),
        stress_rr: 1e7 + 1e8 * pulse(at, [-0.2, 2.0], 0.3),
        stress_phiphi: 1e7,
    };
    let mut solid = SolidSolver::<N>::new(setup, initial).expect("a solid");
    solid.model_mut().ways = ways;
    let mut fours = 0;
    for _ in 0..10 {
        if choice.local_steps {
            solid.step_locally_at(0.45).expect("a step");
        } else {
            solid.step_at(0.45).expect("a step");
        }
        let context = solid.context(0.0);
        let is_four = |tile: &&Tile| !tile.is_one() && super::can_be_swept(&context, **tile);
        fours = solid.mesh().tree().tiles().iter().filter(is_four).count();
        solid.adapt(0.0, 1);
    }
    let yielded = solid.reports().finished.iter().filter(|report| report.plastic.strain > 0.0).count();
    (solid, [fours, yielded])
}

/// Everything that a step tells of a solid.
fn all_of(solid: &SolidSolver<N>) -> impl PartialEq + std::fmt::Debug {
    let bits: Vec<u64> = solid.state().as_slice().iter().map(|value| value.to_bits()).collect();
    let mises: Vec<u64> =
        solid.reports().finished.iter().map(|report| report.mises_squared.to_bits()).collect();
    let ledgers = (*solid.ledger(), *solid.plastic_ledger(), solid.yielded_volume());
    (solid.mesh().tree().leaves().to_vec(), bits, mises, ledgers, solid.time(), solid.cell_updates())
}

#[test]
fn tiles_and_sweeps_step_as_stages_of_blocks_do_to_the_last_bit() {
    let elastic = |limiter, geometry, boundaries, local_steps| Choice {
        limiter,
        geometry,
        boundaries,
        plasticity: None,
        local_steps,
    };
    let (round, flat) = (Geometry::Axisymmetric, Geometry::Planar);
    let heat = ThermalSoftening::new(1.0, 1700.0, 293.0, 480.0, 0.9).expect("a law");
    let law = JohnsonCook::new(1.9e8, 2e8, 0.3).expect("a law");
    let law = law.with_rate(RateFactor::new(0.02, 1.0).expect("a law")).with_softening(heat);
    let table = Table::new(&[[0.0, 1.9e8], [1e-4, 2.1e8], [1e-3, 2.4e8]]).expect("a law");
    let plastic = |law, local_steps| Choice {
        plasticity: Some(law),
        ..elastic(Limiter::Mc, round, [NonReflecting, Free, Axis, Absorbing], local_steps)
    };
    for choice in [
        elastic(Limiter::Mc, round, [Absorbing, Free, Axis, Absorbing], false),
        elastic(Limiter::Minmod, round, [NonReflecting, Free, Axis, NonReflecting], true),
        elastic(Limiter::Eno, flat, [Fixed, Free, Symmetry, Absorbing], true),
        elastic(Limiter::None, flat, [Periodic, Periodic, Fixed, Free], false),
        plastic(Hardening::perfect(1.9e8).expect("a law"), true),
        plastic(Hardening::linear(1.9e8, 5e9).expect("a law"), false),
        plastic(Hardening::Table(table), true),
        plastic(Hardening::JohnsonCook(law), false),
    ] {
        let (stages, [_, yielded]) = stepped(&choice, Ways { has_tiles: false, has_sweeps: false });
        assert_eq!(yielded > 0, choice.plasticity.is_some());
        let levels = stages.mesh().levels_present();
        assert!(levels[1] > levels[0] + 1, "there are jumps of levels: {levels:?}");
        for has_tiles in [false, true] {
            let (other, [fours, _]) = stepped(&choice, Ways { has_tiles, has_sweeps: true });
            assert!(fours > 20, "{choice:?}: {fours} tiles of four");
            assert!(all_of(&other) == all_of(&stages), "{has_tiles}: {choice:?}");
        }
    }
}
