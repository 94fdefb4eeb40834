//! How far a run is: a bar on a terminal, else a plain line every few seconds, always on standard error.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::RunDirectory;
use super::progress_file::{ProgressFile, Standing};
use super::progress_line::ProgressLine;
use super::throttle::Throttle;

/// Time between two updates of the bar.
const BAR_INTERVAL: Duration = Duration::from_millis(100);
/// Time between two plain lines.
const LINE_INTERVAL: Duration = Duration::from_secs(5);
/// Time between two plain lines when more was asked for.
const VERBOSE_LINE_INTERVAL: Duration = Duration::from_secs(1);
/// Wall time in seconds over which the speed is averaged for the estimate of the time left.
const SPEED_MEMORY: f64 = 10.0;
/// Positions of the bar.
const BAR_STEPS: u64 = 1000;

/// Shows how far a run is.
#[derive(Debug)]
pub struct Progress {
    end_time: f64,
    display: Display,
    throttle: Throttle,
    speed: Speed,
    file: Option<ProgressFile>,
}

#[derive(Debug)]
enum Display {
    Nothing,
    Lines,
    Bar(ProgressBar),
}

impl Progress {
    /// For a run to the simulated time `end_time` in s. `quiet` shows nothing; `verbosity` > 0 shows plain lines, and more
    /// of them, also on a terminal, so that they go between the lines of a log.
    pub fn new(end_time: f64, quiet: bool, verbosity: u8) -> Self {
        let (display, interval) = if quiet {
            (Display::Nothing, LINE_INTERVAL)
        } else if verbosity > 0 {
            (Display::Lines, VERBOSE_LINE_INTERVAL)
        } else if std::io::stderr().is_terminal() {
            (Display::Bar(bar()), BAR_INTERVAL)
        } else {
            (Display::Lines, LINE_INTERVAL)
        };
        Self { end_time, display, throttle: Throttle::new(interval), speed: Speed::default(), file: None }
    }

    /// The same, which also tells whoever looks at the run's directory, quiet or not.
    #[must_use]
    pub fn told_in(self, directory: &RunDirectory) -> Self {
        Self { file: Some(ProgressFile::new(directory)), ..self }
    }

    /// Takes notice of a step; shows it if it is time to.
    pub fn update(&mut self, line: &ProgressLine) {
        self.speed.update(line.wall, line.time);
        if let Some(file) = &mut self.file
            && file.is_due()
        {
            let left = self.speed.seconds_to(self.end_time - line.time);
            file.write(&Standing { line: line.clone(), end: self.end_time, left });
        }
        if matches!(self.display, Display::Nothing) || !self.throttle.is_due() {
            return;
        }
        let text = describe(line, self.end_time, self.speed.seconds_to(self.end_time - line.time));
        match &self.display {
            Display::Nothing => {}
            Display::Lines => eprintln!("{:3.0} %  {text}", 100.0 * self.fraction(line)),
            Display::Bar(bar) => {
                bar.set_position((self.fraction(line) * BAR_STEPS as f64) as u64);
                bar.set_message(text);
            }
        }
    }

    /// Shows a message without disturbing the bar.
    pub fn message(&self, text: &str) {
        match &self.display {
            Display::Nothing => {}
            Display::Lines => eprintln!("{text}"),
            Display::Bar(bar) => bar.suspend(|| eprintln!("{text}")),
        }
    }

    /// Takes the bar away and shows a last message.
    pub fn finish(&self, text: &str) {
        self.clear();
        self.message(text);
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }

    fn fraction(&self, line: &ProgressLine) -> f64 {
        if self.end_time > 0.0 { (line.time / self.end_time).clamp(0.0, 1.0) } else { 1.0 }
    }
}

fn bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:24} {percent:>3} %  {wide_msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr()).with_style(style)
}

