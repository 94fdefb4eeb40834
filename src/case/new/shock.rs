//! A pulse from afar that collapses a bubble near a wall.

use std::f64::consts::{FRAC_PI_3, PI};
use std::fmt::Write as _;

use super::super::error::CaseErrors;
use super::super::format::si;
use super::super::scales::RAYLEIGH_FACTOR;
use super::checks::Checks;
use super::grid::Blocks;
use super::parts::{Bubble, DENSITY, number, sound, times};
use super::quantity::Dimension;
use super::wall::{Wall, twice_as_wide};

/// Radii between the bubble and the side where the pulse comes in.
const ABOVE: f64 = 4.0;
/// Radii of the domain from the axis.
const ACROSS: f64 = 8.0;
/// Radii of the solid downwards.
const DEEP: f64 = 8.0;
/// Church's pulse: decay, 1/s, and angular frequency, rad/s.
const DECAY: f64 = 9.1e5;
const FREQUENCY: f64 = 2.0 * PI * 83.3e3;
/// Shortest time in which the front rises, s, and the fewest cells that it is wide.
const RISE: f64 = 20e-9;
const RISE_CELLS: f64 = 8.0;
/// The mean of the pulse over its positive part, in its amplitude: what drives the collapse.
const MEAN: f64 = 0.6;
/// Rows of the table of the pulse after its front, and the time that they cover at most, s: there it has fallen to 10⁻⁵.
const ROWS: u32 = 80;
const COVERED: f64 = 12e-6;
/// The share that a front may add without a word to the impulse of the pulse until it turns to tension.
const ADDED: f64 = 0.05;

/// A lithotripter's pulse collapses a gas bubble near a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct ShockedBubble {
    /// R, m.
    pub radius: f64,
    /// Pressure of liquid and gas before the pulse, Pa.
    pub pressure: f64,
    /// Largest pressure of the pulse above that, Pa.
    pub amplitude: f64,
    /// d/R: at least 0.
    pub stand_off: f64,
    /// What the bubble collapses at.
    pub wall: Wall,
    /// Finest cells of the fluid per radius.
    pub cells_per_radius: f64,
}

