//! The law that whole rows have in common where they hold neither gas nor a covolume.

use crate::Mixture;

/// The law of pure liquid without a covolume.
#[derive(Clone, Copy)]
pub(super) struct Liquid {
    /// As in [`super::Sides`].
    pub m: f64,
    pub pi: f64,
}

impl Liquid {
    #[inline(always)]
    pub fn of(mixture: &Mixture) -> Self {
        let inverse_above = 1.0 / (1.0 + mixture.beta1(0.0));
        Self { m: 0.5 * inverse_above, pi: mixture.beta2(0.0) * inverse_above }
    }
}
