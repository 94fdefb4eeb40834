//! The keys of the cases that differ among runs.

use std::collections::{BTreeMap, BTreeSet};

use crate::runs::flat::{Keys, Scalar};
use crate::runs::listing::Entry;

/// Where things go is no parameter.
const OUTPUT: &str = "output.";

/// Constants that a material's name stands for.
const MATERIAL: &str = "solid.material.";

/// Keys that follow from others unless they are given.
const DERIVED: [&str; 3] = ["scale_pressure", "scale_density", "scale_stress"];

/// The keys that have not the same value in all runs, mostly by the alphabet. What a material's name says already is left out, and
/// scales that follow from what else differs.
#[must_use]
pub fn varied(keys: &Keys, entries: &[Entry]) -> Vec<String> {
    let mut values: Vec<Option<&Scalar>> = vec![None; keys.names().len()];
    let (mut count, mut differs) = (vec![0; values.len()], vec![false; values.len()]);
    for (key, value) in entries.iter().flat_map(|entry| &entry.case) {
        let key = *key as usize;
        count[key] += 1;
        differs[key] |= *values[key].get_or_insert(value) != value;
    }
    let is_varied = |key: usize| count[key] > 0 && (differs[key] || count[key] < entries.len());
    let names =
        keys.names().iter().enumerate().filter(|(key, name)| is_varied(*key) && !name.starts_with(OUTPUT));
    let names: Vec<&String> = names.map(|(_, name)| name).collect();
    let named = keys.get(&format!("{MATERIAL}name"));
    let is_named = |name: &str| {
        name.starts_with(MATERIAL)
            && named
                .is_some_and(|named| keys.get(name) != Some(named) && follows(entries, named, keys.get(name)))
    };
    let is_derived = |name: &str| DERIVED.iter().any(|end| name.ends_with(end));
    let kept: Vec<&String> = names.iter().copied().filter(|name| !is_named(name)).collect();
    let plain: Vec<String> =
        kept.iter().filter(|name| !is_derived(name)).map(|name| (*name).clone()).collect();
    // Scales that differ alone were given.
    if plain.is_empty() { kept.into_iter().cloned().collect() } else { plain }
}

/// Whether one key's value says another's: no two runs have the same one and differ in the other.
fn follows(entries: &[Entry], first: u32, second: Option<u32>) -> bool {
    let mut seen: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for entry in entries {
        let of = |key: Option<u32>| {
            let value = entry.case.iter().find(|(of, _)| Some(*of) == key);
            value.map_or_else(String::new, |(_, value)| value.to_string())
        };
        seen.entry(of(Some(first))).or_default().insert(of(second));
    }
    seen.values().all(|values| values.len() == 1)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::output::RunState;

    fn varied_of(cases: &[serde_json::Value]) -> Vec<String> {
        let mut keys = Keys::default();
        let entry = |case: &serde_json::Value| Entry {
            path: String::new(),
            state: RunState::Finished,
            progress: None,
            started: 0,
            case: keys.read(&case.to_string()).expect("it is flat"),
            summary: Vec::new(),
        };
        let entries: Vec<Entry> = cases.iter().map(entry).collect();
        varied(&keys, &entries)
    }

    #[test]
    fn only_what_differs_is_varied_and_output_is_not() {
        let base = json!({ "time.end": 1e-6, "fluid.region.0.radius": 0.01, "output.compression": 4 });
        let mut other = base.clone();
        other["output.compression"] = json!(1);
        assert_eq!(varied_of(&[base.clone(), other.clone()]), Vec::<String>::new());
        other["fluid.region.0.radius"] = json!(0.02);
        other["fluid.gravity"] = json!(9.81);
        assert_eq!(varied_of(&[base.clone(), other]), ["fluid.region.0.radius", "fluid.gravity"]);
        assert_eq!(varied_of(&[base]), Vec::<String>::new());
    }

    #[test]
    fn a_materials_name_stands_for_its_constants_as_long_as_it_does() {
        let of = |name: &str, density: f64, scale: f64| json!({ "solid.material.name": name, "solid.material.density": density, "solid.scale_stress": scale });
        let (steel, copper) = (of("steel", 7800.0, 1.0), of("copper", 8960.0, 2.0));
        assert_eq!(varied_of(&[steel.clone(), copper]), ["solid.material.name"]);
        let heavy = of("steel", 9000.0, 1.0);
        assert_eq!(varied_of(&[steel.clone(), heavy]), ["solid.material.density"]);
        assert_eq!(varied_of(&[steel, of("steel", 7800.0, 3.0)]), ["solid.scale_stress"]);
    }
}
