//! Numbers with units, as they are given on the command line: `1mm`, `10bar`, `2.5 us`.
//!
//! Case files know SI alone; this is the one place where units are accepted.

/// What a number measures, and the units it may be given in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Metres.
    Length,
    /// Pascals.
    Pressure,
    /// Seconds.
    Time,
}

impl Dimension {
    /// Units by name, with what they are in SI; the first is the SI unit itself.
    const fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Length => &[
                ("m", 1.0),
                ("cm", 1e-2),
                ("mm", 1e-3),
                ("um", 1e-6),
                ("µm", 1e-6),
                ("μm", 1e-6),
                ("nm", 1e-9),
            ],
            Self::Pressure => &[
                ("Pa", 1.0),
                ("kPa", 1e3),
                ("MPa", 1e6),
                ("GPa", 1e9),
                ("mbar", 1e2),
                ("bar", 1e5),
                ("atm", 101_325.0),
            ],
            Self::Time => &[("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("μs", 1e-6), ("ns", 1e-9)],
        }
    }

    /// The shortest text that [`Self::parse`] reads as this value.
    pub fn shortest(self, value: f64) -> String {
        let texts = self.units().iter().filter(|(name, _)| name.is_ascii()).map(|(name, scale)| {
            // Without the round-off of the division, where that is the same number.
            let [exact, rounded] =
                [value / scale, format!("{:.12e}", value / scale).parse().unwrap_or(value / scale)];
            [format!("{rounded}{name}"), format!("{exact}{name}")]
        });
        let same = texts.flatten().filter(|text| self.parse(text) == Ok(value));
        same.min_by_key(String::len).unwrap_or_else(|| format!("{value:e}"))
    }

    /// A number with a unit behind it, or without one in SI.
    ///
    /// # Errors
    /// No finite number, or a unit that does not measure this: the message says what may be given.
    pub fn parse(self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let begins = text.char_indices().find(|(at, letter)| {
            let rest = &text[at + letter.len_utf8()..];
            // The letter of an exponent is followed by its digits.
            let exponent = matches!(letter, 'e' | 'E')
                && rest.starts_with(|next: char| next.is_ascii_digit() || "+-".contains(next));
            letter.is_alphabetic() && !exponent
        });
        let (number, unit) = begins.map_or((text, ""), |(at, _)| text.split_at(at));
        let units = self.units();
        let scale = match unit {
            "" => Some(1.0),
            _ => units.iter().find(|(name, _)| *name == unit).map(|(_, scale)| *scale),
        };
        let value = number.trim().parse::<f64>().ok();
        value
            .zip(scale)
            .map(|(value, scale)| scaled(value, scale))
            .filter(|value| value.is_finite())
            .ok_or_else(|| {
                let names: Vec<&str> = units
                    .iter()
                    .map(|(name, _)| *name)
                    .filter(|name| *name != "μm" && *name != "μs")
                    .collect();
                format!("give a number with {}, or without a unit in {}", names.join(", "), units[0].0)
            })
    }
}

/// A number in another unit, as the decimal number that is meant: 2.5 µs is 2.5e-6 s to the last bit.
fn scaled(value: f64, scale: f64) -> f64 {
    let product = value * scale;
    // Numbers given in decimals have at most 15 digits that count.
    let decimal = format!("{product:.14e}").parse().unwrap_or(product);
    if ((decimal - product) / product).abs() < 4.0 * f64::EPSILON { decimal } else { product }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_text_is_read_as_the_same_number() {
        for (dimension, value, text) in [
            (Dimension::Length, 1e-3, "1mm"),
            (Dimension::Length, 1.5e-4, "150um"),
            (Dimension::Pressure, 2e7, "20MPa"),
            (Dimension::Pressure, 2340.0, "2340Pa"),
            (Dimension::Time, 2.5e-6, "2.5us"),
        ] {
            assert_eq!(dimension.shortest(value), text);
        }
        for value in [1.0 / 3.0, 7.0e-7, 123_456.789, 1e-30, 6.02e23] {
            assert_eq!(Dimension::Pressure.parse(&Dimension::Pressure.shortest(value)), Ok(value));
        }
    }

    #[test]
    fn numbers_have_the_units_of_what_they_measure() {
        let close = |found: Result<f64, String>, expected: f64| {
            found.is_ok_and(|found| (found / expected - 1.0).abs() < 1e-15)
        };
        for (text, expected) in [
            ("1mm", 1e-3),
            ("2.5 um", 2.5e-6),
            ("3µm", 3e-6),
            ("1e-3", 1e-3),
            ("1e-3m", 1e-3),
            ("4E2nm", 4e-7),
            (" 1 cm ", 1e-2),
        ] {
            assert!(close(Dimension::Length.parse(text), expected), "{text}");
        }
        for (text, expected) in
            [("10bar", 1e6), ("1 atm", 101_325.0), ("50MPa", 5e7), ("1.2e1 kPa", 1.2e4), ("-3bar", -3e5)]
        {
            assert!(close(Dimension::Pressure.parse(text), expected), "{text}");
        }
        assert!(close(Dimension::Time.parse("20ns"), 2e-8));
        for text in ["", "mm", "1 psi", "1 MPa", "1 mm x", "nan", "inf mm", "1e400m", "1,5mm"] {
            let refused = Dimension::Length.parse(text);
            assert!(
                refused.as_ref().is_err_and(|help| help.contains("mm") && help.contains("in m")),
                "{text}: {refused:?}"
            );
        }
    }
}
