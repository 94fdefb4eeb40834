//! Tests of the rows against the scalar solver.

use super::*;
use crate::reconstruction::dispersion::{AlongFaces, Dispersion};
use crate::riemann::exact_riemann::tests::{Random, extreme, reference};
use crate::riemann::exact_riemann::{Side, sample, star_state};
use crate::riemann::hllc::Face;
use crate::state::PrimitiveCell;
use crate::state::primitive::{PHI, PRESSURE, RHO, V_N, V_T};
use crate::two_phase::FaceState;

/// The first lane of a chunk solved: pressure, velocity of the contact, flux; and whether it counts.
fn solve_one(left: PrimitiveCell, right: PrimitiveCell, mixture: &Mixture) -> (f64, f64, Face, bool) {
    let mut chunk = Chunk::zeros();
    for (sides, state) in [(&mut chunk.left, left), (&mut chunk.right, right)] {
        [sides.rho[0], sides.u[0], sides.v[0], sides.p[0], sides.phi[0]] = state;
        sides.gas_share[0] = state[PHI];
    }
    let solve = if mixture.has_covolume() { solve::<true, true> } else { solve::<true, false> };
    let mut out = [[0.0]; 6];
    let [mass, velocity, pressure, shear, energy, phi] = &mut out;
    let (mut compression, mut solved) = ([0.0; LANES], [0.0; LANES]);
    let (more, ok) = (&mut compression, &mut solved);
    let is_solved = solve(1, &mut chunk, mixture, mass, velocity, pressure, shear, energy, phi, more, ok);
    let [[mass], [velocity], [pressure], [shear], [energy], [phi]] = out;
    let (p, u) = if chunk.weak.is_weak[0] != 0.0 {
        (chunk.weak.p[0], chunk.weak.u[0])
    } else {
        (chunk.p[0], 0.5 * ((chunk.left.u[0] - chunk.f_left[0]) + (chunk.right.u[0] + chunk.f_right[0])))
    };
    let face = Face { mass, velocity, pressure, shear, energy, phi, compression: compression[0] };
    (p, u, face, is_solved)
}

/// Asserts that a problem has the scalar solver's star state to 1e-9; says whether the rows solve it.
///
/// `round_off` is the share of the largest speeds and pressures that either solver may lose.
fn compare(left: &Side, right: &Side, round_off: f64) -> bool {
    let mixture = Mixture::new(left.law(), right.law());
    let state = |s: &Side, phi: f64| [s.rho, s.u, 5.0, s.p, phi];
    let (l, r) = (state(left, 0.0), state(right, 1.0));
    let (p, u, face, solved) = solve_one(l, r, &mixture);
    if !solved {
        return false;
    }
    let star = star_state(left, right);
    assert!(!star.vacuum, "{left:?} {right:?}");
    let (a, b) = (left.sound_speed(), right.sound_speed());
    let speeds = a + b + left.u.abs() + right.u.abs();
    let pressures = left.p.abs() + right.p.abs() + left.pi + right.pi;
    assert!(
        (p - star.p).abs() <= 1e-9 * star.p.abs() + round_off * pressures,
        "{p} {star:?} {left:?} {right:?}"
    );
    let u_size = star.u.abs().max(a.min(b));
    assert!((u - star.u).abs() <= 1e-9 * u_size + round_off * speeds, "{u} {star:?} {left:?} {right:?}");
    // Where the sign of a small velocity is one of round-off, either side may be upwind.
    if star.u.abs() > 1e-9 * u_size + round_off * speeds {
        let want = flux_exact(l, r, [0.0, 1.0], &mixture);
        assert_eq!(face.phi, want.phi);
        let (rho, rho_want) = (face.mass / face.velocity, want.mass / want.velocity);
        assert!((rho - rho_want).abs() <= 1e-9 * rho_want, "{rho} {rho_want} {left:?} {right:?}");
        assert!(
            (face.compression - want.compression).abs() <= 1e-9 * want.compression,
            "{face:?} {want:?} {left:?} {right:?}"
        );
        let scale =
            want.velocity.abs().max(1e-3 * u_size) * (want.energy / want.velocity).abs().max(pressures);
        assert!((face.energy - want.energy).abs() <= (1e-8 + 10.0 * round_off) * scale, "{face:?} {want:?}");
    }
    true
}

#[test]
fn reference_and_extreme_states_are_the_scalar_solver_s() {
    for case in reference().iter().chain(&extreme()) {
        let solved = compare(&case.left, &case.right, 4.0 * f64::EPSILON);
        eprintln!("{:28} {}", case.name, if solved { "solved" } else { "left to the scalar solver" });
        let star = star_state(&case.left, &case.right);
        let fan = sample(&case.left, &case.right, &star, 0.0).in_fan;
        let softer = if case.left.pi < case.right.pi { case.left } else { case.right };
        let near_vacuum = star.shifted < 1e-6 * (softer.p + softer.pi);
        assert!(solved || fan || near_vacuum, "{}", case.name);
    }
}

