//! A bubble far from everything.

use super::super::error::CaseErrors;
use super::super::format::si;
use super::checks::Checks;
use super::grid::Blocks;
use super::parts::{Bubble, OF_COLLAPSE, VAPOUR, times};
use super::quantity::Dimension;

/// Radii from the bubble's centre to the open sides.
const REACH: f64 = 5.0;
/// The end, in times of the collapse: past the largest rebound.
const END: f64 = 2.0;
/// Snapshots after the collapse, in its time.
const REBOUND: [f64; 6] = [1.03, 1.1, 1.25, 1.45, 1.65, 1.85];

/// A gas bubble collapses in unbounded liquid and rebounds.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeBubble {
    /// R, m.
    pub radius: f64,
    /// Pressure of the liquid far away, Pa.
    pub pressure: f64,
    /// Pressure of the gas in the bubble, Pa.
    pub gas_pressure: f64,
    /// Finest cells per radius.
    pub cells_per_radius: f64,
}

impl Default for FreeBubble {
    /// 1 mm at 10 bar.
    fn default() -> Self {
        Self { radius: 1e-3, pressure: 1e6, gas_pressure: 10.0 * VAPOUR, cells_per_radius: 40.0 }
    }
}

impl FreeBubble {
    /// The case file.
    ///
    /// # Errors
    /// Numbers that make no case, each named with what is allowed.
    pub fn text(&self) -> Result<String, CaseErrors> {
        let Self { radius, pressure, gas_pressure, cells_per_radius } = *self;
        Checks::default()
            .positive("radius", radius, "m")
            .positive("gas_pressure", gas_pressure, "Pa")
            .above_gas("pressure", pressure, gas_pressure)
            .cells(cells_per_radius)
            .done()?;
        let bubble = Bubble { radius, pressure, gas_pressure };
        let collapse = bubble.collapse_time(f64::INFINITY);
        let snapshots = OF_COLLAPSE.into_iter().chain(REBOUND).map(|share| share * collapse);
        let [shown, far, gas] = [
            (radius, Dimension::Length),
            (pressure, Dimension::Pressure),
            (gas_pressure, Dimension::Pressure),
        ]
        .map(|(value, dimension)| dimension.shortest(value));
        let mut text = format!(
            "# A gas bubble of radius {shown} collapses in water at {far}, far from any wall, and rebounds.
#
#   cav new free --radius {shown} --pressure {far} --gas-pressure {gas} --cells-per-radius {cells_per_radius}
#
# Rayleigh's collapse time is {}. `pycav.plot.histories` sets the radius beside Keller's and Miksis's.

",
            si(bubble.rayleigh_time(), "s")
        );
        text += &times(END * collapse, "past the largest rebound", snapshots);
        text += "\n[fluid]\n";
        let finest = format!("{cells_per_radius} cells per radius where the waves are");
        let reach = REACH * radius;
        text += &Blocks::of(radius, cells_per_radius).keys(reach, reach, reach, &finest);
        text += "initial_pressure = \"rayleigh\"   # the bubble starts from rest, without a water hammer\n";
        text += &bubble.keys(0.0);
        text += "\n[coupling]\nscheme = \"none\"                 # liquid alone, open on all sides\n";
        Ok(text)
    }
}
