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

/// A bubble so near the steel that its gas comes to the wall: the traces of mixed cells, and the fluxes through the wall
/// from them, must be those of their own face states.
#[test]
fn gas_comes_to_the_steel() {
    let text = r#"
geometry = "axisymmetric"
[time]
end = 16e-6
[fluid]
z = [0.0, 6.4e-3]
r = [0.0, 6.4e-3]
cells = [16, 16]
levels = 3
epsilon = 1e-3
[fluid.liquid]
gamma = 7.15
pi = 3e8
[fluid.gas]
gamma = 1.4
pi = 0.0
[fluid.ambient]
density = 1000.0
pressure = 1e7
[[fluid.region]]
shape = "sphere"
centre = [1.5e-3, 0.0]
radius = 1e-3
phase = "gas"
density = 1.2
pressure = 1e5
[solid]
z = [-6.4e-3, 0.0]
r = [0.0, 6.4e-3]
cells = [16, 16]
levels = 3
epsilon = 1e-3
material = "structural-steel"
[coupling]
scheme = "riemann"
"#;
    let mut sides = Sides::of(&crate::harness::case(text));
    let (mut gas_at_the_wall, mut wall) = (0.0_f64, Peak::default());
    let mut gas = [f64::NAN; 2];
    sides.run(|fluid, _| {
        for face in fluid.mesh().blocks_along(mesh::Side::ZMin) {
            gas_at_the_wall = gas_at_the_wall.max(fluid.cell(face, 0, 0).phi);
        }
        wall.push(fluid.time(), fluid.wall_pressures().axis);
        let mass = fluid.bubble().gas_mass;
        gas = [if gas[0].is_nan() { mass } else { gas[0] }, mass];
        assert!(fluid.largest_speeds().iter().all(|speed| speed.is_finite()));
    });
    eprintln!("gas fraction at the wall {gas_at_the_wall:.2}, pressure {:?}, gas mass {gas:?}", wall.0);
    assert!(gas_at_the_wall > 0.1, "the gas does not come to the wall");
    // The wall's motion carries gas through the fixed face, and back.
    assert!((gas[1] / gas[0] - 1.0).abs() < 1e-4);
    assert!(wall.0[0] > 1.5e8 && wall.0[0] < 4e8, "{:?}", wall.0);
}
