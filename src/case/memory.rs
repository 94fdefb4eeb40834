//! How much memory a run takes, and whether the machine has it.
//!
//! Counted is what is there at the same time at the worst moment, while a snapshot is written: fields and registers of the solver, and
//! the snapshot's values. Against measured peaks see docs/reference/cases.md.

use fluid::{InitialPressure, RayleighField};
use mesh::BLOCK;

use super::format::mebibytes;
use super::start_grid::least_cells;
use super::{Case, CaseError, CaseErrors, FluidCase, GridCase, Medium, SolidCase};

/// A process without any cells, bytes: program, libraries, threads and their scratch, histories.
const PROCESS: f64 = 32.0 * MEBI;
const MEBI: f64 = (1 << 20) as f64;
const NUMBER: f64 = size_of::<f64>() as f64;
/// Numbers a cell of what is kept block by block besides fields: reports, tree.
const OF_BLOCKS: f64 = 1.5;
/// What grows has more than it needs: rows an eighth, and what moves leaves holes behind.
const SPARE: f64 = 1.25;
/// Numbers a cell that a snapshot holds: density, pressure, two of velocity, gas fraction, |∇ρ|. The others are made when they are
/// written.
const FLUID_VALUES: f64 = 6.0;
/// The same of the solid: two of velocity, four stresses.
const SOLID_VALUES: f64 = 6.0;
/// What of a row of the interface's history is in memory, in rows: grid, last and first state, map, row, buffer, batch.
const ROWS: f64 = 11.0;

/// What a side keeps of each cell.
#[derive(Clone, Copy)]
struct Numbers {
    components: usize,
    /// Numbers that no step depends on, of which there is no second field.
    once: usize,
    /// Registered at each face between blocks.
    registered: usize,
    values: f64,
}

fn of_solid(solid: &SolidCase) -> Numbers {
    // Plastic strain, and temperature where heat matters; once the rate of the strain and two of displacement.
    let own = solid.plasticity.as_ref().map_or(0, |law| 1 + usize::from(law.softening().is_some()));
    let (once, values) = if own > 0 { (3, SOLID_VALUES + own as f64 + 3.0) } else { (0, SOLID_VALUES) };
    Numbers { components: 6 + own, once, registered: 4, values }
}

fn of_fluid(fluid: &FluidCase) -> Numbers {
    let carried = usize::from(fluid.tracer.is_some()) + usize::from(fluid.terms.phase_change.is_some());
    let values = FLUID_VALUES + carried as f64;
    Numbers { components: fluid.model.components() + carried, once: 0, registered: 8 + carried, values }
}

/// What finding the pressure at t = 0 takes at the most, bytes.
fn of_field(fluid: &FluidCase) -> f64 {
    match fluid.initial.pressure {
        InitialPressure::Uniform => 0.0,
        InitialPressure::Rayleigh => RayleighField::MOST_BYTES as f64,
    }
}

impl Numbers {
    /// Numbers a cell at the most.
    fn most(self, grid: &GridCase, local_steps: bool) -> f64 {
        let adapts = grid.adaptation.is_some();
        let fields = self.components as f64;
        let register = (4 * self.registered) as f64 / BLOCK as f64;
        // While a grid adapts they are there as they were, as they are and on the new grid.
        let once = (if adapts { 3 } else { 1 } * self.once) as f64;
        let present = 2.0 * fields + once + register + OF_BLOCKS;
        // Levels that step by themselves have means of what passed between them.
        let local = if adapts && local_steps { register } else { 0.0 };
        (present + local + self.values) * if adapts { SPARE } else { 1.0 }
    }
}

/// The memory of one side of a run, bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory {
    /// If all cells are on the finest level.
    pub most: f64,
    /// At the start, at least: of an adaptive grid what its level bounds, regions and pulses ask for.
    pub at_start: f64,
    /// What a snapshot takes, bytes a cell.
    pub per_cell_of_output: f64,
}

impl Memory {
    /// - `least_cells`: cells at the start; `rows`: bytes of a row of the interface's history.
    fn of(numbers: Numbers, grid: &GridCase, local_steps: bool, least_cells: f64, row: f64) -> Self {
        let per_cell = NUMBER * numbers.most(grid, local_steps);
        let fixed = PROCESS + ROWS * row;
        Self {
            most: fixed + per_cell * grid.cell_count() as f64,
            at_start: fixed + per_cell * least_cells,
            per_cell_of_output: NUMBER * numbers.values,
        }
    }

    /// With so much more at the most, bytes.
    fn with(self, more: f64) -> Self {
        Self { most: self.most + more, ..self }
    }
}

impl Case {
    /// The fluid's memory.
    pub fn fluid_memory(&self) -> Option<Memory> {
        let fluid = self.fluid.as_ref()?;
        let cells = self.output.interface_cells.unwrap_or(fluid.grid.finest()[1]);
        let least = least_cells(self, Medium::Fluid);
        let row = NUMBER * (1 + 3 * cells) as f64;
        Some(
            Memory::of(of_fluid(fluid), &fluid.grid, self.time.local_steps.may(), least, row)
                .with(of_field(fluid)),
        )
    }

