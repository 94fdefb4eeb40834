//! What comes back from the sides, and what rests stays at rest.

use mesh::{Domain, FaceState, Limiter, Side};
use solid::{Boundary, ElasticState, SolidSetup, SolidSolver};

use crate::helpers::*;

/// A plane P or S pulse travelling along +z, with the particle velocity exp(−((z − z₀)/a)²).
fn pulse(z: f64, shear: bool) -> ElasticState {
    let v = (-((z - 0.5) / 0.08).powi(2)).exp();
    if shear {
        return ElasticState { v_r: v, stress_zr: -STEEL.z2() * v, ..ElasticState::default() };
    }
    let stress_zz = -STEEL.z1() * v;
    let across = stress_zz * STEEL.lambda() / STEEL.p_modulus();
    ElasticState { v_z: v, stress_zz, stress_rr: across, stress_phiphi: across, ..ElasticState::default() }
}

/// Velocity and stress of the pulse, of amplitude 1 each.
fn parts(w: ElasticState, shear: bool) -> [f64; 2] {
    if shear { [w.v_r, -w.stress_zr / STEEL.z2()] } else { [w.v_z, -w.stress_zz / STEEL.z1()] }
}

/// Sends the pulse against z_max and back to where it started; gives (reflected/incident) of velocity and
/// stress by their sums over the cells, and the largest of either that is left.
fn reflected(kind: Boundary, shear: bool) -> ([f64; 2], f64) {
    let cells = 128;
    let mut boundaries = [Boundary::NonReflecting, kind, Boundary::Periodic, Boundary::Periodic];
    if kind == Boundary::Interface {
        boundaries[1] = Boundary::Interface;
    }
    let setup = SolidSetup {
        domain: Domain { geometry: PLANAR, z: [0.0, 1.0], r: [0.0, 8.0 / cells as f64] },
        ..setup(PLANAR, [cells, 8], boundaries)
    };
    let mut solid = SolidSolver::<8>::new(setup, |[z, _]| pulse(z, shear)).unwrap();
    let sums = |solid: &SolidSolver<8>| {
        let (mut sums, mut largest) = ([0.0; 2], 0.0_f64);
        each_cell(solid, |_, w| {
            for (sum, part) in sums.iter_mut().zip(parts(w, shear)) {
                *sum += part;
                largest = largest.max(part.abs());
            }
        });
        (sums, largest)
    };
    let (incident, _) = sums(&solid);
    run_to(&mut solid, 1.0 / if shear { STEEL.c2 } else { STEEL.c1 });
    let (back, largest) = sums(&solid);
    ([back[0] / incident[0], back[1] / incident[1]], largest)
}

#[test]
fn plane_waves_at_normal_incidence() {
    for shear in [false, true] {
        // (velocity, stress): a free surface turns the stress round, a clamped one the velocity; a plane of
        // symmetry clamps P waves and frees S waves.
        let symmetry = if shear { [1.0, -1.0] } else { [-1.0, 1.0] };
        for (kind, want) in
            [(Boundary::Free, [1.0, -1.0]), (Boundary::Fixed, [-1.0, 1.0]), (Boundary::Symmetry, symmetry)]
        {
            let (got, largest) = reflected(kind, shear);
            eprintln!("{kind:?}, shear {shear}: reflected {got:?}, peak {largest:.4}");
            // The sums are what the boundary gives back, free of the scheme's dispersion; the tails of the
            // pulse are 1e-9. The peak loses the 3 % that MC takes at 10 cells per width on 128 cells' way.
            for (got, want) in got.into_iter().zip(want) {
                assert!((got - want).abs() < 1e-6, "{kind:?} {shear}: {got} {want}");
            }
            assert!((largest - 1.0).abs() < 0.05);
        }
        for kind in [Boundary::NonReflecting, Boundary::Absorbing] {
            let (_, left) = reflected(kind, shear);
            eprintln!("{kind:?}, shear {shear}: left {left:.1e}");
            // Asked is 1 %; only the slopes of the last cells differ from those within.
            assert!(left < 2e-3, "{left}");
        }
    }
}

