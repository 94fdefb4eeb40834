//! What is where at the start of a case.

use std::ops::ControlFlow;

use fluid::Phase;
use mesh::Geometry;

use super::super::format::si;
use super::super::start_grid::blocks_at_start;
use super::super::{Case, FluidCase, Medium};

/// More blocks than this are not drawn.
const MOST_BLOCKS: usize = 40_000;

/// What is at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    Outside,
    Liquid,
    Gas,
    Solid,
}

/// What a picture of a case shows.
pub(super) struct Scene<'a> {
    case: &'a Case,
    /// Range in z, m.
    pub z: [f64; 2],
    /// Range in r, m; about the axis in axisymmetric geometry.
    pub r: [f64; 2],
}

impl<'a> Scene<'a> {
    /// All that a case has; `None` where it has no media.
    pub fn of(case: &'a Case) -> Option<Self> {
        let grids = [case.fluid.as_ref().map(|side| &side.grid), case.solid.as_ref().map(|side| &side.grid)];
        let both = grids.into_iter().flatten().map(|grid| (grid.z, grid.r));
        let (z, r) = both.reduce(|(z, r), (other_z, other_r)| {
            let hull = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
            (hull(z, other_z), hull(r, other_r))
        })?;
        let r = if case.geometry == Geometry::Axisymmetric { [-r[1], r[1]] } else { r };
        Some(Self { case, z, r })
    }

    /// What is at a point; to the left of an axis what is to its right.
    pub fn content(&self, [z, r]: [f64; 2]) -> Content {
        let r = if self.case.geometry == Geometry::Axisymmetric { r.abs() } else { r };
        if let Some(fluid) = self.case.fluid.as_ref().filter(|side| side.grid.contains([z, r])) {
            return of_fluid(fluid, [z, r]);
        }
        match &self.case.solid {
            Some(solid) if solid.grid.contains([z, r]) => Content::Solid,
            _ => Content::Outside,
        }
    }

    /// Corners (z, r) of the blocks that the grids have at the start at least, on the side of the axis where r > 0.
    pub fn blocks(&self) -> Vec<[[f64; 2]; 2]> {
        let mut corners = Vec::new();
        for medium in [Medium::Fluid, Medium::Solid] {
            blocks_at_start(self.case, medium, |low, high| {
                corners.push([low, high]);
                // Finer than pixels.
                if corners.len() > MOST_BLOCKS { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
        }
        corners
    }

    /// Points (z, r) of the probes.
    pub fn probes(&self) -> impl Iterator<Item = [f64; 2]> {
        self.case.probes.iter().map(|probe| probe.position)
    }

    /// Where the wall is, m, if there is one.
    pub fn wall(&self) -> Option<f64> {
        let fluid = self.case.fluid.as_ref().map(|side| side.grid.z[0]);
        let solid = self.case.solid.as_ref().map(|side| side.grid.z[1]);
        let none = self.case.coupling.scheme == coupler::Scheme::None;
        fluid.filter(|_| !none).or(solid)
    }

    /// Where the discs that record the wall's pressure begin and end, m; in planar geometry they are strips about r = 0.
    pub fn discs(&self) -> impl Iterator<Item = [f64; 2]> {
        let begin = self.r[0];
        self.case.sensors.iter().map(move |sensor| [begin.max(-sensor.radius), sensor.radius])
    }

    /// A line on what is drawn.
    pub fn title(&self) -> String {
        let radius = self.case.fluid.as_ref().and_then(|fluid| {
            fluid.initial.regions.iter().find_map(|region| match region.shape {
                fluid::Shape::Sphere { radius, .. } if region.state.phase == Phase::Gas => Some(radius),
                _ => None,
            })
        });
        let solid = self.case.solid.as_ref().map(|solid| solid.material.name().to_owned());
        let parts =
            [Some(self.case.name.clone()), radius.map(|radius| format!("R = {}", si(radius, "m"))), solid];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

fn of_fluid(fluid: &FluidCase, point: [f64; 2]) -> Content {
    let initial = &fluid.initial;
    let painted = initial.regions.iter().rev().find(|region| region.shape.contains(point));
    match painted.map_or(initial.ambient.phase, |region| region.state.phase) {
        Phase::Liquid => Content::Liquid,
        Phase::Gas => Content::Gas,
    }
}
