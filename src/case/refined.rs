//! A case on a finer grid: every cell halved, and halved again.

use toml::{Table, Value};

use super::{Case, CaseErrors, GridCase, set};

impl Case {
    /// A case with every cell of both sides halved `halvings` times, and all changes (as of `--set`) that make it of the text.
    ///
    /// `levels` grows by `halvings`, and so do the bounds of `[[....refine]]` with it: a bound keeps its distance from the finest level,
    /// so cells are halved within zones, too, and the grids are alike. A bound that binds nothing, `at_least` no finer than
    /// the coarsest blocks, stays.
    ///
    /// - `text`, `name`, `shown`, `sets`: as of [`Case::read`].
    ///
    /// # Errors
    /// As [`Case::load`]; there may be more levels than a case can have.
    pub fn refined(
        text: &str,
        name: &str,
        shown: &str,
        sets: &[String],
        halvings: usize,
    ) -> Result<(Self, Vec<String>), CaseErrors> {
        let case = Self::read(text, name, shown, sets)?;
        if halvings == 0 {
            return Ok((case, sets.to_vec()));
        }
        let changed = set::apply(text, sets).map_err(|faults| CaseErrors::new(shown, text, faults))?;
        // It has just been read.
        let table: Table = changed.parse().unwrap_or_default();
        let sides = [
            ("fluid", case.fluid.as_ref().map(|side| &side.grid)),
            ("solid", case.solid.as_ref().map(|side| &side.grid)),
        ];
        let mut all = sets.to_vec();
        for (side, grid) in sides {
            let Some(grid) = grid else { continue };
            all.push(format!("{side}.levels={}", grid.levels + halvings));
            all.extend(bounds(side, grid, &table, halvings));
        }
        // The grid that follows a bubble does so with halved cells.
        let followed = case.fluid.as_ref().and_then(|fluid| fluid.bubble?.cells_per_radius);
        if let Some(cells) = followed {
            all.push(format!("fluid.bubble.cells_per_radius={:?}", cells * (halvings as f64).exp2()));
        }
        Self::read(text, name, shown, &all).map(|case| (case, all))
    }
}

/// The bounds of a side's zones, moved with the finest level.
fn bounds(side: &str, grid: &GridCase, case: &Table, halvings: usize) -> Vec<String> {
    let roots = grid.root_level();
    let zones = case.get(side).and_then(|side| side.get("refine")).and_then(Value::as_array);
    let mut changes = Vec::new();
    for (number, zone) in zones.into_iter().flatten().enumerate() {
        for key in ["at_least", "at_most"] {
            let level =
                zone.get(key).and_then(Value::as_integer).and_then(|level| usize::try_from(level).ok());
            let Some(level) = level.filter(|level| key == "at_most" || *level > roots) else { continue };
            changes.push(format!("{side}.refine.{number}.{key}={}", level.max(roots) + halvings));
        }
    }
    changes
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const TEXT: &str = "[time]\nend = 1e-6\n[coupling]\nscheme = \"rigid\"\n[fluid]\nz = [0, 0.01]\nr = [0, 0.01]\ncells = [4, 4]\n\
        levels = 4\n[fluid.liquid]\ngamma = 7.15\npi = 3e8\n[fluid.ambient]\ndensity = 1000\npressure = 1e6\n\
        [[fluid.refine]]\nshape = \"interface\"\nat_least = 4\n\
        [[fluid.refine]]\nshape = \"box\"\nz = [0.005, 0.01]\nr = [0, 0.01]\nat_least = 1\nat_most = 3\n\
        [[fluid.refine]]\nshape = \"outer\"\ncentre = [0, 0]\nradius = 0.005\n";

    fn grid(sets: &[&str], halvings: usize) -> GridCase {
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let (case, _) = Case::refined(TEXT, "case", "case", &sets, halvings).unwrap();
        case.fluid.unwrap().grid
    }

    #[test]
    fn every_cell_is_halved_and_bounds_keep_their_distance_from_the_finest_level() {
        let [given, finer] = [0, 2].map(|halvings| grid(&[], halvings));
        assert_eq!([given.levels, finer.levels], [4, 6]);
        assert_eq!(given.cell_size().map(|h| h / 4.0), finer.cell_size());
        let levels = |grid: &GridCase| {
            let bounds = &grid.adaptation.as_ref().unwrap().bounds;
            bounds.iter().map(|bound| [bound.at_least, bound.at_most]).collect::<Vec<_>>()
        };
        // The coarsest blocks are of level 2; the outer zones are bounded by 3 and 2, and then by 5, 4, 3, 2.
        assert_eq!(levels(&given), [[4, 4], [2, 3], [2, 3], [2, 2]]);
        assert_eq!(levels(&finer), [[6, 6], [2, 5], [2, 5], [2, 4], [2, 3], [2, 2]]);
    }

    #[test]
    fn changes_come_before_refinement() {
        let zone = "fluid.refine=[{ shape = \"interface\", at_most = 0 }]";
        let finer = grid(&["fluid.levels=3", zone], 1);
        assert_eq!((finer.levels, finer.adaptation.unwrap().bounds[0].at_most), (4, 3));
        let too_many = Case::refined(TEXT, "case", "case", &[], 17).unwrap_err().to_string();
        assert!(too_many.contains("fluid.levels"), "{too_many}");
    }
}
