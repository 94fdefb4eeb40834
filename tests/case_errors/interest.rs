//! The region of interest in case files.

use mesh::RegionOfInterest;

use crate::good_cases::round_trip;
use crate::{good, with};

#[test]
fn grids_that_adapt_follow_the_region_of_interest() {
    let interest = |sets: &[&str]| {
        let case = with(sets);
        round_trip(&case);
        [case.fluid.map(|fluid| fluid.grid), case.solid.map(|solid| solid.grid)]
            .map(|grid| grid.and_then(|grid| grid.adaptation).and_then(|adaptation| adaptation.interest))
    };
    let region = |centre| Some(RegionOfInterest { centre, radius: 1e-3 });
    assert_eq!(interest(&[]), [None; 2]);
    // By default it lies around where the wall meets the axis.
    let wall = good().fluid.map_or(0.0, |fluid| fluid.grid.z[0]);
    assert_eq!(interest(&["region_of_interest={ radius = 1e-3 }"]), [region([wall, 0.0]); 2]);
    // The axis of a planar domain is where r = 0.
    let planar = [
        "geometry=planar",
        "fluid.r=[-4e-3, 6e-3]",
        "solid.r=[-4e-3, 6e-3]",
        "region_of_interest={ radius = 1e-3 }",
    ];
    assert_eq!(interest(&planar), [region([wall, 0.0]); 2]);
    let elsewhere = ["region_of_interest={ radius = 1e-3, centre = [1e-3, 2e-3] }", "solid.adapt=false"];
    assert_eq!(interest(&elsewhere), [region([1e-3, 2e-3]), None]);
    // It changes what a run computes.
    assert_ne!(with(&["region_of_interest={ radius = 1e-3 }"]).hash(), good().hash());
}
