//! J2 plasticity at a point: hardening laws, the radial return, materials. Knows no mesh.
//!
//! Small strains, isotropic hardening, backward Euler in time. A cell is stepped elastically first; where its stress then
//! lies outside the yield surface, [`Plasticity::return_map`] brings it back.

mod chunk;
mod closed;
mod consistency;
mod error;
mod flow;
mod hardening;
mod johnson_cook;
mod lanes;
mod library;
mod polyline;
mod powers;
mod rate;
mod return_map;
mod rows;
mod screen;
mod stress;
mod table;
#[cfg(test)]
mod tests;

pub use error::PlasticityError;
pub use flow::Flow;
pub use hardening::{Hardening, Linear, Perfect};
pub use johnson_cook::{JohnsonCook, ThermalSoftening};
pub use library::MaterialHardening;
pub use rate::RateFactor;
pub use return_map::{Plasticity, Returned};
pub use rows::PlasticRows;
pub use stress::{Stress, project_to_yield};
pub use table::Table;
