//! A pre-stressed solid under a liquid at rest stays at rest, to round-off.

use crate::fixture::{grid, inner_sides, steel, water};
use crate::harness::{PAPERS_SCHEMES, Sides, fluid_cells, solid_cells};

const PRESSURE: f64 = 5e7;

/// - `gravity`: along z, m/s²; the pressure is then that on the wall.
fn at_rest(geometry: &str, stress: &str, coupling: &str, gravity: f64) -> Sides {
    let inner = inner_sides(geometry);
    Sides::of_parts(&[
        &format!("geometry = \"{geometry}\"\n[time]\nend = 1e-3\n"),
        &water(&(grid([0.0, 0.01], 0.01, [32, 32]) + &format!("gravity = {gravity:?}\n")), PRESSURE),
        "[fluid.boundary]\n",
        inner[0],
        &steel(&grid([-0.01, 0.0], 0.01, [32, 48])),
        &format!("initial_stress = \"{stress}\"\n[solid.boundary]\n"),
        inner[1],
        &format!("[coupling]\n{coupling}\n"),
    ])
}

/// The fastest motion and the largest deviation from the initial pressure and stress, of both sides.
fn unrest(sides: &Sides, uniaxial: bool, gravity: f64) -> [f64; 2] {
    let [mut speed, mut stress] = [0.0_f64; 2];
    for ([z, _], w) in fluid_cells(sides.fluid.solver()) {
        speed = speed.max(w.v_z.abs()).max(w.v_r.abs());
        stress = stress.max((w.pressure - PRESSURE - 1000.0 * gravity * z).abs());
    }
    let across = if uniaxial { 0.0 } else { PRESSURE };
    for (_, w) in solid_cells(sides.solid.solver()) {
        speed = speed.max(w.v_z.abs()).max(w.v_r.abs());
        let off = [w.stress_zz + PRESSURE, w.stress_zr, w.stress_rr + across, w.stress_phiphi + across];
        stress = off.iter().fold(stress, |most, off| most.max(off.abs()));
    }
    [speed, stress]
}

#[test]
fn a_prestress_stays_to_round_off() {
    // The fluid gets its pressure back from an energy of γπ/(γ − 1) = 3.5e8 J/m³, so to some 1e-7 Pa; over the
    // solid's impedance that is some 1e-14 m/s.
    for geometry in ["planar", "axisymmetric"] {
        for stress in ["hydrostatic", "uniaxial"] {
            for coupling in ["", "star = \"acoustic\""].into_iter().chain(PAPERS_SCHEMES) {
                let mut sides = at_rest(geometry, stress, coupling, 0.0);
                for _ in 0..300 {
                    assert!(sides.round(|_, _| ()), "the run is long");
                }
                let [speed, off] = unrest(&sides, stress == "uniaxial", 0.0);
                eprintln!("{geometry}, {stress}, {coupling:?}: {speed:.1e} m/s, {off:.1e} Pa");
                assert!(
                    // In a round the solid makes up to four steps.
                    speed < 1e-13 && off < 4e-6,
                    "{geometry}, {stress}, {coupling}: {speed:e} m/s, {off:e} Pa"
                );
                let state = sides.fluid.solver().state();
                let mut masses = state.as_slice().chunks(state.block_len()).flat_map(|block| &block[..256]);
                assert!(masses.all(|rho| *rho == 1000.0), "density moved");
            }
        }
    }
}

/// The liquid's weight is on the wall: the trace that the solid gets falls with the liquid, and its pressure is that on the face.
#[test]
fn liquid_under_its_weight_rests_on_a_solid() {
    let gravity = -1e6;
    for geometry in ["planar", "axisymmetric"] {
        let mut sides = at_rest(geometry, "hydrostatic", "", gravity);
        for _ in 0..300 {
            assert!(sides.round(|_, _| ()), "the run is long");
        }
        let [speed, off] = unrest(&sides, false, gravity);
        // Over the height it is 1e7 Pa; without the fall in the trace 1e-3 of that would move the solid.
        assert!(speed < 1e-12 && off < 1e-5, "{geometry}: {speed:e} m/s, {off:e} Pa");
    }
}

#[test]
fn the_printed_factor_moves_it() {
    let mut sides = at_rest("planar", "hydrostatic", "scheme = \"weak\"\nkappa = \"printed\"", 0.0);
    (0..50).for_each(|_| assert!(sides.round(|_, _| ()), "the run is long"));
    // A static pressure p0 becomes κ p0 in the solid: as large as the pre-stress itself.
    let moved = sides
        .solid
        .solver()
        .interface()
        .states()
        .iter()
        .map(|s| (s.pressure - 5e7).abs())
        .fold(0.0, f64::max);
    assert!(moved > 1e6, "{moved:e} Pa");
}
