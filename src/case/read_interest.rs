//! `[region_of_interest]`: where the answer is that a run is made for.

use mesh::RegionOfInterest;

use super::GridCase;
use super::reader::{Faults, Table};

/// Reads it, and has the grids that adapt follow it.
///
/// - `grids`: those of the fluid and of the solid, where they are there; `wall`: z of the interface or the wall, if there is one.
pub(super) fn region_of_interest(
    root: &mut Table<'_>,
    mut grids: [Option<&mut GridCase>; 2],
    wall: Option<f64>,
    faults: &mut Faults,
) {
    let Some(mut table) = root.table("region_of_interest", faults) else { return };
    let (place, span) = (table.path.clone(), table.span.clone());
    let radius = table.required_positive("radius", faults);
    let corner =
        wall.zip(grids.iter().flatten().next()).map(|(z, grid)| [z, 0.0_f64.clamp(grid.r[0], grid.r[1])]);
    // A side that is faulty has no grid here; its own faults are enough.
    if wall.is_none() && grids.iter().any(Option::is_some) && !table.has("centre") {
        let help = "give `centre = [z, r]`; by default it is where the wall meets the axis, and this case has no wall";
        table.missing("centre", help, faults);
    }
    let centre = table.pair("centre", faults);
    table.finish(faults);
    let (Some(centre), Some(radius)) = (centre.map(|given| given.value).or(corner), radius) else { return };
    let region = RegionOfInterest { centre, radius };
    let has_points_in = |grid: &&mut GridCase| {
        let corner = |end: usize| [grid.z[end], grid.r[end]];
        region.distance(corner(0), corner(1)) < region.radius
    };
    let sides = || grids.iter().flatten();
    if sides().next().is_some() && !sides().any(has_points_in) {
        let message = format!(
            "the circle of radius {:?} m around {:?} m has no point in the domain",
            region.radius, region.centre
        );
        faults.at(&place, &span, message, "move `centre`, or take a larger `radius`");
    }
    let mut adapts = false;
    for adaptation in grids.iter_mut().flatten().filter_map(|grid| grid.adaptation.as_mut()) {
        adaptation.interest = Some(region);
        adapts = true;
    }
    if !adapts && faults.0.is_empty() {
        let help = "take adapt = true and more than one level, or remove [region_of_interest]";
        faults.at(&place, &span, "no grid of this case adapts, so there is nothing to follow", help);
    }
}
