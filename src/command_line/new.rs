//! `cav new`: writes a case for what is asked.

use clap::{Args, Subcommand};
use solid::Material;

use super::arguments::time;
use crate::case::new::{
    Collapse, Dimension, FreeBubble, LaserBubble, LaserRadii, ShockedBubble, Wall, WallLoad,
};
use crate::case::{Case, CaseErrors};

/// What `cav new` lists.
const KINDS: &str = "\
cav new writes a short, commented case file to standard output:

  cav new collapse    a gas bubble collapses near a wall that may yield
  cav new free        a gas bubble collapses in unbounded liquid and rebounds
  cav new laser       a laser bubble grows, collapses and rebounds
  cav new shock       a lithotripter's pulse collapses an air bubble near a wall
  cav new load        a given pressure on a wall, without a fluid: the pit

For instance:

  cav new collapse --radius 1mm --pressure 10bar --stand-off 1.2 --wall steel > mine.toml
  cav check mine.toml
  cav run mine.toml

Lengths, pressures and times take units (1mm, 10bar, 2.5us); plain numbers are SI. `cav new collapse --help` has the
options, `cav materials` the walls.
";

/// The kind of case; without one they are listed.
#[derive(Args)]
pub(super) struct New {
    #[command(subcommand)]
    kind: Option<Kind>,
}

#[derive(Subcommand)]
enum Kind {
    /// A gas bubble collapses near a wall that may yield.
    Collapse(CollapseArgs),
    /// A gas bubble collapses in unbounded liquid and rebounds.
    Free(FreeArgs),
    /// A laser bubble grows, collapses and rebounds, free or near a wall.
    Laser(LaserArgs),
    /// A lithotripter's pulse collapses an air bubble near a wall.
    Shock(ShockArgs),
    /// A given pressure on a wall, without a fluid: the pit.
    Load(LoadArgs),
}

fn length(text: &str) -> Result<f64, String> {
    Dimension::Length.parse(text)
}

/// A length, or `none`.
#[derive(Clone, Copy)]
struct LengthOrNone(Option<f64>);

fn length_or_none(text: &str) -> Result<LengthOrNone, String> {
    if text == "none" { Ok(LengthOrNone(None)) } else { length(text).map(|value| LengthOrNone(Some(value))) }
}

fn pressure(text: &str) -> Result<f64, String> {
    Dimension::Pressure.parse(text)
}

fn material(text: &str) -> Result<Material, String> {
    match Wall::named(text)? {
        Wall::Solid(material) => Ok(*material),
        Wall::Rigid => Err("a rigid wall takes no load; see cav materials".to_owned()),
    }
}

#[derive(Args)]
struct CollapseArgs {
    /// Radius of the bubble.
    #[arg(long, value_parser = length, default_value = "1mm")]
    radius: f64,
    /// Pressure of the liquid far away.
    #[arg(long, value_parser = pressure, default_value = "20MPa")]
    pressure: f64,
    /// Distance of the bubble's centre from the wall, in radii; below 1 the wall cuts the bubble.
    #[arg(long, value_name = "D/R", default_value_t = 1.5, allow_negative_numbers = true)]
    stand_off: f64,
    /// A material of the library, a short name such as steel, or rigid.
    #[arg(long, value_parser = Wall::named, default_value = "al-1100-o")]
    wall: Wall,
    /// Pressure of the gas in the bubble; as given, water's vapour pressure at 20 degrees.
    #[arg(long, value_parser = pressure, default_value = "2340Pa")]
    gas_pressure: f64,
    /// Finest cells of the fluid per radius of the bubble.
    #[arg(long, value_name = "N", default_value_t = 40.0)]
    cells_per_radius: f64,
    /// Leave the wall elastic.
    #[arg(long)]
    elastic: bool,
}

#[derive(Args)]
struct FreeArgs {
    /// Radius of the bubble.
    #[arg(long, value_parser = length, default_value = "1mm")]
    radius: f64,
    /// Pressure of the liquid far away.
    #[arg(long, value_parser = pressure, default_value = "10bar")]
    pressure: f64,
    /// Pressure of the gas in the bubble.
    #[arg(long, value_parser = pressure, default_value = "23.4kPa")]
    gas_pressure: f64,
    /// Finest cells per radius of the bubble.
    #[arg(long, value_name = "N", default_value_t = 40.0)]
    cells_per_radius: f64,
}

