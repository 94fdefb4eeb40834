//! Waiting costs nothing and can be ended.

use std::time::{Duration, Instant};

use coupler::{CouplerError, Endpoint, Link, Participant, ProcessLink};
use rustix::process::Signal;

use crate::helper::Scene;

#[test]
fn a_second_of_waiting_takes_less_than_50_ms_of_processor_time() {
    let scene = Scene::new();
    let mut solid = scene.start("solid", "");
    let _fluid = scene.start("fluid", "--sleep-ms 60000");
    solid.connected();
    let before = solid.cpu_seconds();
    std::thread::sleep(Duration::from_secs(1));
    let used = solid.cpu_seconds() - before;
    assert!(used < 0.05, "{used} s");
}

#[test]
fn a_stopped_peer_is_waited_for_and_called_silent_when_patience_ends() {
    let scene = Scene::new();
    let (mut fluid, mut solid) = (
        scene.start("fluid", "--steps 1000000000 --patience-s 1.5"),
        scene.start("solid", "--steps 1000000000"),
    );
    fluid.connected();
    solid.connected();
    solid.signal(Signal::STOP);
    std::thread::sleep(Duration::from_millis(800));
    solid.signal(Signal::CONT);
    std::thread::sleep(Duration::from_millis(200));
    solid.signal(Signal::STOP);
    let start = Instant::now();
    let end = fluid.end();
    assert!(start.elapsed() > Duration::from_millis(1300), "gave up after {:?}", start.elapsed());
    end.assert_refused(&[&format!("the solid (process {})", solid.pid()), "is it stopped?"]);
}

#[test]
fn the_callers_hook_ends_a_wait() {
    let scene = Scene::new();
    let _fluid = scene.start("fluid", "--sleep-ms 60000");
    let mut asked = 0;
    let mut link = ProcessLink::connect(Endpoint {
        interrupt: Some(Box::new(move || {
            asked += 1;
            let reason = "launcher gone".to_owned();
            if asked > 3 { Err(CouplerError::Interrupted { reason }) } else { Ok(()) }
        })),
        ..scene.endpoint(Participant::Solid)
    })
    .unwrap();
    let start = Instant::now();
    assert_eq!(link.wait(), Err(CouplerError::Interrupted { reason: "launcher gone".to_owned() }));
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
    assert!(link.counters().waited > Duration::from_millis(50));
}
