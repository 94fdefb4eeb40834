//! `[fluid.bubble]`: a bubble by what is in it.

use fluid::{
    BubbleContent, GasState, Gravity, InitialCondition, NobleAbelStiffenedGas, Phase, PhaseState, Region,
    Saturation, Shape,
};
use mesh::Geometry;

use super::GridCase;
use super::bubble::{BubbleCase, ResetCase};
use super::keys::bubble::TEMPERATURE;
use super::read_shape::{extent, on_axis};
use super::reader::{Faults, Given, Table};
use super::shared::not_below_zero;

/// What a bubble is described against, as far as it could be read.
pub(super) struct Surroundings<'a> {
    pub ambient: Option<PhaseState>,
    pub gravity: Option<Gravity>,
    pub gas: Option<NobleAbelStiffenedGas>,
    pub grid: Option<&'a GridCase>,
    pub geometry: Geometry,
    /// That of the liquid, if it acts, N/m.
    pub surface_tension: f64,
}

/// What the table says.
pub(super) struct Described {
    /// The region that it makes; none where it is about one that is there.
    pub region: Option<Region>,
    /// Whether it starts at its largest, from rest.
    pub is_largest: bool,
    /// γ of the gas and the vapour, where the vapour has its own.
    pub gamma: Option<f64>,
    pub case: BubbleCase,
    named: Option<Given<usize>>,
}

impl Described {
    /// The vapour's part of the pressure in the bubble, where its content is described.
    ///
    /// Gas and vapour have one law, so that it is the part of the mass, too.
    pub fn vapour_share(&self) -> Option<f64> {
        self.region.map(|region| self.case.vapour_pressure / region.state.pressure)
    }
}

/// The numbers that the content is described by.
struct Numbers {
    centre: Option<Given<[f64; 2]>>,
    largest: Option<Given<f64>>,
    start: Option<Given<f64>>,
    equilibrium: Option<Given<f64>>,
    gas_pressure: Option<Given<f64>>,
    gas_density: Option<f64>,
    vapour_gamma: Option<Given<f64>>,
}

const RADII: &str =
    "give `radius_max` (it starts at rest at its largest) or `radius` (it may grow first), in m";
const GAS: &str = "give `equilibrium_radius` in m or `gas_pressure` in Pa";

/// Reads the table.
pub(super) fn bubble(
    mut table: Table<'_>,
    around: &Surroundings<'_>,
    faults: &mut Faults,
) -> Option<Described> {
    let before = faults.0.len();
    let named = table.whole("region", faults);
    let numbers = Numbers {
        centre: table.pair("centre", faults),
        largest: positive(&mut table, "radius_max", faults),
        start: positive(&mut table, "radius", faults),
        equilibrium: positive(&mut table, "equilibrium_radius", faults),
        gas_pressure: positive(&mut table, "gas_pressure", faults),
        gas_density: table.positive("gas_density", faults),
        vapour_gamma: above_one(&mut table, faults),
    };
    let vapour = not_below_zero(&mut table, "vapour_pressure", "", faults);
    let tension = not_below_zero(&mut table, "surface_tension", "", faults);
    let temperature = table.positive("temperature", faults).unwrap_or(TEMPERATURE);
    let cells = table.within("cells_per_radius", "40 is a good begin; 20 is quick", faults);
    let reset = table.table("reset", faults).map(|table| (table.span.clone(), reset(table, faults)));
    if around.geometry == Geometry::Planar {
        let message = "describes a sphere, and the geometry is planar";
        faults.at(
            &table.path,
            &table.span,
            message,
            "take geometry = \"axisymmetric\", or a [[fluid.region]]",
        );
    }
    if let (Some(cells), Some(grid)) = (&cells, around.grid)
        && grid.adaptation.is_none()
    {
        let message = format!("{:?} cells along the present radius need a grid that adapts", cells.value);
        faults.of(cells, message, "take fluid.adapt = true and fluid.levels = 1 or more, or remove it");
    }
    let vapour_pressure = vapour.as_ref().map_or(0.0, |given| given.value);
    let surface_tension = tension.map_or(around.surface_tension, |given| given.value);
    let case = BubbleCase {
        region: named.as_ref().map_or(0, |given| given.value),
        surface_tension,
        vapour_pressure,
        temperature,
        cells_per_radius: cells.map(|given| given.value),
        reset: reset.as_ref().and_then(|(_, reset)| *reset),
    };
    if let (Some((span, _)), Some(largest)) = (&reset, &numbers.largest) {
        let message = format!(
            "cuts the gas at the first maximum, and radius_max = {:?} m is where the bubble starts",
            largest.value
        );
        let help = "give the smaller equilibrium_radius at once, or `radius` of a bubble that grows first";
        faults.at(&table.path_of("reset"), span, message, help);
    }
    let region = match &named {
        Some(named) => {
            is_alone(&table, named, faults);
            None
        }
        None => region(&table, &numbers, &case, vapour.as_ref(), around, faults),
    };
    if let (Some((_, Some(ResetCase::EquilibriumRadius(left)))), Some(rest)) = (&reset, &numbers.equilibrium)
        && *left >= rest.value
    {
        let message =
            format!("reset.equilibrium_radius = {left:?} m is no cut: the gas has R_n = {:?} m", rest.value);
        faults.of(rest, message, "give a smaller radius under reset");
    }
    table.finish(faults);
    if faults.0.len() > before {
        return None;
    }
    let gamma = region.as_ref().and_then(|(_, gamma)| *gamma);
    let region = region.map(|(region, _)| region);
    Some(Described { region, is_largest: numbers.largest.is_some(), gamma, case, named })
}