/// Simulated time, step, step length and who limits it, cells and the time left, in one line.
fn describe(line: &ProgressLine, end_time: f64, left: Option<f64>) -> String {
    let whole = |seconds: f64| Duration::from_secs(seconds.max(0.0).round() as u64);
    let left =
        left.map_or_else(|| "?".to_owned(), |left| humantime::format_duration(whole(left)).to_string());
    format!(
        "t = {} of {}  step {}  Δt = {} ({})  {} cells  {} left",
        engineering(line.time, "s"),
        engineering(end_time, "s"),
        line.step,
        engineering(line.dt, "s"),
        line.limited_by,
        line.cells,
        left
    )
}

/// A number with its unit, the prefix chosen so that 1 to 999 stand before the point: `12.35 µs`.
pub fn engineering(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 9] = [
        (1e9, "G"),
        (1e6, "M"),
        (1e3, "k"),
        (1.0, ""),
        (1e-3, "m"),
        (1e-6, "µ"),
        (1e-9, "n"),
        (1e-12, "p"),
        (1e-15, "f"),
    ];
    // From the value as it will be rounded, so that 999.999 ns become 1.00 µs.
    let found = PREFIXES.iter().find(|(factor, _)| value.abs() / factor >= 0.99995);
    let (factor, prefix) = found.unwrap_or(&(1.0, ""));
    let scaled = value / factor;
    let decimals = if scaled == 0.0 || scaled.abs() >= 99.995 { 1 } else { 2 };
    format!("{scaled:.decimals$} {prefix}{unit}")
}

/// Simulated time per wall time, averaged over the last seconds: the step length changes much in a collapse.
#[derive(Debug, Default)]
struct Speed {
    last: Option<(f64, f64)>,
    mean: Option<f64>,
}

impl Speed {
    fn update(&mut self, wall: f64, time: f64) {
        let (last_wall, last_time) = *self.last.get_or_insert((wall, time));
        let elapsed = wall - last_wall;
        // Too short a piece of wall time would be mostly noise of the clock.
        if elapsed < 0.05 {
            return;
        }
        let now = (time - last_time) / elapsed;
        let weight = 1.0 - (-elapsed / SPEED_MEMORY).exp();
        self.mean = Some(self.mean.map_or(now, |mean| mean + weight * (now - mean)));
        self.last = Some((wall, time));
    }

    /// Wall seconds for a piece of simulated time; `None` while the speed is not known.
    fn seconds_to(&self, time: f64) -> Option<f64> {
        self.mean.filter(|&mean| mean > 0.0).map(|mean| time.max(0.0) / mean)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_line_says_time_step_limit_cells_and_time_left() {
        let text = describe(&ProgressLine::example(), 6.57e-5, Some(185.0));
        assert_eq!(
            text,
            "t = 12.50 µs of 65.70 µs  step 340  Δt = 31.00 ns (fluid)  131072 cells  3m 5s left"
        );
    }

    #[test]
    fn prefixes_change_at_a_thousand() {
        let cases = [
            (0.0, "0.0 s"),
            (1e-6, "1.00 µs"),
            (999.96e-9, "1.00 µs"),
            (999.4e-9, "999.4 ns"),
            (-2.5e8, "-250.0 Ms"),
            (1e-30, "0.00 s"),
        ];
        for (value, text) in cases {
            assert_eq!(engineering(value, "s"), text);
        }
    }

    #[test]
    fn the_time_left_follows_a_change_of_speed() {
        let mut speed = Speed::default();
        assert_eq!(speed.seconds_to(1.0), None);
        for second in 0..=20 {
            speed.update(f64::from(second), 2.0 * f64::from(second));
        }
        assert!((speed.seconds_to(10.0).unwrap() - 5.0).abs() < 1e-9);
        for second in 1..=60 {
            speed.update(20.0 + f64::from(second), 40.0 + f64::from(second));
        }
        let left = speed.seconds_to(10.0).unwrap();
        assert!((left - 10.0).abs() < 0.1, "half the speed, twice the time: {left}");
    }
}
