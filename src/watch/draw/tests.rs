//! Pictures in the memory of a terminal that is none.

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::style::Color;

use super::*;
use crate::output::progress_file::Standing;
use crate::output::progress_line::ProgressLine;
use crate::watch::curve::Curve;
use crate::watch::seen::Titled;

const BOTH: View = View { answer_alone: false, passed: 0 };
const ALONE: View = View { answer_alone: true, passed: 0 };

const END: f64 = 6.57e-5;

/// A run of which so much of the time has passed: a bubble that shrinks, a peak on the wall that lasts for one step in 20,000.
fn seen(state: RunState, share: f64) -> Seen {
    let curve = |value: &dyn Fn(f64) -> f64| {
        let mut curve = Curve::default();
        (0..=20_000)
            .map(|step| share * f64::from(step) / 20_000.0)
            .for_each(|x| curve.push(x * END, value(x)));
        curve
    };
    let titled =
        |title, unit, is_least_wanted, curve| Titled { title, unit, is_least_wanted, curve, peak: None };
    let peak = 0.8 * share;
    let line = ProgressLine {
        time: share * END,
        step: 20_000,
        dt: 3.1e-8,
        limited_by: "fluid".to_owned(),
        cells: 131_072,
        solid_cells: 65_536,
        wall: 10.0,
    };
    Seen {
        directory: "runs/steel".into(),
        grid: None,
        state,
        standing: Some(Standing { line, end: END, left: Some(185.0) }),
        curves: vec![
            titled("equivalent radius R(t)", "m", true, curve(&|x| 0.01 * (1.0 - 0.6 * x))),
            titled(
                "wall pressure on the axis",
                "Pa",
                false,
                curve(&|x| {
                    if (x - peak).abs() < 0.4e-4 * share { 2.48e8 } else { 5e7 }
                }),
            ),
            titled("largest von Mises stress", "Pa", false, curve(&|x| 1e8 * x)),
        ],
        end: Some(END),
        error: None,
        answer: Vec::new(),
        can_go_on: false,
        trouble: None,
    }
}

/// The picture on a terminal of this size, line by line.
fn lines(seen: &Seen, [width, height]: [u16; 2], view: View) -> Vec<String> {
    let buffer = buffer(seen, [width, height], &Colours::some(), view);
    let row =
        |y| (0..width).map(|x| buffer[(x, y)].symbol().to_owned()).collect::<String>().trim_end().to_owned();
    (0..height).map(row).collect()
}

fn buffer(
    seen: &Seen,
    [width, height]: [u16; 2],
    colours: &Colours,
    mut view: View,
) -> ratatui::buffer::Buffer {
    let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("memory");
    terminal.draw(|frame| draw(frame, seen, colours, &mut view)).expect("memory takes it");
    terminal.backend().buffer().clone()
}

/// Rows of dots of Braille in a picture.
fn dotted(lines: &[String]) -> Vec<usize> {
    let is_dotted = |line: &String| line.chars().any(|c| ('\u{2801}'..='\u{28ff}').contains(&c));
    lines.iter().enumerate().filter(|(_, line)| is_dotted(line)).map(|(number, _)| number).collect()
}

#[test]
fn a_small_terminal_has_room_for_state_numbers_and_all_three_curves() {
    let lines = lines(&seen(RunState::Running, 0.5), [80, 24], BOTH);
    let text = lines.join("\n");
    for fragment in [
        "runs/steel  running",
        "t = 32.85 µs of 65.70 µs (50 %)",
        "step 20000",
        "Δt = 31.00 ns (fluid)",
        "cells: fluid 65536, solid 65536",
        "3m 5s left",
        "equivalent radius R(t): 7.00 mm, smallest 7.00 mm at 32.85 µs",
        "wall pressure on the axis: 50.00 MPa, largest 248.0 MPa at 26.28 µs",
        "largest von Mises stress: 50.00 MPa, largest 50.00 MPa at 32.85 µs",
        "65.70 µs",
        "q: leave",
    ] {
        assert!(text.contains(fragment), "no `{fragment}` in\n{text}");
    }
    let frames = lines.iter().filter(|line| line.starts_with('┌')).count();
    assert_eq!(frames, 3, "{text}");
    assert!(dotted(&lines).len() >= 9, "{text}");
}

/// A peak of one step is thinner than a column by far, and must reach the upper edge nevertheless.
#[test]
fn the_peak_of_a_single_step_is_drawn_where_it_was() {
    let mut only = seen(RunState::Running, 1.0);
    only.curves = vec![only.curves.swap_remove(1)];
    let lines = lines(&only, [100, 20], BOTH);
    let highest = dotted(&lines)[0];
    // The frame's and what is above it.
    assert!(highest <= 6, "{}", lines.join("\n"));
    let at = lines[highest].chars().position(|c| ('\u{2801}'..='\u{28ff}').contains(&c)).expect("a dot");
    assert!((70..=85).contains(&at), "column {at}\n{}", lines.join("\n"));
}

