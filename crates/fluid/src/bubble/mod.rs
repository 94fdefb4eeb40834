//! A bubble as laboratories describe it: what is in it, how the grid follows it, and how its gas is cut.

pub(crate) mod content;
pub(crate) mod follow;
pub(crate) mod look;
pub(crate) mod reset;
pub(crate) mod rule;