/// Whether the bubble is one of the regions: a sphere of gas in liquid.
pub(super) fn check_region(described: &Described, initial: &InitialCondition, faults: &mut Faults) {
    let Some(named) = &described.named else { return };
    let help = "give the number, from 0, of a [[fluid.region]] with shape = \"sphere\" and phase = \"gas\"";
    let count = initial.regions.len();
    match initial.regions.get(named.value) {
        None => {
            faults.of(named, format!("there are {count} regions, got {}", named.value), help);
        }
        Some(Region { shape: Shape::Sphere { .. }, state }) if state.phase == Phase::Gas => {}
        Some(_) => faults.of(named, format!("region {} is no sphere of gas", named.value), help),
    }
}

/// With `region` the content stands in that region.
fn is_alone(table: &Table<'_>, named: &Given<usize>, faults: &mut Faults) {
    const CONTENT: [&str; 7] = [
        "centre",
        "radius_max",
        "radius",
        "equilibrium_radius",
        "gas_pressure",
        "gas_density",
        "vapour_gamma",
    ];
    for key in CONTENT {
        if let Some(given) = table.place(key) {
            let message = format!("the content of region {} stands in [[fluid.region]]", named.value);
            faults.of(&given, message, format!("remove `{key}`, or `region`"));
        }
    }
}

/// One of two that exclude each other.
fn one_of<'a>(
    table: &Table<'_>,
    [first, second]: [(&str, &'a Option<Given<f64>>); 2],
    help: &str,
    faults: &mut Faults,
) -> Option<&'a Given<f64>> {
    match (first.1, second.1) {
        (Some(_), Some(given)) => {
            let (one, other) = (first.0, second.0);
            faults.of(
                given,
                format!("`{one}` and `{other}` exclude each other"),
                format!("remove one: {help}"),
            );
            None
        }
        (None, None) => {
            if !(table.has(first.0) || table.has(second.0)) {
                table.missing(first.0, help, faults);
            }
            None
        }
        (given, None) | (None, given) => given.as_ref(),
    }
}

/// The region, and γ of gas and vapour where the vapour has its own.
fn region(
    table: &Table<'_>,
    numbers: &Numbers,
    case: &BubbleCase,
    vapour: Option<&Given<f64>>,
    around: &Surroundings<'_>,
    faults: &mut Faults,
) -> Option<(Region, Option<f64>)> {
    if numbers.centre.is_none() && !table.has("centre") {
        table.missing("centre", "give `centre = [z, 0.0]` in m", faults);
    }
    let radii = [("radius_max", &numbers.largest), ("radius", &numbers.start)];
    let radius = one_of(table, radii, RADII, faults);
    let contents = [("equilibrium_radius", &numbers.equilibrium), ("gas_pressure", &numbers.gas_pressure)];
    let given = one_of(table, contents, GAS, faults);
    if let Some(centre) = &numbers.centre {
        on_axis(centre, around.geometry, faults);
        if let Some(grid) = around.grid.filter(|grid| !grid.contains(centre.value)) {
            let [z, r] = centre.value;
            faults.of(centre, format!("the centre ({z:?}, {r:?}) m is outside the fluid"), extent(grid));
        }
    }
    let (mut ambient, gas) = (around.ambient?, around.gas?);
    // The liquid is that at the bubble's height.
    if let Some((gravity, centre)) = around.gravity.zip(numbers.centre.as_ref()) {
        ambient = gravity.at_height(ambient, centre.value[0]);
    }
    if ambient.phase == Phase::Gas {
        let help = "make the ambient phase \"liquid\"";
        faults.at(&table.path, &table.span, "a bubble is in a liquid, and the ambient phase is gas", help);
        return None;
    }
    if gas.pi != 0.0 {
        let message = format!("describes an ideal gas, and fluid.gas.pi is {:?} Pa", gas.pi);
        faults.at(&table.path, &table.span, message, "take fluid.gas.pi = 0, or a [[fluid.region]]");
        return None;
    }
    if let Some(vapour) = vapour.filter(|vapour| vapour.value >= ambient.pressure) {
        let message = format!(
            "the vapour's {:?} Pa are not below fluid.ambient.pressure = {:?} Pa{}: the liquid would boil",
            vapour.value,
            ambient.pressure,
            if around.gravity.is_some() { " at its height" } else { "" }
        );
        faults.of(
            vapour,
            message,
            "give a vapour pressure below that of the liquid; water has 2339 Pa at 20 °C",
        );
        return None;
    }
    if vapour.is_some_and(|vapour| is_supercritical(table, case.temperature, vapour, faults)) {
        return None;
    }
    let (centre, radius, given) = (numbers.centre.as_ref()?, radius?, given?);
    let content = case.content(ambient.pressure, gas);
    let own = own_gas(&content, numbers, radius.value, given, faults)?;
    let state = own + content.vapour();
    if numbers.largest.is_some() && state.pressure >= ambient.pressure {
        let message = format!(
            "the bubble holds {:?} Pa at radius_max = {:?} m, not less than the liquid's {:?} Pa: it would grow",
            state.pressure, radius.value, ambient.pressure
        );
        faults.of(given, message, "give less gas, or `radius` instead of `radius_max`");
        return None;
    }
    let gamma = numbers.vapour_gamma.as_ref().map(|vapour| content.mixed_gamma(own.pressure, vapour.value));
    let GasState { pressure, density } = state;
    let shape = Shape::Sphere { centre: centre.value, radius: radius.value };
    let state = PhaseState { phase: Phase::Gas, density, pressure, velocity: [0.0; 2] };
    Some((Region { shape, state }, gamma))
}

