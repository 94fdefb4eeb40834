//! Colours, or none.

use ratatui::style::{Color, Modifier, Style};

use crate::output::RunState;

/// How things are set off from each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colours {
    /// Names.
    pub strong: Style,
    /// What one need not read.
    pub faint: Style,
    /// Frames and axes.
    pub frame: Style,
    curves: [Style; 3],
    states: [Style; 4],
}

impl Colours {
    /// With colours: those that a terminal of sixteen has.
    #[must_use]
    pub fn some() -> Self {
        let of = |colour: Color| Style::new().fg(colour);
        Self {
            strong: Style::new().add_modifier(Modifier::BOLD),
            faint: of(Color::DarkGray),
            frame: of(Color::DarkGray),
            curves: [Color::Cyan, Color::Yellow, Color::Magenta].map(of),
            states: [Color::Green, Color::Blue, Color::Red, Color::Yellow].map(of),
        }
    }

    /// Without: everything is told by words and shapes alone.
    #[must_use]
    pub fn none() -> Self {
        let plain = Style::new();
        Self { strong: plain, faint: plain, frame: plain, curves: [plain; 3], states: [plain; 4] }
    }

    /// As the environment asks for: none where `NO_COLOR` is anything but empty.
    #[must_use]
    pub fn of_environment() -> Self {
        let is_refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        if is_refused { Self::none() } else { Self::some() }
    }

    /// Of a state.
    #[must_use]
    pub fn of(&self, state: RunState) -> Style {
        self.states[state as usize]
    }

    /// Of the curve with this number.
    #[must_use]
    pub fn curve(&self, number: usize) -> Style {
        self.curves[number % self.curves.len()]
    }
}