    /// The solid's memory.
    pub fn solid_memory(&self) -> Option<Memory> {
        let solid = self.solid.as_ref()?;
        let least = least_cells(self, Medium::Solid);
        // Its initial stress carries the fluid's pressure.
        let field = self.fluid.as_ref().map_or(0.0, of_field);
        Some(Memory::of(of_solid(solid), &solid.grid, self.time.local_steps.may(), least, 0.0).with(field))
    }

    /// Whether the machine has the memory with which some sides of the case begin, the fluid's and the solid's.
    ///
    /// # Errors
    /// It has not: the key that counts most, and the remedy. Where the system does not say what it has, nothing is refused.
    pub fn fits_memory(&self, [fluid, solid]: [bool; 2]) -> Result<(), CaseErrors> {
        let Some(available) = available_memory() else { return Ok(()) };
        let sides = [
            ("fluid", self.fluid_memory().filter(|_| fluid), self.fluid.as_ref().map(|side| &side.grid)),
            ("solid", self.solid_memory().filter(|_| solid), self.solid.as_ref().map(|side| &side.grid)),
        ];
        let bytes = |memory: &Option<Memory>| memory.map_or(0.0, |memory| memory.at_start);
        let needed: f64 = sides.iter().map(|(_, memory, _)| bytes(memory)).sum();
        if needed <= available {
            return Ok(());
        }
        let largest = sides.iter().max_by(|one, other| bytes(&one.1).total_cmp(&bytes(&other.1)));
        let Some((name, _, Some(grid))) = largest else { return Ok(()) };
        let [cells_z, cells_r] = grid.finest();
        let message = format!(
            "the run begins with about {}, but {} of memory are available: the {name} has up to {cells_z} x {cells_r} cells",
            mebibytes(needed),
            mebibytes(available)
        );
        let uniform = if grid.adaptation.is_none() {
            format!(", or let the grid adapt ({name}.adapt)")
        } else {
            String::new()
        };
        let help =
            format!("lower {name}.levels or {name}.cells{uniform}; `cav check` says what the case needs");
        let fault = CaseError { path: format!("{name}.levels"), message, help: Some(help), span: None };
        Err(CaseErrors::new(&self.name, "", vec![fault]))
    }
}

/// What the kernel says is available, bytes; unknown on systems that do not say.
pub fn available_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let row = text.lines().find_map(|row| row.strip_prefix("MemAvailable:"))?;
    let machine = row.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kib| kib * 1024.0)?;
    Some(group_memory().map_or(machine, |group| machine.min(group)))
}

/// What the control group that a container is leaves, bytes; `None` where it has no limit.
fn group_memory() -> Option<f64> {
    let read = |name: &str| std::fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok();
    let number = |name: &str| read(name)?.trim().parse::<f64>().ok();
    // Pages of files that the kernel can give back count as used.
    let idle = read("memory.stat").and_then(|text| {
        text.lines().find_map(|row| row.strip_prefix("inactive_file ")?.trim().parse::<f64>().ok())
    });
    Some((number("memory.max")? - number("memory.current")? + idle.unwrap_or(0.0)).max(0.0))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::case::fixture::of_four_levels as case;

    #[test]
    fn an_adaptive_grid_begins_with_what_its_regions_and_bounds_ask_for() {
        let cells = |sets: &[&str]| least_cells(&case(sets), Medium::Fluid);
        assert_eq!(cells(&["fluid.adapt=false"]), 65536.0);
        let edge = cells(&[]);
        assert!(edge > 4096.0 && edge < 32768.0, "{edge}");
        assert_eq!(cells(&["fluid.refine=[{ shape = \"interface\", at_least = 0, at_most = 4 }]"]), edge);
        assert!(cells(&["fluid.refine=[{ shape = \"interface\", at_least = 4 }]"]) > edge);
        let all = "fluid.refine=[{ shape = \"box\", z = [0, 1], r = [0, 1], at_least = 4 }]";
        assert_eq!(cells(&[all]), 65536.0);
    }

    #[test]
    fn what_no_machine_holds_is_refused_with_key_and_remedy() {
        case(&[]).fits_memory([true; 2]).unwrap();
        let large =
            case(&["fluid.adapt=false", "fluid.levels=0", "fluid.cells=[1048576, 1048576]", "time.end=1e-9"]);
        large.fits_memory([false, true]).unwrap();
        let text = large.fits_memory([true, true]).unwrap_err().to_string();
        for part in ["fluid.levels", "1048576 x 1048576", "available", "fluid.adapt", "GiB"] {
            assert!(text.contains(part), "no {part} in {text}");
        }
    }
}