/// Whether it is no vapour any more, which is refused: water's, as its density is.
fn is_supercritical(table: &Table<'_>, temperature: f64, vapour: &Given<f64>, faults: &mut Faults) -> bool {
    let [critical_temperature, critical_pressure] = Saturation::CRITICAL;
    if vapour.value >= critical_pressure {
        let message = format!(
            "the vapour's {:?} Pa are not below water's critical {critical_pressure:e} Pa",
            vapour.value
        );
        faults.of(vapour, message, "water has 2339 Pa at 20 °C; give what is denser as `gas_pressure`");
        return true;
    }
    let is_hot = vapour.value > 0.0 && temperature >= critical_temperature;
    if let Some(given) = table.place("temperature").filter(|_| is_hot) {
        let message = format!(
            "{temperature:?} K are not below water's critical {critical_temperature} K: it has no vapour"
        );
        faults.of(
            &given,
            message,
            "give a lower temperature, 293.15 K by default, or remove `vapour_pressure`",
        );
    }
    is_hot
}

/// The gas at the start, without the vapour.
fn own_gas(
    content: &BubbleContent,
    numbers: &Numbers,
    radius: f64,
    given: &Given<f64>,
    faults: &mut Faults,
) -> Option<GasState> {
    let mut own = if numbers.equilibrium.is_some() {
        if let Some(largest) = numbers.largest.as_ref().filter(|largest| given.value >= largest.value) {
            let message = format!(
                "R_n = {:?} m is not below radius_max = {:?} m: at its largest a bubble is beyond equilibrium",
                given.value, largest.value
            );
            faults.of(given, message, "give a smaller R_n, or `radius` instead of `radius_max`");
            return None;
        }
        content.gas_at(given.value, radius)
    } else {
        content.at_temperature(given.value)
    };
    if let Some(density) = numbers.gas_density {
        own.density = density;
    }
    let has_room = content.gas.free_share(own.density) > 0.0;
    if !(own.pressure > 0.0 && own.pressure.is_finite() && own.density > 0.0 && has_room) {
        let message = format!(
            "the gas would have {:?} Pa and {:?} kg/m3 at a radius of {radius:?} m",
            own.pressure, own.density
        );
        let help =
            "give another amount of gas or another radius; with a covolume, a density below 1/covolume";
        faults.of(given, message, help);
        return None;
    }
    Some(own)
}

fn reset(mut table: Table<'_>, faults: &mut Faults) -> Option<ResetCase> {
    let radius = positive(&mut table, "equilibrium_radius", faults);
    let share =
        table.within("gas_share", "give the share of the gas that is left, 0.04 for instance", faults);
    let help = "give `equilibrium_radius` in m or `gas_share`";
    let which = one_of(&table, [("equilibrium_radius", &radius), ("gas_share", &share)], help, faults);
    let value = which.map(|given| given.value);
    let is_radius = radius.is_some();
    table.finish(faults);
    value
        .map(|value| if is_radius { ResetCase::EquilibriumRadius(value) } else { ResetCase::GasShare(value) })
}

fn positive(table: &mut Table<'_>, key: &'static str, faults: &mut Faults) -> Option<Given<f64>> {
    let place = table.place(key);
    let value = table.positive(key, faults)?;
    place.map(|place| Given { value, path: place.path, span: place.span })
}

fn above_one(table: &mut Table<'_>, faults: &mut Faults) -> Option<Given<f64>> {
    let given = table.number("vapour_gamma", faults)?;
    if given.value <= 1.0 {
        let message = format!("must be greater than 1, got {:?}", given.value);
        faults.of(&given, message, "the vapour's adiabatic exponent: 1.33 for water's");
    }
    Some(given)
}
