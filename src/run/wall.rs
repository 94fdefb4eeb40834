//! What stays in a wall that was hit: left by a run, taken up by the next one (`solid.initial`).

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use coupler::Participant;
use mesh::{BLOCK, BlockId, Field};
use serde::{Deserialize, Serialize};
use solid::{ElasticState, InitialStress, SolidSetup, SolidSolver};

use crate::case::{Case, SolidCase, from_where};
use crate::output::checkpoint::{self, Head};
use crate::output::run_directory::WALL;
use crate::output::{OutputError, RunDirectory};
use crate::run::RunError;

/// The cells of a wall and how its surface lies.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Wall<'a> {
    ground: Ground,
    leaves: Cow<'a, [BlockId]>,
    cells: Cow<'a, Field>,
    /// Of the cells.
    moved: Option<Field>,
    /// (u_z, u_r) on the faces of the finest level, m.
    displacement: Vec<[f64; 2]>,
}

/// What a wall and the case that takes it up must agree upon, and the stress that it began with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Ground {
    is_axisymmetric: bool,
    z: [f64; 2],
    r: [f64; 2],
    coarsest: [usize; 2],
    /// Density (kg/m³), c₁, c₂ (m/s).
    material: [f64; 3],
    /// Ambient, Pa.
    pressure: f64,
    is_hydrostatic: bool,
    /// That of its own weight, m/s²; 0 without.
    gravity: f64,
}

impl Ground {
    fn of(case: &Case, solid: &SolidCase) -> Self {
        let material = &solid.material;
        Self {
            is_axisymmetric: case.geometry == mesh::Geometry::Axisymmetric,
            z: solid.grid.z,
            r: solid.grid.r,
            coarsest: solid.grid.cells,
            material: [material.density(), material.c1(), material.c2()],
            pressure: case.ambient_pressure(),
            is_hydrostatic: solid.initial_stress == InitialStress::Hydrostatic,
            gravity: solid.weight.map_or(0.0, |weight| weight.acceleration),
        }
    }

    /// What differs that must not, in words.
    fn differs(&self, other: &Self) -> Option<String> {
        let differs = |key: &str, own: &[f64], others: &[f64]| {
            (own != others).then(|| format!("{key} is {others:?} there and {own:?} here"))
        };
        if self.is_axisymmetric != other.is_axisymmetric {
            return Some("geometry is another one there".to_owned());
        }
        differs("solid.z", &self.z, &other.z)
            .or_else(|| differs("solid.r", &self.r, &other.r))
            .or_else(|| {
                let [own, others] = [self, other].map(|ground| ground.coarsest.map(|cells| cells as f64));
                differs("solid.cells", &own, &others)
            })
            .or_else(|| differs("solid.material (density, c1, c2)", &self.material, &other.material))
            .or_else(|| differs("solid.gravity", &[self.gravity], &[other.gravity]))
    }

    /// The stress under the ambient pressure.
    fn stress(&self) -> ElasticState {
        let across = if self.is_hydrostatic { -self.pressure } else { 0.0 };
        ElasticState {
            stress_zz: -self.pressure,
            stress_rr: across,
            stress_phiphi: across,
            ..ElasticState::default()
        }
    }
}

/// Leaves the wall of a run in its directory.
#[derive(Clone, Debug)]
pub struct WallLeaver {
    ground: Ground,
    case: [u8; 32],
}

impl WallLeaver {
    /// Of a case; `None` where nothing can stay in the wall.
    pub fn of(case: &Case) -> Option<Self> {
        let solid = case.solid.as_ref().filter(|solid| solid.plasticity.is_some())?;
        Some(Self { ground: Ground::of(case, solid), case: case.fingerprint() })
    }

    /// Writes the wall.
    pub fn leave(
        &self,
        solver: &SolidSolver<BLOCK>,
        displacement: Vec<[f64; 2]>,
        directory: &RunDirectory,
    ) -> Result<(), OutputError> {
        let wall = Wall {
            ground: self.ground.clone(),
            leaves: Cow::Borrowed(solver.mesh().tree().leaves()),
            cells: Cow::Borrowed(solver.state()),
            moved: solver.displacements(),
            displacement,
        };
        let head = Head::of(self.case, Participant::Solid.name(), solver.steps());
        checkpoint::write(&directory.file(WALL), &head, &wall)
    }
}

/// That a run does not replace the wall that it begins with.
///
/// - `directory`: the run's own.
/// - errors: [`RunError::Wall`].
pub fn keep_apart(case: &Case, directory: &Path) -> Result<(), RunError> {
    let Some(run) = case.solid.as_ref().and_then(|solid| solid.initial.as_ref()) else { return Ok(()) };
    let is_same =
        |a: &Path, b: &Path| a.canonicalize().ok().zip(b.canonicalize().ok()).is_some_and(|(a, b)| a == b);
    if is_same(run, directory) {
        return Err(fault(run, "that is the run's own directory; give another one with --out".to_owned()));
    }
    Ok(())
}

/// Whether the wall that a case begins with, if it begins with one, can be taken up.
///
/// - errors: as [`Wall::of`].
pub fn check(case: &Case) -> Result<(), RunError> {
    case.solid.as_ref().map_or(Ok(()), |solid| Wall::of(case, solid).map(|_| ()))
}

impl Wall<'static> {
    /// The wall that a case begins with, if it begins with one.
    ///
    /// - errors: [`RunError::Wall`]: there is none, or it does not belong to a wall like this case's.
    pub fn of(case: &Case, solid: &SolidCase) -> Result<Option<Self>, RunError> {
        let Some(run) = &solid.initial else { return Ok(None) };
        let wall = Self::read(run).map_err(|reason| fault(run, reason))?;
        if let Some(difference) = Ground::of(case, solid).differs(&wall.ground) {
            return Err(fault(run, format!("{difference}; a wall goes on in its own domain and material")));
        }
        let finest = wall.leaves.iter().map(|leaf| usize::from(leaf.level)).max().unwrap_or(0);
        if finest > solid.grid.levels {
            let here = solid.grid.levels;
            return Err(fault(
                run,
                format!("solid.levels is {finest} there and {here} here; take as many or more"),
            ));
        }
        Ok(Some(wall))
    }

    fn read(run: &Path) -> Result<Self, String> {
        let path = run.join(WALL);
        if !path.is_file() {
            return Err(format!(
                "there is no {WALL} in it; a run leaves one when it is finished and has [solid.plasticity]{}",
                from_where(run)
            ));
        }
        checkpoint::read(&path).map(|(_, wall)| wall).map_err(|fault| fault.to_string())
    }

    /// How its surface lies.
    pub fn displacement(&self) -> &[[f64; 2]] {
        &self.displacement
    }

    /// A solid that begins as this wall, at rest; a pressure that the new case has more is carried besides.
    ///
    /// - `pressed`: the stress of the new case under what presses on it at t = 0, at a point, without its own weight: that the wall
    ///   carries already.
    pub fn solver(
        self,
        setup: SolidSetup,
        pressed: impl Fn([f64; 2]) -> ElasticState + Sync,
    ) -> Result<SolidSolver<BLOCK>, RunError> {
        let before = self.ground.stress().to_array();
        let change = |point| {
            let now = pressed(point).to_array();
            ElasticState::from_array(std::array::from_fn(|c| now[c] - before[c]))
        };
        Ok(SolidSolver::compiled_at_rest_with(
            setup,
            self.leaves.into_owned(),
            &self.cells,
            self.moved,
            &change,
        )?)
    }
}

fn fault(run: &Path, reason: String) -> RunError {
    RunError::Wall { run: PathBuf::from(run), reason }
}
