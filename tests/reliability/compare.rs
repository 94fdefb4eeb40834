//! Whether two runs have left the same, to the last bit.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

/// The files of datasets that a run may leave.
const FILES: [&str; 5] = ["fluid.h5", "solid.h5", "history.h5", "fluid.vtkhdf", "solid.vtkhdf"];

/// All datasets of a file: shape, and numbers as bits.
pub fn datasets(path: &Path) -> BTreeMap<String, (Vec<usize>, Vec<u64>)> {
    fn walk(group: &hdf5::Group, found: &mut BTreeMap<String, (Vec<usize>, Vec<u64>)>) {
        for dataset in group.datasets().unwrap() {
            let numbers: Vec<u64> = if dataset.dtype().unwrap().is::<f64>() {
                dataset.read_raw::<f64>().unwrap().iter().map(|x| x.to_bits()).collect()
            } else {
                dataset.read_raw::<i64>().unwrap().iter().map(|x| *x as u64).collect()
            };
            found.insert(dataset.name(), (dataset.shape(), numbers));
        }
        for inner in group.groups().unwrap() {
            walk(&inner, found);
        }
        if let Ok(steps) = group.attr("NSteps") {
            found.insert(
                format!("{}@", group.name()),
                (vec![], vec![steps.read_scalar::<i64>().unwrap() as u64]),
            );
        }
    }
    let mut found = BTreeMap::new();
    walk(&hdf5::File::open(path).unwrap(), &mut found);
    found
}

/// The summary, or `null` where there is none.
pub fn summary(directory: &Path) -> Value {
    let text = std::fs::read_to_string(directory.join("summary.json")).unwrap_or_default();
    serde_json::from_str(&text).unwrap_or_default()
}

/// Drops what depends on the machine: times, and how often the sides of two processes greeted each other.
fn without_timings(value: &Value, drops_counts: bool) -> Value {
    match value {
        Value::Object(map) => {
            let is_kept = |key: &str| {
                let is_count = key == "exchanges" || key == "bytes";
                !(key.contains("seconds") || key.starts_with("exchange_") || drops_counts && is_count)
            };
            let kept = map.iter().filter(|(key, _)| is_kept(key));
            kept.map(|(key, value)| (key.clone(), without_timings(value, drops_counts))).collect()
        }
        other => other.clone(),
    }
}

/// Asserts that every dataset of both runs and all counts of their summaries are equal; returns how many datasets there are.
///
/// - `same_processes`: whether both ran in as many processes; greetings are counted as exchanges, too.
pub fn assert_same(what: &str, one: &Path, other: &Path, same_processes: bool) -> usize {
    let mut count = 0;
    for name in FILES {
        assert_eq!(one.join(name).exists(), other.join(name).exists(), "{what}: {name}");
        if !one.join(name).exists() {
            continue;
        }
        let (a, b) = (datasets(&one.join(name)), datasets(&other.join(name)));
        assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{what}: {name}");
        for (path, values) in &a {
            assert_eq!(values.0, b[path].0, "{what}: the shape of {path} in {name}");
            assert!(*values == b[path], "{what}: {path} in {name} differs");
        }
        count += a.len();
    }
    let summaries = [one, other].map(|directory| without_timings(&summary(directory), !same_processes));
    assert_eq!(summaries[0], summaries[1], "{what}");
    assert_eq!(summaries[0]["completed"], true, "{what}");
    count
}
