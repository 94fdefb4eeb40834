//! Choices between a new number and the one that is there, in loops over rows.

use std::hint::{black_box, select_unpredictable};

/// Chooses without masked stores.
///
/// A row that gets `if condition { new } else { old }` back becomes a masked store (`vmaskmovpd`) with AVX2, which takes seven times as long
/// as a blend and a plain store (AMD Zen 3: 3.4 for 0.5 ns per four numbers). An operation between load and choice that changes no bit, which
/// the compiler cannot know, keeps it from that. Worth while in loops that do little else.
#[derive(Clone, Copy, Debug)]
pub struct Blend {
    nothing: u64,
}

impl Blend {
    /// To be made once before a loop.
    #[inline(always)]
    #[must_use]
    #[expect(clippy::new_without_default, reason = "a default would be made where it is needed: in the loop")]
    pub fn new() -> Self {
        Self { nothing: black_box(0) }
    }

    /// `old`, which the compiler does not see to be what has been loaded.
    #[inline(always)]
    #[must_use]
    pub fn loaded(self, old: f64) -> f64 {
        f64::from_bits(old.to_bits() | self.nothing)
    }

    /// `new` where the condition holds, else `old`, all bits of it.
    #[inline(always)]
    #[must_use]
    pub fn choose(self, condition: bool, new: f64, old: f64) -> f64 {
        select_unpredictable(condition, new, self.loaded(old))
    }

    /// The larger one of two, neither of them NaN.
    #[inline(always)]
    #[must_use]
    pub fn larger(self, new: f64, old: f64) -> f64 {
        let old = self.loaded(old);
        if new > old { new } else { old }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_keeps_its_bits() {
        let blend = Blend::new();
        for old in [0.0, -0.0, 1.5, f64::NEG_INFINITY, f64::from_bits(0x7ff8_0000_dead_beef)] {
            assert_eq!(blend.choose(false, 3.0, old).to_bits(), old.to_bits());
            assert_eq!(blend.choose(true, old, 3.0).to_bits(), old.to_bits());
        }
        assert_eq!([blend.larger(2.0, 1.0), blend.larger(1.0, 2.0)], [2.0, 2.0]);
    }
}
