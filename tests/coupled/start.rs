//! A run that begins with Rayleigh's pressure begins with both media in equilibrium on the wall.

use crate::fixture::{AIR, bubble, grid, steel, water};
use crate::harness::{Sides, solid_cells};

/// A bubble of 2 mm, 16 cells, two radii above steel.
fn at_start(stress: &str) -> Sides {
    let lines = |z| grid(z, 0.008, [64, 64]);
    Sides::of_parts(&[
        "[time]\nend = 1e-3\n",
        &water(&(lines([0.0, 0.008]) + "initial_pressure = \"rayleigh\"\n"), 1e6),
        &bubble([0.004, 0.0], 0.002, AIR),
        &steel(&lines([-0.008, 0.0])),
        &format!("initial_stress = \"{stress}\"\n"),
    ])
}

/// On the axis the pressure of the start is 0.70 MPa below the ambient one. A solid under the latter would be thrown
/// up with that over its impedance.
#[test]
fn the_solid_carries_the_pressure_of_the_start() {
    let thrown = 0.7e6 / (7800.0 * 5990.0);
    for stress in ["uniaxial", "hydrostatic"] {
        let mut sides = at_start(stress);
        let off = |sides: &Sides| {
            let cells = solid_cells(sides.solid.solver());
            cells.iter().fold(0.0_f64, |most, (_, w)| most.max(w.v_z.abs()).max(w.v_r.abs()))
        };
        let across = if stress == "uniaxial" { 0.0 } else { -1e6 };
        let cells = solid_cells(sides.solid.solver());
        let highest = cells.iter().fold(f64::NEG_INFINITY, |most, (_, w)| most.max(w.stress_zz));
        assert!((highest + 0.3e6).abs() < 0.03e6, "{stress}: {highest:e}");
        assert!(cells.iter().all(|(_, w)| w.stress_rr == across && w.stress_phiphi == across), "{stress}");
        // Until sound has gone half a radius in the liquid and four in the steel.
        while sides.fluid.solver().time() < 0.5 * 0.002 / 1465.0 {
            assert!(sides.round(|_, _| ()), "the run is long");
        }
        let speed = off(&sides) / thrown;
        eprintln!("{stress}: {speed:.4} of {thrown:.4} m/s");
        assert!(speed < 0.1, "{stress}: {speed}");
    }
}
