//! The `[fluid]` table.

use coupler::Scheme;
use fluid::{
    Boundary, Gravity, InitialCondition, InitialPressure, Model, NobleAbelStiffenedGas, Phase, PhaseState,
    Pulse, Region, RiemannSolver, Shape, Sharpening, StiffenedGas,
};
use mesh::{Geometry, Limiter, Side};

use super::keys::fluid::GAS;
use super::read_bubble::{self, Described, Surroundings};
use super::read_grid::{GridPlace, grid};
use super::read_medium::{leaves_room, medium, refuse_covolumes};
use super::read_near_wall::near_wall;
use super::read_pulse::pulse;
use super::read_shape::body;
use super::read_terms::{TermsCase, terms};
use super::reader::{Faults, Given, Table};
use super::shared::{Context, boundaries, history};
use super::{
    FluidCase, GridCase, Inflow, contact, far_field, initial_pressure, read_conduction, read_phase_change,
    scales,
};

/// Equations of state as far as they could be read, and the grid likewise.
struct Setting {
    liquid: Option<NobleAbelStiffenedGas>,
    gas: Option<NobleAbelStiffenedGas>,
    grid: Option<GridCase>,
    geometry: Geometry,
    /// Gravity along z as it is given, m/s².
    gravity: Option<Given<f64>>,
}

impl Setting {
    fn eos(&self, phase: Phase) -> Option<NobleAbelStiffenedGas> {
        match phase {
            Phase::Liquid => self.liquid,
            Phase::Gas => self.gas,
        }
    }
}

