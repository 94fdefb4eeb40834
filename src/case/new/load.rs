//! A given pressure on a wall, without a fluid.

use solid::Material;

use super::super::error::CaseErrors;
use super::checks::Checks;
use super::grid::Blocks;
use super::parts::number;
use super::quantity::Dimension;
use super::wall::plasticity;

/// Radii of the load that the solid reaches, downwards and from the axis.
const REACH: f64 = 10.0;
/// At the latest the surface is still after the load and so many times its radius over the speed of shear waves.
const LATEST: f64 = 60.0;
/// Rows of the history.
const ROWS: u32 = 16;

/// A pressure A exp(−r²/b²) that comes and goes as a squared sine acts on a solid.
#[derive(Clone, Debug, PartialEq)]
pub struct WallLoad {
    /// A, Pa.
    pub amplitude: f64,
    /// b, m.
    pub radius: f64,
    /// From nothing to nothing, s.
    pub duration: f64,
    /// What it acts on.
    pub material: Material,
    /// Cells per radius of the load.
    pub cells_per_radius: f64,
}

impl WallLoad {
    /// The case file.
    ///
    /// # Errors
    /// Numbers that make no case, each named with what is allowed.
    pub fn text(&self) -> Result<String, CaseErrors> {
        let Self { amplitude, radius, duration, ref material, cells_per_radius } = *self;
        Checks::default()
            .positive("amplitude", amplitude, "Pa")
            .positive("radius", radius, "m")
            .positive("duration", duration, "s")
            .cells(cells_per_radius)
            .done()?;
        let longest = duration + LATEST * radius / material.c2();
        let rows = (0..=ROWS).map(|row| {
            let phase = f64::from(row) / f64::from(ROWS);
            let factor = if row == ROWS { 0.0 } else { (std::f64::consts::PI * phase).sin().powi(2) };
            format!("[{}, {}]", number(phase * duration), number((1e4 * factor).round() * 1e-4))
        });
        let history: Vec<String> = rows.collect();
        let lines: Vec<String> =
            history.chunks(4).map(|chunk| format!("    {},", chunk.join(", "))).collect();
        let [peak, wide, long] =
            [(amplitude, Dimension::Pressure), (radius, Dimension::Length), (duration, Dimension::Time)]
                .map(|(value, dimension)| dimension.shortest(value));
        let name = material.name();
        let law = plasticity(material);
        let stays = if law.is_empty() { "it stays elastic, and keeps no pit" } else { "the pit that stays" };
        Ok(format!(
            "# A pressure of {peak} on a disc of radius {wide} presses on {name} for {long}: {stays}.
#
#   cav new load --amplitude {peak} --radius {wide} --duration {long} --wall {name} --cells-per-radius {cells_per_radius}

[time]
end = \"settled\"                 # when the surface is still
longest = {longest}
snapshots = [{half}, {duration}]

[solid]
{grid}material = \"{name}\"
{law}
[coupling]
scheme = \"load\"

[coupling.load]                 # A exp(-r^2/b^2) f(t)
amplitude = {amplitude}
radius = {radius}
history = [
{rows}
]
",
            longest = number(longest),
            half = number(0.5 * duration),
            duration = number(duration),
            grid = Blocks::of(radius, cells_per_radius).keys(REACH * radius, 0.0, REACH * radius, &format!("{cells_per_radius} cells per radius of the load")),
            amplitude = number(amplitude),
            radius = number(radius),
            rows = lines.join("\n"),
        ))
    }
}
