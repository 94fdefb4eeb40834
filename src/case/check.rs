//! `cav check` and `cav materials`: what a case means in cells, steps, memory and time, before it is run.

mod bubble;
mod terms;

use std::fmt::Write as _;

use coupler::Scheme;
use fluid::{Boundary, NearWall, Phase, PhaseState, RayleighField, Shape};
use mesh::{Adaptation, BLOCK, Domain, Geometry, Side};
use solid::Material;

use super::format::{duration, hex, mebibytes, plain, si};
use super::materials::law_in_words;
use super::memory::{Memory, available_memory};
use super::run_time::{self, guessed_share};
use super::scales::RAYLEIGH_FACTOR;
use super::steps::first_steps;
use super::warnings::SAFE_CFL;
use super::{Case, FluidCase, GridCase, SolidCase};

/// What a case means: cells, memory, time steps, collapse time, impedances, run time, warnings.
pub fn report(case: &Case) -> String {
    let mut text = String::new();
    let geometry = match case.geometry {
        Geometry::Axisymmetric => "axisymmetric",
        Geometry::Planar => "planar",
    };
    let until = if case.time.settles { "until the surface is still, at most to" } else { "to" };
    line(&mut text, "case", &format!("{}, {geometry}, {until} {}", case.name, si(case.time.end, "s")));
    line(&mut text, "hash", &hex(&case.hash()));
    if let (Some(fluid), Some(memory)) = (&case.fluid, case.fluid_memory()) {
        side(&mut text, "fluid", &fluid.grid, memory);
        if let Some(adaptive) = &fluid.grid.adaptation {
            let pressure = (fluid.wave_epsilon, fluid.scale_pressure, "Pa");
            let density = (adaptive.epsilon, fluid.scale_density, "kg/m3");
            adaptation(&mut text, adaptive, &[pressure, density]);
            near_wall(&mut text, &fluid.near_wall);
        }
        regions(&mut text, case, fluid);
        bubble::bubble(&mut text, fluid);
        sides(&mut text, fluid);
        terms::terms(&mut text, fluid);
    }
    if let (Some(solid), Some(memory)) = (&case.solid, case.solid_memory()) {
        side(&mut text, "solid", &solid.grid, memory);
        if let Some(adaptive) = &solid.grid.adaptation {
            adaptation(&mut text, adaptive, &[(adaptive.epsilon, solid.scale_stress, "Pa")]);
        }
        material(&mut text, &solid.material);
        if let Some(law) = &solid.plasticity {
            line(&mut text, "yields by", &law_in_words(law));
        }
    }
    if let (Some(fluid), Some(solid)) = (&case.fluid, &case.solid) {
        impedances(&mut text, fluid, solid);
    }
    if let Some(region) = case.region_of_interest() {
        let [z, r] = region.centre.map(|at| si(at, "m"));
        let radius = si(region.radius, "m");
        let about = format!("within {radius} of ({z}, {r}); beyond, grids follow what runs towards it");
        line(&mut text, "answer", &about);
    }
    steps(&mut text, case);
    let mut warnings = case.warnings();
    warnings.extend(memory_warning(case));
    for warning in &warnings {
        line(&mut text, "warning", warning);
    }
    text
}

fn line(text: &mut String, label: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{label:<14}{value}");
}

/// The cells of a side and their memory.
fn side(text: &mut String, name: &str, grid: &GridCase, memory: Memory) {
    let ([cells_z, cells_r], [blocks_z, blocks_r], [h_z, h_r]) =
        (grid.finest(), grid.blocks(), grid.cell_size());
    let (count, size) = (grid.cell_count(), format!("{} x {}", si(h_z, "m"), si(h_r, "m")));
    if grid.adaptation.is_none() {
        let cells = format!(
            "{cells_z} x {cells_r} = {count} cells of {size}, {} blocks of {BLOCK} x {BLOCK}, about {}",
            blocks_z * blocks_r,
            mebibytes(memory.most)
        );
        return line(text, name, &cells);
    }
    let roots = grid.root_level();
    let [coarse_z, coarse_r] = grid.cells_on(roots);
    let cells = format!(
        "adaptive, level {roots} to {}: {coarse_z} x {coarse_r} to {cells_z} x {cells_r} cells of {size}, \
         blocks of {BLOCK} x {BLOCK}",
        grid.levels
    );
    line(text, name, &cells);
    let bounds = format!(
        "{count} cells and {} if all cells were on the finest level; {:.0} % of them are a guess: {}",
        mebibytes(memory.most),
        100.0 * guessed_share(grid),
        mebibytes(guessed_memory(memory, grid))
    );
    line(text, "  at most", &bounds);
}

