//! Who may join whom.

use std::time::{Duration, Instant};

use coupler::{CouplerError, Participant, ProcessLink};

use crate::helper::Scene;

#[test]
fn different_cases_are_refused_on_both_sides_at_once() {
    let scene = Scene::new();
    let start = Instant::now();
    let (fluid, solid) = (scene.start("fluid", "--hash 1"), scene.start("solid", "--hash 2"));
    fluid.end().assert_refused(&["different case (020202020202, here 010101010101)"]);
    solid.end().assert_refused(&["different case (010101010101, here 020202020202)"]);
    assert!(start.elapsed() < Duration::from_secs(3), "{:?}", start.elapsed());
    scene.assert_clean();
}

#[test]
fn a_missing_peer_is_named_after_the_time_out() {
    let scene = Scene::new();
    let endpoint = coupler::Endpoint {
        connect_timeout: Duration::from_millis(300),
        ..scene.endpoint(Participant::Fluid)
    };
    match ProcessLink::connect(endpoint) {
        Err(CouplerError::PeerAbsent { peer, run_id, waited }) => {
            assert_eq!((peer, &run_id), (Participant::Solid, &scene.run_id));
            assert!((300..1500).contains(&waited.as_millis()), "{waited:?}");
        }
        other => panic!("{other:?}"),
    }
    scene.assert_clean();
}

#[test]
fn a_second_fluid_is_refused_and_the_run_goes_on() {
    let scene = Scene::new();
    let (fluid, solid) = scene.connected_pair("--steps 100 --sleep-ms 5");
    let pid = fluid.pid();
    scene.start("fluid", "").end().assert_refused(&["already has a fluid", &format!("(process {pid})")]);
    scene.ends_well((fluid, solid));
}

#[test]
fn a_second_fluid_that_comes_while_the_first_waits_is_refused_and_the_solid_still_meets_the_first() {
    let scene = Scene::new();
    let first = scene.waiting_fluid("--steps 10");
    scene.start("fluid", "").end().assert_refused(&[&format!("(process {})", first.pid())]);
    scene.ends_well((first, scene.start("solid", "--steps 10")));
}

#[test]
fn an_unusable_run_id_is_refused_before_anything_is_made() {
    let scene = Scene::new();
    let endpoint = coupler::Endpoint { run_id: "../x".to_owned(), ..scene.endpoint(Participant::Fluid) };
    assert!(matches!(ProcessLink::connect(endpoint), Err(CouplerError::BadRunId { .. })));
    assert!(!scene.domain.root.exists());
}
