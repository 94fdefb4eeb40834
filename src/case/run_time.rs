//! How long a run is expected to take: cells, steps, laws and output by what they cost (docs/performance/index.md).

use solid::plasticity::Hardening;

use super::{Case, FluidCase, GridCase, SolidCase};

/// Processor time per cell and step of the fluid, ns; docs/performance/two-phase.md.
const FLUID: f64 = 60.0;
/// By how much the exact Riemann solver makes it longer; docs/performance/kernels.md.
const EXACT: f64 = 3.0;
/// What the fluid's terms and laws add to it, ns; docs/performance/two-phase.md.
const MORE: Additions = Additions {
    covolume: 15.0,
    surface_tension: 50.0,
    viscosity: 60.0,
    conduction: 45.0,
    phase_change: 50.0,
    tracer: 25.0,
};
/// The same of a solid, ns.
const SOLID: SolidCost = SolidCost { elastic: 30.0, yields: 42.0, with_rate_or_heat: 84.0 };
/// Per cell in a snapshot, ns.
const SNAPSHOT: f64 = 2800.0;
/// Per face of the interface and row of its history, ns.
const ROW: f64 = 800.0;
/// The share of the finest grid's N cells that an adaptive one is guessed to have, a N^b and at most all: 88, 60 and 39 % of 128², 256²
/// and 512² cells, over all steps of `cases/collapse.toml` with its levels one lower, as they are, and one higher.
const GUESS: [f64; 2] = [15.0, -0.29];
/// Threads that the estimate assumes.
pub(super) const THREADS: f64 = 2.0;

/// Wall time with [`THREADS`] threads, s: all cells on the finest level, and as many as there may be.
///
/// - `steps`: of the fluid and of the solid, as many as the first one's length says.
pub(super) fn estimate(case: &Case, steps: [f64; 2]) -> [f64; 2] {
    [all_cells as fn(&GridCase) -> f64, guessed_cells].map(|cells| {
        let fluid = case.fluid.as_ref().map_or(0.0, |fluid| cells(&fluid.grid) * of_fluid(fluid) * steps[0]);
        let solid = case.solid.as_ref().map_or(0.0, |solid| cells(&solid.grid) * of_solid(solid) * steps[1]);
        let grids = [case.fluid.as_ref().map(|side| &side.grid), case.solid.as_ref().map(|side| &side.grid)];
        let kept: f64 = grids.into_iter().flatten().map(cells).sum();
        let snapshots = SNAPSHOT * kept * case.time.snapshots.len() as f64;
        1e-9 * (fluid + solid + snapshots + rows(case, steps)) / THREADS
    })
}

fn all_cells(grid: &GridCase) -> f64 {
    grid.cell_count() as f64
}

/// What a solid costs by what it does, where some of it yields.
struct SolidCost {
    elastic: f64,
    yields: f64,
    /// Where rate or heat count.
    with_rate_or_heat: f64,
}

/// What a fluid costs by what is asked for besides waves of stiffened gases.
struct Additions {
    /// Noble–Abel laws.
    covolume: f64,
    surface_tension: f64,
    viscosity: f64,
    conduction: f64,
    phase_change: f64,
    /// A passive tracer.
    tracer: f64,
}

fn of_fluid(fluid: &FluidCase) -> f64 {
    let waves = match fluid.riemann {
        fluid::RiemannSolver::Hllc | fluid::RiemannSolver::HllcLowMach => FLUID,
        fluid::RiemannSolver::Exact => EXACT * FLUID,
    };
    let terms = &fluid.terms;
    let asked = [
        (fluid.liquid.covolume + fluid.gas.covolume > 0.0, MORE.covolume),
        (terms.surface_tension.is_some(), MORE.surface_tension),
        (terms.viscosity.is_some(), MORE.viscosity),
        (terms.conduction.is_some(), MORE.conduction),
        (terms.phase_change.is_some(), MORE.phase_change),
        (fluid.tracer.is_some(), MORE.tracer),
    ];
    let more: f64 = asked.into_iter().filter_map(|(is_asked, cost)| is_asked.then_some(cost)).sum();
    waves + more
}

fn of_solid(solid: &SolidCase) -> f64 {
    match &solid.plasticity {
        None => SOLID.elastic,
        Some(Hardening::JohnsonCook(_)) => SOLID.with_rate_or_heat,
        Some(_) => SOLID.yields,
    }
}

/// Cells that a grid is expected to have: all of a uniform one, of an adaptive one a guess.
fn guessed_cells(grid: &GridCase) -> f64 {
    guessed_share(grid) * grid.cell_count() as f64
}

/// The share of a grid's finest cells that it is expected to have.
pub(super) fn guessed_share(grid: &GridCase) -> f64 {
    let [factor, exponent] = GUESS;
    let adapted = (factor * (grid.cell_count() as f64).powf(exponent)).min(1.0);
    if grid.adaptation.is_some() { adapted } else { 1.0 }
}

