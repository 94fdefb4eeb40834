//! What a number comes to on finer and finer grids: observed order, Richardson's value, grid-convergence index.

/// How many times narrower cells are from one grid to the next.
pub const RATIO: f64 = 2.0;
/// Bounds of the order in the index: a number may seem to converge faster than the scheme can, or so slowly that the index means nothing.
pub const ORDERS: [f64; 2] = [0.5, 2.0];
/// The safety factor where the order is observed.
pub const SAFETY_OBSERVED: f64 = 1.25;
/// The safety factor where it is assumed.
pub const SAFETY_ASSUMED: f64 = 3.0;
/// The order that is assumed with two grids, that of the scheme.
pub const ASSUMED_ORDER: f64 = 2.0;
/// Values that differ by less than this share of the larger one are the same but for round-off.
const ROUND_OFF: f64 = 1e-12;

/// How a number behaves on the finest grids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convergence {
    /// Differences of one sign that become smaller, by an order of [`ORDERS`]'s lower bound or more.
    Monotone,
    /// The same by a lower order: the grids are not yet those on which an order means anything, and nothing is extrapolated.
    Slow,
    /// Differences of changing sign that become smaller.
    Oscillatory,
    /// Differences of one sign that do not become smaller.
    Divergent,
    /// Differences of changing sign that do not become smaller.
    OscillatoryDivergent,
    /// The two finest grids agree to round-off and the one before does not: no order can be told.
    Coincident,
    /// All grids agree to round-off.
    Unchanged,
    /// There are two grids, which say nothing of an order.
    TwoGrids,
    /// There are fewer.
    Unknown,
}

impl Convergence {
    /// As it is written.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Monotone => "monotone",
            Self::Slow => "slow",
            Self::Oscillatory => "oscillatory",
            Self::Divergent => "divergent",
            Self::OscillatoryDivergent => "oscillatory-divergent",
            Self::Coincident => "coincident",
            Self::Unchanged => "unchanged",
            Self::TwoGrids => "two-grids",
            Self::Unknown => "unknown",
        }
    }
}

/// What a number comes to. All numbers in it are finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// How it behaves.
    pub convergence: Convergence,
    /// The grids that this is said of, the coarsest first.
    pub grids: Vec<usize>,
    /// Observed order, where differences of one sign become smaller.
    pub order: Option<f64>,
    /// Richardson's value by that order, where it is no lower than [`ORDERS`] say.
    pub richardson: Option<f64>,
    /// The order in the index: the observed one within [`ORDERS`], or the assumed one.
    pub order_used: Option<f64>,
    /// The safety factor in the index.
    pub safety_factor: Option<f64>,
    /// Grid-convergence index of the finest grid, a share of its value; none where that is 0.
    pub gci: Option<f64>,
    /// The same in the unit of the number, of every grid that has a value.
    pub uncertainties: Vec<Option<f64>>,
    /// Largest minus smallest value on these grids, in the unit of the number.
    pub spread: Option<f64>,
}

/// Analyses the values of a number by grid, the coarsest first, with cells [`RATIO`] times narrower from one to the next.
///
/// - p = ln((f₃ − f₂)/(f₂ − f₁))/ln r with f₁ on the finest grid, and f = f₁ + (f₁ − f₂)/(r^p − 1) (Richardson 1911; Roache 1998,
///   *Verification and Validation in Computational Science and Engineering*, ch. 5);
/// - GCI = F |f₂ − f₁|/(|f₁| (r^p − 1)) (Roache 1994, J. Fluids Eng. 116, 405; Celik et al. 2008, J. Fluids Eng. 130, 078001),
///   F = 1.25 with p observed and taken within 0.5 to 2, F = 3 with p = 2 assumed where there are two grids;
/// - on coarser grids r^p times as much for each grid.
///
/// The three finest grids with a value count if they are equally far apart (r is then that of one to the next of them), else the two
/// finest. An order needs differences of one sign that become smaller; without them there is neither an order nor an index, and
/// [`Analysis::spread`] says how far apart the values are. Below an order of a half there is no Richardson's value: 1/(r^p − 1)
/// would extrapolate any difference as far as one likes.
///
/// - `values`: of a grid without one `None`; what is not finite counts as such. errors: none.
pub fn analyse(values: &[Option<f64>]) -> Analysis {
    let known: Vec<(usize, f64)> = (values.iter().enumerate())
        .filter_map(|(grid, value)| Some((grid, value.filter(|value| value.is_finite())?)))
        .collect();
    let mut analysis = Analysis {
        convergence: Convergence::Unknown,
        grids: known.iter().map(|(grid, _)| *grid).collect(),
        order: None,
        richardson: None,
        order_used: None,
        safety_factor: None,
        gci: None,
        uncertainties: vec![None; values.len()],
        spread: None,
    };
    match known[..] {
        [.., (a, coarse), (b, middle), (c, fine)] if b - a == c - b => {
            analysis.of_three([a, b, c], [coarse, middle, fine]);
        }
        [.., (b, middle), (c, fine)] => analysis.of_two([b, c], [middle, fine]),
        _ => {}
    }
    if let (Some(order), Some((finest, _))) = (analysis.order_used, known.last())
        && let Some(own) = analysis.uncertainties[*finest]
    {
        for (grid, _) in &known {
            let more = own * RATIO.powf(order * (finest - grid) as f64);
            analysis.uncertainties[*grid] = Some(more).filter(|more| more.is_finite());
        }
    }
    analysis
}

