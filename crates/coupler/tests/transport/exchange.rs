//! Every number arrives, at whatever length.

use crate::helper::Scene;

#[test]
fn two_processes_exchange_2000_frames_whose_length_changes_every_step() {
    let scene = Scene::new();
    let (fluid, solid) = scene.start_pair("--steps 2000 --faces 40 --grow");
    // The helper compares every number it gets.
    let ends = [fluid.end(), solid.end()];
    let numbers: u64 = (0..2000).map(|step| 2 * 5 * (40 + step * 7919 % 361)).sum();
    let at_least = 8 * numbers + 2 * 2000 * 128;
    for end in ends {
        end.assert_done();
        let summary = end.stdout.lines().last().unwrap();
        let bytes: u64 = summary.split(' ').nth(2).unwrap().parse().unwrap();
        assert!((at_least..at_least + at_least / 5).contains(&bytes), "{bytes} bytes, {at_least} at least");
    }
    scene.assert_clean();
}

#[test]
fn the_last_frame_arrives_though_its_sender_leaves_at_once_and_its_memory_is_new() {
    // Step 1 is 8 times longer than step 0, so the solid's last register lies in a segment taken for it.
    let scene = Scene::new();
    for _ in 0..20 {
        scene.run_pair("--steps 2 --faces 997 --grow");
    }
    scene.assert_clean();
}

#[test]
fn runs_side_by_side_do_not_meet() {
    let scene = Scene::new();
    let other = Scene { run_id: format!("{}-b", scene.run_id), domain: scene.domain.clone() };
    let pairs =
        [scene.start_pair("--steps 500 --grow --hash 1"), other.start_pair("--steps 500 --faces 7 --hash 2")];
    for (fluid, solid) in pairs {
        fluid.end().assert_done();
        solid.end().assert_done();
    }
    scene.assert_clean();
}
