//! The interface between two solvers: frames, transports, coupling schemes. No PDE.

mod options;
mod star;

pub use options::{Kappa, Scheme, StarSolver};
pub use star::{FluidTrace, InterfaceStar, SolidTrace, acoustic_star, exact_star, star_density};