#[test]
fn random_states_are_the_scalar_solver_s() {
    let mut random = Random(11);
    let (mut solved, total) = (0, 300_000);
    for _ in 0..total {
        let (left, right) = random.problem();
        solved += usize::from(compare(&left, &right, 1e-12));
    }
    eprintln!("{solved} of {total} solved in rows");
    assert!(solved > total / 2, "{solved}");
}

fn water_and_gas() -> Mixture {
    Mixture::water_and_air()
}

/// Padded rows of mixed states with jumps up to a thousandfold, and something that is no state.
fn rows(random: &mut Random, len: usize) -> ([Vec<f64>; 5], [Vec<f64>; 5], Vec<f64>) {
    let (mut half, mut differences) = (<[Vec<f64>; 5]>::default(), <[Vec<f64>; 5]>::default());
    let mut keep = vec![];
    for k in 0..len {
        let phi = [0.0, 1.0, random.uniform(0.0, 1.0)][(random.bits() % 3) as usize];
        let p = if k % 97 == 13 { -1e12 } else { random.log_uniform(1e5, 1e8) };
        let rho = 1000.0 * (1.0 - phi) + 1.2 * phi;
        for (c, value) in
            [rho, random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), p, phi].into_iter().enumerate()
        {
            half[c].push(value);
            differences[c].push(if c == 4 { 0.0 } else { 0.2 * value * random.uniform(-1.0, 1.0) });
        }
        keep.push([0.0, 0.5, 1.0][(random.bits() % 3) as usize]);
    }
    (half, differences, keep)
}

#[test]
fn rows_equal_the_scalar_flux_and_do_not_depend_on_their_company() {
    let (stride, mixture) = (20, water_and_gas());
    let len = stride * stride;
    let (half, differences, keep) = rows(&mut Random(12), len);
    let cells = Reconstruction {
        half: half.each_ref().map(|row| &row[..]),
        differences: differences.each_ref().map(|row| &row[..]),
        keep: &keep,
        sound: &vec![1.0; len],
        gas_shares: &half[4],
        with_gas: true,
        // Of so fast a sound nothing is left out.
        dispersion: Dispersion { per_speed: 1.0, ..Dispersion::default() },
        along_faces: AlongFaces::new([&differences[1], &differences[3]], 1),
    };
    fn real(k: usize, step: usize) -> bool {
        k % 97 != 13 && (k + step) % 97 != 13
    }
    for step in [1, stride] {
        let solve = |range: std::ops::Range<usize>| {
            let mut faces = FaceRows::zeros(len, stride);
            let used: Vec<f64> = (0..len).map(|k| if real(k, step) { 1.0 } else { 0.0 }).collect();
            exact_faces(&cells, step, stride, range, &used, &mixture, &mut faces);
            faces
        };
        let faces = solve(41..358);
        let of = |f: &FaceRows, k: usize| {
            [f.mass[k], f.velocity[k], f.pressure[k], f.shear[k], f.energy[k], f.phi[k]]
        };
        for k in (41..358).filter(|k| real(*k, step)) {
            let want =
                flux_exact(cells.face_state(k, 1.0), cells.face_state(k + step, -1.0), [0.0; 2], &mixture);
            let want = [want.mass, want.velocity, want.pressure, want.shear, want.energy, want.phi];
            for (got, want) in of(&faces, k).into_iter().zip(want) {
                assert!((got - want).abs() <= 1e-9 * want.abs() + 1e-300, "{got} {want} at {k}");
            }
        }
        for first in [49, 60, 199] {
            let others = solve(first..first + 3);
            for k in (first..first + 3).filter(|k| real(*k, step)) {
                assert_eq!(of(&others, k), of(&faces, k));
            }
        }
    }
}

/// The fluxes between neighbours of a row of cells without slopes.
fn faces_of(states: &[PrimitiveCell], mixture: &Mixture, with_gas: bool) -> Vec<[f64; 6]> {
    let row = |c: usize| -> Vec<f64> { states.iter().map(|state| state[c]).collect() };
    let (half, nothing, len) = ([0, 1, 2, 3, 4].map(row), vec![0.0; states.len()], states.len());
    let cells = Reconstruction {
        half: half.each_ref().map(|row| &row[..]),
        differences: [&nothing[..]; 5],
        keep: &nothing,
        sound: &vec![1.0; len],
        gas_shares: &half[4],
        with_gas,
        dispersion: Dispersion { per_speed: 1.0, ..Dispersion::default() },
        along_faces: AlongFaces::new([&nothing, &nothing], 0),
    };
    let mut faces = FaceRows::zeros(len, 0);
    exact_faces(&cells, 1, 0, 0..len - 1, &vec![1.0; len], mixture, &mut faces);
    let of = |k: usize| faces.fluxes().map(|row| row[k]);
    (0..len - 1).map(of).collect()
}

