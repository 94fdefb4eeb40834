//! What kernels over rows of cells are made of, and how blocks are shared among threads.

pub(crate) mod ahead;
pub(crate) mod aligned;
pub(crate) mod blend;
pub(crate) mod cell_bits;
pub(crate) mod dispersion;
pub(crate) mod elementary;
pub(crate) mod limiter;
pub(crate) mod parallel;
pub(crate) mod reduce;
