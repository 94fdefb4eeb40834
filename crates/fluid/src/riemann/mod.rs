//! Riemann solvers: of one face, and of rows of faces.

pub mod exact_riemann;
pub(crate) mod exact_rows;
pub(crate) mod godunov;
pub(crate) mod hllc;
pub(crate) mod hllc_rows;
pub(crate) mod low_mach;
