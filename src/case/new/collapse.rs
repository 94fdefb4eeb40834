//! A bubble that collapses near a wall.

use std::fmt::Write as _;

use super::super::error::CaseErrors;
use super::super::format::si;
use super::checks::Checks;
use super::grid::Blocks;
use super::parts::{Bubble, OF_COLLAPSE, VAPOUR, sound, times};
use super::quantity::Dimension;
use super::wall::{Wall, twice_as_wide};

/// Radii from the bubble to open sides, where a far field is as good as one far away (docs/theory/far-field.md).
const CLEAR: f64 = 4.0;
/// Radii of the domain from the axis, and of the solid downwards.
const ACROSS: f64 = 5.0;
/// How long waves are followed after the collapse, in R/c: until the surface of a wall that yields is still.
const AFTER: f64 = 12.0;
/// The same as a share of the collapse's time: past the second collapse of slow bubbles.
const REBOUND: f64 = 0.5;
/// When the shock and the jet are on their way to the wall, in R/c after the collapse.
const AFTERWARDS: [f64; 8] = [0.4, 0.8, 1.2, 1.8, 2.6, 4.0, 6.0, 9.0];
/// Radius of the disc on the wall that stands for a transducer, in R.
const DISC: f64 = 0.5;

/// A gas bubble collapses near a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Collapse {
    /// R, m.
    pub radius: f64,
    /// Pressure of the liquid far away, Pa.
    pub pressure: f64,
    /// d/R, the distance of the bubble's centre from the wall in radii: at least 0. Below 1 the wall cuts the bubble.
    pub stand_off: f64,
    /// What the bubble collapses at.
    pub wall: Wall,
    /// Pressure of the gas in the bubble, Pa.
    pub gas_pressure: f64,
    /// Finest cells of the fluid per radius.
    pub cells_per_radius: f64,
    /// Leave a solid elastic, whatever it could bear.
    pub elastic: bool,
}

impl Default for Collapse {
    /// 1 mm at 20 MPa, 1.5 radii above pure, annealed aluminium.
    fn default() -> Self {
        Self {
            radius: 1e-3,
            pressure: 2e7,
            stand_off: 1.5,
            wall: Wall::named("al-1100-o").unwrap_or(Wall::Rigid),
            gas_pressure: VAPOUR,
            cells_per_radius: 40.0,
            elastic: false,
        }
    }
}

impl Collapse {
    /// The case file.
    ///
    /// # Errors
    /// Numbers that make no case, each named with what is allowed.
    pub fn text(&self) -> Result<String, CaseErrors> {
        Checks::default()
            .positive("radius", self.radius, "m")
            .positive("gas_pressure", self.gas_pressure, "Pa")
            .above_gas("pressure", self.pressure, self.gas_pressure)
            .stand_off(self.stand_off)
            .cells(self.cells_per_radius)
            .done()?;
        let Self { radius, stand_off, cells_per_radius, .. } = *self;
        let bubble = Bubble { radius, pressure: self.pressure, gas_pressure: self.gas_pressure };
        let collapse = bubble.collapse_time(stand_off);
        let crossing = radius / sound(self.pressure);
        let travel = stand_off * crossing;
        let end = collapse + travel + (AFTER * crossing).max(REBOUND * collapse);
        let height = stand_off * radius;
        let blocks = Blocks::of(radius, cells_per_radius);
        let mut text = self.heading(&bubble, collapse);
        let snapshots = OF_COLLAPSE.map(|share| share * collapse).into_iter();
        let about = "the collapse, its shock on the wall, and the rebound";
        text += &times(end, about, snapshots.chain(AFTERWARDS.map(|after| collapse + after * crossing)));
        let finest = format!("{cells_per_radius} cells per radius where the waves are");
        text += "\n[fluid]                         # above the wall at z = 0\n";
        text += &blocks.keys(0.0, height + CLEAR * radius, ACROSS * radius, &finest);
        text += "initial_pressure = \"rayleigh\"   # the bubble starts from rest, without a water hammer\n";
        text += &bubble.keys(height);
        let (solid, about) = twice_as_wide(&blocks);
        text += &self.wall.keys((&solid, about), [ACROSS * radius; 2], "", self.elastic);
        let _ = write!(
            text,
            "
[[sensor]]                      # mean pressure, force and impulse on a disc about the axis
name = \"disc\"
radius = {}
",
            super::parts::number(DISC * radius)
        );
        Ok(text)
    }

    fn heading(&self, bubble: &Bubble, collapse: f64) -> String {
        let Self { stand_off, .. } = *self;
        let [radius, pressure, gas] = [
            (self.radius, Dimension::Length),
            (self.pressure, Dimension::Pressure),
            (self.gas_pressure, Dimension::Pressure),
        ]
        .map(|(value, dimension)| dimension.shortest(value));
        let (wall, cells) = (self.wall.name(), self.cells_per_radius);
        let elastic = if self.elastic { " --elastic" } else { "" };
        let [rayleigh, about] = [bubble.rayleigh_time(), collapse].map(|time| si(time, "s"));
        format!(
            "# A gas bubble of radius {radius} collapses {stand_off} radii above a wall ({wall}), in water at {pressure}.
#
#   cav new collapse --radius {radius} --pressure {pressure} --stand-off {stand_off} --wall {wall} \\
#       --gas-pressure {gas} --cells-per-radius {cells}{elastic}
#
# Rayleigh's collapse time is {rayleigh}; near the wall the bubble collapses at about {about}.
# Peaks depend on the resolution: `cav run FILE --refine 3` says how far they are converged.
# `cav keys` explains every key and lists those that are left at their defaults.

"
        )
    }
}
