//! A picture of a run on a terminal.

pub mod colours;
mod curves;

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, LineGauge, Paragraph, Wrap};

use crate::output::RunState;
use crate::watch::seen::Seen;
use colours::Colours;

/// Rows of the head: name and state, where it stands, and a bar.
const HEAD: u16 = 4;
/// Fewer rows than this are none to draw a curve in, its frame included.
const LOWEST: u16 = 5;

/// What of a run is shown where there is no room for all.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct View {
    /// The curves give way to the answer.
    pub answer_alone: bool,
    /// So many lines of the answer have been passed.
    pub passed: u16,
}

/// Draws a run.
pub fn draw(frame: &mut Frame<'_>, seen: &Seen, colours: &Colours, view: &mut View) {
    let [head, body, foot] =
        Layout::vertical([Constraint::Length(HEAD), Constraint::Min(0), Constraint::Length(1)])
            .areas(frame.area());
    draw_head(frame, head, seen, colours);
    let words = words(seen, colours);
    let needed = height(&words, body.width);
    let most = if view.answer_alone { body.height } else { body.height.saturating_sub(LOWEST) };
    let [curves, below] =
        Layout::vertical([Constraint::Min(0), Constraint::Length(needed.min(most))]).areas(body);
    if !view.answer_alone {
        curves::draw(frame, curves, seen, colours);
    }
    if needed > 0 && below.height > 0 {
        view.passed = view.passed.min(needed.saturating_sub(below.height));
        let has_more = needed > below.height + view.passed;
        let title = if has_more { " what it found (more below) " } else { " what it found " };
        let block = Block::bordered().title(title).border_style(colours.frame);
        let words = Paragraph::new(words).wrap(Wrap { trim: true }).scroll((view.passed, 0));
        frame.render_widget(words.block(block), below);
    }
    let keys = if seen.answer.is_empty() {
        "q: leave, the run goes on"
    } else {
        "q: leave   a: the answer alone, or with the curves   up, down: more of it"
    };
    frame.render_widget(Line::styled(keys, colours.faint), foot);
}

/// Name, state, where it stands, how much is done.
fn draw_head(frame: &mut Frame<'_>, area: Rect, seen: &Seen, colours: &Colours) {
    let [first, facts, bar] =
        Layout::vertical([Constraint::Length(1), Constraint::Length(2), Constraint::Length(1)]).areas(area);
    let state = Span::styled(seen.state.name(), colours.of(seen.state));
    frame.render_widget(
        Line::from(vec![Span::styled(seen.name(), colours.strong), Span::raw("  "), state]),
        first,
    );
    frame.render_widget(Paragraph::new(packed(&seen.facts(), area.width)), facts);
    let time = seen.standing.as_ref().map_or(0.0, |standing| standing.line.time);
    let share = match seen.end {
        _ if seen.state == RunState::Finished => 1.0,
        Some(end) if end > 0.0 => (time / end).clamp(0.0, 1.0),
        _ => 0.0,
    };
    let gauge = LineGauge::default()
        .ratio(share)
        .label(format!("{:3.0} %", 100.0 * share))
        .filled_style(colours.of(seen.state))
        .unfilled_style(colours.faint)
        .filled_symbol("━")
        .unfilled_symbol("─");
    frame.render_widget(gauge, bar);
}

/// Facts in lines of this width, none of them broken.
fn packed(facts: &[String], width: u16) -> Vec<Line<'static>> {
    let mut lines: Vec<String> = Vec::new();
    for fact in facts {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 3 + fact.chars().count() <= usize::from(width) => {
                line.push_str("   ");
                line.push_str(fact);
            }
            _ => lines.push(fact.clone()),
        }
    }
    lines.into_iter().map(Line::from).collect()
}

/// What is to be said besides: why it failed, what helps, what was found.
fn words<'a>(seen: &'a Seen, colours: &Colours) -> Vec<Line<'a>> {
    let error =
        seen.error.iter().map(|error| Line::styled(format!("error: {error}"), colours.of(RunState::Failed)));
    let trouble =
        seen.trouble.iter().map(|trouble| Line::styled(trouble.as_str(), colours.of(RunState::Failed)));
    let remedy = seen.remedy().map(|remedy| Line::styled(remedy, colours.strong));
    let answer = seen.answer.iter().map(|sentence| Line::raw(sentence.as_str()));
    error.chain(trouble).chain(remedy).chain(answer).collect()
}

/// Rows that lines take in a frame of this width, the frame included; 0 for none.
fn height(lines: &[Line<'_>], width: u16) -> u16 {
    let inside = usize::from(width.saturating_sub(2).max(1));
    // Words are not broken, so a line may take a row more than its length says; of long ones a tenth.
    let rows: usize = lines.iter().map(|line| (line.width() * 11 / 10).div_ceil(inside).max(1)).sum();
    if rows == 0 { 0 } else { u16::try_from(rows + 2).unwrap_or(u16::MAX) }
}

#[cfg(test)]
mod tests;