#[test]
fn no_terminal_is_too_small_or_too_large() {
    let mut finished = seen(RunState::Finished, 1.0);
    finished.answer = vec!["The wall pressure reaches 248 MPa at 50.7 µs. ".repeat(5); 6];
    for seen in [&finished, &seen(RunState::Running, 0.0)] {
        for size in [[1, 1], [2, 3], [10, 4], [20, 60], [40, 12], [79, 5], [300, 100]] {
            for view in [BOTH, ALONE, View { passed: 1000, ..ALONE }] {
                lines(seen, size, view);
            }
        }
    }
}

#[test]
fn a_finished_run_says_what_it_found_and_the_curves_stay() {
    let mut finished = seen(RunState::Finished, 1.0);
    finished.answer = vec!["The wall pressure reaches 248 MPa.".to_owned(), "Nothing yields.".to_owned()];
    let both = lines(&finished, [80, 24], BOTH);
    let text = both.join("\n");
    for fragment in
        ["finished", "what it found", "The wall pressure reaches 248 MPa.", "Nothing yields.", "100 %"]
    {
        assert!(text.contains(fragment), "no `{fragment}` in\n{text}");
    }
    assert!(!dotted(&both).is_empty(), "{text}");
    let long =
        "A sentence of some length that needs more than one line of a small terminal to be told. ".repeat(3);
    finished.answer = (0..6).map(|number| format!("{number} {long}")).collect();
    let first = lines(&finished, [80, 24], ALONE).join("\n");
    assert!(
        first.contains("0 A sentence") && first.contains("more below") && !first.contains("5 A sentence"),
        "{first}"
    );
    let alone = lines(&finished, [80, 24], View { passed: 1000, ..ALONE });
    assert!(alone.iter().any(|line| line.contains("5 A sentence")), "{}", alone.join("\n"));
    assert!(dotted(&alone).is_empty());
}

#[test]
fn a_run_that_settled_before_its_latest_time_is_finished_as_a_whole() {
    let text = lines(&seen(RunState::Finished, 0.2), [80, 24], BOTH).join("\n");
    assert!(text.contains("t = 13.14 µs of 13.14 µs (100 %)"), "{text}");
    assert!(!text.contains("20 %") && !text.contains("65.70 µs"), "the axis of time ends with it: {text}");
}

#[test]
fn the_largest_wall_pressure_of_a_finished_run_is_that_of_its_answer() {
    let mut finished = seen(RunState::Finished, 1.0);
    for (peak, said) in [(2.6e8, "largest 260.0 MPa at 50.70 µs"), (2.4e8, "largest 248.0 MPa at 52.56 µs")]
    {
        finished.curves[1].peak = Some([5.07e-5, peak]);
        let text = lines(&finished, [80, 24], BOTH).join("\n");
        assert!(text.contains(said), "no `{said}` in\n{text}");
    }
    // Of a bubble that grows from less than it collapses to, the curve is least at the start.
    finished.curves[0].peak = Some([5.07e-5, 2e-3]);
    let text = lines(&finished, [80, 24], BOTH).join("\n");
    assert!(text.contains("smallest 2.00 mm at 50.70 µs"), "{text}");
}

#[test]
fn a_run_that_failed_or_was_interrupted_says_why_and_what_helps() {
    let mut failed = seen(RunState::Failed, 0.4);
    failed.error = Some("the time step collapsed".to_owned());
    failed.can_go_on = true;
    let text = lines(&failed, [80, 24], BOTH).join("\n");
    for fragment in ["failed", "error: the time step collapsed", "cav run --resume runs/steel"] {
        assert!(text.contains(fragment), "no `{fragment}` in\n{text}");
    }
    let text = lines(&seen(RunState::Interrupted, 0.4), [80, 24], BOTH).join("\n");
    assert!(
        text.contains("interrupted") && !text.contains("--resume") && !text.contains(" left\n"),
        "{text}"
    );
}

#[test]
fn without_colours_there_are_none_and_the_words_are_the_same() {
    let seen = seen(RunState::Running, 0.5);
    let [some, none] =
        [Colours::some(), Colours::none()].map(|colours| buffer(&seen, [80, 24], &colours, BOTH));
    let coloured = |buffer: &ratatui::buffer::Buffer| {
        buffer.content().iter().filter(|cell| cell.fg != Color::Reset || cell.bg != Color::Reset).count()
    };
    assert!(coloured(&some) > 100);
    assert_eq!(coloured(&none), 0);
    let text = |buffer: &ratatui::buffer::Buffer| {
        buffer.content().iter().map(|cell| cell.symbol().to_owned()).collect::<String>()
    };
    assert_eq!(text(&some), text(&none));
}
