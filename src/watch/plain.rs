//! A run in lines, for where there is no terminal.

use crate::output::progress::engineering;
use crate::watch::seen::{Seen, Titled};

/// What there is to see, once.
#[must_use]
pub fn lines(seen: &Seen) -> String {
    let mut lines = vec![format!("{}: {}", seen.name(), seen.state.name())];
    lines.push(format!("  {}", seen.facts().join("  ")));
    let width = seen.curves.iter().map(|titled| titled.title.chars().count()).max().unwrap_or(0);
    for titled in &seen.curves {
        lines.push(format!("  {:width$}  {}", titled.title, values(titled)));
    }
    lines.extend(seen.error.iter().map(|error| format!("  error: {error}")));
    lines.extend(seen.remedy().map(|remedy| format!("  {remedy}")));
    lines.extend(seen.trouble.iter().map(|trouble| format!("  {trouble}")));
    lines.extend(seen.answer.iter().map(|sentence| format!("  {sentence}")));
    lines.join("\n") + "\n"
}

/// The value at the end, and the one worth a word.
#[must_use]
pub fn values(titled: &Titled) -> String {
    let Some([_, now]) = titled.curve.last() else { return String::new() };
    let now = with_unit(now, titled.unit);
    match titled.extreme() {
        Some((word, [time, value])) => {
            format!("{now}, {word} {} at {}", with_unit(value, titled.unit), engineering(time, "s"))
        }
        None => now,
    }
}

/// A number with its unit; a share in per cent.
#[must_use]
pub fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { format!("{:.3} %", 100.0 * value) } else { engineering(value, unit) }
}
