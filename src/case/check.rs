//! `cav check` and `cav materials`: what a case means in cells, steps, memory and time, before it is run.

use std::fmt::Write as _;

use coupler::Scheme;
use fluid::{Phase, PhaseState, PulseShape, Shape, StiffenedGas};
use mesh::{BLOCK, Geometry};
use solid::Material;

use super::warnings::SAFE_CFL;
use super::{Case, FluidCase, GridCase, SolidCase};

/// Wall time per cell and step of the fluid on one core, ns: an estimate for the release build.
const FLUID_NS: f64 = 60.0;
/// The same of the solid.
const SOLID_NS: f64 = 30.0;
/// Threads the estimate of the run time assumes.
const THREADS: f64 = 2.0;
/// Numbers kept per cell: 5 fields, two copies of each, their slopes in two directions and rates.
const FLUID_NUMBERS: f64 = 30.0;
/// The same with the solid's 6 fields.
const SOLID_NUMBERS: f64 = 36.0;
/// Layers of ghost cells about a block.
const GHOSTS: f64 = 2.0;
/// Rayleigh's collapse time over R √(ρ/Δp): 0.91468… (Rayleigh 1917).
const RAYLEIGH: f64 = 0.915;

/// What a case means: cells, memory, time steps, collapse time, impedances, run time, warnings.
pub fn report(case: &Case) -> String {
    let mut text = String::new();
    let geometry = match case.geometry {
        Geometry::Axisymmetric => "axisymmetric",
        Geometry::Planar => "planar",
    };
    line(&mut text, "case", &format!("{}, {geometry}, to {}", case.name, si(case.time.end, "s")));
    line(&mut text, "hash", &hex(&case.hash()));
    if let Some(fluid) = &case.fluid {
        side(&mut text, "fluid", &fluid.grid, memory(&fluid.grid, FLUID_NUMBERS));
        regions(&mut text, case, fluid);
    }
    if let Some(solid) = &case.solid {
        side(&mut text, "solid", &solid.grid, memory(&solid.grid, SOLID_NUMBERS));
        material(&mut text, &solid.material);
    }
    if let (Some(fluid), Some(solid)) = (&case.fluid, &case.solid) {
        impedances(&mut text, fluid, solid);
    }
    steps(&mut text, case);
    let mut warnings = case.warnings();
    warnings.extend(memory_warning(case));
    for warning in &warnings {
        line(&mut text, "warning", warning);
    }
    text
}

/// The materials known by name.
pub fn materials_table() -> String {
    let mut text = format!(
        "{:<18}{:>9}{:>7}{:>7}{:>9}{:>9}{:>9}  source\n{:<18}{:>9}{:>7}{:>7}{:>9}{:>9}{:>9}\n",
        "name",
        "density",
        "c1",
        "c2",
        "young",
        "poisson",
        "yield",
        "",
        "kg/m3",
        "m/s",
        "m/s",
        "GPa",
        "1",
        "MPa"
    );
    for material in Material::library() {
        let strength = material.yield_strength().map_or("-".to_owned(), |y| format!("{:.0}", y / 1e6));
        let _ = writeln!(
            text,
            "{:<18}{:>9.0}{:>7.0}{:>7.0}{:>9.4}{:>9.4}{:>9}  {}",
            material.name(),
            material.density(),
            material.c1(),
            material.c2(),
            material.young() / 1e9,
            material.poisson(),
            strength,
            material.source()
        );
    }
    text
}

fn line(text: &mut String, label: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{label:<14}{value}");
}

fn side(text: &mut String, name: &str, grid: &GridCase, bytes: f64) {
    let ([cells_z, cells_r], [blocks_z, blocks_r], [h_z, h_r]) =
        (grid.finest(), grid.blocks(), grid.cell_size());
    let cells = format!(
        "{cells_z} x {cells_r} = {} cells of {} x {}, {} blocks of {BLOCK} x {BLOCK}, about {}",
        grid.cell_count(),
        si(h_z, "m"),
        si(h_r, "m"),
        blocks_z * blocks_r,
        mebibytes(bytes)
    );
    line(text, name, &cells);
}

fn regions(text: &mut String, case: &Case, fluid: &FluidCase) {
    let [h_z, h_r] = fluid.grid.cell_size();
    let ambient = &fluid.initial.ambient;
    for (number, region) in fluid.initial.regions.iter().enumerate() {
        let Shape::Sphere { centre, radius } = region.shape else { continue };
        let mut parts =
            vec![format!("R = {}, {:.1} cells per radius", si(radius, "m"), radius / h_z.max(h_r))];
        if case.coupling.scheme != Scheme::None {
            let distance = centre[0] - fluid.grid.z[0];
            parts.push(format!("stand-off d/R = {:.3}", distance / radius));
        }
        if let Some(time) = rayleigh_time(ambient, &region.state, radius) {
            parts.push(format!("Rayleigh collapse time {}", si(time, "s")));
        }
        line(text, &format!("region {number}"), &parts.join(", "));
    }
    for (number, pulse) in fluid.initial.pulses.iter().enumerate() {
        let cells =
            format!("a = {}, {:.1} cells per width", si(pulse.width, "m"), pulse.width / h_z.max(h_r));
        line(text, &format!("pulse {number}"), &cells);
    }
}

