//! How long the first steps are, and whether a run of such steps can end.

use fluid::{PhaseState, PulseShape};

use super::{Case, FluidCase, GridCase, SolidCase};

/// A step shorter than this share of the run never gets to its end, or means that the solution has gone bad.
pub const SMALLEST_STEP: f64 = 1e-9;

/// The step that a side begins with.
pub(super) struct FirstStep {
    /// s.
    pub length: f64,
    /// Along z and r, m/s.
    speeds: [f64; 2],
    /// The table that sets the speeds.
    table: String,
    /// The keys that do, in it and elsewhere.
    keys: &'static str,
}

impl FirstStep {
    fn new(grid: &GridCase, cfl: f64, speeds: [f64; 2], table: String, keys: &'static str) -> Self {
        // What is no speed gives no step, not one of any length.
        let speeds = speeds.map(|speed| if speed.is_nan() { f64::INFINITY } else { speed });
        Self { length: mesh::longest_step(cfl, grid.cell_size(), speeds), speeds, table, keys }
    }
}

/// What the fluid and the solid begin with.
pub(super) fn first_steps(case: &Case) -> [Option<FirstStep>; 2] {
    [
        case.fluid.as_ref().map(|fluid| fluids(fluid, case.time.cfl)),
        case.solid.as_ref().map(|solid| solids(solid, case.time.cfl)),
    ]
}

/// The shortest step of what is in the fluid at t = 0, see [`mesh::longest_step`].
fn fluids(fluid: &FluidCase, cfl: f64) -> FirstStep {
    const KEYS: &str = "density, pressure, velocity, and gamma and pi of fluid.liquid or fluid.gas";
    let of = |state: &PhaseState, table: String| {
        let c = fluid.eos(state).sound_speed(state.density, state.pressure);
        FirstStep::new(&fluid.grid, cfl, state.velocity.map(|v| v.abs() + c), table, KEYS)
    };
    let initial = &fluid.initial;
    let mut first = of(&initial.ambient, "fluid.ambient".to_owned());
    let mut see = |other: FirstStep| {
        if !(other.length >= first.length) {
            first = other;
        }
    };
    for (number, region) in initial.regions.iter().enumerate() {
        let described = fluid.bubble.is_some_and(|bubble| bubble.region == number);
        let by = if described { " (fluid.bubble, at fluid.ambient.pressure)" } else { "" };
        see(of(&region.state, format!("fluid.region.{number}{by}")));
    }
    // At a pulse's crest, and in an inflow, the liquid is compressed along its isentrope.
    let eos = fluid.eos(&initial.ambient);
    let (density, pressure) = (initial.ambient.density, initial.ambient.pressure);
    let compressed = |crest: f64| {
        let density = eos.isentropic_density(density, pressure, crest);
        PhaseState { density, pressure: crest, ..initial.ambient }
    };
    let crests = fluid.inflow.iter().flat_map(|inflow| &inflow.pressure).map(|row| row[1]);
    if let Some(crest) = crests.reduce(f64::max).filter(|crest| *crest > pressure) {
        let keys = "pressure, and what is in fluid.ambient and fluid.liquid";
        see(FirstStep { keys, ..of(&compressed(crest), "fluid.inflow".to_owned()) });
    }
    for (number, pulse) in initial.pulses.iter().enumerate().filter(|(_, pulse)| pulse.amplitude > 0.0) {
        let mut state = compressed(pressure + pulse.amplitude);
        if let PulseShape::Plane { direction: Some([z, r]) } = pulse.shape {
            let v = pulse.amplitude / (density * eos.sound_speed(density, pressure));
            state.velocity[0] += v * z;
            state.velocity[1] += v * r;
        }
        let keys = "amplitude, and what is in fluid.ambient and fluid.liquid";
        see(FirstStep { keys, ..of(&state, format!("fluid.pulse.{number}")) });
    }
    first
}

fn solids(solid: &SolidCase, cfl: f64) -> FirstStep {
    let table = "solid.material".to_owned();
    FirstStep::new(&solid.grid, cfl, [solid.material.c1(); 2], table, "c1, or the moduli and density")
}

/// What is wrong, and the remedy, where a run of steps as the first one would not end in years.
pub(super) fn too_many(case: &Case) -> Option<(String, String)> {
    let end = case.time.end;
    let sides = [
        ("fluid", case.fluid.as_ref().map(|side| &side.grid)),
        ("solid", case.solid.as_ref().map(|side| &side.grid)),
    ];
    for (first, (side, grid)) in first_steps(case).into_iter().zip(sides) {
        let (Some(first), Some(grid)) = (first, grid) else { continue };
        if first.length > SMALLEST_STEP * end {
            continue;
        }
        let ([h_z, h_r], speed) = (grid.cell_size(), first.speeds[0].max(first.speeds[1]));
        let message = format!(
            "{end:?} s are {:.1e} steps of {:.1e} s, more than {:.0e}: the {side} has cells of {h_z:.1e} x {h_r:.1e} m, signals \
             of {speed:.1e} m/s in {}, and time.cfl = {:?}",
            end / first.length,
            first.length,
            1.0 / SMALLEST_STEP,
            first.table,
            case.time.cfl,
        );
        let help = format!(
            "end earlier, look at {} ({}), take wider cells ({side}.z, {side}.r, {side}.cells, {side}.levels) or a larger \
             time.cfl",
            first.table, first.keys
        );
        return Some((message, help));
    }
    None
}
