//! A laser bubble: a small one of high pressure that grows, collapses and rebounds.

use fluid::{BubbleContent, StiffenedGas};

use super::super::error::CaseErrors;
use super::super::format::si;
use super::checks::Checks;
use super::gilmore::{Turn, turns};
use super::grid::Blocks;
use super::parts::{DENSITY, lengthened, media, number, sound, times};
use super::quantity::Dimension;
use super::wall::Wall;

/// Largest radii from the bubble to open sides.
const CLEAR: f64 = 4.0;
/// Largest radii of the domain from the axis, and of the solid downwards.
const ACROSS: f64 = 5.0;
/// How long the run follows the second cycle, of its length by Gilmore's equation: grids that do not resolve the smallest radius let the
/// bubble rebound to more, and so for longer.
const SECOND: f64 = 1.7;
/// Over how much of R/c of the largest radius the wall's pressure is averaged.
const MEAN: f64 = 1.0 / 12.0;
/// How many levels the solid has less than the fluid.
const COARSER_SOLID: u32 = 3;
/// Its threshold is that of the fluid.
const SOLID_KEYS: &str = "epsilon = 1e-3                  # coarser than by default, as in the fluid\n";
/// What counts as a wave, Pa: of shocks and jets, not of the bubble's first pressure.
const WAVES: f64 = 1e7;

/// A bubble as a laser makes it, after Lechner, Lauterborn, Koch & Mettin (2020).
#[derive(Clone, Debug, PartialEq)]
pub struct LaserBubble {
    /// Radius at the start, m.
    pub radius: f64,
    /// R_n of its gas, m.
    pub equilibrium_radius: f64,
    /// R_n of what is left of it after the first maximum, m; all of it without.
    pub left_radius: Option<f64>,
    /// Pressure of the liquid far away, Pa.
    pub pressure: f64,
    /// d/R_max, the distance of its centre from a wall in largest radii; far from any without.
    pub stand_off: Option<f64>,
    /// What the wall is.
    pub wall: Wall,
    /// Cells along the present radius, at least.
    pub cells_per_radius: f64,
}

impl Default for LaserBubble {
    /// 20 µm that grow to half a millimetre, far from any wall.
    fn default() -> Self {
        Self {
            radius: 20e-6,
            equilibrium_radius: 184.1e-6,
            left_radius: Some(64e-6),
            pressure: 1e5,
            stand_off: None,
            wall: Wall::Rigid,
            cells_per_radius: 16.0,
        }
    }
}

impl LaserBubble {
    /// The largest radius of the default bubble, m.
    pub(super) const GROWS_TO: f64 = 493.6e-6;

    /// The case file.
    ///
    /// # Errors
    /// Numbers that make no case, each named with what is allowed.
    pub fn text(&self) -> Result<String, CaseErrors> {
        let turns = self.turns()?;
        let [largest, collapse, _, second] = turns;
        let longer = self.stand_off.map_or(1.0, lengthened);
        let end = longer * (collapse.time + SECOND * (second.time - collapse.time));
        let snapshots = (1..20).map(|share| f64::from(share) / 20.0 * end);
        let height = self.stand_off.unwrap_or(0.0) * largest.radius;
        // Cells for the largest radius, then as many levels as the first one needs.
        let blocks = Blocks::of(largest.radius, self.cells_per_radius);
        let finer = blocks.finer((largest.radius / self.radius).log2().ceil() as u32);
        let finest = format!("{} cells per radius at the start and at the largest", self.cells_per_radius);
        let above = height + CLEAR * largest.radius;
        let below = if self.stand_off.is_some() { 0.0 } else { above };
        let mut text = self.heading(&turns, longer);
        text += &times(end, "past the second collapse", snapshots);
        text +=
            "local_steps = true              # coarse levels make longer steps than fine ones\n\n[fluid]\n";
        text += &finer.keys(below, above, ACROSS * largest.radius, &finest);
        text += &format!(
            "epsilon = 1e-3                  # coarser than by default: the bubble counts\nscale_pressure = {:<14} # what grids resolve: shocks and jets, not the first pressure\nscale_density = {DENSITY:?}\n",
            number(WAVES)
        );
        if self.stand_off == Some(0.0) && self.wall == Wall::Rigid {
            // By symmetry the wall is none.
            text += "near_wall = { shock_levels = 0 }  # half a bubble on a plane of symmetry: no wall\n";
        }
        text += &self.bubble_keys(height);
        text += &match self.stand_off {
            Some(_) => {
                let solid = finer.coarser(COARSER_SOLID);
                let finest = "cells eight times as wide as the fluid's finest";
                self.wall.keys((&solid, finest), [ACROSS * largest.radius; 2], SOLID_KEYS, false)
            }
            None => "\n[coupling]\nscheme = \"none\"                 # liquid alone, open on all sides\n"
                .to_owned(),
        };
        if self.stand_off.is_some() {
            let mean = MEAN * largest.radius / sound(self.pressure);
            text += &format!(
                "\n[output]\nmean_time = {:<19} # of the wall's pressure: R/(12 c) of the largest radius\n",
                number(mean)
            );
        }
        Ok(text)
    }

