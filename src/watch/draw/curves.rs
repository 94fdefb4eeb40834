//! The curves of a run over simulated time.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::symbols::Marker;
use ratatui::text::Line;
use ratatui::widgets::{Axis, Block, Chart, Dataset, GraphType, Paragraph};

use super::LOWEST;
use super::colours::Colours;
use crate::output::progress::engineering;
use crate::watch::plain::{values, with_unit};
use crate::watch::seen::{Seen, Titled};

/// Beyond the smallest and the largest value, as a share of what is between them.
const MARGIN: f64 = 0.05;

/// Draws all curves, one below the other, or side by side where there are too few rows.
pub(super) fn draw(frame: &mut Frame<'_>, area: Rect, seen: &Seen, colours: &Colours) {
    let count = seen.curves.len() as u16;
    if count == 0 {
        let words =
            "The curves appear with the first batch of histories, about a second after the first step.";
        frame.render_widget(Paragraph::new(words).style(colours.faint), area);
        return;
    }
    let parts = vec![Constraint::Ratio(1, u32::from(count)); usize::from(count)];
    let is_high = area.height >= count * LOWEST;
    let areas = if is_high { Layout::vertical(parts) } else { Layout::horizontal(parts) }.split(area);
    for (number, (titled, area)) in seen.curves.iter().zip(areas.iter()).enumerate() {
        let has_times = !is_high || number + 1 == usize::from(count);
        draw_one(frame, *area, titled, number, seen.ends(), has_times, colours);
    }
}

/// Draws a curve in its frame, with the axis of time below it if wanted.
fn draw_one(
    frame: &mut Frame<'_>,
    area: Rect,
    titled: &Titled,
    number: usize,
    end: Option<f64>,
    has_times: bool,
    colours: &Colours,
) {
    let last = titled.curve.last().map_or(0.0, |[time, _]| time);
    let end = end.unwrap_or(last).max(last).max(f64::MIN_POSITIVE);
    let [low, high] = range(titled);
    let label = |value: f64| Line::styled(with_unit(value, titled.unit), colours.faint);
    let title = Line::from(format!(" {}: {} ", titled.title, values(titled))).style(colours.curve(number));
    // Of a Braille character two columns of dots.
    let points = titled.curve.in_columns(2 * usize::from(area.width.max(1)), end);
    let points: Vec<(f64, f64)> = points.into_iter().map(|[time, value]| (time, value)).collect();
    let data = Dataset::default()
        .marker(Marker::Braille)
        .graph_type(GraphType::Line)
        .style(colours.curve(number))
        .data(&points);
    let mut times = Axis::default().bounds([0.0, end]).style(colours.frame);
    if has_times && area.height > LOWEST {
        times = times
            .labels([0.0, end / 2.0, end].map(|time| Line::styled(engineering(time, "s"), colours.faint)));
    }
    let y = Axis::default().bounds([low, high]).labels([label(low), label(high)]).style(colours.frame);
    let block = Block::bordered().title(title).border_style(colours.frame);
    frame.render_widget(
        Chart::new(vec![data]).x_axis(times).y_axis(y).legend_position(None).block(block),
        area,
    );
}

/// What the axis of values goes from and to.
fn range(titled: &Titled) -> [f64; 2] {
    let value = |point: Option<[f64; 2]>| point.map_or(0.0, |[_, value]| value);
    let (least, largest) = (value(titled.curve.least()), value(titled.curve.largest()));
    // What is never negative stands on its zero.
    let least = if least >= 0.0 && least < 0.5 * largest { 0.0 } else { least };
    let margin = MARGIN * (largest - least).max(1e-3 * largest.abs()).max(f64::MIN_POSITIVE * 1e3);
    [if least == 0.0 { 0.0 } else { least - margin }, largest + margin]
}
