//! SIMD batches of cells of a padded block, eight lanes each, for kernels that serve some of them.

/// Cells served together.
pub(crate) const LANES: usize = 8;

pub(crate) type Lane = [f64; LANES];

/// Cells at equal distances in a padded block, of which some are on a list. All lanes are walked, for loads of whole lines
/// are cheap and single ones are not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub first: usize,
    pub step: usize,
    /// Which lanes are on the list: bit by bit.
    pub listed: u8,
}

impl Window {
    /// The cell of a lane.
    #[inline(always)]
    pub fn cell(self, lane: usize) -> usize {
        self.first + lane * self.step
    }

    /// The cells of a window that are on the list.
    pub fn cells(self) -> impl Iterator<Item = usize> {
        lanes(self.listed).map(move |lane| self.cell(lane))
    }

    #[inline(always)]
    pub fn has(self, lane: usize) -> bool {
        self.listed >> lane & 1 == 1
    }

    /// What a row holds `by` after the cells.
    #[inline(always)]
    pub fn load(self, row: &[f64], by: isize) -> Lane {
        let first = self.first.wrapping_add_signed(by);
        if self.step == 1 {
            *row[first..].first_chunk().expect("rows go on beyond a block's cells")
        } else {
            apart(row, first, self.step)
        }
    }
}

/// Lanes that lie apart: in a place of its own, as it is rare and long.
#[inline(never)]
fn apart(row: &[f64], first: usize, step: usize) -> Lane {
    let row = &row[first..=first + (LANES - 1) * step];
    std::array::from_fn(|lane| row[lane * step])
}

/// The fewest windows that hold the cells asked for of a line of n.
///
/// - `first`, `step`: the place of the line's first cell and the distance to the next; `asked`: its cells bit by bit.
pub(crate) fn windows(n: usize, first: usize, step: usize, mut asked: u64, mut put: impl FnMut(Window)) {
    while asked != 0 {
        let start = (asked.trailing_zeros() as usize).min(n - LANES);
        let listed = (asked >> start) as u8;
        put(Window { first: first + start * step, step, listed });
        asked &= !(u64::from(listed) << start);
    }
}

/// The lanes whose bit is set.
#[inline(always)]
pub(crate) fn lanes(mut bits: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}

/// Bit k where flag k is set.
#[inline(always)]
pub(crate) fn bits(flags: [bool; LANES]) -> u8 {
    // In the flags' own width, and without a branch.
    let mut places = [0_u64; LANES];
    for k in 0..LANES {
        places[k] = u64::from(flags[k]) << k;
    }
    places.into_iter().fold(0, |bits, place| bits | place) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_hold_the_cells_asked_for_once() {
        let mut random = 1_u64;
        for _ in 0..200 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let asked = (random >> 48) & (random >> 32) & 0xffff;
            let mut found = Vec::new();
            windows(16, 100, 3, asked, |window| {
                assert!(window.listed != 0 && window.first + 7 * 3 <= 100 + 15 * 3);
                found.extend(window.cells());
            });
            let cells: Vec<usize> = (0..16).filter(|k| asked >> k & 1 == 1).map(|k| 100 + 3 * k).collect();
            assert_eq!(found, cells);
        }
    }
}
