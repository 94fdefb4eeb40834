//! The figures' case at half the resolution of its file: 25.6 cells per radius.

use std::path::Path;

use cav::case::Case;
use cav::run::collapse::CollapseFinder;

use crate::harness::Sides;

/// Value and time of the largest so far.
#[derive(Default)]
struct Peak([f64; 2]);

impl Peak {
    fn push(&mut self, time: f64, value: f64) {
        if value > self.0[0] {
            self.0 = [value, time];
        }
    }
}

#[test]
fn the_figures_case_has_its_known_peaks() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012-coarse.toml");
    let sets = ["fluid.levels=5", "solid.levels=3", "time.end=58e-6"].map(str::to_owned);
    let sets = [&sets[..], &["time.snapshots=[]".to_owned()]].concat();
    let case = Case::load(&path, &sets).unwrap_or_else(|errors| panic!("{errors}"));
    let mut sides = Sides::of(&case);
    let (mut wall, mut mises, mut volume) = (Peak::default(), Peak::default(), CollapseFinder::default());
    sides.run(|fluid, solid| {
        wall.push(fluid.time(), fluid.wall_pressures().axis);
        mises.push(solid.time(), solid.mises_peak().stress);
        volume.push(fluid.time(), fluid.bubble().volume);
    });
    let collapse = volume.found().expect("it collapses");
    let radius = (0.75 * collapse.volume / std::f64::consts::PI).cbrt();
    // Two independent codes agree on these values; the tolerances are those of the specification.
    for (what, found, wanted, tolerance) in [
        ("wall pressure on the axis", wall.0[0], 199e6, 0.06),
        ("its time", wall.0[1], 51.4e-6, 0.01),
        ("von Mises stress", mises.0[0], 168e6, 0.06),
        ("its time", mises.0[1], 53.0e-6, 0.01),
        ("smallest equivalent radius", radius, 0.39 * 0.01, 0.08),
        ("its time", collapse.time, 43.1e-6, 0.01),
    ] {
        eprintln!("{what}: {found:.5e} of {wanted:e}");
        assert!((found / wanted - 1.0).abs() < tolerance, "{what}: {found:e} of {wanted:e}");
    }
}
