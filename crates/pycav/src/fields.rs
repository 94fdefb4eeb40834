//! Cells and samples of a solver as arrays, all of them copies.

use cav::run::side::coupled_solver::CoupledSolver;
use mesh::{BLOCK, CellSnapshot, Mesh};
use numpy::ndarray::{Array1, Array2};
use numpy::{IntoPyArray, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A solver whose state can be read cell by cell and point by point.
pub trait Readable: CoupledSolver + Sync {
    /// Names of what [`Readable::at`] gives.
    const SAMPLED: &'static [&'static str];

    /// Names and values of the fields with one number a cell.
    fn scalars(&self) -> Vec<(&'static str, Vec<f64>)>;
    /// The state at a point by the linear reconstruction in its cell; `None` outside.
    fn at(&self, point: [f64; 2]) -> Option<Vec<f64>>;
}

impl Readable for fluid::FluidSolver<BLOCK> {
    const SAMPLED: &'static [&'static str] =
        &["density", "velocity_z", "velocity_r", "pressure", "gas_fraction"];

    fn scalars(&self) -> Vec<(&'static str, Vec<f64>)> {
        let snapshot = self.snapshot();
        let [velocity_z, velocity_r] = components(&snapshot.velocity);
        vec![
            ("density", snapshot.density),
            ("pressure", snapshot.pressure),
            ("velocity_z", velocity_z),
            ("velocity_r", velocity_r),
            ("gas_fraction", snapshot.gas_fraction),
            ("schlieren", snapshot.schlieren),
        ]
    }

    fn at(&self, point: [f64; 2]) -> Option<Vec<f64>> {
        self.sample(point).map(|state| state.to_array().to_vec())
    }
}

impl Readable for solid::SolidSolver<BLOCK> {
    const SAMPLED: &'static [&'static str] =
        &["velocity_z", "velocity_r", "stress_zz", "stress_zr", "stress_rr", "stress_phiphi", "von_mises"];

    fn scalars(&self) -> Vec<(&'static str, Vec<f64>)> {
        let snapshot = self.snapshot();
        let [velocity_z, velocity_r] = components(&snapshot.velocity);
        let [displacement_z, displacement_r] = components(&snapshot.displacement);
        let von_mises = (0..snapshot.cells()).map(|cell| snapshot.von_mises(cell)).collect();
        let mut scalars = vec![
            ("velocity_z", velocity_z),
            ("velocity_r", velocity_r),
            ("stress_zz", snapshot.stress_zz),
            ("stress_zr", snapshot.stress_zr),
            ("stress_rr", snapshot.stress_rr),
            ("stress_phiphi", snapshot.stress_phiphi),
            ("von_mises", von_mises),
        ];
        if self.is_plastic() {
            scalars.extend([
                ("plastic_strain", snapshot.plastic_strain),
                ("plastic_strain_rate", snapshot.plastic_strain_rate),
                ("displacement_z", displacement_z),
                ("displacement_r", displacement_r),
            ]);
        }
        if self.has_heat() {
            scalars.push(("temperature", snapshot.temperature));
        }
        scalars
    }

    fn at(&self, point: [f64; 2]) -> Option<Vec<f64>> {
        let state = self.sample(point)?;
        let mises = solid::von_mises(state.stress_zz, state.stress_zr, state.stress_rr, state.stress_phiphi);
        Some([&state.to_array()[..], &[mises]].concat())
    }
}

fn components(velocity: &[[f64; 2]]) -> [Vec<f64>; 2] {
    [0, 1].map(|axis| velocity.iter().map(|velocity| velocity[axis]).collect())
}

/// Places, sizes and levels of all cells, and the fields in them: arrays of shape (cells,).
pub fn cells<'py>(py: Python<'py>, solver: &impl Readable) -> PyResult<Bound<'py, PyDict>> {
    let (places, levels, scalars) = py.detach(|| {
        let (places, levels) = places(solver.mesh());
        (places, levels, solver.scalars())
    });
    let found = PyDict::new(py);
    for (name, values) in ["z", "r", "width_z", "width_r", "area"].into_iter().zip(places) {
        found.set_item(name, values.into_pyarray(py))?;
    }
    found.set_item("level", levels.into_pyarray(py))?;
    for (name, values) in scalars {
        found.set_item(name, values.into_pyarray(py))?;
    }
    Ok(found)
}

/// Centres (z, r), widths and areas in the section of all cells in the order of snapshots, and their levels.
fn places(mesh: &Mesh<BLOCK>) -> ([Vec<f64>; 5], Vec<u8>) {
    let mut places: [Vec<f64>; 5] = std::array::from_fn(|_| Vec::with_capacity(mesh.cells()));
    let mut levels = Vec::with_capacity(mesh.cells());
    for id in mesh.tree().leaves() {
        let [h_z, h_r] = mesh.widths(id.level);
        for j in 0..BLOCK {
            for i in 0..BLOCK {
                let [z, r] = mesh.centre(*id, i, j);
                for (list, value) in places.iter_mut().zip([z, r, h_z, h_r, h_z * h_r]) {
                    list.push(value);
                }
                levels.push(id.level);
            }
        }
    }
    (places, levels)
}

/// The state at the points of a regular grid: arrays of shape (len(z), len(r)), NaN outside the domain.
pub fn sample<'py, S: Readable>(
    py: Python<'py>,
    solver: &S,
    z: &PyReadonlyArray1<'py, f64>,
    r: &PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let (z, r): (Array1<f64>, Array1<f64>) = (z.as_array().to_owned(), r.as_array().to_owned());
    let images = py.detach(|| {
        let mut images = vec![Array2::from_elem((z.len(), r.len()), f64::NAN); S::SAMPLED.len()];
        for (i, z) in z.iter().enumerate() {
            for (j, r) in r.iter().enumerate() {
                for (image, value) in images.iter_mut().zip(solver.at([*z, *r]).unwrap_or_default()) {
                    image[[i, j]] = value;
                }
            }
        }
        images
    });
    let found = PyDict::new(py);
    for (name, image) in S::SAMPLED.iter().zip(images) {
        found.set_item(name, image.into_pyarray(py))?;
    }
    Ok(found)
}