pub(super) fn fluid(
    mut table: Table<'_>,
    context: Context,
    faults: &mut Faults,
) -> Option<(FluidCase, GridPlace, Option<read_conduction::Asked>)> {
    let mut placed = grid(&mut table, context, Side::ZMin, faults);
    let near_wall = near_wall(&mut table, placed.as_mut().map(|(grid, _)| grid), context, faults);
    let liquid = if table.has("liquid") {
        table.table("liquid", faults).and_then(|table| medium(table, None, faults))
    } else {
        table.table("liquid", faults);
        table.missing(
            "liquid",
            "write [fluid.liquid] and below it fluid = \"water\", or gamma and pi, for water 7.15 and 3e8",
            faults,
        );
        None
    };
    let [gamma, pi] = GAS;
    let air = StiffenedGas { gamma, pi }.into();
    let gas = match table.table("gas", faults) {
        Some(table) => medium(table, Some(air), faults),
        None => Some(air),
    };
    let mut setting = Setting {
        liquid,
        gas,
        grid: placed.as_ref().map(|(grid, _)| grid.clone()),
        geometry: context.geometry,
        gravity: table.number("gravity", faults).filter(|given| given.value != 0.0),
    };
    let acting = (table.path_of("terms"), table.place("terms").map_or(0..0, |place| place.span));
    let (mut terms, mut pending) = terms(&mut table, faults);
    let pressure = table.choice("initial_pressure", &InitialPressure::NAMES, faults);
    let (mut initial, bubble) = initial(&mut table, pressure.as_ref(), &terms, &mut setting, faults);
    if let (Some(change), Some(share), false) =
        (&mut pending.phase_change, bubble.as_ref().and_then(Described::vapour_share), pending.is_share_given)
    {
        change.value.vapour_fraction = share;
        terms.phase_change = Some(change.value);
    }
    let gravity = initial.as_ref().and_then(|initial| gravity(initial, &setting, faults));
    let tracer = table.table("tracer", faults).and_then(|table| tracer(table, &setting, faults));
    let (mut boundary, named) = sides(&mut table, context, faults);
    let gas = setting.gas;
    if let (Some(initial), Some(grid)) = (&mut initial, &setting.grid) {
        initial_pressure::check(pressure.as_ref(), (initial, gravity), grid, boundary, context, faults);
        let is_free = pressure.is_none() && bubble.as_ref().is_some_and(|bubble| bubble.is_largest);
        initial_pressure::at_rest(is_free, initial, gravity, grid, boundary, context);
        if context.scheme.is_some() {
            contact::check((&acting.0, &acting.1), &terms, initial, grid, boundary, faults);
        }
    }
    let inflow = inflow(&mut table, boundary, liquid, faults);
    if let (Some(initial), Some(grid)) = (&initial, &setting.grid) {
        let media = [liquid, gas];
        let others = (inflow.as_ref(), gravity);
        far_field::decide(&mut boundary, &named, initial, grid, media, others, context, faults);
    }
    let riemann = table.name("riemann", &RiemannSolver::NAMES, faults);
    let model = table.name("model", &Model::NAMES, faults);
    if model == Model::SaurelAbgrall {
        refuse_covolumes([("liquid", liquid), ("gas", gas)], &table, faults);
    }
    let by_default = if model == Model::SaurelAbgrall { Sharpening::None } else { Sharpening::Thinc };
    let sharpening = table.choice("interface", &Sharpening::NAMES, faults);
    if let Some(given) = sharpening.as_ref().filter(|given| given.value == Sharpening::Thinc)
        && model == Model::SaurelAbgrall
    {
        let message = "\"thinc\" needs phases with densities of their own, got model = \"saurel-abgrall\"";
        faults.of(
            given,
            message.to_owned(),
            "model = \"five-equation\" (the default), or interface = \"none\"",
        );
    }
    let limiter = table.name("limiter", &Limiter::NAMES, faults);
    let scale_pressure = table.positive("scale_pressure", faults);
    let scale_density = table.positive("scale_density", faults);
    table.finish(faults);
    let (grid, place) = placed?;
    let (liquid, gas, initial) = (liquid?, gas?, initial?);
    if let Some(asked) = &pending.conduction {
        read_conduction::refuse_mixture(asked, model, faults);
    }
    if let Some(change) = &pending.phase_change {
        read_phase_change::check(change, [liquid, gas], model, &initial, faults);
    }
    let eos = setting.eos(initial.ambient.phase)?;
    let scale_pressure = scale_pressure.unwrap_or_else(|| scales::pressure(&initial, inflow.as_ref(), eos));
    let scale_density = scale_density.unwrap_or_else(|| scales::density(&initial, scale_pressure, eos));
    let case = FluidCase {
        grid,
        liquid,
        gas,
        initial,
        boundary,
        inflow,
        riemann,
        model,
        sharpening: sharpening.map_or(by_default, |given| given.value),
        limiter,
        near_wall: fluid::NearWall { reference_pressure: scale_pressure, ..near_wall },
        scale_pressure,
        scale_density,
        wave_epsilon: super::read_adaptation::DEFAULT_ERROR,
        gravity,
        bubble: bubble.map(|bubble| bubble.case),
        terms,
        tracer,
    };
    Some((case, place, pending.conduction))
}

/// Gravity along z in a grid, at whose z_min the liquid has the ambient pressure.
fn under(acceleration: f64, grid: &GridCase) -> Gravity {
    Gravity { acceleration, level: grid.z[0] }
}

/// Gravity along z, under which the pressure of the ambient liquid is that of the case on z_min.
fn gravity(initial: &InitialCondition, setting: &Setting, faults: &mut Faults) -> Option<Gravity> {
    let given = setting.gravity.as_ref()?;
    let (ambient, grid) = (&initial.ambient, setting.grid.as_ref()?);
    let gravity = under(given.value, grid);
    if ambient.phase == Phase::Gas {
        let message = "fills the ambient liquid with a hydrostatic pressure, and the ambient phase is gas";
        faults.of(given, message, "remove it, or make the ambient phase \"liquid\"");
        return None;
    }
    // As much as the pressure that the liquid can lose, either way.
    let bearable = ambient.pressure + setting.liquid.map_or(0.0, |eos| eos.pi);
    let head = gravity.head(ambient.density, grid.z[1]);
    if head.abs() >= bearable || !head.is_finite() {
        let (g, density, z) = (given.value, ambient.density, grid.z[1]);
        let message = format!(
            "{g:?} m/s2 changes the pressure by {head:?} Pa up to fluid.z = {z:?} m, with fluid.ambient.density = {density:?} kg/m3"
        );
        let most = bearable / (density * (z - grid.z[0]));
        let bears = format!("fluid.ambient.pressure + fluid.liquid.pi = {bearable:?} Pa");
        faults.of(
            given,
            message,
            format!("the liquid bears less than {bears}: give less than {most:?} m/s2"),
        );
        return None;
    }
    Some(gravity)
}

