//! Values of a case file with their places, and the faults found in them.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::error::CaseError;

/// Numbers of larger magnitude are mistakes: squares and products of several would leave the range of `f64`.
pub(super) const LARGEST: f64 = 1e60;
/// Positive numbers below this are mistakes likewise.
pub(super) const SMALLEST: f64 = 1e-60;

/// A value with the key it stands under and its place in the text.
#[derive(Clone, Debug)]
pub(super) struct Given<T> {
    pub value: T,
    pub path: String,
    pub span: Range<usize>,
}

/// The faults found so far.
#[derive(Default)]
pub(super) struct Faults(pub Vec<CaseError>);

impl Faults {
    /// Records a fault at a place of the text.
    pub fn at(
        &mut self,
        path: &str,
        span: &Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.0.push(CaseError {
            path: path.to_owned(),
            message: message.into(),
            help: Some(help.into()),
            span: Some(span.clone()),
        });
    }

    /// Records a fault of a value that was read.
    pub fn of<T>(&mut self, given: &Given<T>, message: impl Into<String>, help: impl Into<String>) {
        self.at(&given.path, &given.span, message, help);
    }
}

/// What a TOML value is called in a message, with the value where it is short.
pub(super) fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("the string \"{text}\""),
        DeValue::Integer(number) => format!("the whole number {number}"),
        DeValue::Float(number) => format!("the number {number}"),
        DeValue::Boolean(value) => format!("{value}"),
        DeValue::Datetime(value) => format!("the date {value}"),
        DeValue::Array(_) => "an array".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

pub(super) fn wrong_type(given: &Given<&DeValue<'_>>, expected: &str, help: String, faults: &mut Faults) {
    faults.of(given, format!("must be {expected}, got {}", describe(given.value)), help);
}

/// The elements of an array, each with its own path and place.
pub(super) fn array<'a>(
    given: &Given<&'a DeValue<'a>>,
    expected: &str,
    unit: &str,
    faults: &mut Faults,
) -> Option<Vec<Given<&'a DeValue<'a>>>> {
    let DeValue::Array(elements) = given.value else {
        wrong_type(given, expected, format!("write [..., ...] with values in {unit}"), faults);
        return None;
    };
    let element = |(index, element): (usize, &'a Spanned<DeValue<'a>>)| Given {
        value: element.get_ref(),
        path: format!("{}.{index}", given.path),
        span: element.span(),
    };
    Some(elements.iter().enumerate().map(element).collect())
}

/// What a value is as a number, finite or not; `None` where it is none.
pub(super) fn as_number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(number) => number.as_str().parse().ok(),
        DeValue::Integer(number) => {
            i64::from_str_radix(number.as_str(), number.radix()).ok().map(|n| n as f64)
        }
        _ => None,
    }
}

/// A finite number; integers count.
pub(super) fn number(given: &Given<&DeValue<'_>>, unit: &str, faults: &mut Faults) -> Option<f64> {
    if !matches!(given.value, DeValue::Float(_) | DeValue::Integer(_)) {
        let help = format!("give a number without quotes, in {unit}");
        wrong_type(given, "a number", help, faults);
        return None;
    }
    let value = as_number(given.value);
    match value {
        Some(value) if value.abs() <= LARGEST => Some(value),
        Some(value) if value.is_finite() => {
            let message = format!("must not exceed {LARGEST:e} in magnitude, got {value:e}");
            faults.of(given, message, format!("give a smaller number in {unit}"));
            None
        }
        _ => {
            let message = format!("must be finite, got {}", describe(given.value));
            faults.of(given, message, format!("give a finite number in {unit}"));
            None
        }
    }
}

/// Two finite numbers.
pub(super) fn pair(given: &Given<&DeValue<'_>>, unit: &str, faults: &mut Faults) -> Option<[f64; 2]> {
    let elements = array(given, "two numbers", unit, faults)?;
    let [first, second] = elements.as_slice() else {
        let message = format!("must be two numbers, got {}", elements.len());
        faults.of(given, message, format!("write [..., ...] with values in {unit}"));
        return None;
    };
    let (first, second) = (number(first, unit, faults), number(second, unit, faults));
    Some([first?, second?])
}

/// A whole number in a range.
pub(super) fn whole(
    given: &Given<&DeValue<'_>>,
    allowed: &std::ops::RangeInclusive<usize>,
    faults: &mut Faults,
) -> Option<usize> {
    let help = format!("give a whole number from {} to {}", allowed.start(), allowed.end());
    let DeValue::Integer(number) = given.value else {
        wrong_type(given, "a whole number", help, faults);
        return None;
    };
    let value = usize::from_str_radix(number.as_str(), number.radix()).ok();
    if let Some(value) = value.filter(|value| allowed.contains(value)) {
        return Some(value);
    }
    let message = format!("must be from {} to {}, got {number}", allowed.start(), allowed.end());
    faults.of(given, message, help);
    None
}
