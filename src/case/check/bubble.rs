//! What came of a bubble that is described by what is in it.

use super::super::format::{plain, si};
use super::line;
use crate::case::{FluidCase, ResetCase};

/// Pressure and density at the start, how the grid follows it, and how its gas is cut.
pub(super) fn bubble(text: &mut String, fluid: &FluidCase) {
    let Some(bubble) = &fluid.bubble else { return };
    let Some(region) = fluid.initial.regions.get(bubble.region) else { return };
    let Some(([z, _], _)) = fluid.bubble_sphere() else { return };
    let (far, pressure) = (fluid.ambient_at(z).pressure, region.state.pressure);
    let vapour = match bubble.vapour_pressure {
        0.0 => String::new(),
        vapour => format!(", {} of it vapour", si(vapour, "Pa")),
    };
    let content = format!(
        "region {}: {}{vapour}, {:.3e} of the liquid's, {}, gamma = {:.4}",
        bubble.region,
        si(pressure, "Pa"),
        pressure / far,
        plain(region.state.density, "kg/m3"),
        fluid.gas.gamma
    );
    line(text, "bubble", &content);
    if let Some(cells) = bubble.cells_per_radius {
        let (first, finest) = (fluid.first_level(), fluid.grid.levels);
        let follows = format!(
            "at least {cells} cells along the present radius, as far as level {finest} has them: level {first} at the start"
        );
        line(text, "  its grid", &follows);
    }
    let left = match bubble.reset {
        Some(ResetCase::EquilibriumRadius(radius)) => format!("that of R_n = {}", si(radius, "m")),
        Some(ResetCase::GasShare(share)) => format!("{share:?} of its mass"),
        None => return,
    };
    line(text, "  its gas", &format!("cut at the first maximum of the volume to {left}"));
}