#[derive(Args)]
struct LaserArgs {
    /// Largest radius; the equilibrium radius follows from it by Gilmore's equation.
    #[arg(long, value_parser = length, conflicts_with = "equilibrium_radius")]
    largest_radius: Option<f64>,
    /// Radius at the start; without it 20um, or with a largest radius in proportion to that.
    #[arg(long, value_parser = length)]
    radius: Option<f64>,
    /// Radius at which its gas would be in equilibrium; 184.1um.
    #[arg(long, value_parser = length)]
    equilibrium_radius: Option<f64>,
    /// The same of the gas that is left after the first maximum; none: all of it; without it 64um, or with a largest radius in proportion to that.
    #[arg(long, value_parser = length_or_none)]
    left_radius: Option<LengthOrNone>,
    /// Pressure of the liquid far away.
    #[arg(long, value_parser = pressure, default_value = "1bar")]
    pressure: f64,
    /// Distance of the bubble's centre from a wall, in largest radii; without it there is no wall.
    #[arg(long, value_name = "D/R", allow_negative_numbers = true)]
    stand_off: Option<f64>,
    /// A material of the library, a short name such as steel, or rigid.
    #[arg(long, value_parser = Wall::named, default_value = "rigid", requires = "stand_off")]
    wall: Wall,
    /// Cells along the present radius of the bubble, at least.
    #[arg(long, value_name = "N", default_value_t = 16.0)]
    cells_per_radius: f64,
}

#[derive(Args)]
struct ShockArgs {
    /// Radius of the bubble.
    #[arg(long, value_parser = length, default_value = "100um")]
    radius: f64,
    /// Pressure of water and air before the pulse.
    #[arg(long, value_parser = pressure, default_value = "1bar")]
    pressure: f64,
    /// Largest pressure of the pulse above that.
    #[arg(long, value_parser = pressure, default_value = "35MPa")]
    amplitude: f64,
    /// Distance of the bubble's centre from the wall, in radii; below 1 the wall cuts the bubble.
    #[arg(long, value_name = "D/R", default_value_t = 2.0, allow_negative_numbers = true)]
    stand_off: f64,
    /// A material of the library, a short name such as steel, or rigid.
    #[arg(long, value_parser = Wall::named, default_value = "steel")]
    wall: Wall,
    /// Finest cells of the fluid per radius of the bubble.
    #[arg(long, value_name = "N", default_value_t = 40.0)]
    cells_per_radius: f64,
}

#[derive(Args)]
struct LoadArgs {
    /// Largest pressure, on the axis.
    #[arg(long, value_parser = pressure, default_value = "1GPa")]
    amplitude: f64,
    /// Where the pressure is 1/e of that.
    #[arg(long, value_parser = length, default_value = "0.5mm")]
    radius: f64,
    /// From nothing to nothing.
    #[arg(long, value_parser = time, default_value = "1us")]
    duration: f64,
    /// A material of the library, or a short name such as steel.
    #[arg(long, value_parser = material, default_value = "steel")]
    wall: Material,
    /// Cells per radius of the load.
    #[arg(long, value_name = "N", default_value_t = 20.0)]
    cells_per_radius: f64,
}

/// The case that is asked for, which reads without a fault, or the kinds there are.
pub(super) fn text(args: New) -> Result<String, CaseErrors> {
    let Some(kind) = args.kind else { return Ok(KINDS.to_owned()) };
    let written = written(kind)?;
    Case::read(&written, "new", "the case that these numbers give", &[])?;
    Ok(written)
}

fn written(kind: Kind) -> Result<String, CaseErrors> {
    match kind {
        Kind::Collapse(asked) => Collapse {
            radius: asked.radius,
            pressure: asked.pressure,
            stand_off: asked.stand_off,
            wall: asked.wall,
            gas_pressure: asked.gas_pressure,
            cells_per_radius: asked.cells_per_radius,
            elastic: asked.elastic,
        }
        .text(),
        Kind::Free(FreeArgs { radius, pressure, gas_pressure, cells_per_radius }) => {
            FreeBubble { radius, pressure, gas_pressure, cells_per_radius }.text()
        }
        Kind::Laser(asked) => {
            let radii = LaserRadii {
                start: asked.radius,
                equilibrium: asked.equilibrium_radius,
                largest: asked.largest_radius,
                left: asked.left_radius.map(|left| left.0),
            };
            LaserBubble {
                stand_off: asked.stand_off,
                wall: asked.wall,
                cells_per_radius: asked.cells_per_radius,
                ..radii.bubble(asked.pressure)?
            }
            .text()
        }
        Kind::Shock(ShockArgs { radius, pressure, amplitude, stand_off, wall, cells_per_radius }) => {
            ShockedBubble { radius, pressure, amplitude, stand_off, wall, cells_per_radius }.text()
        }
        Kind::Load(LoadArgs { amplitude, radius, duration, wall, cells_per_radius }) => {
            WallLoad { amplitude, radius, duration, material: wall, cells_per_radius }.text()
        }
    }
}
