//! `time.local_steps`: whether levels of an adaptive grid step by themselves.

use std::fmt;

use toml::de::DeValue;

use super::reader::{Faults, Table};
use super::values::wrong_type;

/// Whether levels of an adaptive grid step by themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LocalSteps {
    /// All cells make the steps of the finest.
    Never,
    /// Where that saves work, decided before each step.
    Auto,
    /// As many levels as may.
    Always,
}

impl LocalSteps {
    /// How a case asks for [`LocalSteps::Auto`], which is the default.
    pub const AUTO: &'static str = "auto";

    /// Whether levels may step by themselves.
    pub fn may(self) -> bool {
        self != Self::Never
    }

    /// `local_steps` of `[time]`.
    pub(super) fn read(table: &mut Table<'_>, faults: &mut Faults) -> Self {
        let Some(given) = table.raw("local_steps") else { return Self::Auto };
        let allowed = format!("write {:?} in quotes, or true or false without", Self::AUTO);
        match given.value {
            DeValue::Boolean(true) => return Self::Always,
            DeValue::Boolean(false) => return Self::Never,
            DeValue::String(text) if text.as_ref() == Self::AUTO => {}
            DeValue::String(text) => faults.of(&given, format!("unknown name `{text}`"), allowed),
            _ => wrong_type(&given, "true, false or \"auto\"", allowed, faults),
        }
        Self::Auto
    }
}

/// As a case has it.
impl fmt::Display for LocalSteps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Never => f.write_str("false"),
            Self::Auto => write!(f, "{:?}", Self::AUTO),
            Self::Always => f.write_str("true"),
        }
    }
}