impl ShockedBubble {
    /// The case file.
    ///
    /// # Errors
    /// Numbers that make no case, each named with what is allowed.
    pub fn text(&self) -> Result<String, CaseErrors> {
        let Self { radius, pressure, amplitude, stand_off, cells_per_radius, .. } = *self;
        Checks::default()
            .positive("radius", radius, "m")
            .positive("pressure", pressure, "Pa")
            .positive("amplitude", amplitude, "Pa")
            .stand_off(stand_off)
            .cells(cells_per_radius)
            .done()?;
        let blocks = Blocks::of(radius, cells_per_radius);
        let top = blocks.rounded((stand_off + ABOVE) * radius);
        let c = sound(pressure);
        let driven = Bubble { radius, pressure: pressure + MEAN * amplitude, gas_pressure: pressure };
        let arrival = (top - (stand_off + 1.0) * radius) / c;
        let collapse = arrival + driven.rayleigh_time().max(self.while_rising());
        let end = collapse + (stand_off + 6.0) * radius / c;
        let shares = [0.5, 0.7, 0.85, 0.95, 1.0].map(|share| arrival + share * (collapse - arrival));
        let afterwards = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0].map(|after| collapse + after * radius / c);
        let mut text = self.heading(arrival, collapse);
        text += &times(
            end,
            "the collapse and what it sends to the wall",
            [0.5 * arrival, arrival].into_iter().chain(shares).chain(afterwards),
        );
        text += "\n[fluid]                         # above the wall at z = 0\n";
        text += &blocks.keys(
            0.0,
            (stand_off + ABOVE) * radius,
            ACROSS * radius,
            &format!("{cells_per_radius} cells per radius where the waves are"),
        );
        let bubble = Bubble { radius, pressure, gas_pressure: pressure };
        text += &bubble.keys(stand_off * radius);
        text += "\n[fluid.boundary]\nz_max = \"inflow\"                # where the pulse comes in\nr_max = \"wall\"                  # it runs along it\n";
        text += &self.pulse(end);
        let beside = "\n[solid.boundary]\nr_max = \"symmetry\"              # as the wall of the fluid\n";
        let (solid, about) = twice_as_wide(&blocks);
        text += &self.wall.keys((&solid, about), [DEEP * radius, ACROSS * radius], beside, false);
        let _ = write!(
            text,
            "\n[[probe]]                       # the pulse before it meets the bubble\nname = \"incident\"\nposition = [{}, 0.0]\nmedium = \"fluid\"\n",
            number(top - 0.5 * radius)
        );
        Ok(text)
    }

    fn heading(&self, arrival: f64, collapse: f64) -> String {
        let [radius, pressure, amplitude] = [
            (self.radius, Dimension::Length),
            (self.pressure, Dimension::Pressure),
            (self.amplitude, Dimension::Pressure),
        ]
        .map(|(value, dimension)| dimension.shortest(value));
        let (stand_off, wall, cells) = (self.stand_off, self.wall.name(), self.cells_per_radius);
        let rise = self.rise();
        let added = 0.5 * rise / positive_impulse();
        let slow = if added > ADDED {
            format!(
                "\n# On {cells} cells per radius that front adds {:.0} % to the impulse of the pulse until it turns to tension; finer cells add less.",
                100.0 * added
            )
        } else {
            String::new()
        };
        let turn = turns_to_tension();
        let late = if collapse - arrival > rise + turn {
            format!(
                "\n# It turns to tension {} after its front, before that: whether the bubble collapses a run tells.",
                si(turn, "s")
            )
        } else {
            String::new()
        };
        let [arrival, collapse, rise] = [arrival, collapse, rise].map(|time| si(time, "s"));
        format!(
            "# A lithotripter's pulse of {amplitude} collapses an air bubble of {radius}, {stand_off} radii above a wall ({wall}).
#
#   cav new shock --radius {radius} --pressure {pressure} --amplitude {amplitude} --stand-off {stand_off} --wall {wall} \\
#       --cells-per-radius {cells}
#
# The pulse is Church's (1989), p = 2 P exp(-alpha t) cos(omega t + pi/3), behind a front of {rise}. It reaches the bubble at
# {arrival}; {MEAN} P that stays collapses it by {collapse}.{late}{slow}

"
        )
    }

    /// How long the front of the pulse takes, s: some cells, so that it does not ring.
    fn rise(&self) -> f64 {
        RISE.max(RISE_CELLS * self.radius / self.cells_per_radius / sound(self.pressure))
    }

    /// How long a bubble takes that collapses while the pulse still rises, s: Rayleigh's time of the same share of the mean pressure until then,
    /// T² = (0.915 R)² ρ/p with p = 0.6 P T/(2 rise).
    fn while_rising(&self) -> f64 {
        let length = RAYLEIGH_FACTOR * self.radius;
        (length * length * DENSITY * 2.0 * self.rise() / (MEAN * self.amplitude)).cbrt()
    }

    /// `[fluid.inflow]`: Church's pulse as a table that is linear in between.
    fn pulse(&self, end: f64) -> String {
        let (rise, span) = (self.rise(), (end - self.rise()).max(self.rise()));
        let mut rows = vec![format!("[0.0, {}]", number(self.pressure))];
        // The closer the nearer to the front.
        let covered = (0..=ROWS).map(|row| span.min(COVERED) * (f64::from(row) / f64::from(ROWS)).powi(2));
        rows.extend(covered.chain((span > COVERED).then_some(span)).map(|after| {
            format!("[{}, {}]", number(rise + after), number(self.pressure + self.amplitude * shape(after)))
        }));
        let lines: Vec<String> = rows.chunks(4).map(|chunk| format!("    {},", chunk.join(", "))).collect();
        format!("\n[fluid.inflow]\npressure = [\n{}\n]\n", lines.join("\n"))
    }
}

/// Church's pulse over its amplitude, p/P = 2 exp(−αt) cos(ωt + π/3), `t` s after its front.
fn shape(t: f64) -> f64 {
    2.0 * (-DECAY * t).exp() * (FREQUENCY * t + FRAC_PI_3).cos()
}

/// ∫ p dt over P of the pulse from its front until it turns to tension at ωt = π/6, s.
fn positive_impulse() -> f64 {
    // Of 2 Re exp((iω − α) t + iπ/3) from 0 to π/(6ω).
    let (real, turn) = (-DECAY, turns_to_tension());
    let integral = |t: f64| {
        let phase = FREQUENCY * t + FRAC_PI_3;
        2.0 * (-DECAY * t).exp() * (real * phase.cos() + FREQUENCY * phase.sin())
            / (real * real + FREQUENCY * FREQUENCY)
    };
    integral(turn) - integral(0.0)
}

/// When the pulse turns to tension after its front, s.
fn turns_to_tension() -> f64 {
    PI / 6.0 / FREQUENCY
}