/// 0.915 R √(ρ/(p∞ − p_gas)) of a gas bubble in a liquid of higher pressure, s.
fn rayleigh_time(ambient: &PhaseState, bubble: &PhaseState, radius: f64) -> Option<f64> {
    let driving = ambient.pressure - bubble.pressure;
    let collapses = ambient.phase == Phase::Liquid && bubble.phase == Phase::Gas && driving > 0.0;
    collapses.then(|| RAYLEIGH * radius * (ambient.density / driving).sqrt())
}

fn material(text: &mut String, material: &Material) {
    let strength = material.yield_strength().map_or("none".to_owned(), |y| si(y, "Pa"));
    let numbers = format!(
        "{}: density {:?} kg/m3, c1 = {:.1} m/s, c2 = {:.1} m/s, E = {}, nu = {:.4}, yield strength {strength}",
        material.name(),
        material.density(),
        material.c1(),
        material.c2(),
        si(material.young(), "Pa"),
        material.poisson()
    );
    line(text, "material", &numbers);
}

fn impedances(text: &mut String, fluid: &FluidCase, solid: &SolidCase) {
    let ambient = &fluid.initial.ambient;
    let z_fluid = ambient.density * sound_speed(fluid.eos(ambient), ambient.density, ambient.pressure);
    let z_solid = solid.material.impedance_p();
    let reflection = (z_solid - z_fluid) / (z_solid + z_fluid);
    let numbers = format!(
        "fluid {}, solid {}: normal reflection coefficient of pressure {reflection:.6}, transmission {:.6}",
        si(z_fluid, "Pa s/m"),
        si(z_solid, "Pa s/m"),
        1.0 + reflection
    );
    line(text, "impedance", &numbers);
}

/// c = √(γ(p + π)/ρ).
fn sound_speed(eos: StiffenedGas, density: f64, pressure: f64) -> f64 {
    (eos.gamma * (pressure + eos.pi) / density).sqrt()
}

/// The fluid's step at t = 0, s: cfl · min over cells of min(h_z/(|v_z| + c), h_r/(|v_r| + c)).
fn fluid_step(fluid: &FluidCase, cfl: f64) -> f64 {
    let [h_z, h_r] = fluid.grid.cell_size();
    let limit = |state: &PhaseState| {
        let c = sound_speed(fluid.eos(state), state.density, state.pressure);
        (h_z / (state.velocity[0].abs() + c)).min(h_r / (state.velocity[1].abs() + c))
    };
    let initial = &fluid.initial;
    let mut step = limit(&initial.ambient);
    for region in &initial.regions {
        step = step.min(limit(&region.state));
    }
    // At a pulse's crest the liquid is compressed along its isentrope, (p + π)/ρ^γ = const.
    for pulse in initial.pulses.iter().filter(|pulse| pulse.amplitude > 0.0) {
        let eos = fluid.eos(&initial.ambient);
        let (density, pressure) = (initial.ambient.density, initial.ambient.pressure);
        let crest = pressure + pulse.amplitude;
        let compressed = density * ((crest + eos.pi) / (pressure + eos.pi)).powf(1.0 / eos.gamma);
        let mut state = PhaseState { density: compressed, pressure: crest, ..initial.ambient };
        if let PulseShape::Plane { direction: Some([z, r]) } = pulse.shape {
            let v = pulse.amplitude / (density * sound_speed(eos, density, pressure));
            state.velocity[0] += v * z;
            state.velocity[1] += v * r;
        }
        step = step.min(limit(&state));
    }
    cfl * step
}

/// The solid's step, s: cfl · h/c₁.
fn solid_step(solid: &SolidCase, cfl: f64) -> f64 {
    let [h_z, h_r] = solid.grid.cell_size();
    cfl * h_z.min(h_r) / solid.material.c1()
}

