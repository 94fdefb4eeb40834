//! Sides of the interface that are not this program's solvers.

use std::path::Path;

use cav::run::process::session::{Session, Solvers};
use cav::run::process::stop::Stop;
use cav::run::side::RunSide as _;
use cav::run::side::fluid_side::Turn;
use cav::run::side::solid_side::SolidSide;
use coupler::{FlowParticipant, FlowTrace, direct_pair};

use crate::fixture::{grid, steel};
use crate::harness::{case, solid_cells};

#[path = "../../examples/spring_mass_wall.rs"]
#[allow(dead_code, reason = "its main is not called here")]
mod spring_mass_wall;

#[test]
fn a_mass_on_a_spring_moves_as_its_equation_says() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/spring-mass-wall.toml");
    let [largest, off] = spring_mass_wall::run(&case, None).expect("the run");
    assert!((largest - 5.84e-9).abs() < 1e-11, "{largest:e} m");
    assert!(off < 1e-3, "{off}");
}

/// A planar strip of steel, the upper end of which is `coupling`'s.
fn strip(coupling: &str) -> String {
    let text = [
        "geometry = \"planar\"\n[time]\nend = 2e-6\n",
        &steel(&grid([-0.0128, 0.0], 0.0016, [128, 16])),
        "adapt = false\ninitial_stress = \"hydrostatic\"\n",
        "[solid.boundary]\nr_min = \"symmetry\"\nr_max = \"symmetry\"\n",
        &format!("[coupling]\n{coupling}\n"),
    ];
    text.concat()
}

#[test]
fn a_given_pressure_does_the_same_as_the_scheme_load() {
    // Up to 1 MPa in a microsecond, and down again; so wide that the strip has the same pressure everywhere.
    let factor = |t: f64| if t < 1e-6 { t / 1e-6 } else { (2e-6 - t) / 1e-6 };
    let load = "scheme = \"load\"\n[coupling.load]\namplitude = 1e6\nradius = 1e6\n\
                history = [[0.0, 0.0], [1e-6, 1.0], [2e-6, 0.0]]";
    let of_load = case(&strip(load));
    let mut session = Session::new(&of_load, None, Solvers::default()).expect("the solid");
    let mut times = Vec::new();
    while session.step(&Stop::default()).expect("a step") == Turn::Continues {
        times.push(session.solid().expect("the solid").solver().time());
    }
    let of_participant = case(&strip("scheme = \"external\""));
    let stop = Stop::default();
    let (mut to_solid, mut to_flow) = direct_pair(of_participant.hash());
    let solid = of_participant.solid.as_ref().expect("a solid");
    let mut solid = SolidSide::new(&of_participant, solid, None).expect("the solid");
    solid.open(&mut to_flow, &stop).expect("opens");
    let mut flow = FlowParticipant::open(&mut to_solid, vec![0.0016]).expect("opens");
    let mut work = 0.0;
    for time in times {
        let (begin, dt) = (flow.time(), time - flow.time());
        // A kink within a step is met by its mean rate.
        let middle = factor(begin + 0.5 * dt);
        let rate = 2.0 * (middle - factor(begin)) / dt;
        flow.begin(&mut to_solid, dt, |_| FlowTrace::load(1e6 * factor(begin), 1e6 * rate)).expect("begins");
        assert_eq!(solid.turn(&mut to_flow, &stop).expect("the solid's turn"), Turn::Continues);
        let means = flow.complete(&mut to_solid).expect("completes");
        assert!((means.pressure[0] - 1e6 * middle).abs() < 1e-6, "{means:?}");
        work += dt * means.power[0];
    }
    flow.close(&mut to_solid).expect("closes");
    assert_eq!(solid.turn(&mut to_flow, &stop).expect("the end"), Turn::Over(0));
    let ours = session.solid().expect("the solid").solver();
    let largest = solid_cells(ours).iter().fold(0.0_f64, |most, (_, w)| most.max(w.v_z.abs()));
    assert!(largest > 1e-2, "{largest}");
    for ((_, a), (_, b)) in solid_cells(ours).iter().zip(solid_cells(solid.solver())) {
        assert!((a.v_z - b.v_z).abs() < 1e-12 * largest, "{} {}", a.v_z, b.v_z);
        assert!((a.stress_zz - b.stress_zz).abs() < 1e-5, "{} {}", a.stress_zz, b.stress_zz);
    }
    // What the participant is told of work is what the solid has got.
    let got = solid.solver().ledger().energy[1] / 0.0016;
    assert!((work + got).abs() < 1e-12 * got.abs(), "{work} {got}");
}
