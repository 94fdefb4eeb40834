//! The interface between two solvers: frames, transports, coupling schemes. No PDE.

mod exchange;
mod mapping;
mod options;
mod star;
mod weak;

pub use exchange::{RegisterRow, TraceRow, WallRegister};
pub use mapping::{CommonRefinement, SubFace};
pub use options::{Kappa, Scheme, StarSolver};
pub use star::{FluidTrace, InterfaceStar, SolidTrace, acoustic_star, exact_star, star_density};
pub use weak::KappaFactor;
