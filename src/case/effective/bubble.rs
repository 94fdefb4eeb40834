//! `[fluid.bubble]`: its content stands in the region that it has made.

use super::Lines;
use crate::case::{BubbleCase, ResetCase};

pub(super) fn write(text: &mut Lines, bubble: &BubbleCase) {
    text.head("[fluid.bubble]");
    text.key("region", bubble.region);
    text.number("surface_tension", bubble.surface_tension);
    text.number("vapour_pressure", bubble.vapour_pressure);
    text.number("temperature", bubble.temperature);
    if let Some(cells) = bubble.cells_per_radius {
        text.number("cells_per_radius", cells);
    }
    match bubble.reset {
        Some(ResetCase::EquilibriumRadius(radius)) => {
            text.key("reset", format_args!("{{ equilibrium_radius = {radius:?} }}"));
        }
        Some(ResetCase::GasShare(share)) => text.key("reset", format_args!("{{ gas_share = {share:?} }}")),
        None => {}
    }
}
