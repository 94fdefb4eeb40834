//! What a study of grid convergence beside a run says of its numbers.

use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use crate::output::run_directory::{CONVERGENCE, CONVERGENCE_SUFFIX, HISTORY};
use crate::output::{root_attribute, summary};
use crate::run::record::answer::percent;

/// Numbers that are told, the first of each row that a run has, and what they are called.
const TOLD: [&[(&str, &str)]; 4] = [
    &[("wall_pressure_mean_peak", "the mean wall pressure"), ("wall_pressure_peak", "the wall pressure")],
    &[("load_impulse", "the impulse")],
    &[("von_mises_peak", "the von Mises stress")],
    &[("pit_depth", "the pit")],
];

/// In words, how far the numbers of a run are converged; `None` where no study that is complete has its case.
///
/// - `directory`: of the run. The study is one that the run belongs to, or that lies beside it (NAME-convergence).
/// - `whole`: its summary.
pub fn how_sure(directory: &Path, whole: &Map<String, Value>) -> Option<String> {
    let hash = root_attribute(&directory.join(HISTORY), "case_hash")?;
    let (record, grid) = places(directory).into_iter().find_map(|place| {
        let record = summary::read(&place.join(CONVERGENCE)).ok()?;
        let grid = grid_of(&record, &hash)?;
        Some((record, grid))
    })?;
    words(&record, grid, whole)
}

/// Where a study of the run may be: in its directory, in the two above, beside it.
fn places(directory: &Path) -> Vec<PathBuf> {
    let own = directory.canonicalize().unwrap_or_else(|_| directory.to_path_buf());
    let mut beside = own.clone().into_os_string();
    beside.push(CONVERGENCE_SUFFIX);
    own.ancestors().take(3).map(Path::to_path_buf).chain([PathBuf::from(beside)]).collect()
}

/// The number of the grid with this case, of a study all of whose grids have ended.
fn grid_of(record: &Map<String, Value>, hash: &str) -> Option<usize> {
    let grids = record.get("grids")?.as_array()?;
    let has_ended = |grid: &Value| grid["completed"] == true || grid["error"].is_string();
    grids.iter().all(has_ended).then(|| grids.iter().position(|grid| grid["case_hash"] == *hash))?
}

fn words(record: &Map<String, Value>, grid: usize, whole: &Map<String, Value>) -> Option<String> {
    let count = record.get("grids")?.as_array()?.len();
    let known = |(key, name): &(&str, &str)| {
        // A solid that stays elastic has a pit of 0.
        let value = whole.get(*key)?.as_f64().filter(|value| *value != 0.0)?;
        let found = record.get("numbers")?.get(*key)?;
        // Of another program the numbers of the same case may be others.
        if found["values"][grid].as_f64() != Some(value) {
            return None;
        }
        let how = found["convergence"].as_str()?.replace('-', " ");
        Some(match found["uncertainties"][grid].as_f64() {
            Some(own) if how == "slow" => {
                format!("{name} within {}, with an order too low to mean much", percent(own / value.abs()))
            }
            Some(own) => format!("{name} within {}", percent(own / value.abs())),
            None => format!("{name} not known ({how})"),
        })
    };
    let told: Vec<String> = TOLD.iter().filter_map(|row| row.iter().find_map(known)).collect();
    (!told.is_empty())
        .then(|| format!("By grid {grid} of 0 to {} of a study: {}.", count - 1, told.join("; ")))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_study_says_how_sure_each_number_is() {
        let grid =
            |hash: &str, completed: bool| json!({ "case_hash": hash, "completed": completed, "error": null });
        let mut record = json!({
            "grids": [grid("a", true), grid("b", true)],
            "numbers": {
                "wall_pressure_mean_peak": {"values": [4e8, 5e8], "uncertainties": [4e7, 2e7], "convergence": "monotone"},
                "load_impulse": {"values": [1.0, 2.0], "uncertainties": [1.0, 0.5], "convergence": "slow"},
                "von_mises_peak": {"values": [1e8, 9e7], "uncertainties": [null, null], "convergence": "oscillatory-divergent"},
                "pit_depth": {"values": [1e-6, 2e-6], "uncertainties": [1e-7, 1e-7], "convergence": "monotone"},
            },
        });
        let whole = json!({"wall_pressure_mean_peak": 5e8, "wall_pressure_peak": 6e8, "load_impulse": 2.0,
                           "von_mises_peak": 9e7, "pit_depth": 3e-6});
        let object = |value: &Value| value.as_object().expect("an object").clone();
        let grid = grid_of(&object(&record), "b");
        assert_eq!(grid, Some(1));
        assert_eq!(
            words(&object(&record), 1, &object(&whole)).as_deref(),
            Some(
                "By grid 1 of 0 to 1 of a study: the mean wall pressure within 4.0 %; the impulse within 25 %, with an order \
                 too low to mean much; the von Mises stress not known (oscillatory divergent)."
            ),
            "the pit is of another program"
        );
        record["numbers"]["pit_depth"] =
            json!({"values": [0.0, 0.0], "uncertainties": [0.0, 0.0], "convergence": "unchanged"});
        let elastic = object(&json!({"load_impulse": 3.0, "pit_depth": 0.0}));
        assert_eq!(words(&object(&record), 1, &elastic), None, "there is no pit");
        assert_eq!(grid_of(&object(&record), "c"), None);
        record["grids"][0]["completed"] = json!(false);
        assert_eq!(grid_of(&object(&record), "b"), None, "the study is under way");
    }
}