/// All cells, `[j][i]`, of n × n ones within sides of a kind, after a lump has gone to them and halfway back.
fn in_a_box(kind: Boundary, limiter: Limiter, n: usize) -> Vec<Vec<[f64; 6]>> {
    let lump = |[z, r]: [f64; 2]| {
        let stress = STEEL.z1() * (-((z - 0.3) / 0.1).powi(2) - ((r - 0.65) / 0.1).powi(2)).exp();
        ElasticState {
            stress_zz: stress,
            stress_rr: stress,
            stress_phiphi: stress,
            ..ElasticState::default()
        }
    };
    let mut solid =
        SolidSolver::<8>::new(SolidSetup { limiter, ..setup(PLANAR, [n, n], [kind; 4]) }, lump).unwrap();
    run_to(&mut solid, 1.3 / STEEL.c1);
    global(&solid, n)
}

/// What is not zero on a side has a slope there, too: of the cells next to it the limiter must not find none.
#[test]
fn waves_keep_second_order_beside_free_and_clamped_sides() {
    const FINE: usize = 256;
    for kind in [Boundary::Free, Boundary::Fixed] {
        let fine = in_a_box(kind, Limiter::None, FINE);
        let errors = [64, 128].map(|n| {
            let (cells, parts) = (in_a_box(kind, Limiter::Mc, n), FINE / n);
            relative_l1(|compare| {
                let beside = |k: usize| k == 0 || k == n - 1;
                for (j, i) in (0..n * n).map(|k| (k / n, k % n)).filter(|&(j, i)| beside(j) || beside(i)) {
                    // Velocities as the stresses of their waves.
                    let weighed = |w: &[f64; 6]| {
                        std::array::from_fn::<_, 6, _>(|c| if c < 2 { STEEL.z1() * w[c] } else { w[c] })
                    };
                    let mut mean = [0.0; 6];
                    for part in
                        (0..parts * parts).map(|k| &fine[j * parts + k / parts][i * parts + k % parts])
                    {
                        mean.iter_mut()
                            .zip(weighed(part))
                            .for_each(|(sum, w)| *sum += w / (parts * parts) as f64);
                    }
                    compare(&weighed(&cells[j][i]), &mean);
                }
            })
        });
        // By mirror images of what is even 1.5 and 1.4.
        assert!(order(&format!("cells beside {kind:?} sides"), &errors) > 1.9, "{errors:?}");
    }
}

#[test]
fn pre_stress_stays_at_rest_bitwise() {
    let p = 5e7;
    let uniaxial = ElasticState { stress_zz: -p, ..ElasticState::default() };
    let hydrostatic = ElasticState { stress_rr: -p, stress_phiphi: -p, ..uniaxial };
    use Boundary::{Absorbing, Axis, Fixed, Free, Interface, NonReflecting, Periodic, Symmetry};
    for (geometry, state, boundaries) in [
        (AXIAL, uniaxial, [NonReflecting, Interface, Axis, Free]),
        (AXIAL, uniaxial, [NonReflecting, Interface, Axis, NonReflecting]),
        (AXIAL, uniaxial, [Fixed, NonReflecting, Axis, Free]),
        (PLANAR, uniaxial, [Symmetry, Interface, Free, Free]),
        (AXIAL, hydrostatic, [NonReflecting, Interface, Axis, NonReflecting]),
        (AXIAL, hydrostatic, [Fixed, Symmetry, Axis, Fixed]),
        (AXIAL, hydrostatic, [Symmetry, NonReflecting, Axis, Symmetry]),
        (PLANAR, hydrostatic, [Symmetry, NonReflecting, Fixed, Symmetry]),
        (PLANAR, hydrostatic, [Periodic, Periodic, NonReflecting, Fixed]),
        (AXIAL, uniaxial, [Absorbing, Interface, Axis, Absorbing]),
        (AXIAL, hydrostatic, [Absorbing, Interface, Axis, Absorbing]),
        (PLANAR, hydrostatic, [Absorbing, Absorbing, Absorbing, Absorbing]),
        (PLANAR, ElasticState::default(), [Free; 4]),
    ] {
        for limiter in [Limiter::Mc, Limiter::Minmod] {
            let setup = SolidSetup { limiter, ..setup(geometry, [16, 16], boundaries) };
            let mut solid = SolidSolver::<8>::new(setup, |_| state).unwrap();
            let start = solid.state().clone();
            for _ in 0..if boundaries[0] == Absorbing { 3000 } else { 20 } {
                solid.interface_mut().set_all(|_| FaceState {
                    pressure: p,
                    velocity: 0.0,
                    power: 0.0,
                    ..FaceState::default()
                });
                solid.step_at(CFL).unwrap();
            }
            assert!(*solid.state() == start, "{geometry:?} {state:?} {boundaries:?} {limiter:?}");
        }
    }
    assert_eq!(Side::ZMax as usize, 1, "the surface is the second side");
}
