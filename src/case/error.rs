//! What is wrong with a case, told so that it can be put right.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

/// One fault of a case file: the key, what is wrong with it, and the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseError {
    /// The key with its tables and array elements, as `--set` takes it: `fluid.region.0.radius`.
    pub path: String,
    /// What is wrong, with the value that was given.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
    /// Bytes of the text that are meant; absent when a whole file or a `--set` is at fault.
    pub span: Option<Range<usize>>,
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.path.is_empty() {
            write!(f, "{}", self.message)
        } else {
            write!(f, "{}: {}", self.path, self.message)
        }
    }
}

impl std::error::Error for CaseError {}

impl Diagnostic for CaseError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.span.clone()?;
        Some(Box::new(std::iter::once(LabeledSpan::new(None, span.start, span.len()))))
    }
}

/// All faults of a case file, in the order of the text.
#[derive(Debug)]
pub struct CaseErrors {
    faults: Vec<CaseError>,
    source: NamedSource<String>,
}

impl CaseErrors {
    pub(super) fn new(name: &str, text: &str, mut faults: Vec<CaseError>) -> Self {
        faults.sort_by_key(|fault| fault.span.as_ref().map_or(0, |span| span.start));
        faults.dedup();
        Self { faults, source: NamedSource::new(name, text.to_owned()) }
    }

    /// The faults, at least one.
    pub fn faults(&self) -> &[CaseError] {
        &self.faults
    }

    /// Line and column (from 1, in characters) where a fault begins.
    pub fn position(&self, fault: &CaseError) -> Option<(usize, usize)> {
        let before = self.source.inner().get(..fault.span.as_ref()?.start)?;
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Some((before.matches('\n').count() + 1, before[line_start..].chars().count() + 1))
    }

    /// The faults with the lines of the text they are in, for a terminal (`colour`) or a file.
    pub fn render(&self, colour: bool) -> String {
        let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::none() };
        let handler = GraphicalReportHandler::new_themed(theme).with_width(110).without_cause_chain();
        let mut text = String::new();
        for fault in &self.faults {
            let drawn = Drawn { fault, source: fault.span.as_ref().map(|_| &self.source) };
            if handler.render_report(&mut text, &drawn).is_err() {
                return self.to_string();
            }
            text.push('\n');
        }
        let count = match self.faults.len() {
            1 => "1 fault".to_owned(),
            several => format!("{several} faults"),
        };
        text + &format!("{count} in {}\n", self.source.name())
    }
}

/// A fault with the text it is in.
#[derive(Debug)]
struct Drawn<'a> {
    fault: &'a CaseError,
    source: Option<&'a NamedSource<String>>,
}

impl fmt::Display for Drawn<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fault.fmt(f)
    }
}

impl std::error::Error for Drawn<'_> {}

impl Diagnostic for Drawn<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.fault.help()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.fault.labels()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.map(|source| source as &dyn SourceCode)
    }
}

/// One line per fault: `case.toml:3:5: fluid.liquid.gamma: must be ... (remedy)`.
impl fmt::Display for CaseErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, fault) in self.faults.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{}", self.source.name())?;
            if let Some((line, column)) = self.position(fault) {
                write!(f, ":{line}:{column}")?;
            }
            write!(f, ": {fault}")?;
            if let Some(help) = &fault.help {
                write!(f, " ({help})")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for CaseErrors {}

impl Diagnostic for CaseErrors {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source)
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.faults.iter().map(|fault| fault as &dyn Diagnostic)))
    }
}

/// "did you mean `x`?", or the whole list where nothing is near.
pub(super) fn suggest<'n>(given: &str, allowed: impl IntoIterator<Item = &'n str>) -> String {
    let allowed: Vec<&str> = allowed.into_iter().collect();
    let list = allowed.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    match nearest(given, &allowed) {
        Some(name) => format!("did you mean `{name}`? Allowed: {list}"),
        None => format!("allowed: {list}"),
    }
}

/// The allowed name that is nearest to a mistyped one, if any is near at all.
pub(super) fn nearest<'n>(given: &str, allowed: &[&'n str]) -> Option<&'n str> {
    let given = given.to_lowercase().replace(['_', ' '], "-");
    allowed
        .iter()
        .map(|name| (strsim::damerau_levenshtein(&given, &name.replace('_', "-")), *name))
        .filter(|(distance, name)| {
            *distance <= (name.len() / 3).max(1)
                || (given.len() > 3 && (name.starts_with(&given) || given.starts_with(name)))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
        .or_else(|| allowed.iter().find(|name| given.len() > 3 && name.contains(&given)).copied())
}
