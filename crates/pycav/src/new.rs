//! Cases for what is asked most often, as `cav new` writes them.

use cav::case::CaseErrors;
use cav::case::new::{Collapse, FreeBubble, LaserBubble, LaserRadii, ShockedBubble, Wall, WallLoad};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::case::Case;
use crate::error::case_error;

fn case(text: Result<String, CaseErrors>, name: &str) -> PyResult<Case> {
    Case::from_toml(text.map_err(|errors| case_error(&errors))?, name)
}

fn wall(name: &str) -> PyResult<Wall> {
    Wall::named(name).map_err(PyValueError::new_err)
}

/// A gas bubble near a wall; the arguments of `cav new collapse`, SI.
#[pyfunction]
pub fn new_collapse(
    radius: f64,
    pressure: f64,
    stand_off: f64,
    wall_name: &str,
    gas_pressure: f64,
    cells_per_radius: f64,
    elastic: bool,
) -> PyResult<Case> {
    let wall = wall(wall_name)?;
    let asked = Collapse { radius, pressure, stand_off, wall, gas_pressure, cells_per_radius, elastic };
    case(asked.text(), "collapse")
}

/// A gas bubble in unbounded liquid; the arguments of `cav new free`, SI.
#[pyfunction]
pub fn new_free_bubble(
    radius: f64,
    pressure: f64,
    gas_pressure: f64,
    cells_per_radius: f64,
) -> PyResult<Case> {
    case(FreeBubble { radius, pressure, gas_pressure, cells_per_radius }.text(), "free")
}

/// A laser bubble, free or near a wall; the arguments of `cav new laser`, SI: its radii at the start, in equilibrium and at its largest, and
/// whether all of its gas is left or, if not, R_n of what is.
#[pyfunction]
pub fn new_laser_bubble(
    radii: (Option<f64>, Option<f64>, Option<f64>),
    left: (bool, Option<f64>),
    pressure: f64,
    stand_off: Option<f64>,
    wall_name: &str,
    cells_per_radius: f64,
) -> PyResult<Case> {
    let wall = wall(wall_name)?;
    let (start, equilibrium, largest) = radii;
    let (all_is_left, radius) = left;
    let left = if all_is_left { Some(None) } else { radius.map(Some) };
    let text = LaserRadii { start, equilibrium, largest, left }
        .bubble(pressure)
        .and_then(|bubble| LaserBubble { stand_off, wall, cells_per_radius, ..bubble }.text());
    case(text, "laser")
}

/// A lithotripter's pulse and an air bubble near a wall; the arguments of `cav new shock`, SI.
#[pyfunction]
pub fn new_shocked_bubble(
    radius: f64,
    pressure: f64,
    amplitude: f64,
    stand_off: f64,
    wall_name: &str,
    cells_per_radius: f64,
) -> PyResult<Case> {
    let wall = wall(wall_name)?;
    case(ShockedBubble { radius, pressure, amplitude, stand_off, wall, cells_per_radius }.text(), "shock")
}

/// A pressure on a wall; the arguments of `cav new load`, SI.
#[pyfunction]
pub fn new_wall_load(
    amplitude: f64,
    radius: f64,
    duration: f64,
    wall_name: &str,
    cells_per_radius: f64,
) -> PyResult<Case> {
    let Wall::Solid(material) = wall(wall_name)? else {
        return Err(PyValueError::new_err(
            "a rigid wall takes no load; pycav.materials() lists those that do",
        ));
    };
    case(WallLoad { amplitude, radius, duration, material: *material, cells_per_radius }.text(), "load")
}
