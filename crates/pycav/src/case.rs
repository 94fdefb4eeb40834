//! A case file, read and changed.

use std::path::PathBuf;

use cav::case;
use cav::convergence::plan::Source;
use cav::run::process::launch::directory_of;
use pyo3::prelude::*;

use crate::error::case_error;

/// A case: read, checked, all defaults filled in. It does not change; `with_sets` gives a changed copy.
#[pyclass(frozen, module = "pycav._pycav")]
pub struct Case {
    text: String,
    shown: String,
    sets: Vec<String>,
    case: case::Case,
}

impl Case {
    pub fn case(&self) -> &case::Case {
        &self.case
    }

    pub fn sets(&self) -> &[String] {
        &self.sets
    }

    /// What it was read from.
    pub fn source(&self) -> Source {
        Source {
            text: self.text.clone(),
            name: self.case.name.clone(),
            shown: self.shown.clone(),
            sets: self.sets.clone(),
        }
    }

    fn read(text: String, name: &str, shown: String, sets: Vec<String>) -> PyResult<Self> {
        let case = case::Case::read(&text, name, &shown, &sets).map_err(|errors| case_error(&errors))?;
        Ok(Self { text, shown, sets, case })
    }
}

#[pymethods]
impl Case {
    /// Reads a case file.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        let case = case::Case::load(&path, &[]).map_err(|errors| case_error(&errors))?;
        let text = std::fs::read_to_string(&path)?;
        Ok(Self { text, shown: path.display().to_string(), sets: Vec::new(), case })
    }

    /// Reads a case from text.
    #[staticmethod]
    pub fn from_toml(text: String, name: &str) -> PyResult<Self> {
        Self::read(text, name, format!("{name}.toml"), Vec::new())
    }

    /// A copy with changes `KEY=VALUE` made to it, after those made before.
    fn with_sets(&self, sets: Vec<String>) -> PyResult<Self> {
        let sets = [self.sets.clone(), sets].concat();
        Self::read(self.text.clone(), &self.case.name, self.shown.clone(), sets)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.case.name
    }

    /// The directory of a run of the case that names none.
    #[getter]
    fn directory(&self) -> PathBuf {
        directory_of(&self.case, None)
    }

    /// The text that the case was read from, without the changes made since.
    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// End of the run, s.
    #[getter]
    fn end(&self) -> f64 {
        self.case.time.end
    }

    /// The media of the case: "fluid", "solid".
    #[getter]
    fn media(&self) -> Vec<&'static str> {
        let fluid = self.case.fluid.as_ref().map(|_| "fluid");
        fluid.into_iter().chain(self.case.solid.as_ref().map(|_| "solid")).collect()
    }

    /// What the case does not do though its text might be read so.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.case.warnings()
    }

    /// The case written out, all defaults filled in.
    fn to_toml(&self) -> String {
        self.case.effective_toml()
    }

    /// Hash of what the case computes.
    #[getter]
    fn hash(&self) -> String {
        self.case.hash().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// What `cav check` says of the case.
    fn report(&self) -> String {
        case::report(&self.case)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.case == other.case
    }

    fn __hash__(&self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|k| self.case.hash()[k]))
    }
}

/// The library of materials: name, density (kg/m³), c₁, c₂ (m/s), yield strength (Pa, None if it has none).
#[pyfunction]
pub fn materials() -> Vec<(String, f64, f64, f64, Option<f64>)> {
    let row = |material: &solid::Material| {
        let name = material.name().to_owned();
        (name, material.density(), material.c1(), material.c2(), material.yield_strength())
    };
    solid::Material::library().iter().map(row).collect()
}
