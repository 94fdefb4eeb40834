//! What a table of a case file and a key of it are declared to be.

use std::fmt;
use std::ops::Bound;

/// A table of a case file, or what of it is about one subject.
///
/// Texts are Markdown; `[words][name]` leads to the page that [`super::links`] has under that name.
#[derive(Debug)]
pub struct Section {
    /// The path of the table, without the numbers of elements; empty for the top of the file.
    pub path: &'static str,
    /// Whether there may be any number of it, `[[path]]`.
    pub repeated: bool,
    /// What it is about.
    pub title: &'static str,
    /// What holds for all its keys.
    pub about: &'static str,
    /// Its keys, in the order in which they are told.
    pub keys: &'static [Key],
}

/// One key.
#[derive(Debug)]
pub struct Key {
    /// Its name within its table.
    pub name: &'static str,
    /// The unit of its numbers; empty where it has none.
    pub unit: &'static str,
    /// What it may be.
    pub values: Values,
    /// What it is where the case does not say.
    pub default: Preset,
    /// What it does.
    pub about: &'static str,
}

/// What a key may be.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// A finite number.
    Number,
    /// A number above zero.
    Positive,
    /// A number of an interval.
    Within(Interval),
    /// A whole number, from the first to the second.
    Whole(usize, usize),
    /// Two whole numbers, along z and r, each from the first to the second.
    Cells(usize, usize),
    /// Two numbers, along z and r.
    Point,
    /// Two numbers, the smaller one first.
    Range,
    /// `true` or `false`.
    Flag,
    /// One of these names; what each means.
    Names(&'static [(&'static str, &'static str)]),
    /// Anything else, in words.
    Words(&'static str),
    /// Some of what this lists.
    AnyOf(fn() -> Vec<&'static str>),
}

/// What a key is where the case does not say.
#[derive(Clone, Copy, Debug)]
pub enum Preset {
    /// It has to be said, if its table is there.
    Required,
    /// Nothing.
    None,
    /// A number.
    Number(f64),
    /// A whole number.
    Whole(usize),
    /// A name.
    Name(&'static str),
    /// `true` or `false`.
    Flag(bool),
    /// What follows from something else, in words.
    Words(&'static str),
}

/// An interval of numbers.
#[derive(Clone, Copy, Debug)]
pub struct Interval(pub Bound<f64>, pub Bound<f64>);

impl Interval {
    /// Without its ends.
    pub const fn open(low: f64, high: f64) -> Self {
        Self(Bound::Excluded(low), Bound::Excluded(high))
    }

    /// With its upper end alone.
    pub const fn above(low: f64, high: f64) -> Self {
        Self(Bound::Excluded(low), Bound::Included(high))
    }

    /// With its ends.
    pub const fn closed(low: f64, high: f64) -> Self {
        Self(Bound::Included(low), Bound::Included(high))
    }

    /// Its ends.
    pub fn ends(&self) -> (f64, f64) {
        let end = |bound, without| match bound {
            Bound::Included(end) | Bound::Excluded(end) => end,
            Bound::Unbounded => without,
        };
        (end(self.0, f64::NEG_INFINITY), end(self.1, f64::INFINITY))
    }

    /// Whether a number is of it.
    pub fn contains(&self, value: f64) -> bool {
        std::ops::RangeBounds::contains(&(self.0, self.1), &value)
    }
}

/// As in `(0, 0.9]`.
impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Bound::Included(low) => write!(f, "[{}", Plain(low))?,
            Bound::Excluded(low) => write!(f, "({}", Plain(low))?,
            Bound::Unbounded => write!(f, "(-inf")?,
        }
        match self.1 {
            Bound::Included(high) => write!(f, ", {}]", Plain(high)),
            Bound::Excluded(high) => write!(f, ", {})", Plain(high)),
            Bound::Unbounded => write!(f, ", inf)"),
        }
    }
}

/// A number as a person writes it: `30`, `0.45`, `1e-6`.
pub(super) struct Plain(pub f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = format!("{:?}", self.0);
        match digits.strip_suffix(".0") {
            Some(whole) if whole.len() > 6 => write!(f, "{:e}", self.0),
            Some(whole) => write!(f, "{whole}"),
            None => write!(f, "{digits}"),
        }
    }
}

impl Key {
    /// What it may be, in Markdown.
    pub fn allowed(&self) -> String {
        let quoted = |name: &&str| format!("`\"{name}\"`");
        match self.values {
            Values::Number => "a number".to_owned(),
            Values::Positive => "> 0".to_owned(),
            Values::Within(interval) => format!("{interval}"),
            Values::Whole(low, high) => format!("{low} to {high}"),
            Values::Cells(low, high) => format!("`[along z, along r]`, {low} to {high}"),
            Values::Point => "`[z, r]`".to_owned(),
            Values::Range => "`[low, high]`".to_owned(),
            Values::Flag => "`true`, `false`".to_owned(),
            Values::Names(names) => names.iter().map(|(name, _)| quoted(name)).collect::<Vec<_>>().join(", "),
            Values::Words(words) => words.to_owned(),
            Values::AnyOf(list) => {
                let names: Vec<String> = list().iter().map(quoted).collect();
                format!("any of {}", names.join(", "))
            }
        }
    }

    /// What it is where the case does not say, in Markdown.
    pub fn preset(&self) -> String {
        match self.default {
            Preset::Required => "required".to_owned(),
            Preset::None => "none".to_owned(),
            Preset::Number(number) => format!("{}", Plain(number)),
            Preset::Whole(number) => format!("{number}"),
            Preset::Name(name) => format!("`\"{name}\"`"),
            Preset::Flag(value) => format!("`{value}`"),
            Preset::Words(words) => words.to_owned(),
        }
    }

    /// Its unit with raised digits: `kg/m³`.
    pub fn printed_unit(&self) -> String {
        let raised = [("m2", "m²"), ("m3", "m³"), ("s2", "s²")];
        raised.iter().fold(self.unit.to_owned(), |unit, (flat, raised)| unit.replace(flat, raised))
    }
}

impl Section {
    /// Its line in a case file: `[fluid]`, `[[fluid.region]]`; nothing for the top.
    pub fn head(&self) -> String {
        match (self.path, self.repeated) {
            ("", _) => String::new(),
            (path, false) => format!("[{path}]"),
            (path, true) => format!("[[{path}]]"),
        }
    }

    /// The first of its keys that has the same names as this one, if it is another.
    pub fn same_names(&self, key: &Key) -> Option<&'static Key> {
        let Values::Names(names) = key.values else { return None };
        let has_them = |other: &&Key| matches!(other.values, Values::Names(others) if others == names);
        self.keys.iter().find(has_them).filter(|first| first.name != key.name)
    }

    /// The path of one of its keys.
    pub fn path_of(&self, key: &Key) -> String {
        if self.path.is_empty() { key.name.to_owned() } else { format!("{}.{}", self.path, key.name) }
    }
}
