//! A participant played against the other side in one process.

use super::*;
use crate::{SolidTrace, acoustic_star, direct_pair, exact_star};

#[test]
fn two_participants_without_physics_meet() {
    let (mut to_wall, mut to_flow) = direct_pair([3; 32]);
    let mut wall = WallParticipant { max_step: 0.25, ..WallParticipant::default() };
    wall.open(&mut to_flow).unwrap();
    let mut flow = FlowParticipant::open(&mut to_wall, vec![1.0, 2.0]).unwrap();
    assert_eq!(flow.max_step(), 0.25);
    for step in 0..3 {
        let state = FluidTrace { pressure: 7.0, velocity: 0.5, density: 1.0, gamma: 2.0, pi: 3.0 };
        let trace = |face| FlowTrace { state, pressure_rate: face as f64, velocity_rate: 2.0 };
        flow.begin(&mut to_wall, 1.0, trace).unwrap();
        let goes_on = wall.turn(&mut to_flow, |seen, means| {
            assert_eq!((seen.number, seen.begin, seen.dt), (step, step as f64, 1.0));
            assert_eq!(seen.edges(), [1.0, 2.0]);
            // Two parts of the step, the wall at rest.
            for face in 0..2 {
                for (share, middle) in [(0.25, 0.125), (0.75, 0.625)] {
                    let trace = seen.trace_at(face, seen.begin + middle);
                    assert_eq!(trace.velocity, 0.5 + 2.0 * middle);
                    let pressure = trace.pressure;
                    means.add(
                        face,
                        share,
                        &InterfaceStar { pressure, velocity: 0.1, iterations: 0, floored: false },
                    );
                }
            }
        });
        assert!(goes_on.unwrap());
        let means = flow.complete(&mut to_wall).unwrap();
        assert_eq!(means.pressure, [7.0, 7.5]);
        assert!(means.velocity.iter().all(|v| (v - 0.1).abs() < 1e-15));
        assert!(means.power.iter().zip([0.7, 0.75]).all(|(a, b)| (a - b).abs() < 1e-15));
    }
    assert_eq!(flow.time(), 3.0);
    flow.close(&mut to_wall).unwrap();
    assert!(!wall.turn(&mut to_flow, |_, _| unreachable!("the run is over")).unwrap());
}

/// What a participant makes of a frame, in its first step.
fn wall_sees(header: FrameHeader, payload: &[f64]) -> Result<bool, CouplerError> {
    let (mut to_wall, mut to_flow) = direct_pair([3; 32]);
    to_wall.send(header, |place| place.copy_from_slice(payload)).unwrap();
    WallParticipant::default().turn(&mut to_flow, |_, _| ())
}

fn trace(dt: f64, edges: [f64; 2]) -> (FrameHeader, Vec<f64>) {
    let header =
        FrameHeader { dt, fields: TraceRow::COUNT as u64, count: 2, ..FrameHeader::new(FrameKind::Trace) };
    (header, [edges.to_vec(), vec![2.0; 30]].concat())
}

#[test]
fn a_wall_refuses_traces_that_make_no_sense() {
    let (header, payload) = trace(1.0, [1.0, 2.0]);
    assert_eq!(wall_sees(header, &payload), Ok(true));
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = wall_sees(FrameHeader { dt, ..header }, &payload).expect_err("no step");
        assert!(matches!(error, CouplerError::BadStep { .. }), "{error}");
    }
    for time in [1.0, -1.0, f64::NAN] {
        for flags in [0, FrameHeader::LAST] {
            let error = wall_sees(FrameHeader { time, flags, ..header }, &payload).expect_err("no time");
            assert!(matches!(error, CouplerError::BadStep { .. }), "{error}");
        }
    }
    for edges in [[2.0, 1.0], [1.0, 1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
        let (header, payload) = trace(1.0, edges);
        assert!(wall_sees(header, &payload).expect_err("no faces").is_refusal());
    }
    for (row, value) in [(TraceRow::Density, -1.0), (TraceRow::DensityRate, -3.0), (TraceRow::Gamma, 1.0)] {
        let mut payload = payload.clone();
        payload[2 * row as usize + 1] = value;
        let error = wall_sees(header, &payload).expect_err("no state");
        assert!(matches!(error, CouplerError::NoState { .. }), "{error}");
    }
    let nothing = FrameHeader { count: 0, ..header };
    assert!(matches!(wall_sees(nothing, &[]), Err(CouplerError::BadFaces { .. })));
}

#[test]
fn a_flow_refuses_answers_to_other_steps_and_numbers_that_are_none() {
    let answered = |change: fn(&mut FrameHeader, &mut [f64])| {
        let (mut to_wall, mut to_flow) = direct_pair([3; 32]);
        WallParticipant::default().open(&mut to_flow).unwrap();
        let mut flow = FlowParticipant::open(&mut to_wall, vec![1.0]).unwrap();
        flow.begin(&mut to_wall, 0.5, |_| FlowTrace::load(1.0, 0.0)).unwrap();
        to_flow.receive(|_| ()).unwrap();
        let mut header = FrameHeader {
            dt: 0.5,
            dt_max: 1.0,
            fields: RegisterRow::COUNT as u64,
            count: 1,
            ..FrameHeader::new(FrameKind::Register)
        };
        let mut payload = [0.0; RegisterRow::COUNT];
        change(&mut header, &mut payload);
        to_flow.send(header, |place| place.copy_from_slice(&payload)).unwrap();
        flow.complete(&mut to_wall).map(|_| ())
    };
    assert_eq!(answered(|_, _| ()), Ok(()));
    let bad: [fn(&mut FrameHeader, &mut [f64]); 6] = [
        |header, _| header.time = 0.5,
        |header, _| header.dt = 0.25,
        |header, _| header.dt = f64::NAN,
        |header, _| header.dt_max = f64::NAN,
        |header, _| header.dt_max = -1.0,
        |_, payload| payload[1] = f64::INFINITY,
    ];
    for change in bad {
        assert!(answered(change).expect_err("must be refused").is_refusal());
    }
}

/// A load that falls through zero within a step is a state all the time.
#[test]
fn a_load_may_change_its_sign_within_a_step() {
    let FlowTrace { state, pressure_rate, .. } = FlowTrace::load(1e3, -1e14);
    let pressure = state.pressure + 1e-6 * pressure_rate;
    assert_eq!(pressure, 1e3 - 1e8);
    let fluid = FluidTrace { pressure, ..state };
    let solid = SolidTrace { pressure: 3e5, velocity: 2.0, impedance: 4e7 };
    for star in [exact_star(&fluid, &solid), acoustic_star(&fluid, &solid)] {
        assert!((star.pressure - pressure).abs() <= 1e-12 * pressure.abs(), "{star:?}");
    }
}

#[test]
fn a_load_is_the_pressure_whatever_the_wall_does() {
    for pressure in [1e6, -2e7, 0.0, 5e9] {
        let fluid = FlowTrace::load(pressure, 0.0).state;
        let solid = SolidTrace { pressure: 3e5, velocity: 2.0, impedance: 4e7 };
        for star in [exact_star(&fluid, &solid), acoustic_star(&fluid, &solid)] {
            assert!((star.pressure - pressure).abs() <= 1e-12 * pressure.abs() + 1e-12, "{star:?}");
            assert!((star.velocity - (2.0 + (3e5 - pressure) / 4e7)).abs() < 1e-9, "{star:?}");
        }
    }
}
