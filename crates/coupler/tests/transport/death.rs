//! One side ends: the other says who, and shared memory is cleared away.

use std::time::{Duration, Instant};

use coupler::{CouplerError, FrameHeader, FrameKind, Link, Participant, ProcessLink, clean_up_dead};

use crate::helper::Scene;

const ENDLESS: &str = "--steps 1000000000 --grow";

#[test]
fn a_killed_peer_is_named_nothing_stays_and_the_run_id_works_again() {
    for victim in [Participant::Fluid, Participant::Solid] {
        let scene = Scene::new();
        let mut survivor = scene.start(victim.peer().name(), ENDLESS);
        let mut killed = scene.start(victim.name(), ENDLESS);
        survivor.connected();
        killed.connected();
        assert!(!scene.shared_objects().is_empty(), "the test looks in the wrong place");
        std::thread::sleep(Duration::from_millis(100));

        let pid = killed.pid();
        killed.kill();
        let start = Instant::now();
        let end = survivor.end();
        assert!(start.elapsed() < Duration::from_secs(2), "noticed after {:?}", start.elapsed());
        end.assert_refused(&[&format!("the {victim} (process {pid}) died at step")]);
        scene.assert_clean();

        scene.run_pair("--steps 10");
        scene.assert_clean();
    }
}

#[test]
fn what_two_killed_participants_left_is_cleared_away_by_the_next_or_on_request() {
    let scene = Scene::new();
    for by_next_run in [true, false] {
        let (fluid, solid) = scene.connected_pair(ENDLESS);
        fluid.kill();
        // The solid may have cleared away the fluid's part by then.
        solid.kill();
        assert!(!scene.shared_objects().is_empty());
        if by_next_run {
            scene.run_pair("--steps 10");
        } else {
            // How many it counts is open: the solid may have been killed while it was clearing away the fluid, and
            // what is half cleared away goes with the sweep. That all is gone is what counts.
            clean_up_dead(&scene.domain).unwrap();
        }
        scene.assert_clean();
    }
}

#[test]
fn a_participant_killed_while_it_waits_for_its_peer_does_not_hinder_the_next() {
    let scene = Scene::new();
    scene.waiting_fluid("").kill();
    scene.run_pair("--steps 10");
    scene.assert_clean();
}

#[test]
fn participants_killed_at_any_moment_of_their_start_do_not_hinder_the_next() {
    let scene = Scene::new();
    for milliseconds in 0..12 {
        let (fluid, solid) = scene.start_pair(ENDLESS);
        std::thread::sleep(Duration::from_millis(milliseconds));
        fluid.kill();
        solid.kill();
    }
    scene.run_pair("--steps 10");
    scene.assert_clean();
}

#[test]
fn a_peer_killed_at_any_moment_of_its_start_does_not_keep_the_other_waiting() {
    for victim in [Participant::Fluid, Participant::Solid] {
        let scene = Scene::new();
        for milliseconds in 0..12 {
            let options = format!("{ENDLESS} --timeout-s 0.3");
            let survivor = scene.start(victim.peer().name(), &options);
            let killed = scene.start(victim.name(), &options);
            std::thread::sleep(Duration::from_millis(milliseconds));
            killed.kill();
            // Which of several words it has for it depends on the moment.
            survivor.end().assert_refused(&[]);
            scene.assert_clean();
        }
    }
}

#[test]
fn sending_to_a_dead_peer_fails_and_leaving_it_does_not_hang() {
    let scene = Scene::new();
    let mut solid = scene.start("solid", "--steps 10 --sleep-ms 60000");
    let mut link = ProcessLink::connect(scene.endpoint(Participant::Fluid)).unwrap();
    // Now it has taken the greeting.
    solid.connected();
    let pid = solid.pid();
    solid.kill();
    let header = |step| FrameHeader { step, count: 10, fields: 2, ..FrameHeader::new(FrameKind::Trace) };
    let start = Instant::now();
    // The first one fits into the buffer of the dead; nobody can know better without looking.
    let results: Vec<_> = (1..=2).map(|step| link.send(header(step), |_| {})).collect();
    let lost = CouplerError::PeerLost { peer: Participant::Solid, pid, step: 1 };
    assert_eq!(results, [Ok(()), Err(lost)]);
    drop(link);
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
    scene.assert_clean();
}

#[test]
fn a_dead_peer_is_found_while_waiting_and_its_last_frame_is_still_read() {
    let scene = Scene::new();
    let fluid = scene.start("fluid", "--steps 10");
    let mut link = ProcessLink::connect(scene.endpoint(Participant::Solid)).unwrap();
    link.wait().unwrap();
    let pid = fluid.pid();
    fluid.kill();
    assert_eq!(link.receive(|frame| frame.header.kind), Ok(FrameKind::Trace as u32));
    let start = Instant::now();
    assert_eq!(link.wait(), Err(CouplerError::PeerLost { peer: Participant::Fluid, pid, step: 0 }));
    assert!(start.elapsed() < Duration::from_secs(1), "{:?}", start.elapsed());
    drop(link);
    scene.assert_clean();
}

#[test]
fn a_fault_ends_the_peer_at_once_with_its_reason() {
    let words = ["the fluid gave up at step 7", "failed numerically"];
    Scene::new().one_leaves(["fluid", "--fail-at 7"], ["solid", ""], &words);
}

#[test]
fn a_peer_that_leaves_early_is_named() {
    let words = ["the solid left the run after step"];
    Scene::new().one_leaves(["solid", "--steps 5"], ["fluid", "--steps 20"], &words);
}

#[test]
fn two_that_leave_with_frames_unread_do_not_wait_for_each_other() {
    let scene = Scene::new();
    let endpoints = [Participant::Fluid, Participant::Solid].map(|name| scene.endpoint(name));
    let threads = endpoints.map(|endpoint| {
        std::thread::spawn(move || {
            let mut link = ProcessLink::connect(endpoint).unwrap();
            let header = FrameHeader { count: 100_000, fields: 1, ..FrameHeader::new(FrameKind::Trace) };
            link.send(header, |_| {}).unwrap();
            let start = Instant::now();
            drop(link);
            start.elapsed()
        })
    });
    for thread in threads {
        let leaving = thread.join().unwrap();
        assert!(leaving < Duration::from_secs(1), "{leaving:?}");
    }
    scene.assert_clean();
}
