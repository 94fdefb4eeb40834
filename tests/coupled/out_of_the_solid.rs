//! Waves that come out of the solid into liquid that has known nothing before.

use crate::fixture::{grid, steel, water};
use crate::harness::{Sides, at, case};

/// Water above steel, each on 16 · 2³ cells of 6.4 mm: a spherical wave meets the interface from below, 24 cells per width in the steel, 6 in the water.
fn wave(adapt: &str) -> String {
    let lines = |z| grid(z, 6.4e-3, [16, 16]) + "levels = 3\n" + adapt;
    let text = [
        "[time]\nend = 1.9e-6\n",
        &water(&lines([0.0, 6.4e-3]), 1e5),
        &steel(&lines([-6.4e-3, 0.0])),
        "initial_stress = \"hydrostatic\"\n",
        "[[solid.pulse]]\ncentre = [-4e-3, 0.0]\nwidth = 1.2e-3\namplitude = 1e-12\n",
    ];
    text.concat()
}

/// p − p₀ in the liquid on the axis and beside it, after each step.
fn heard(adapt: &str) -> (Vec<[f64; 3]>, usize) {
    let mut sides = Sides::of(&case(&wave(adapt)));
    let (mut rows, mut fewest) = (Vec::new(), usize::MAX);
    sides.run(|fluid, _| {
        let at = |place: [f64; 2]| fluid.sample(place).expect("inside").pressure - 1e5;
        rows.push([fluid.time(), at([0.4e-3, 0.0]), at([0.8e-3, 1.5e-3])]);
        fewest = fewest.min(fluid.mesh().cells());
    });
    (rows, fewest)
}

/// On the cells that a liquid at rest has, and in the steps that these make, the misfit was 0.23; of a wave half as wide 0.98.
#[test]
fn a_wave_that_comes_out_of_the_solid_finds_fine_cells() {
    let (uniform, all) = heard("adapt = false\n");
    let (adapted, fewest) = heard("");
    for column in [1, 2] {
        let (mut off, mut whole) = (0.0, 0.0);
        for row in &uniform {
            off += (at(&adapted, row[0], column) - row[column]).powi(2);
            whole += row[column].powi(2);
        }
        let misfit = (off / whole).sqrt();
        eprintln!("probe {column}: misfit {misfit:.2e}; {fewest} of {all} cells at first");
        assert!(misfit < 1e-6, "{misfit}");
    }
    assert!(fewest < all / 8, "as long as it is at rest its cells are coarse: {fewest} of {all}");
}
