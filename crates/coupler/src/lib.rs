//! The interface between two solvers: frames, transports, coupling schemes. No PDE.

mod options;

pub use options::{Kappa, Scheme, StarSolver};
mod star;
pub use star::{FluidTrace, star_density};