    fn turns(&self) -> Result<[Turn; 4], CaseErrors> {
        let Self { radius, equilibrium_radius, pressure, .. } = *self;
        let mut checks = Checks::default();
        checks
            .positive("radius", radius, "m")
            .positive("equilibrium_radius", equilibrium_radius, "m")
            .positive("pressure", pressure, "Pa")
            .cells(self.cells_per_radius);
        let help = "give R_n above twice the radius at the start: the bubble is to grow";
        checks.hold(
            equilibrium_radius > 2.0 * radius,
            "equilibrium_radius",
            equilibrium_radius,
            &format!("above twice the radius at the start, {}", si(radius, "m")),
            help,
        );
        if let Some(stand_off) = self.stand_off {
            checks.stand_off(stand_off);
        }
        if let Some(left) = self.left_radius {
            checks.positive("left_radius", left, "m");
            let help = "give R_n of the gas that is left, or leave it out";
            checks.hold(
                left < equilibrium_radius,
                "left_radius",
                left,
                &format!("less than R_n, {}", si(equilibrium_radius, "m")),
                help,
            );
        }
        checks.done()?;
        let turns = turns(&self.content(), radius, equilibrium_radius, self.left_radius);
        let Some(turns) = turns else {
            let help = "take a pressure and radii of a bubble that grows, collapses and rebounds";
            checks.hold(
                false,
                "equilibrium_radius",
                equilibrium_radius,
                "that of a bubble that collapses",
                help,
            );
            checks.done()?;
            return Ok([Turn::default(); 4]);
        };
        Ok(turns)
    }

    pub(super) fn content(&self) -> BubbleContent {
        BubbleContent {
            far_pressure: self.pressure,
            gas: StiffenedGas { gamma: 1.4, pi: 0.0 }.into(),
            surface_tension: 0.0,
            vapour_pressure: 0.0,
            temperature: super::super::keys::bubble::TEMPERATURE,
        }
    }

    fn bubble_keys(&self, height: f64) -> String {
        let reset = self.left_radius.map_or(String::new(), |left| {
            format!(
                "reset = {{ equilibrium_radius = {} }}  # what is left of it at its largest\n",
                number(left)
            )
        });
        format!(
            "{media}
[fluid.bubble]
centre = [{centre}, 0.0]
radius = {radius}
equilibrium_radius = {rest:<11} # of its gas
cells_per_radius = {cells:<13} # at least, along the present radius
{reset}",
            media = media(self.pressure),
            centre = number(height),
            radius = number(self.radius),
            rest = number(self.equilibrium_radius),
            cells = number(self.cells_per_radius),
        )
    }

    fn heading(&self, [largest, collapse, rebound, second]: &[Turn; 4], longer: f64) -> String {
        let length = |value: f64| Dimension::Length.shortest(value);
        let [radius, rest] = [self.radius, self.equilibrium_radius].map(length);
        let pressure = Dimension::Pressure.shortest(self.pressure);
        let left = self.left_radius.map_or("none".to_owned(), length);
        let (place, wall) = match self.stand_off {
            Some(stand_off) => (
                format!("{stand_off} largest radii above a wall ({})", self.wall.name()),
                format!(" --stand-off {stand_off} --wall {}", self.wall.name()),
            ),
            None => ("far from any wall".to_owned(), String::new()),
        };
        let turn = |turn: &Turn| format!("{} at {}", si(turn.radius, "m"), si(longer * turn.time, "s"));
        format!(
            "# A laser bubble of {radius} grows {place} in water at {pressure}, collapses and rebounds.
#
#   cav new laser --radius {radius} --equilibrium-radius {rest} --left-radius {left} --pressure {pressure} \\
#       --cells-per-radius {cells}{wall}
#
# By Gilmore's equation it has {} at its largest, collapses to {},
# rebounds to {} and collapses again at {}.

",
            turn(largest),
            turn(collapse),
            turn(rebound),
            si(longer * second.time, "s"),
            cells = self.cells_per_radius,
        )
    }
}
