//! What Python gives for the surface between the media.

use coupler::InterfaceStar;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// What Python gives for the surface: means over a step, face by face.
pub struct Given {
    pressure: Option<Vec<f64>>,
    velocity: Option<Vec<f64>>,
    power: Option<Vec<f64>>,
}

impl Given {
    /// Checked: one finite number for each face.
    pub fn new(
        faces: usize,
        pressure: Option<PyReadonlyArray1<'_, f64>>,
        velocity: Option<PyReadonlyArray1<'_, f64>>,
        power: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        let take = |name: &str, array: Option<PyReadonlyArray1<'_, f64>>| -> PyResult<Option<Vec<f64>>> {
            let Some(array) = array else { return Ok(None) };
            let values = array.as_array().to_vec();
            let what = match values.iter().position(|value| !value.is_finite()) {
                Some(face) => format!("{name}[{face}] is {}", values[face]),
                None if values.len() != faces => format!("it has {}", values.len()),
                None => return Ok(Some(values)),
            };
            Err(PyValueError::new_err(format!(
                "{name} has to be {faces} finite numbers, one for each face of the surface; {what}"
            )))
        };
        let given = Self {
            pressure: take("pressure", pressure)?,
            velocity: take("velocity", velocity)?,
            power: take("power", power)?,
        };
        if given.power.is_some() && (given.pressure.is_none() || given.velocity.is_none()) {
            return Err(PyValueError::new_err("power goes with both pressure and velocity"));
        }
        if faces > 0 && given.pressure.is_none() && given.velocity.is_none() {
            return Err(PyValueError::new_err("pressure or velocity of the surface is needed, or both"));
        }
        Ok(given)
    }

    /// Pressure, velocity and power of a face; what is not given comes from the medium's own wave.
    pub fn state(
        &self,
        face: usize,
        under: impl Fn(f64) -> InterfaceStar,
        moved: impl Fn(f64) -> InterfaceStar,
    ) -> [f64; 3] {
        let at = |values: &Option<Vec<f64>>| values.as_ref().map(|values| values[face]);
        let (pressure, velocity) = match (at(&self.pressure), at(&self.velocity)) {
            (Some(pressure), Some(velocity)) => (pressure, velocity),
            (Some(pressure), None) => (pressure, under(pressure).velocity),
            (None, Some(velocity)) => (moved(velocity).pressure, velocity),
            (None, None) => (0.0, 0.0),
        };
        [pressure, velocity, at(&self.power).unwrap_or(pressure * velocity)]
    }
}
