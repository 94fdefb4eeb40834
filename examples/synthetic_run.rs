//! Writes a run directory with made-up fields, to work on pictures and readers without a simulation:
//! `cargo run --release --example synthetic_run -- DIR`. Prints what a snapshot and a batch of histories cost.

use std::path::Path;
use std::time::Instant;

use cav::output::run_directory::{FLUID_FIELDS, FLUID_HISTORY, SOLID_FIELDS};
use cav::output::{
    Column, FieldSpec, HistoryFile, OutputError, OwnedQuadMesh, RunDirectory, SeriesWriter, Storage,
};

/// Cells along one edge of a block.
const N: usize = 16;
const RADIUS: f64 = 0.01;
const WALL: f64 = 0.01;

/// Blocks of N x N cells, the corners shared within a block.
#[derive(Default)]
struct Mesh {
    points: Vec<f64>,
    quads: Vec<[usize; 4]>,
    centres: Vec<[f64; 2]>,
    levels: Vec<f64>,
}

impl Mesh {
    fn add_block(&mut self, origin: [f64; 2], width: f64, level: f64) {
        let first = self.points.len() / 3;
        let h = width / N as f64;
        for j in 0..=N {
            for i in 0..=N {
                self.points.extend([origin[0] + i as f64 * h, origin[1] + j as f64 * h, 0.0]);
            }
        }
        for j in 0..N {
            for i in 0..N {
                let corner = first + j * (N + 1) + i;
                self.quads.push([corner, corner + 1, corner + N + 2, corner + N + 1]);
                self.centres.push([origin[0] + (i as f64 + 0.5) * h, origin[1] + (j as f64 + 0.5) * h]);
                self.levels.push(level);
            }
        }
    }

    /// Blocks of a square of 0.05 m from `z_min` up; where `refine` says so a block is four of half the width.
    fn square(z_min: f64, blocks: usize, refine: impl Fn(f64, f64) -> bool) -> Self {
        let width = 0.05 / blocks as f64;
        let mut mesh = Self::default();
        for (i, j) in (0..blocks).flat_map(|j| (0..blocks).map(move |i| (i, j))) {
            let origin = [z_min + i as f64 * width, j as f64 * width];
            if refine(origin[0] + 0.5 * width, origin[1] + 0.5 * width) {
                for (a, b) in [(0.0, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5)] {
                    mesh.add_block([origin[0] + a * width, origin[1] + b * width], 0.5 * width, 6.0);
                }
            } else {
                mesh.add_block(origin, width, 5.0);
            }
        }
        mesh
    }
}

/// A field as the program writes it.
fn spec<S: mesh::CellSnapshot>(fields: &[mesh::CellField<S>], name: &str) -> FieldSpec<'static> {
    let field = fields.iter().find(|field| field.name == name).expect("a field of the program");
    let storage = if name == "level" { Storage::U8 } else { Storage::F64 };
    let mesh::CellField { name, unit, description, .. } = *field;
    FieldSpec { name, components: field.components(), unit, description, storage }
}

fn main() -> Result<(), OutputError> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "runs/synthetic".to_owned());
    let directory = RunDirectory::prepare(Path::new(&path), true)?;
    write_fluid(&directory)?;
    write_solid(&directory)?;
    write_history(&directory)
}

fn write_fluid(directory: &RunDirectory) -> Result<(), OutputError> {
    let names = ["density", "pressure", "velocity", "gas_fraction", "schlieren", "level"];
    let fields = names.map(|name| spec(fluid::CELL_FIELDS, name));
    let mut writer = SeriesWriter::create(&directory.file(FLUID_FIELDS), &fields, 1, &[])?;
    for step in 0..6 {
        let t = 1e-5 * step as f64;
        let radius = RADIUS * (1.0 - 0.1 * step as f64);
        let centre = 0.03 - 0.001 * step as f64;
        // Levels appear from the third snapshot on; the first two share a mesh.
        let mesh = if step < 2 {
            Mesh::square(WALL, 16, |_, _| false)
        } else {
            Mesh::square(WALL, 8, |z, r| ((z - centre).hypot(r) - radius).abs() < 0.006 || z < 0.02)
        };
        let shock = 0.012 + 0.004 * step as f64;
        let phi = |d: f64| 0.5 - 0.5 * ((d - radius) / 2e-4).tanh();
        let front = |d: f64| 0.5 - 0.5 * ((d - shock) / 3e-4).tanh();
        let echo =
            |z: f64, r: f64| 40.0 * (-(((2.0 * WALL - z - centre).hypot(r) - shock) / 8e-4).powi(2)).exp();
        let density = |z: f64, r: f64| {
            let d = (z - centre).hypot(r);
            phi(d) * 0.03 + (1.0 - phi(d)) * (1000.0 + 60.0 * front(d) * (RADIUS / (d + 1e-3)) + echo(z, r))
        };
        let cells = mesh.quads.len();
        let scalar =
            |f: &dyn Fn(f64, f64) -> f64| mesh.centres.iter().map(|c| f(c[0], c[1])).collect::<Vec<f64>>();
        let gradient = |z: f64, r: f64| {
            let e = 5e-5;
            (density(z + e, r) - density(z - e, r)).hypot(density(z, r + e) - density(z, r - e)) / (2.0 * e)
        };
        let values = [
            scalar(&density),
            scalar(&|z, r| 5e7 + 1e6 * (density(z, r) - 1000.0)),
            mesh.centres.iter().flat_map(|c| [-100.0 * phi(c[0] - centre), c[1], 0.0]).collect(),
            scalar(&|z, r| phi((z - centre).hypot(r))),
            scalar(&gradient),
            mesh.levels.clone(),
        ];
        append(&mut writer, t, &mesh, step, &values, &format!("fluid, {cells} cells"))?;
    }
    Ok(())
}