/// Where the passive tracer is at t = 0.
fn tracer(mut table: Table<'_>, setting: &Setting, faults: &mut Faults) -> Option<Shape> {
    let shape = body(&mut table, setting.grid.as_ref(), setting.geometry, faults);
    table.finish(faults);
    shape
}

fn initial(
    table: &mut Table<'_>,
    pressure: Option<&Given<InitialPressure>>,
    terms: &TermsCase,
    setting: &mut Setting,
    faults: &mut Faults,
) -> (Option<InitialCondition>, Option<Described>) {
    let ambient = if table.has("ambient") {
        table.table("ambient", faults).and_then(|mut table| {
            let ambient = state(&mut table, Some(Phase::Liquid), setting, faults);
            table.finish(faults);
            ambient
        })
    } else {
        table.table("ambient", faults);
        table.missing("ambient", "write [fluid.ambient] with density and pressure", faults);
        None
    };
    let bubble = bubble(table, (ambient, terms), setting, faults);
    let regions: Vec<Option<Region>> =
        table.tables("region", faults).into_iter().map(|table| region(table, setting, faults)).collect();
    let pulses: Vec<Option<Pulse>> = table
        .tables("pulse", faults)
        .into_iter()
        .map(|table| pulse(table, setting.geometry, setting.liquid, ambient, faults))
        .collect();
    let described = bubble.iter().filter_map(|bubble| bubble.region).map(Some);
    let whole = || {
        Some(InitialCondition {
            ambient: ambient?,
            pressure: pressure.map_or(InitialPressure::Uniform, |given| given.value),
            regions: described.chain(regions).collect::<Option<_>>()?,
            pulses: pulses.into_iter().collect::<Option<_>>()?,
        })
    };
    let initial = whole();
    if let (Some(bubble), Some(initial)) = (&bubble, &initial) {
        read_bubble::check_region(bubble, initial, faults);
    }
    (initial, bubble)
}

/// The bubble that is described by what is in it; the gas gets the γ that it has with its vapour.
fn bubble(
    table: &mut Table<'_>,
    (ambient, terms): (Option<PhaseState>, &TermsCase),
    setting: &mut Setting,
    faults: &mut Faults,
) -> Option<Described> {
    let table = table.table("bubble", faults)?;
    let Setting { gas, grid, geometry, gravity, .. } = setting;
    let gravity = gravity.as_ref().zip(grid.as_ref()).map(|(given, grid)| under(given.value, grid));
    let around = Surroundings {
        ambient,
        gravity,
        gas: *gas,
        grid: grid.as_ref(),
        geometry: *geometry,
        surface_tension: terms.surface_tension.unwrap_or(0.0),
    };
    let described = read_bubble::bubble(table, &around, faults)?;
    if let (Some(gas), Some(gamma)) = (gas, described.gamma) {
        gas.gamma = gamma;
    }
    Some(described)
}

/// A uniform state; its pressure must be one that its phase can have.
fn state(
    table: &mut Table<'_>,
    default: Option<Phase>,
    setting: &Setting,
    faults: &mut Faults,
) -> Option<PhaseState> {
    let phase = if table.has("phase") || default.is_none() {
        if !table.has("phase") {
            table.missing("phase", "give `phase = \"gas\"` or \"liquid\"", faults);
        }
        table.choice("phase", &Phase::NAMES, faults).map(|given| given.value)
    } else {
        table.raw("phase");
        default
    };
    let density = table.required_positive("density", faults);
    let pressure = table.required("pressure", faults);
    let velocity = table.pair("velocity", faults).map_or([0.0; 2], |given| given.value);
    let pressure = pressure?;
    let eos = phase.and_then(|phase| setting.eos(phase));
    let name = if phase == Some(Phase::Gas) { "gas" } else { "liquid" };
    if let (Some(eos), Some(density)) = (eos, density)
        && !leaves_room((name, eos), density, table, faults)
    {
        return None;
    }
    if let Some(eos) = eos
        && pressure.value + eos.pi <= 0.0
    {
        let least = -eos.pi;
        let message = format!(
            "the equation of state needs p + pi > 0, got p = {:?} Pa with pi = {:?} Pa",
            pressure.value, eos.pi
        );
        faults.of(&pressure, message, format!("give a pressure above {least:?} Pa"));
        return None;
    }
    Some(PhaseState { phase: phase?, density: density?, pressure: pressure.value, velocity })
}