/// Waves below and above the strength at which series take the place of powers and roots, in water and in gas.
#[test]
fn weak_waves_are_the_scalar_solver_s_also_beside_strong_ones() {
    let (mixture, mut random) = (water_and_gas(), Random(3));
    for strength in [1e-9, 1e-6, 1e-4, 1e-3, 2e-3, 4e-3, 1e-2] {
        let mut states: Vec<PrimitiveCell> = (0..97)
            .map(|k| {
                let phi = f64::from(u32::from(k >= 48));
                let (rho, p, base, c) =
                    if phi == 0.0 { (1000.0, 5e7, 3.5e8, 1582.0) } else { (1.2, 1e5, 1e5, 342.0) };
                let mut some = || strength * random.uniform(-1.0, 1.0);
                [rho * (1.0 + some()), c * some(), 3.0, p + base * some(), phi]
            })
            .collect();
        let weak = faces_of(&states, &mixture, true);
        for (k, found) in weak.iter().enumerate().filter(|(k, _)| *k != 47) {
            let want = flux_exact(states[k], states[k + 1], [0.0; 2], &mixture);
            let want = [want.mass, want.velocity, want.pressure, want.shear, want.energy, want.phi];
            for (c, (found, want)) in found.iter().zip(want).enumerate() {
                // Mass, velocity and what they carry are differences of larger numbers.
                let [rho, _, _, p, _] = states[k];
                let speed = if k < 48 { 1582.0 } else { 342.0 };
                let scale = [rho * speed, speed, p, 3.0 * rho * speed, speed * 2e9 * p / 5e7, 1.0][c];
                assert!((found - want).abs() <= 1e-13 * scale, "{strength}, face {k}, {c}: {found} {want}");
            }
        }
        // One strong wave in each chunk, and the others are what they were.
        for k in (15..97).step_by(LANES) {
            states[k][PRESSURE] *= 3.0;
        }
        let with_strong = faces_of(&states, &mixture, true);
        let is_between_old = |k: &usize| k % LANES != 15 && k % LANES != 14;
        for k in (0..96).filter(is_between_old) {
            assert_eq!(with_strong[k], weak[k], "{strength}, face {k}");
        }
    }
}

/// Weak and strong waves in the liquid, by the kernel that knows of no gas and by that which does.
#[test]
fn liquid_has_the_same_fluxes_with_and_without_gas_elsewhere() {
    let (mixture, mut random) = (water_and_gas(), Random(8));
    let states: Vec<PrimitiveCell> = (0..20 * LANES)
        .map(|k| {
            let strength = if k / LANES % 3 == 2 && k % 7 == 0 { 0.5 } else { 1e-3 };
            let mut some = || strength * random.uniform(-1.0, 1.0);
            [1000.0 * (1.0 + some()), 1582.0 * some(), 3.0, 5e7 + 3.5e8 * some(), 0.0]
        })
        .collect();
    assert_eq!(faces_of(&states, &mixture, false), faces_of(&states, &mixture, true));
}

/// Weak waves between two laws: waters of different gas content, and water and gas.
#[test]
fn weak_waves_between_two_laws_are_the_scalar_solver_s() {
    let (mixture, mut random) = (water_and_gas(), Random(4));
    let mut found = 0;
    for strength in [1e-8, 1e-5, 3e-4, 1e-3] {
        for _ in 0..2000 {
            let phi = [0.0, 1.0, random.uniform(0.0, 1.0), random.uniform(0.0, 0.01)];
            let mut some = || strength * random.uniform(-1.0, 1.0);
            let [l, r] = [phi[some().to_bits() as usize % 4], phi[some().to_bits() as usize % 4]]
                .map(|phi| [1000.0 * (1.0 - phi) + 1.2 * phi, some(), 3.0, 1e5 * (1.0 + some()), phi]);
            let (p, u, face, is_solved) = solve_one(l, r, &mixture);
            let want = flux_exact(l, r, [0.0; 2], &mixture);
            assert!(is_solved && (p, u) == (face.pressure, face.velocity));
            found += usize::from(face.compression != 1.0);
            assert!((p - want.pressure).abs() <= 1e-13 * 1e5, "{l:?} {r:?}: {p} {}", want.pressure);
            assert!((u - want.velocity).abs() <= 1e-12, "{l:?} {r:?}: {u} {}", want.velocity);
            assert!((face.compression - want.compression).abs() <= 1e-13, "{face:?} {want:?}");
        }
    }
    assert!(found > 7900, "{found}");
}

