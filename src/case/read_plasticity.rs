//! The `[solid.plasticity]` table.

use solid::Material;
use solid::plasticity::{
    Hardening, JohnsonCook, MaterialHardening, PlasticityError, RateFactor, Table as StressTable,
    ThermalSoftening,
};
use toml::de::DeValue;

use super::reader::{Faults, Given, SMALLEST, Table, array, pair};

/// The laws by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Law {
    Perfect,
    Linear,
    JohnsonCook,
    Table,
}

const LAWS: [(&str, Law); 4] = [
    ("perfect", Law::Perfect),
    ("linear", Law::Linear),
    ("johnson-cook", Law::JohnsonCook),
    ("table", Law::Table),
];

impl Law {
    /// As in case files.
    fn name(self) -> &'static str {
        LAWS.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
    }
}

/// What each key is in, and a value that is usual.
const HELP: [(&str, &str); 11] = [
    ("yield_strength", "give A in Pa, or a material that has one"),
    ("hardening_modulus", "give H (or B of Johnson-Cook) in Pa, 1e9 for mild steel"),
    ("hardening_exponent", "give n above 0 and at most 1, 0.2 to 0.6 for metals"),
    ("rate_coefficient", "give C >= 0, 0.01 to 0.03 for metals; 0 switches the rate off"),
    ("reference_rate", "give the rate in 1/s at which A was measured, mostly 1.0"),
    ("softening_exponent", "give m > 0, about 1 for metals; leave it away for no softening"),
    ("melting_temperature", "give K, above reference_temperature"),
    ("reference_temperature", "give K, mostly 293 to 300"),
    ("heat_capacity", "give c_p in J/(kg K), 477 for steel, 900 for aluminium"),
    ("taylor_quinney", "give the share of the plastic work that heats, 0 to 1, mostly 0.9"),
    ("table", "give table = [[plastic strain, stress in Pa], ...], strains increasing, stresses not falling"),
];

