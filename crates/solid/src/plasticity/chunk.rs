//! Cells whose Johnson–Cook returns are solved together.

use super::powers::NEAR;

type Lane<const L: usize> = [f64; L];

/// Cells that are being solved.
pub(super) struct Chunk<const L: usize> {
    pub q: Lane<L>,
    pub strain: Lane<L>,
    pub rise: Lane<L>,
    /// The flow stress at rate 0 before the step.
    pub static_stress: Lane<L>,
    /// An increment, the plastic strain with it, and B ε_pⁿ there; a T − T_r and its T*ᵐ.
    pub base: Lane<L>,
    pub base_strain: Lane<L>,
    pub power: Lane<L>,
    pub base_rise: Lane<L>,
    pub lost: Lane<L>,
    /// Δε_p, its logarithm, q at the end.
    pub increment: Lane<L>,
    pub log: Lane<L>,
    pub left: Lane<L>,
    /// The step in the logarithm, and what it comes to: 0 goes on, 1 the last step, 1.5 no more step, 3 given up.
    pub step: Lane<L>,
    pub verdict: Lane<L>,
    /// q at the end if this is the last step.
    pub next_left: Lane<L>,
    /// 0 while it is solved, 1 solved, 2 elastic, 3 left to the bracketed solver.
    pub done: Lane<L>,
}

impl<const L: usize> Chunk<L> {
    pub const ZERO: Self = Self {
        q: [0.0; L],
        strain: [0.0; L],
        rise: [0.0; L],
        static_stress: [0.0; L],
        base: [0.0; L],
        base_strain: [0.0; L],
        power: [0.0; L],
        base_rise: [0.0; L],
        lost: [0.0; L],
        increment: [0.0; L],
        log: [0.0; L],
        left: [0.0; L],
        step: [0.0; L],
        verdict: [0.0; L],
        next_left: [0.0; L],
        done: [0.0; L],
    };

    /// Whether the power of a cell's strain can be made of that which is known.
    #[inline(always)]
    pub fn is_near(&self, k: usize) -> bool {
        (self.increment[k] - self.base[k]).abs() < NEAR * self.base_strain[k]
    }

    /// How many of the cells that are not done are so.
    #[inline(always)]
    pub fn open(&self, is_so: impl Fn(&Self, usize) -> bool) -> u64 {
        // In integers: a sum of floating-point numbers has an order, and would keep the loop from vectors.
        let mut found = 0;
        for k in 0..L {
            found += u64::from((self.done[k] == 0.0) & is_so(self, k));
        }
        found
    }
}
