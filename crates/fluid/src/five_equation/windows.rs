//! Cells of a padded block by eights, for kernels that serve some of them.

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
    /// The cells of a window that are on the list.
    pub fn cells(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |lane| self.has(*lane)).map(move |lane| self.first + lane * self.step)
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
            std::array::from_fn(|lane| row[first + lane * self.step])
        }
    }
}

/// The fewest windows that hold the cells asked for of a line of N.
pub(crate) fn windows<const N: usize>(
    first: usize,
    step: usize,
    is_listed: impl Fn(usize) -> bool,
    mut put: impl FnMut(Window),
) {
    let is_listed = |along: usize| is_listed(first + along * step);
    let mut next = 0;
    while let Some(found) = (next..N).find(|along| is_listed(*along)) {
        let start = found.min(N - LANES);
        let bit = |lane: usize| u8::from(start + lane >= found && is_listed(start + lane)) << lane;
        let listed = (0..LANES).fold(0, |listed, lane| listed | bit(lane));
        put(Window { first: first + start * step, step, listed });
        next = start + LANES;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_hold_the_cells_asked_for_once() {
        let mut random = 1_u32;
        for share in [0, 1, 2, 5, 15, 16] {
            let cells: Vec<bool> = (0..16)
                .map(|_| {
                    random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (random >> 28) < share
                })
                .collect();
            let mut found = Vec::new();
            windows::<16>(100, 3, |k| cells[(k - 100) / 3], |window| found.extend(window.cells()));
            let asked: Vec<usize> = (0..16).filter(|k| cells[*k]).map(|k| 100 + 3 * k).collect();
            assert_eq!(found, asked);
        }
    }
}