/// The numbers that are given, with their places.
struct Numbers(Vec<(&'static str, Given<f64>)>);

impl Numbers {
    fn read(table: &mut Table<'_>, faults: &mut Faults) -> Self {
        const NUMBERS: [&str; 10] = [
            "yield_strength",
            "hardening_modulus",
            "hardening_exponent",
            "rate_coefficient",
            "reference_rate",
            "softening_exponent",
            "melting_temperature",
            "reference_temperature",
            "heat_capacity",
            "taylor_quinney",
        ];
        let all = NUMBERS.map(|key| (key, table.number(key, faults)));
        Self(all.into_iter().filter_map(|(key, given)| Some((key, given?))).collect())
    }

    fn of(&self, key: &str) -> Option<f64> {
        self.0.iter().find(|(known, _)| *known == key).map(|(_, given)| given.value)
    }

    /// Numbers so small that products of them vanish are mistakes.
    fn refuse_tiny(&self, faults: &mut Faults) -> bool {
        let mut any = false;
        for (key, given) in &self.0 {
            if given.value > 0.0 && given.value < SMALLEST {
                let message = format!("must be {SMALLEST:e} at least, got {:e}", given.value);
                faults.of(given, message, help(key));
                any = true;
            }
        }
        any
    }
}

fn help(key: &str) -> &'static str {
    HELP.iter().find(|(known, _)| *known == key).map_or("", |(_, help)| help)
}

/// What `[solid.plasticity]` says of a material; a material of the library brings constants that are not given.
///
/// - returns: `None` where a fault was found.
pub(super) fn plasticity(
    mut table: Table<'_>,
    material: Option<&Material>,
    faults: &mut Faults,
) -> Option<Hardening> {
    if !table.has("law") {
        let help = "give `law = \"perfect\"`, \"linear\", \"johnson-cook\" or \"table\"";
        table.missing("law", help, faults);
    }
    let law = table.choice("law", &LAWS, faults);
    let before = faults.0.len();
    let numbers = Numbers::read(&mut table, faults);
    let points = points(&mut table, faults);
    let place = table.place("table");
    let (path, span) = (table.path.clone(), table.span.clone());
    table.finish(faults);
    let (law, material) = (law?.value, material?);
    if faults.0.len() > before || numbers.refuse_tiny(faults) {
        return None;
    }
    if let Some(place) = place.as_ref().filter(|_| law != Law::Table) {
        let message = format!("`table` has no say in law = \"{}\"", law.name());
        let help = "remove it, or choose law = \"table\"";
        faults.at(&format!("{path}.table"), &place.span, message, help);
        return None;
    }
    let library = MaterialHardening::of(material.name()).map(|entry| entry.law);
    let strength = material.yield_strength();
    match made(law, &numbers, points, library, strength) {
        Ok(hardening) if numbers.unused(law, faults) => Some(hardening),
        Ok(_) => None,
        Err(Fault::Missing(key)) => {
            let message = format!("`{key}` is missing: the material {} brings none", material.name());
            faults.at(&format!("{path}.{key}"), &span, message, help(key));
            None
        }
        Err(Fault::Wrong(error)) => {
            let key = key_of(&error);
            let given = numbers.0.iter().find(|(known, _)| *known == key);
            let span = given
                .map(|(_, given)| given.span.clone())
                .or_else(|| place.filter(|_| key == "table").map(|place| place.span))
                .unwrap_or(span);
            faults.at(&format!("{path}.{key}"), &span, error.to_string(), help(key));
            None
        }
    }
}

/// The points of a table, none if there is no such key.
fn points(table: &mut Table<'_>, faults: &mut Faults) -> Option<Vec<[f64; 2]>> {
    let given: Given<&DeValue<'_>> = table.raw("table")?;
    let rows = array(&given, "a list of points [plastic strain, stress]", "1 and Pa", faults)?;
    let rows: Vec<Option<[f64; 2]>> = rows.iter().map(|row| pair(row, "1 and Pa", faults)).collect();
    rows.into_iter().collect()
}

enum Fault {
    Missing(&'static str),
    Wrong(PlasticityError),
}

impl From<PlasticityError> for Fault {
    fn from(error: PlasticityError) -> Self {
        Self::Wrong(error)
    }
}

fn made(
    law: Law,
    numbers: &Numbers,
    points: Option<Vec<[f64; 2]>>,
    library: Option<JohnsonCook>,
    strength: Option<f64>,
) -> Result<Hardening, Fault> {
    let known = |key: &'static str, of: fn(&JohnsonCook) -> f64| {
        numbers.of(key).or_else(|| library.as_ref().map(of)).ok_or(Fault::Missing(key))
    };
    let strength = || numbers.of("yield_strength").or(strength).ok_or(Fault::Missing("yield_strength"));
    let rate = || -> Result<Option<RateFactor>, Fault> {
        let own = library.map(|law| law.rate);
        let coefficient = numbers.of("rate_coefficient").or(own.map(|rate| rate.rate_coefficient));
        let reference = numbers.of("reference_rate").or(own.map(|rate| rate.reference_rate));
        match coefficient {
            Some(0.0) | None if reference.is_none() => Ok(None),
            None => Ok(None),
            Some(coefficient) => {
                Ok(Some(RateFactor::new(coefficient, reference.ok_or(Fault::Missing("reference_rate"))?)?))
            }
        }
    };
    Ok(match law {
        Law::Perfect => Hardening::perfect(strength()?)?,
        Law::Linear => {
            let modulus = numbers.of("hardening_modulus").ok_or(Fault::Missing("hardening_modulus"))?;
            Hardening::linear(strength()?, modulus)?
        }
        Law::JohnsonCook => {
            // A, B and n belong together.
            let own = library.as_ref().map(|law| law.yield_strength);
            let mut law = JohnsonCook::new(
                numbers.of("yield_strength").or(own).map_or_else(strength, Ok)?,
                known("hardening_modulus", |law| law.hardening_modulus)?,
                known("hardening_exponent", |law| law.hardening_exponent)?,
            )?;
            if let Some(rate) = rate()? {
                law = law.with_rate(rate);
            }
            if let Some(softening) = softening(numbers, library.and_then(|law| law.softening))? {
                law = law.with_softening(softening);
            }
            Hardening::JohnsonCook(law)
        }
        Law::Table => {
            let table = StressTable::new(&points.ok_or(Fault::Missing("table"))?)?;
            let acts = numbers.of("rate_coefficient").is_some_and(|given| given != 0.0);
            Hardening::Table(match rate()?.filter(|_| acts) {
                Some(rate) => table.with_rate(rate),
                None => table,
            })
        }
    })
}

/// Softening by heat, where m is given or the library has it.
fn softening(numbers: &Numbers, own: Option<ThermalSoftening>) -> Result<Option<ThermalSoftening>, Fault> {
    let known = |key: &'static str, of: fn(&ThermalSoftening) -> f64| {
        numbers.of(key).or_else(|| own.as_ref().map(of)).ok_or(Fault::Missing(key))
    };
    if numbers.of("softening_exponent").is_none() && own.is_none() {
        return Ok(None);
    }
    Ok(Some(ThermalSoftening::new(
        known("softening_exponent", |heat| heat.softening_exponent)?,
        known("melting_temperature", |heat| heat.melting_temperature)?,
        known("reference_temperature", |heat| heat.reference_temperature)?,
        known("heat_capacity", |heat| heat.heat_capacity)?,
        known("taylor_quinney", |heat| heat.taylor_quinney)?,
    )?))
}

impl Numbers {
    /// Whether every number that is given has a say in the law; those that have none are refused.
    fn unused(&self, law: Law, faults: &mut Faults) -> bool {
        let allowed: &[&str] = match law {
            Law::Perfect => &["yield_strength"],
            Law::Linear => &["yield_strength", "hardening_modulus"],
            Law::JohnsonCook => return true,
            Law::Table => &["rate_coefficient", "reference_rate"],
        };
        let name = law.name();
        let mut all = true;
        for (key, given) in self.0.iter().filter(|(key, _)| !allowed.contains(key)) {
            let message = format!("`{key}` has no say in law = \"{name}\", got {:?}", given.value);
            faults.of(given, message, "remove it, or choose law = \"johnson-cook\"");
            all = false;
        }
        all
    }
}

/// The key that an error of a law is about.
fn key_of(error: &PlasticityError) -> &'static str {
    match error {
        PlasticityError::OutOfRange { name, .. } => name,
        PlasticityError::MeltingBelowReference { .. } => "melting_temperature",
        PlasticityError::EmptyTable
        | PlasticityError::TablePoint { .. }
        | PlasticityError::TableNotIncreasing { .. }
        | PlasticityError::TableSoftens { .. } => "table",
    }
}