/// What the interface's history takes, ns.
fn rows(case: &Case, [of_fluid, of_solid]: [f64; 2]) -> f64 {
    let grid = case.fluid.as_ref().map(|side| &side.grid).or(case.solid.as_ref().map(|side| &side.grid));
    let faces = grid.map_or(0, |grid| case.output.interface_cells.unwrap_or(grid.finest()[1]));
    let steps = if case.fluid.is_some() { of_fluid } else { of_solid };
    ROW * faces as f64 * steps.min(case.time.end / case.interface_every())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Aluminium under a load, 128 x 128 cells and 1000 steps, with a change and more tables.
    fn of(set: &str, more: &str) -> f64 {
        let text = format!(
            "[time]\nend = 1e-5\nsnapshots = []\n[solid]\nz = [-0.01, 0.0]\nr = [0.0, 0.01]\ncells = [128, 128]\nlevels = 0\n\
             adapt = false\nmaterial = \"al-6061-t6\"\n[coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = 1e8\n\
             radius = 1e-3\nhistory = [[0.0, 0.0], [1e-6, 1.0]]\n[output]\ninterface_every = 1e-6\n{more}"
        );
        let case = Case::from_toml(&text, "estimated", &[set.to_owned()])
            .unwrap_or_else(|errors| panic!("{errors}"));
        estimate(&case, [0.0, 1000.0])[0]
    }

    #[test]
    fn what_yields_and_what_is_written_takes_longer() {
        const CELLS: f64 = 128.0 * 128.0;
        // Besides the steps there are a row each microsecond, and two snapshots.
        let besides = 0.5e-9 * (ROW * 128.0 * 10.0 + SNAPSHOT * 2.0 * CELLS);
        let stepping = |more: &str| of("time.end=1e-5", more) - besides;
        let elastic = stepping("");
        assert!((elastic / (0.5e-9 * SOLID.elastic * CELLS * 1000.0) - 1.0).abs() < 1e-9, "{elastic}");
        for (law, cost) in [("perfect", SOLID.yields), ("johnson-cook", SOLID.with_rate_or_heat)] {
            let found = stepping(&format!("[solid.plasticity]\nlaw = \"{law}\"\n")) / elastic;
            assert!((found / cost * SOLID.elastic - 1.0).abs() < 1e-9, "{law}: {found}");
        }
        let snapshots = (1..=50).map(|k| format!("{:e}", 1e-7 * f64::from(k))).collect::<Vec<_>>().join(", ");
        let written = of(&format!("time.snapshots=[{snapshots}]"), "") - elastic - besides;
        assert!((written / (0.5e-9 * SNAPSHOT * 50.0 * CELLS) - 1.0).abs() < 1e-9, "{written}");
        let rows = of("output.interface_every=1e-9", "") - elastic - besides;
        assert!((rows / (0.5e-9 * ROW * 128.0 * 990.0) - 1.0).abs() < 1e-9, "{rows}");
    }

    #[test]
    fn terms_take_their_time() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/collapse.toml");
        let of = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            let case = Case::load(&path, &sets).unwrap_or_else(|errors| panic!("{errors}"));
            of_fluid(case.fluid.as_ref().expect("a fluid"))
        };
        let laws = ["fluid.liquid={fluid=\"water-nasg\"}", "fluid.gas={fluid=\"water-vapour\"}"];
        let term = |own: &str| format!("fluid.terms={{{own}}}");
        assert_eq!(of(&[]), FLUID);
        assert_eq!(of(&["fluid.riemann=exact"]), EXACT * FLUID);
        assert_eq!(of(&laws), FLUID + MORE.covolume);
        let [viscous, tense, boils, evaporates] = [
            "viscosity={liquid=1e-3,gas=1e-5}",
            "surface_tension=0.07,viscosity={liquid=1e-3,gas=1e-5}",
            "phase_change={law=\"ptg\"}",
            "phase_change={law=\"hertz-knudsen\",accommodation=0.04},conduction={liquid=0.6,gas=0.02}",
        ]
        .map(term);
        assert_eq!(of(&[&viscous]), FLUID + MORE.viscosity);
        assert_eq!(of(&[&tense]), FLUID + MORE.viscosity + MORE.surface_tension);
        let with_laws = |term: &str| of(&[laws[0], laws[1], term]) - FLUID - MORE.covolume;
        assert_eq!(with_laws(&boils), MORE.phase_change);
        assert_eq!(with_laws(&evaporates), MORE.phase_change + MORE.conduction);
    }

    #[test]
    fn the_finer_an_adaptive_grid_the_fewer_of_its_cells_there_are() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/collapse.toml");
        for (levels, share) in [(0, 1.0), (1, 0.88), (2, 0.60), (3, 0.39)] {
            let case = Case::load(&path, &[format!("fluid.levels={levels}"), "solid.levels=0".to_owned()]);
            let case = case.unwrap_or_else(|errors| panic!("{errors}"));
            let found = guessed_share(&case.fluid.as_ref().expect("a fluid").grid);
            assert!((found / share - 1.0).abs() < 0.04, "{levels}: {found}");
        }
    }
}
