//! Domains and grids about a length that has to be resolved.

use mesh::BLOCK;

use super::parts::number;

/// The widest block, in units of the length: an eighth of that is what the coarsest cells resolve far away.
const WIDEST_BLOCK: f64 = 2.0;

/// Blocks of the coarsest level, and how often they are halved.
#[derive(PartialEq)]
pub(super) struct Blocks {
    /// Width of a coarsest block, m.
    width: f64,
    /// Levels of refinement.
    levels: u32,
}

impl Blocks {
    /// Blocks whose finest cells are `length`/`cells` wide.
    pub fn of(length: f64, cells: f64) -> Self {
        let levels = (WIDEST_BLOCK * cells / BLOCK as f64).log2().floor().max(0.0);
        Self { width: BLOCK as f64 * levels.exp2() / cells * length, levels: levels as u32 }
    }

    /// The same blocks, halved so many times less.
    pub fn coarser(&self, times: u32) -> Self {
        Self { width: self.width, levels: self.levels.saturating_sub(times) }
    }

    /// The same blocks, halved so many times more.
    pub fn finer(&self, times: u32) -> Self {
        Self { width: self.width, levels: self.levels + times }
    }

    /// How many blocks cover so much, at least.
    fn covering(&self, reach: f64) -> usize {
        // A reach that is a whole number of blocks but for round-off.
        (reach / self.width - 1e-9).ceil().max(1.0) as usize
    }

    /// `reach` rounded up to whole blocks, m.
    pub fn rounded(&self, reach: f64) -> f64 {
        self.covering(reach) as f64 * self.width
    }

    /// `z`, `r`, `cells`, `levels` of a side from `below` under z = 0 to `above` over it, and to `across` from the axis.
    pub fn keys(&self, below: f64, above: f64, across: f64, finest: &str) -> String {
        let z_cells = [below, above].map(|reach| if reach > 0.0 { self.covering(reach) } else { 0 });
        let r_cells = self.covering(across);
        let low = if z_cells[0] == 0 { "0.0".to_owned() } else { number(-(z_cells[0] as f64) * self.width) };
        let high = if z_cells[1] == 0 { "0.0".to_owned() } else { number(z_cells[1] as f64 * self.width) };
        format!(
            "z = [{low}, {high}]\nr = [0.0, {}]\ncells = [{}, {}]\nlevels = {:<22} # {finest}\n",
            number(r_cells as f64 * self.width),
            BLOCK * (z_cells[0] + z_cells[1]),
            BLOCK * r_cells,
            self.levels,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_the_cells_that_were_asked_for() {
        for cells in [4.0, 12.8, 25.6, 40.0, 51.2, 80.0, 333.0] {
            let blocks = Blocks::of(1e-3, cells);
            let finest = blocks.width / (BLOCK as f64) / f64::from(blocks.levels).exp2();
            assert!((finest * cells / 1e-3 - 1.0).abs() < 1e-14, "{cells}");
            assert!(blocks.width <= WIDEST_BLOCK * 1e-3 * (1.0 + 1e-14) || blocks.levels == 0, "{cells}");
        }
        let blocks = Blocks::of(1.0, 40.0);
        assert_eq!((blocks.width, blocks.levels), (1.6, 2));
        assert_eq!(blocks.covering(4.8), 3);
        assert_eq!(blocks.covering(4.9), 4);
        assert_eq!(blocks.coarser(1).levels, 1);
    }
}
