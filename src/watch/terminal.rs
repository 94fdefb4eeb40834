//! Looks, draws, and minds the keys.

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use signal_hook::consts::{SIGHUP, SIGTERM};

use crate::output::OutputError;
use crate::watch::draw::colours::Colours;
use crate::watch::draw::{View, draw};
use crate::watch::plain;
use crate::watch::reader::Reader;
use crate::watch::seen::Seen;

/// How long keys are waited for before signals are looked at.
const KEY_INTERVAL: Duration = Duration::from_millis(100);

/// Shows the run in a directory until it is told to leave; without a terminal once.
///
/// - `every`: time between two looks at the files.
/// - errors: there is no run in the directory.
pub fn watch(directory: &Path, every: Duration) -> Result<(), OutputError> {
    let mut reader = Reader::new(directory);
    let seen = reader.look()?;
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    if !io::stdout().is_terminal() || !io::stdin().is_terminal() || is_dumb {
        print(&seen);
        return Ok(());
    }
    // A terminal is given back whole, whoever ends this.
    let asked = Arc::new(AtomicBool::new(false));
    let minded = [SIGTERM, SIGHUP].map(|signal| signal_hook::flag::register(signal, Arc::clone(&asked)));
    let shown = minded.into_iter().collect::<io::Result<Vec<_>>>().and_then(|_| {
        let mut terminal = ratatui::try_init()?;
        let shown = show(&mut terminal, &mut reader, seen.clone(), every, &asked);
        ratatui::restore();
        shown
    });
    if shown.is_err() {
        // A terminal that does not do as it is asked; the lines it may still take.
        print(&seen);
    }
    Ok(())
}

/// Prints what there is to see.
fn print(seen: &Seen) {
    let mut out = io::stdout().lock();
    // A reader that has seen enough is no error.
    let _ = out.write_all(plain::lines(seen).as_bytes()).and_then(|()| out.flush());
}

/// Looks and draws until a key or a signal asks for the end.
fn show(
    terminal: &mut DefaultTerminal,
    reader: &mut Reader,
    mut seen: Seen,
    every: Duration,
    asked: &AtomicBool,
) -> io::Result<()> {
    let colours = Colours::of_environment();
    let (mut view, mut looked) = (View::default(), Instant::now());
    loop {
        terminal.draw(|frame| draw(frame, &seen, &colours, &mut view))?;
        while looked.elapsed() < every {
            if asked.load(Ordering::Relaxed) {
                return Ok(());
            }
            if !event::poll(KEY_INTERVAL.min(every.saturating_sub(looked.elapsed())))? {
                continue;
            }
            match event::read()? {
                Event::Key(key) if leaves(key) => return Ok(()),
                Event::Key(key) => turn(&mut view, key.code),
                _ => {}
            }
            // At once in the new size.
            terminal.draw(|frame| draw(frame, &seen, &colours, &mut view))?;
        }
        looked = Instant::now();
        match reader.look() {
            Ok(latest) => seen = latest,
            // It may have been moved; what was seen last stays.
            Err(error) => seen.trouble = Some(error.to_string()),
        }
    }
}

/// What else a key asks for.
fn turn(view: &mut View, key: KeyCode) {
    match key {
        KeyCode::Char('a') => view.answer_alone = !view.answer_alone,
        KeyCode::Down => view.passed = view.passed.saturating_add(1),
        KeyCode::Up => view.passed = view.passed.saturating_sub(1),
        _ => {}
    }
}

/// Whether a key asks to leave.
fn leaves(key: KeyEvent) -> bool {
    let is_control_c = key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
    key.kind == KeyEventKind::Press && (is_control_c || matches!(key.code, KeyCode::Char('q') | KeyCode::Esc))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn q_escape_and_control_c_leave_and_nothing_else_does() {
        let key = |code, modifiers| KeyEvent::new(code, modifiers);
        let none = KeyModifiers::NONE;
        assert!(leaves(key(KeyCode::Char('q'), none)) && leaves(key(KeyCode::Esc, none)));
        assert!(leaves(key(KeyCode::Char('c'), KeyModifiers::CONTROL)));
        assert!(!leaves(key(KeyCode::Char('c'), none)) && !leaves(key(KeyCode::Enter, none)));
    }
}