fn region(mut table: Table<'_>, setting: &Setting, faults: &mut Faults) -> Option<Region> {
    let state = state(&mut table, None, setting, faults);
    let shape = body(&mut table, setting.grid.as_ref(), setting.geometry, faults);
    table.finish(faults);
    Some(Region { shape: shape?, state: state? })
}

/// The sides, and the span of each that the case names. Open ones have a far field if it does not, see [`far_field::decide`].
fn sides(
    table: &mut Table<'_>,
    context: Context,
    faults: &mut Faults,
) -> ([Boundary; 4], [Option<Given<()>>; 4]) {
    let z_min = match context.scheme {
        Some(Scheme::Rigid) => Boundary::Wall,
        Some(Scheme::None | Scheme::Load) | None => Boundary::FarField,
        Some(_) => Boundary::Interface,
    };
    let r_min = match context.geometry {
        Geometry::Axisymmetric => Boundary::Axis,
        Geometry::Planar => Boundary::Wall,
    };
    let fixed = |side| match (side, context.scheme) {
        (Side::ZMin, Some(scheme)) if scheme.is_coupled() => {
            Some(("interface", "z_min of the fluid is the interface; only scheme = \"none\" leaves it free"))
        }
        (Side::ZMin, Some(Scheme::Rigid)) => {
            Some(("wall", "z_min of the fluid is the rigid wall; only scheme = \"none\" leaves it free"))
        }
        (Side::RMin, _) if context.geometry == Geometry::Axisymmetric => {
            Some(("axis", "r_min is the axis in axisymmetric geometry"))
        }
        _ => None,
    };
    let default = [z_min, Boundary::FarField, r_min, Boundary::FarField];
    let table = table.table("boundary", faults);
    let named = Side::NAMES.map(|(key, _)| table.as_ref().and_then(|table| table.place(key)));
    let sides = boundaries(table, &Boundary::NAMES, fixed, default, Boundary::Periodic, faults);
    (sides, named)
}

fn inflow(
    table: &mut Table<'_>,
    boundary: [Boundary; 4],
    liquid: Option<NobleAbelStiffenedGas>,
    faults: &mut Faults,
) -> Option<Inflow> {
    let wanted = boundary.contains(&Boundary::Inflow);
    let (path, span) = (table.path_of("inflow"), table.span.clone());
    let Some(mut inflow) = table.table("inflow", faults) else {
        if wanted && !table.has("inflow") {
            let help = "write [fluid.inflow] and below it `pressure = [[t, p], ...]` in s and Pa";
            faults.at(&path, &span, "a side is an \"inflow\" and its pressure history is missing", help);
        }
        return None;
    };
    if !wanted {
        let help = "make a side \"inflow\" under [fluid.boundary], or remove the table";
        faults.at(&path, &inflow.span, "no side is an \"inflow\"", help);
    }
    let pressure = history(&mut inflow, "pressure", faults);
    inflow.finish(faults);
    let pressure = pressure?;
    if let Some(eos) = liquid
        && let Some(row) = pressure.value.iter().find(|row| row[1] + eos.pi <= 0.0)
    {
        let message = format!("the equation of state needs p + pi > 0, got p = {:?} Pa", row[1]);
        faults.of(&pressure, message, format!("give pressures above {:?} Pa", -eos.pi));
    }
    Some(Inflow { pressure: pressure.value })
}