/// The thresholds of an adaptive grid: ε times each reference value.
///
/// - `scales`: ε, reference value, its unit.
fn adaptation(text: &mut String, adaptation: &Adaptation, scales: &[(f64, f64, &str)]) {
    let thresholds: Vec<String> = (scales.iter())
        .map(|(epsilon, scale, unit)| {
            let [scaled, whole] = [epsilon * scale, *scale]
                .map(|value| if *unit == "Pa" { si(value, unit) } else { plain(value, unit) });
            format!("{scaled} ({epsilon:?} of {whole})")
        })
        .collect();
    let numbers = format!(
        "thresholds on the finest level {}, halved with each coarser one; every {} steps",
        thresholds.join(", "),
        adaptation.every
    );
    line(text, "  adaptation", &numbers);
}

/// How far the grid rises next to the wall.
fn near_wall(text: &mut String, near: &NearWall) {
    let NearWall { shock_levels, film_levels, film_cells, .. } = near;
    let mut parts = Vec::new();
    if *shock_levels > 0 {
        parts.push(format!("{shock_levels} where a shock is about to hit it"));
    }
    if *film_levels > 0 {
        parts.push(format!("{film_levels} where a film below gas has fewer than {film_cells} cells"));
    }
    if !parts.is_empty() {
        line(text, "  at the wall", &format!("more levels: {}", parts.join(", ")));
    }
}

fn regions(text: &mut String, case: &Case, fluid: &FluidCase) {
    let [h_z, h_r] = fluid.grid.cell_size();
    let level = if fluid.grid.adaptation.is_some() { " at the finest level" } else { "" };
    for (number, region) in fluid.initial.regions.iter().enumerate() {
        let Shape::Sphere { centre, radius } = region.shape else { continue };
        let mut parts =
            vec![format!("R = {}, {:.1} cells per radius{level}", si(radius, "m"), radius / h_z.max(h_r))];
        if case.coupling.scheme != Scheme::None {
            let distance = centre[0] - fluid.grid.z[0];
            parts.push(format!("stand-off d/R = {:.3}", distance / radius));
        }
        // A cylinder's collapse has no time of its own: it depends on how far away the sides are.
        let is_sphere = case.geometry == Geometry::Axisymmetric;
        if let Some(time) =
            rayleigh_time(&fluid.ambient_at(centre[0]), &region.state, radius).filter(|_| is_sphere)
        {
            parts.push(format!("Rayleigh collapse time {}", si(time, "s")));
        }
        line(text, &format!("region {number}"), &parts.join(", "));
    }
    // The case was read, so it has the field that it asks for.
    let z_min = fluid.grid.z[0];
    let domain = Domain { geometry: case.geometry, z: fluid.grid.z, r: fluid.grid.r };
    let field = RayleighField::of(&fluid.initial, fluid.gravity, &domain, fluid.boundary);
    if let Ok(Some(field)) = field {
        let numbers = format!(
            "rayleigh, {} at z_min on the axis, on the bubbles that of the gas to {:.0e}{}",
            si(field.pressure([z_min, 0.0]), "Pa"),
            field.error(),
            if field.has_reservoirs() { ", on open sides the ambient one" } else { "" }
        );
        line(text, "pressure", &numbers);
    }
    for (number, pulse) in fluid.initial.pulses.iter().enumerate() {
        let cells =
            format!("a = {}, {:.1} cells per width{level}", si(pulse.width, "m"), pulse.width / h_z.max(h_r));
        line(text, &format!("pulse {number}"), &cells);
    }
}

/// What bounds the fluid.
fn sides(text: &mut String, fluid: &FluidCase) {
    let name = |kind: Boundary| match kind {
        Boundary::Axis => "axis",
        Boundary::Interface => "interface",
        other => other.name(),
    };
    let sides = Side::NAMES.map(|(key, side)| format!("{key} {}", name(fluid.boundary[side as usize])));
    line(text, "  sides", &sides.join(", "));
}

