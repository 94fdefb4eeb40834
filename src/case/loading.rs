//! Cases from files and texts.

use std::path::Path;

use super::{Case, CaseError, CaseErrors, read, set};

impl Case {
    /// Reads a case file, with `--set KEY=VALUE` changes applied to it.
    ///
    /// # Errors
    /// Everything that is wrong with it: no such file, not TOML, unknown keys, values that make no sense.
    pub fn load(path: &Path, sets: &[String]) -> Result<Self, CaseErrors> {
        let stem = path.file_stem().map_or_else(|| "case".into(), |stem| stem.to_string_lossy());
        Self::read(&Self::text_of(path)?, &stem, &path.display().to_string(), sets)
    }

    /// The text of a case file.
    ///
    /// # Errors
    /// There is none, or it is no text.
    pub fn text_of(path: &Path) -> Result<String, CaseErrors> {
        std::fs::read_to_string(path).map_err(|error| {
            let shown = path.display().to_string();
            let help = match error.kind() {
                std::io::ErrorKind::NotFound => "check the path; cases/ holds examples",
                std::io::ErrorKind::InvalidData => "a case is a text file in UTF-8",
                std::io::ErrorKind::IsADirectory => "give the TOML file in it",
                _ => "check that the file may be read",
            };
            let message = format!("cannot read the case file: {error}");
            let fault = CaseError { path: shown.clone(), message, help: Some(help.to_owned()), span: None };
            CaseErrors::new(&shown, "", vec![fault])
        })
    }

    /// Reads a case from text; `name` becomes the case's name.
    ///
    /// # Errors
    /// As [`Case::load`].
    pub fn from_toml(text: &str, name: &str, sets: &[String]) -> Result<Self, CaseErrors> {
        Self::read(text, name, &format!("{name}.toml"), sets)
    }

    /// Reads a case from text; `name` becomes the case's name, and `shown` is what errors call the text.
    ///
    /// # Errors
    /// As [`Case::load`].
    pub fn read(text: &str, name: &str, shown: &str, sets: &[String]) -> Result<Self, CaseErrors> {
        let syntax = |text: &str, errors: Vec<toml::de::Error>| {
            let fault = |error: toml::de::Error| CaseError {
                path: String::new(),
                message: format!("not TOML: {}", error.message()),
                help: Some("see https://toml.io for the format".to_owned()),
                span: error.span(),
            };
            CaseErrors::new(shown, text, errors.into_iter().map(fault).collect())
        };
        let (_, errors) = toml::de::DeTable::parse_recoverable(text);
        if !errors.is_empty() {
            return Err(syntax(text, errors));
        }
        if sets.is_empty() {
            return read::case(text, name).map_err(|faults| CaseErrors::new(shown, text, faults));
        }
        let shown = format!("{shown} with --set");
        let text = set::apply(text, sets).map_err(|faults| CaseErrors::new(&shown, "", faults))?;
        read::case(&text, name).map_err(|faults| CaseErrors::new(&shown, &text, faults))
    }
}