#[test]
fn contacts_and_equal_states_come_back_bitwise() {
    for u in [0.0, 150.0, -150.0, 3000.0] {
        let (l, r) = ([1000.0, u, 3.0, 1e5, 0.0], [1.2, u, -2.0, 1e5, 1.0]);
        let (p, u_star, face, solved) = solve_one(l, r, &water_and_gas());
        assert!(solved);
        assert_eq!((p, u_star, face.pressure, face.velocity), (1e5, u, 1e5, u));
        let upwind = if u >= 0.0 { l } else { r };
        assert_eq!((face.mass, face.phi), (upwind[0] * u, upwind[4]));
    }
}

#[test]
fn mirrored_states_give_the_mirrored_flux_bitwise() {
    let (l, r) = ([998.0, 13.0, 5.0, 3e6, 0.01], [700.0, -41.0, 2.0, 8e5, 0.4]);
    let mirror = |w: PrimitiveCell| [w[RHO], -w[V_N], w[V_T], w[PRESSURE], w[PHI]];
    let (_, _, a, _) = solve_one(l, r, &water_and_gas());
    let (_, _, b, _) = solve_one(mirror(r), mirror(l), &water_and_gas());
    assert_eq!((a.mass, a.velocity, a.energy, a.shear), (-b.mass, -b.velocity, -b.energy, -b.shear));
    assert_eq!((a.pressure, a.phi), (b.pressure, b.phi));
    let (_, u, wall, _) = solve_one(l, mirror(l), &water_and_gas());
    assert_eq!((u, wall.mass, wall.velocity), (0.0, 0.0, 0.0));
}

/// Numbered faces with a quarter of gas below and three quarters above.
struct Listed<F> {
    fraction: F,
    found: Vec<(usize, Face)>,
}

impl<F: Fn(f64, f64, f64) -> f64> ListedFaces for Listed<F> {
    type Face = (usize, [PrimitiveCell; 2]);

    fn states(&self, (_, [lower, upper]): &Self::Face) -> [FaceState; 2] {
        [FaceState { w: *lower, gas_share: 0.25 }, FaceState { w: *upper, gas_share: 0.75 }]
    }

    fn star_fraction(&self, [_, p, phi]: [f64; 3], _: f64, compression: f64) -> f64 {
        (self.fraction)(p, phi, compression)
    }

    fn put(&mut self, (number, _): &Self::Face, solution: Face, gas_share: f64) {
        assert_eq!(gas_share, if solution.velocity < 0.0 { 0.75 } else { 0.25 });
        self.found.push((*number, solution));
    }
}

#[test]
fn listed_faces_do_not_depend_on_their_company() {
    let mixture = water_and_gas();
    let mut random = Random(5);
    let mut state = || {
        let phi = random.uniform(0.0, 1.0);
        let p = random.log_uniform(1e3, 1e9);
        [1.2 + 999.0 * (1.0 - phi), random.uniform(-50.0, 50.0), 3.0, p, phi]
    };
    // Two of three have strong waves and wait for others.
    let problems: Vec<(usize, [PrimitiveCell; 2])> = (0..7 * LANES + 5)
        .map(|face| {
            let [rho, u, v, p, phi] = state();
            let weak = [rho, u, v + 1.0, p * 1.0001, phi];
            (face, [[rho, u, v, p, phi], if face % 3 == 0 { weak } else { state() }])
        })
        .collect();
    // Some function of what the fluid comes from.
    let fraction = |p: f64, phi: f64, compression: f64| phi + 1e-3 * p + compression;
    let solved = |problems: &[(usize, [PrimitiveCell; 2])]| {
        let mut faces = Listed { fraction, found: Vec::new() };
        exact_fluxes(problems, &mut faces, &mixture);
        faces.found.sort_unstable_by_key(|(number, _)| *number);
        faces.found
    };
    let together = solved(&problems);
    assert_eq!(together.len(), problems.len());
    for (k, (face, (_, [lower, upper]))) in together.iter().zip(&problems).enumerate() {
        assert_eq!(solved(&problems[k..=k]), [*face], "face {k}");
        let (number, face) = *face;
        assert_eq!(number, k);
        let want = flux_exact(*lower, *upper, [0.25, 0.75], &mixture);
        approx::assert_relative_eq!(face.pressure, want.pressure, max_relative = 1e-8);
        approx::assert_relative_eq!(face.mass, want.mass, max_relative = 1e-8);
        approx::assert_relative_eq!(face.compression, want.compression, max_relative = 1e-8);
        let [_, _, _, p, phi] = if want.velocity < 0.0 { *upper } else { *lower };
        approx::assert_relative_eq!(face.phi, fraction(p, phi, want.compression), max_relative = 1e-8);
    }
}