fn steps(text: &mut String, case: &Case) {
    let fluid = case.fluid.as_ref().map(|fluid| fluid_step(fluid, case.time.cfl));
    let solid = case.solid.as_ref().map(|solid| solid_step(solid, case.time.cfl));
    let (step, limiting) = match (fluid, solid) {
        (Some(fluid), Some(solid)) if solid < fluid => (solid, "the solid limits"),
        (Some(fluid), Some(_)) => (fluid, "the fluid limits"),
        (Some(fluid), None) => (fluid, "fluid"),
        (None, Some(solid)) => (solid, "solid"),
        (None, None) => return,
    };
    if let (Some(fluid), Some(solid)) = (fluid, solid) {
        line(text, "time step", &format!("fluid {}, solid {}: {limiting}", si(fluid, "s"), si(solid, "s")));
    } else {
        line(text, "time step", &format!("{limiting} {}", si(step, "s")));
    }
    line(
        text,
        "cfl",
        &format!(
            "{:?}, no further factor; the unsplit step adds both directions, so up to {SAFE_CFL} is safe",
            case.time.cfl
        ),
    );
    let count = (case.time.end / step).ceil();
    let cells = |grid: Option<&GridCase>| grid.map_or(0.0, |grid| grid.cell_count() as f64);
    let per_step = cells(case.fluid.as_ref().map(|side| &side.grid)) * FLUID_NS
        + cells(case.solid.as_ref().map(|side| &side.grid)) * SOLID_NS;
    let seconds = count * per_step * 1e-9 / THREADS;
    line(text, "steps", &format!("about {count:.0} of the first one's size; a collapse shortens them"));
    line(
        text,
        "run time",
        &format!("about {} with {THREADS:.0} threads, release build, output aside", duration(seconds)),
    );
    line(text, "snapshots", &case.time.snapshots.len().to_string());
}

/// Bytes for the fields of a side.
fn memory(grid: &GridCase, numbers: f64) -> f64 {
    let block = BLOCK as f64;
    let with_ghosts = ((block + 2.0 * GHOSTS) / block).powi(2);
    grid.cell_count() as f64 * with_ghosts * numbers * 8.0
}

fn memory_warning(case: &Case) -> Option<String> {
    let needed = case.fluid.as_ref().map_or(0.0, |side| memory(&side.grid, FLUID_NUMBERS))
        + case.solid.as_ref().map_or(0.0, |side| memory(&side.grid, SOLID_NUMBERS));
    let available = available_memory()?;
    (needed > available).then(|| {
        format!(
            "the fields need about {}, but {} of memory are available; lower `levels`",
            mebibytes(needed),
            mebibytes(available)
        )
    })
}

/// What the kernel says is available, bytes; unknown on systems that do not say.
fn available_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let row = text.lines().find_map(|row| row.strip_prefix("MemAvailable:"))?;
    row.trim().strip_suffix("kB")?.trim().parse::<f64>().ok().map(|kib| kib * 1024.0)
}

fn mebibytes(bytes: f64) -> String {
    let mebi = bytes / f64::from(1 << 20);
    if mebi < 10_000.0 { format!("{mebi:.0} MiB") } else { format!("{:.0} GiB", mebi / 1024.0) }
}

fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s if s < 100.0 * 3600.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86400.0),
    }
}

/// A value with a prefix: `65.7 us`, `250 MPa`.
fn si(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 8] =
        [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n"), (1e-12, "p")];
    let (scale, prefix) = PREFIXES
        .into_iter()
        .find(|(scale, _)| value.abs() >= *scale * 0.99995)
        .unwrap_or(if value == 0.0 { (1.0, "") } else { (1e-12, "p") });
    let scaled = value / scale;
    let digits = if scaled.abs() < 10.0 {
        3
    } else if scaled.abs() < 100.0 {
        2
    } else {
        1
    };
    let number = format!("{scaled:.digits$}");
    let number = number.trim_end_matches('0').trim_end_matches('.');
    format!("{number} {prefix}{unit}")
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes() {
        assert_eq!(si(65.7e-6, "s"), "65.7 us");
        assert_eq!(si(250e6, "Pa"), "250 MPa");
        assert_eq!(si(1e-3, "m"), "1 mm");
        assert_eq!(si(195.3125e-6, "m"), "195.3 um");
        assert_eq!(si(0.0, "m"), "0 m");
        assert_eq!(duration(30.0), "30 s");
        assert_eq!(duration(3600.0 * 5.0), "5.0 h");
    }

    #[test]
    fn the_papers_bubble_collapses_in_four_microseconds() {
        let liquid = PhaseState { phase: Phase::Liquid, density: 1000.0, pressure: 5e7, velocity: [0.0; 2] };
        let gas = PhaseState { phase: Phase::Gas, density: 0.0266, pressure: 2118.0, velocity: [0.0; 2] };
        let time = rayleigh_time(&liquid, &gas, 1e-3).expect("it collapses");
        assert!((time - 4.09e-6).abs() < 0.01e-6, "{time}");
        assert!(rayleigh_time(&gas, &liquid, 1e-3).is_none());
        let c = sound_speed(StiffenedGas { gamma: 7.15, pi: 3e8 }, 1000.0, 5e7);
        assert!((c - 1581.929).abs() < 1e-3, "{c}");
    }
}
