//! `--where KEY=VALUE` and its kin.

use crate::runs::ListError;
use crate::runs::flat::Scalar;

/// Numbers that differ by less than this share of theirs are equal: `0.1` is what a case's 0.1 is.
const EQUAL: f64 = 1e-9;

/// How a value is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Relation {
    Equal,
    Differs,
    Less,
    AtMost,
    Greater,
    AtLeast,
    Contains,
}
use Relation::{AtLeast, AtMost, Contains, Differs, Equal, Greater, Less};

/// As they are written, those of two characters first.
const RELATIONS: [(&str, Relation); 7] = [
    ("!=", Differs),
    ("<=", AtMost),
    (">=", AtLeast),
    ("=", Equal),
    ("<", Less),
    (">", Greater),
    ("~", Contains),
];

/// What must hold of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// The key.
    pub key: String,
    relation: Relation,
    text: String,
    number: Option<f64>,
}

impl Condition {
    /// From `KEY=VALUE`, or another relation in place of `=`.
    ///
    /// - errors: [`ListError::Condition`].
    pub fn parse(given: &str) -> Result<Self, ListError> {
        let refused = |reason| ListError::Condition { text: given.to_owned(), reason };
        let at = given.find(['!', '<', '>', '=', '~']).ok_or_else(|| refused("it compares nothing"))?;
        let (key, rest) = given.split_at(at);
        let relation = RELATIONS.iter().find(|(written, _)| rest.starts_with(written));
        let (written, relation) = relation.ok_or_else(|| refused("it compares nothing"))?;
        let text = rest[written.len()..].trim().trim_matches(['"', '\'']).to_owned();
        let number = text.parse().ok().filter(|number: &f64| number.is_finite());
        if key.trim().is_empty() {
            return Err(refused("the key is missing"));
        }
        if text.is_empty() {
            return Err(refused("the value is missing"));
        }
        if number.is_none() && matches!(relation, Less | AtMost | Greater | AtLeast) {
            return Err(refused("only numbers are smaller or larger"));
        }
        Ok(Self { key: key.trim().to_owned(), relation: *relation, text, number })
    }

    /// Whether it holds of a value. Of none nothing holds.
    #[must_use]
    pub fn holds(&self, value: Option<&Scalar>) -> bool {
        let Some(value) = value.filter(|value| !value.is_null()) else { return false };
        let numbers = value.number().zip(self.number);
        let is_equal = || match numbers {
            Some((one, other)) => (one - other).abs() <= EQUAL * one.abs().max(other.abs()),
            None => value.to_string() == self.text,
        };
        let compared = |holds: fn(f64, f64) -> bool| numbers.is_some_and(|(one, other)| holds(one, other));
        match self.relation {
            Equal => is_equal(),
            Differs => !is_equal(),
            Less => compared(|one, other| one < other),
            AtMost => compared(|one, other| one <= other) || numbers.is_some() && is_equal(),
            Greater => compared(|one, other| one > other),
            AtLeast => compared(|one, other| one >= other) || numbers.is_some() && is_equal(),
            Contains => value.to_string().contains(&self.text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_hold_of_the_values_that_they_name_and_of_no_others() {
        let steel = Scalar::Text("structural-steel".to_owned());
        let (peak, whole, truth) = (Scalar::Float(2.48e8), Scalar::Integer(5), Scalar::Bool(true));
        for (condition, value, expected) in [
            ("solid.material=structural-steel", &steel, true),
            ("solid.material = 'structural-steel'", &steel, true),
            ("solid.material=steel", &steel, false),
            ("solid.material~steel", &steel, true),
            ("solid.material!=copper", &steel, true),
            ("solid.material>1", &steel, false),
            ("p>1e8", &peak, true),
            ("p > 2.48e8", &peak, false),
            ("p>=248000000", &peak, true),
            ("p<=0.248e9", &peak, true),
            ("p<1e9", &peak, true),
            ("p=2.48e8", &peak, true),
            ("levels=5", &whole, true),
            ("levels=5.0", &whole, true),
            ("levels!=5", &whole, false),
            ("adapt=true", &truth, true),
            ("pit!=1", &Scalar::Null, false),
        ] {
            let parsed = Condition::parse(condition).unwrap_or_else(|error| panic!("{condition}: {error}"));
            assert_eq!(parsed.holds(Some(value)), expected, "{condition} of {value}");
            assert!(!parsed.holds(None));
        }
    }

    #[test]
    fn what_is_no_condition_is_refused_with_the_reason() {
        for (text, reason) in [
            ("peak", "compares nothing"),
            ("=3", "key is missing"),
            ("p>", "value is missing"),
            ("p>many", "only numbers"),
        ] {
            let error = Condition::parse(text).expect_err(text).to_string();
            assert!(error.contains(reason) && error.contains("KEY=VALUE"), "{error}");
        }
    }
}
