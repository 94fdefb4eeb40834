//! A solid that begins with the static stress of a half-space under a pressure that stays: it rests, to what the grid leaves out.

use mesh::{Domain, FaceState};
use solid::{Boundary, ElasticState, Harmonic, SolidSetup, SolidSolver, half_space_stress};

use crate::helpers::*;

/// Height of the charge above the surface, over which its pressure varies, m, and the pressure beneath it, Pa.
const HEIGHT: f64 = 1e-3;
const PRESSURE: f64 = 1e6;

/// The pressure P η/s of a charge, continued: h = P η/√((η + d)² + r²).
fn static_stress([z, r]: [f64; 2]) -> ElasticState {
    let along = HEIGHT - z;
    let s = along.hypot(r);
    let h = PRESSURE * HEIGHT / s;
    let harmonic = Harmonic {
        value: h,
        gradient: [h * along / (s * s), -h * r / (s * s)],
        disc_mean: 2.0 * h * s / (s + along),
        disc_mean_along_z: 2.0 * h / (s + along),
    };
    half_space_stress(&harmonic, -z, STEEL.lambda() / (2.0 * (STEEL.lambda() + STEEL.shear_modulus())))
}

/// The largest ρc₁|v| and the largest change of a stress, over the pressure, in some microseconds in which waves cross the domain.
///
/// - `is_held`: whether the sides know the stress in each cell, and not only in the last one.
fn unrest(kind: Boundary, cells: usize, is_held: bool) -> [f64; 2] {
    let initial = static_stress;
    let setup = SolidSetup {
        domain: Domain { geometry: AXIAL, z: [-6.4e-3, 0.0], r: [0.0, 6.4e-3] },
        ..setup(AXIAL, [cells; 2], [kind, Boundary::Interface, Boundary::Axis, kind])
    };
    let mut solid = match is_held {
        true => SolidSolver::<8>::under_load(setup, initial, initial),
        false => SolidSolver::<8>::new(setup, initial),
    }
    .unwrap();
    let dt = solid.time_step_limit(CFL);
    let edges = solid.interface_edges();
    let mut largest = [0.0_f64; 2];
    while solid.time() < 2.2e-6 {
        let mut traces = vec![];
        solid.traces_at_mid_step(dt, &mut traces);
        solid.interface_mut().set_all(|face| {
            let r = 0.5 * (edges[face] + if face == 0 { 0.0 } else { edges[face - 1] });
            let pressure = -initial([0.0, r]).stress_zz;
            let velocity = traces[face].velocity + (traces[face].pressure - pressure) / STEEL.z1();
            FaceState { pressure, velocity, power: pressure * velocity }
        });
        solid.step(dt).unwrap();
    }
    each_cell(&solid, |centre, w| {
        let (now, then) = (w.to_array(), initial(centre).to_array());
        largest[0] = largest[0].max(STEEL.z1() * w.v_z.hypot(w.v_r) / PRESSURE);
        largest[1] = (2..6).fold(largest[1], |most, c| most.max((now[c] - then[c]).abs() / PRESSURE));
    });
    largest
}

#[test]
fn it_rests_under_the_load_that_it_began_with() {
    for kind in [Boundary::NonReflecting, Boundary::Absorbing] {
        let [coarse, fine] = [64, 128].map(|cells| unrest(kind, cells, true));
        eprintln!("{kind:?}: velocity and stress {coarse:?}, {fine:?}");
        let uniform = unrest(kind, 64, false);
        assert!(uniform[0] > 3.0 * coarse[0], "the sides would not rest with one stress: {uniform:?}");
        assert!(fine[0] < 4e-4 && fine[1] < 4e-3, "{fine:?}");
        assert!(fine[1] < 0.3 * coarse[1], "{coarse:?} {fine:?}");
    }
}