/// Whether two values are the same but for round-off.
fn same(one: f64, other: f64) -> bool {
    (one - other).abs() <= ROUND_OFF * one.abs().max(other.abs())
}

impl Analysis {
    fn of_three(&mut self, grids: [usize; 3], [coarse, middle, fine]: [f64; 3]) {
        self.grids = grids.to_vec();
        self.spread = spread(&[coarse, middle, fine]);
        let (before, last) = (middle - coarse, fine - middle);
        let shrink = last / before;
        self.convergence = match (same(coarse, middle), same(middle, fine)) {
            (true, true) => Convergence::Unchanged,
            (false, true) => Convergence::Coincident,
            (true, false) => Convergence::Divergent,
            (false, false) if shrink >= 1.0 => Convergence::Divergent,
            (false, false) if shrink > 0.0 => Convergence::Monotone,
            (false, false) if shrink > -1.0 => Convergence::Oscillatory,
            (false, false) => Convergence::OscillatoryDivergent,
        };
        match self.convergence {
            Convergence::Monotone => {
                let halvings = (grids[2] - grids[1]) as f64;
                let order = -shrink.ln() / (halvings * RATIO.ln());
                self.order = Some(order);
                if order < ORDERS[0] * (1.0 - ROUND_OFF.sqrt()) {
                    self.convergence = Convergence::Slow;
                } else {
                    // 1/(r^p − 1) with r^p = 1/shrink.
                    let richardson = fine + last * shrink / (1.0 - shrink);
                    self.richardson = Some(richardson).filter(|value| value.is_finite());
                }
                let used = order.clamp(ORDERS[0], ORDERS[1]);
                self.index(grids[2], halvings, [middle, fine], used, SAFETY_OBSERVED);
            }
            Convergence::Unchanged => {
                self.gci = (fine != 0.0).then_some(0.0);
                for grid in grids {
                    self.uncertainties[grid] = Some(0.0);
                }
            }
            _ => {}
        }
    }

    fn of_two(&mut self, grids: [usize; 2], [middle, fine]: [f64; 2]) {
        self.grids = grids.to_vec();
        self.spread = spread(&[middle, fine]);
        self.convergence = Convergence::TwoGrids;
        let halvings = (grids[1] - grids[0]) as f64;
        self.index(grids[1], halvings, [middle, fine], ASSUMED_ORDER, SAFETY_ASSUMED);
    }

    /// Sets the index of the finest grid, which is `halvings` finer than the one before.
    fn index(&mut self, finest: usize, halvings: f64, [middle, fine]: [f64; 2], order: f64, safety: f64) {
        let uncertainty = safety * (fine - middle).abs() / (RATIO.powf(halvings * order) - 1.0);
        (self.order_used, self.safety_factor) = (Some(order), Some(safety));
        self.uncertainties[finest] = Some(uncertainty).filter(|value| value.is_finite());
        self.gci = Some(uncertainty / fine.abs()).filter(|value| value.is_finite());
    }
}

/// Largest minus smallest.
fn spread(values: &[f64]) -> Option<f64> {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    Some(largest - smallest).filter(|spread| spread.is_finite())
}

#[cfg(test)]
mod tests;