fn write_solid(directory: &RunDirectory) -> Result<(), OutputError> {
    let stresses = ["stress_zz", "stress_zr", "stress_rr", "stress_phiphi", "von_mises", "yield_function"];
    let names = ["velocity"].into_iter().chain(stresses).chain(["level"]);
    let fields: Vec<_> = names.map(|name| spec(solid::CELL_FIELDS, name)).collect();
    let mut writer = SeriesWriter::create(&directory.file(SOLID_FIELDS), &fields, 1, &[])?;
    let mesh = Mesh::square(-0.04, 16, |_, _| false);
    for step in 0..6 {
        let peak = 2e8 * (-((step as f64 - 4.0) / 1.5).powi(2)).exp();
        let (front, width) = (0.008 * step as f64, 2e-3 + 4e-4 * step as f64);
        let von_mises: Vec<f64> = (mesh.centres.iter())
            .map(|c| {
                let d = (WALL - c[0]).hypot(c[1]);
                let lobe = ((WALL - c[0] - 0.002) / 3e-3).powi(2) + (c[1] / 4e-3).powi(2);
                peak * ((-lobe).exp() + 0.15 * (-((d - front) / width).powi(2)).exp())
            })
            .collect();
        let zero = vec![0.0; mesh.quads.len()];
        let values = [
            vec![0.0; 3 * mesh.quads.len()],
            von_mises.iter().map(|s| -s).collect(),
            zero.clone(),
            zero.clone(),
            zero,
            von_mises.clone(),
            von_mises.iter().map(|s| s - 2.5e8).collect(),
            mesh.levels.clone(),
        ];
        append(&mut writer, 1e-5 * step as f64, &mesh, 0, &values, "solid, 65536 cells")?;
    }
    Ok(())
}

fn append(
    writer: &mut SeriesWriter,
    time: f64,
    mesh: &Mesh,
    mesh_id: u64,
    values: &[Vec<f64>],
    what: &str,
) -> Result<(), OutputError> {
    let slices: Vec<&[f64]> = values.iter().map(|field| &field[..]).collect();
    let start = Instant::now();
    let cells = OwnedQuadMesh { points: mesh.points.clone(), quads: mesh.quads.clone() };
    writer.append(time, &cells, mesh_id.max(1), &slices)?;
    eprintln!("{what}: snapshot in {:.1} ms", 1e3 * start.elapsed().as_secs_f64());
    Ok(())
}

fn write_history(directory: &RunDirectory) -> Result<(), OutputError> {
    let mut history = HistoryFile::create(&directory.file(FLUID_HISTORY), &[])?;
    let names: Vec<String> = (0..40).map(|number| format!("probes/{number}/pressure")).collect();
    let column = |name, width| Column { name, unit: "Pa", description: "made up", width };
    let columns: Vec<Column<'_>> = names.iter().map(|name| column(name.as_str(), 1)).collect();
    let steps = history.add_series("", &columns)?;
    let interface = history.add_series("interface", &[column("time", 1), column("pressure", 256)])?;
    for _ in 0..8 {
        for step in 0..1000 {
            history.push(steps, &[1.0; 40])?;
            if step % 5 == 0 {
                history.push(interface, &[1.0; 257])?;
            }
        }
        let start = Instant::now();
        history.flush()?;
        let length = std::fs::metadata(directory.file(FLUID_HISTORY)).map_or(0, |file| file.len());
        eprintln!(
            "history of {:.1} MB: batch in {:.1} ms",
            1e-6 * length as f64,
            1e3 * start.elapsed().as_secs_f64()
        );
    }
    Ok(())
}
