//! Four blocks stepped as one come to what they come to one by one, to the last bit.

use mesh::{Adaptation, Domain, Geometry, Limiter, Tile};

use crate::Boundary::{Axis, Inflow, NonReflecting, Periodic, Wall};
use crate::boundary::history::PressureHistory;
use crate::{
    Boundary, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Model, Phase, PhaseState, Region,
    RiemannSolver, Scales, Shape,
};

const N: usize = 8;

/// A bubble under a wave, on a grid with jumps of levels, after some steps; with how many tiles of four the last of them was made.
fn stepped(
    (model, riemann, limiter): (Model, RiemannSolver, Limiter),
    boundaries: [Boundary; 4],
    local_steps: bool,
    has_tiles: bool,
) -> (FluidSolver<N>, usize) {
    let setup = FluidSetup {
        model,
        riemann,
        limiter,
        levels: 3,
        adaptation: Some(Adaptation::by_details(1e-3, 4)),
        scales: Scales { pressure: 5e7, density: 1e3 },
        inflow: PressureHistory::new(vec![[0.0, 5e7], [1e-5, 7e7]]),
        ..FluidSetup::new(
            Domain { geometry: Geometry::Axisymmetric, z: [0.0, 4.0], r: [0.0, 4.0] },
            [32, 32],
            boundaries,
        )
    };
    let state = |phase, density, pressure, velocity| PhaseState { phase, density, pressure, velocity };
    let sphere = |z: f64, r: f64, radius: f64, state: PhaseState| Region {
        shape: Shape::Sphere { centre: [z, r], radius },
        state,
    };
    let initial = InitialCondition {
        ambient: state(Phase::Liquid, 1000.0, 5e7, [5.0, -3.0]),
        pressure: InitialPressure::Uniform,
        regions: vec![
            sphere(1.0, 0.0, 0.4, state(Phase::Gas, 0.0266, 2118.0, [0.0; 2])),
            sphere(3.0, 0.0, 0.5, state(Phase::Liquid, 1010.0, 9e7, [0.0; 2])),
        ],
        pulses: vec![],
    };
    let mut fluid = FluidSolver::<N>::new(&setup, &initial).expect("a fluid");
    fluid.model_mut().has_tiles = has_tiles;
    let mut fours = 0;
    for _ in 0..10 {
        if local_steps {
            fluid.step_locally_at(0.45).expect("a step");
        } else {
            fluid.step_at(0.45).expect("a step");
        }
        let context = fluid.context(0.0);
        let is_four = |tile: &&Tile| !tile.is_one() && super::is_one(&context, **tile);
        fours = fluid.mesh().tree().tiles().iter().filter(is_four).count();
        fluid.adapt(0.0, 1);
    }
    (fluid, fours)
}

#[test]
fn tiles_step_as_their_blocks_do_to_the_last_bit() {
    let closed = [Wall, Wall, Axis, Wall];
    let open = [NonReflecting, Inflow, Axis, NonReflecting];
    let around = [Periodic, Periodic, Axis, Wall];
    let (hllc, exact, slow) = (RiemannSolver::Hllc, RiemannSolver::Exact, RiemannSolver::HllcLowMach);
    for (choices, boundaries, local_steps) in [
        ((Model::SaurelAbgrall, hllc, Limiter::Minmod), closed, false),
        ((Model::SaurelAbgrall, exact, Limiter::Mc), open, true),
        ((Model::FiveEquation, hllc, Limiter::Mc), around, true),
        ((Model::FiveEquation, slow, Limiter::Minmod), closed, true),
        ((Model::FiveEquation, exact, Limiter::Mc), open, false),
    ] {
        let run = |has_tiles| stepped(choices, boundaries, local_steps, has_tiles);
        let ((tiles, fours), (blocks, none)) = (run(true), run(false));
        assert!(fours > 20 && none == 0, "{choices:?}: {fours} tiles of four");
        let levels = tiles.mesh().levels_present();
        assert!(levels[1] > levels[0] + 1, "there are jumps of levels");
        assert_eq!(tiles.mesh().tree().leaves(), blocks.mesh().tree().leaves());
        let bits = |fluid: &FluidSolver<N>| -> Vec<u64> {
            fluid.state().as_slice().iter().map(|value| value.to_bits()).collect()
        };
        assert_eq!(bits(&tiles), bits(&blocks), "{choices:?}");
        let of = |fluid: &FluidSolver<N>| (fluid.time(), *fluid.ledger(), fluid.cell_updates());
        assert_eq!(of(&tiles), of(&blocks));
        let speeds = |fluid: &FluidSolver<N>| fluid.largest_speeds();
        assert_eq!(speeds(&tiles), speeds(&blocks));
        let (mut of_tiles, mut of_blocks) = (tiles.fixups(), blocks.fixups());
        // A ghost that lies beside two of a tile's blocks is predicted once.
        (of_tiles.clips.limited_predictions, of_blocks.clips.limited_predictions) = (0, 0);
        assert_eq!(of_tiles, of_blocks);
    }
}