/// 0.91468 R √(ρ/(p∞ − p_gas)) of a gas bubble in a liquid of higher pressure, s.
fn rayleigh_time(ambient: &PhaseState, bubble: &PhaseState, radius: f64) -> Option<f64> {
    let driving = ambient.pressure - bubble.pressure;
    let collapses = ambient.phase == Phase::Liquid && bubble.phase == Phase::Gas && driving > 0.0;
    collapses.then(|| RAYLEIGH_FACTOR * radius * (ambient.density / driving).sqrt())
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
    let z_fluid = ambient.density * fluid.eos(ambient).sound_speed(ambient.density, ambient.pressure);
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

/// The steps that both sides make if each keeps within its limit: the longer one is divided into equal parts.
fn within(limits: [Option<f64>; 2]) -> [Option<f64>; 2] {
    let [Some(fluid), Some(solid)] = limits else { return limits };
    let longest = fluid.max(solid);
    [fluid, solid].map(|own| Some(longest / mesh::steps_in(longest, own)))
}

fn steps(text: &mut String, case: &Case) {
    let [fluid, solid] = first_steps(case).map(|side| side.map(|first| first.length));
    // Each side keeps its own step, as far as the other can follow.
    let ratio = f64::from(case.coupling.step_ratio);
    let beside = |own: Option<f64>, other: Option<f64>| {
        own.map(|own| other.map_or(own, |other| own.min(ratio * other)))
    };
    let [fluid, solid] = within([beside(fluid, solid), beside(solid, fluid)]);
    match (fluid, solid) {
        (Some(fluid), Some(solid)) => {
            let longer = if fluid >= solid { "fluid" } else { "solid" };
            let words = match (fluid.max(solid) / fluid.min(solid)).round() {
                1.0 => "the same".to_owned(),
                most => format!("{most:.0} in one of the {longer}'s"),
            };
            line(text, "time step", &format!("fluid {}, solid {}: {words}", si(fluid, "s"), si(solid, "s")));
        }
        (Some(step), None) => line(text, "time step", &format!("fluid {}", si(step, "s"))),
        (None, Some(step)) => line(text, "time step", &format!("solid {}", si(step, "s"))),
        (None, None) => return,
    }
    line(
        text,
        "cfl",
        &format!(
            "{:?}; the unsplit step adds both directions, and their Courant numbers stay below one together: \
             {SAFE_CFL} each with square cells",
            case.time.cfl
        ),
    );
    let count = |step: Option<f64>| step.map_or(0.0, |step| (case.time.end / step).ceil());
    let most = count(fluid).max(count(solid));
    line(text, "steps", &format!("about {most:.0} of the first one's size; a collapse shortens them"));
    let [most, guess] = run_time::estimate(case, [count(fluid), count(solid)]).map(duration);
    let assumed = format!("with {:.0} threads, release build", run_time::THREADS);
    let adapts = |grid: Option<&GridCase>| grid.is_some_and(|grid| grid.adaptation.is_some());
    if case.fluid.as_ref().and_then(|fluid| fluid.bubble?.cells_per_radius).is_some() {
        let words = "no estimate: the grid follows the bubble, and its cells and steps grow with it";
        line(text, "run time", words);
    } else if adapts(case.fluid.as_ref().map(|side| &side.grid))
        || adapts(case.solid.as_ref().map(|side| &side.grid))
    {
        let words = format!("{most} if all cells were on the finest level; a guess: {guess}");
        line(text, "run time", &format!("{words}; {assumed}"));
    } else {
        line(text, "run time", &format!("about {most} {assumed}"));
    }
    line(text, "snapshots", &case.time.snapshots.len().to_string());
}

/// The memory that a side is expected to take: of a uniform grid all, of an adaptive one a guess.
fn guessed_memory(memory: Memory, grid: &GridCase) -> f64 {
    memory.at_start.max(guessed_share(grid) * memory.most)
}

fn memory_warning(case: &Case) -> Option<String> {
    let sides = [
        case.fluid_memory().zip(case.fluid.as_ref().map(|side| &side.grid)),
        case.solid_memory().zip(case.solid.as_ref().map(|side| &side.grid)),
    ];
    let needed: f64 = sides.into_iter().flatten().map(|(memory, grid)| guessed_memory(memory, grid)).sum();
    let available = available_memory()?;
    (needed > available).then(|| {
        format!(
            "the run needs about {}, but {} of memory are available; lower `levels`",
            mebibytes(needed),
            mebibytes(available)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use fluid::StiffenedGas;

    #[test]
    fn the_papers_bubble_collapses_in_four_microseconds() {
        let liquid = PhaseState { phase: Phase::Liquid, density: 1000.0, pressure: 5e7, velocity: [0.0; 2] };
        let gas = PhaseState { phase: Phase::Gas, density: 0.0266, pressure: 2118.0, velocity: [0.0; 2] };
        let time = rayleigh_time(&liquid, &gas, 1e-3).expect("it collapses");
        assert!((time - 4.09e-6).abs() < 0.01e-6, "{time}");
        assert!(rayleigh_time(&gas, &liquid, 1e-3).is_none());
        let c = StiffenedGas { gamma: 7.15, pi: 3e8 }.sound_speed(1000.0, 5e7);
        assert!((c - 1581.929).abs() < 1e-3, "{c}");
    }
}
