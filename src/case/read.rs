//! From a parsed document to a [`Case`]: the whole, and the tables that belong to neither side alone.

use std::path::PathBuf;

use coupler::Scheme;
use mesh::Geometry;
use toml::Spanned;
use toml::de::DeTable;

use super::error::{CaseError, suggest};
use super::keys::{records, time as of_time};
use super::reader::{Faults, Table, array};
use super::shared::{Context, PlacedProbe, name_of};
use super::{
    Case, LocalSteps, Medium, OutputCase, Probe, Time, cross, read_conduction, read_coupling, read_fluid,
    read_interest, read_sensors, read_solid, scales, steps, thresholds,
};

/// More snapshots than this are a mistake.
pub const MOST_SNAPSHOTS: f64 = 1e5;
/// More rows than this in the histories of the interface and of the conserved quantities are a mistake.
const MOST_ROWS: f64 = 1e6;

pub(super) fn case(text: &str, name: &str) -> Result<Case, Vec<CaseError>> {
    let document = DeTable::parse(text).map_err(|error| {
        let message = format!("not TOML: {}", error.message());
        vec![CaseError { path: String::new(), message, help: None, span: error.span() }]
    })?;
    let mut faults = Faults::default();
    let mut root = Table::root(&document);

    let geometry = root.name("geometry", &Geometry::NAMES, &mut faults);
    let time = time(&mut root, &mut faults);
    let (coupling, scheme) = read_coupling::coupling(&mut root, &mut faults);
    if time.as_ref().is_some_and(|time| time.settles) {
        cross::settles(scheme.as_ref(), &mut faults);
    }
    let local_steps = time.as_ref().map_or(LocalSteps::Auto, |time| time.local_steps);
    let context = Context { geometry, scheme: scheme.as_ref().map(|given| given.value), local_steps };
    let (has_fluid, has_solid) = (root.has("fluid"), root.has("solid"));
    let fluid =
        root.table("fluid", &mut faults).and_then(|table| read_fluid::fluid(table, context, &mut faults));
    let (mut fluid, conduction) = match fluid {
        Some((fluid, place, conduction)) => (Some((fluid, place)), conduction),
        None => (None, None),
    };
    let fluid_pressure = fluid.as_ref().map(|(fluid, _)| fluid.scale_pressure);
    let acting = scales::Acting { fluid: fluid_pressure, load: coupling.load.as_ref() };
    let mut solid = (root.table("solid", &mut faults))
        .and_then(|table| read_solid::solid(table, context, acting, &mut faults));
    thresholds::settle(
        fluid.as_mut().map(|(fluid, place)| (fluid, &place.asked)),
        solid.as_mut().map(|(solid, place)| (solid, &place.asked)),
        coupling.load.as_ref(),
    );
    let probes = probes(&mut root, &mut faults);
    let sensors = read_sensors::sensors(&mut root, &mut faults);
    let output = output(&mut root, time.as_ref().map(|time| time.end), &mut faults);

    let mut notes = Vec::new();
    if let Some(scheme) = &scheme {
        cross::media(scheme, has_fluid, has_solid, &mut faults);
        cross::friction(
            scheme,
            fluid.as_ref().is_some_and(|(fluid, _)| fluid.terms.viscosity.is_some()),
            &mut faults,
        );
    }
    if let (Some(asked), Some((fluid, _))) = (&conduction, &mut fluid) {
        let (laws, solid) = ([fluid.liquid, fluid.gas], solid.as_ref().map(|(solid, _)| &solid.material));
        fluid.terms.conduction = read_conduction::settle(asked, laws, (fluid.boundary, solid), &mut faults);
    }
    let ignores_solid = context.scheme == Some(Scheme::Rigid) && has_solid;
    let mut solid = if ignores_solid {
        notes.push("scheme = \"rigid\" has no solid: the [solid] table is ignored".to_owned());
        None
    } else {
        solid
    };
    if let (Some((_, fluid)), Some((_, solid))) = (&fluid, &solid) {
        cross::domains_meet(fluid, solid, &mut faults);
    }
    let media =
        [fluid.as_mut().map(|(fluid, _)| &mut fluid.grid), solid.as_mut().map(|(solid, _)| &mut solid.grid)];
    let wall_z = match (context.scheme, &media) {
        (Some(Scheme::None), _) => None,
        (_, [Some(fluid), _]) => Some(fluid.z[0]),
        (_, [None, solid]) => solid.as_ref().map(|grid| grid.z[1]),
    };
    read_interest::region_of_interest(&mut root, media, wall_z, &mut faults);
    root.finish(&mut faults);
    let probes = cross::probes(
        probes,
        fluid.as_ref().map(|(fluid, _)| &fluid.grid),
        solid.as_ref().map(|(solid, _)| &solid.grid),
        [has_fluid, has_solid && !ignores_solid],
        ignores_solid,
        &mut notes,
        &mut faults,
    );

    let fluids = fluid.as_ref().map(|(fluid, _)| &fluid.grid);
    let wall = match context.scheme {
        Some(Scheme::None) => None,
        _ => fluids.or(solid.as_ref().map(|(solid, _)| &solid.grid)),
    };
    let sensors = read_sensors::on_wall(sensors, wall, &mut faults);

    let Some(time) = time.filter(|_| faults.0.is_empty()) else { return Err(faults.0) };
    let case = Case {
        name: name.to_owned(),
        geometry,
        time,
        fluid: fluid.map(|(fluid, _)| fluid),
        solid: solid.map(|(solid, _)| solid),
        coupling,
        probes,
        sensors,
        output,
        notes,
    };
    if let Some((message, help)) = steps::too_many(&case) {
        let key = if case.time.settles { "longest" } else { "end" };
        let end = document.get_ref().get("time").and_then(|time| time.get_ref().as_table()?.get(key));
        faults.at(&format!("time.{key}"), &end.map_or(0..0, Spanned::span), message, help);
        return Err(faults.0);
    }
    Ok(case)
}

fn time(root: &mut Table<'_>, faults: &mut Faults) -> Option<Time> {
    if !root.has("time") {
        root.missing("time", "write [time] and below it `end = ...`, in seconds", faults);
    }
    let mut table = root.table("time", faults)?;
    let settles = matches!(table.text("end"), Some("settled"));
    let end = if settles {
        table.raw("end");
        table.required_positive("longest", faults)
    } else {
        let end = table.required_positive("end", faults);
        if let Some(longest) = table.raw("longest") {
            let help = "remove it, or write end = \"settled\"";
            faults.of(&longest, "only a run with end = \"settled\" has a limit besides its end", help);
        }
        end
    };
    let cfl = table.within("cfl", "0.45 is a good value", faults);
    let local_steps = LocalSteps::read(&mut table, faults);
    let snapshots = table.numbers("snapshots", faults);
    let every = table.number("snapshot_every", faults);
    table.finish(faults);

    // No snapshots at all is what `--set` may ask of any case.
    if let (Some(_), Some(every)) = (snapshots.as_ref().filter(|given| !given.value.is_empty()), &every) {
        faults.of(every, "snapshots and snapshot_every exclude each other", "remove one of the two");
    }
    let end = end?;
    let mut times = Vec::new();
    if let Some(given) = &snapshots {
        let mut outside = given.value.iter().enumerate().filter(|(_, time)| !(0.0..=end).contains(*time));
        if let Some((number, time)) = outside.next() {
            let others = match outside.count() {
                0 => "lies".to_owned(),
                more => format!("and {more} more lie"),
            };
            let message = format!("snapshot {number} at {time:?} s {others} outside the run, 0 to {end:?} s");
            let help = "make `end` later, or leave out what is later: `--set time.snapshots=[]` does without any but the first and last";
            faults.of(given, message, help);
        }
        times.clone_from(&given.value);
    } else if let Some(given) = &every {
        let every = given.value;
        if every <= 0.0 {
            faults.of(given, format!("must be positive, got {every:?}"), "give an interval > 0 in s");
        } else if end / every > MOST_SNAPSHOTS {
            let message =
                format!("{every:?} s means more than {MOST_SNAPSHOTS} snapshots until time.end = {end:?} s");
            faults.of(given, message, "give a longer interval");
        } else {
            times.extend((1..).map(|k| f64::from(k) * every).take_while(|time| *time < end));
        }
    }
    Some(Time {
        end,
        settles,
        cfl: cfl.map_or(of_time::CFL, |given| given.value),
        local_steps,
        snapshots: resolve(times, end),
    })
}

/// Ascending, with 0 and `end`, without times that are one up to round-off.
fn resolve(mut times: Vec<f64>, end: f64) -> Vec<f64> {
    times.push(0.0);
    times.sort_by(f64::total_cmp);
    // `-0.0` would sort before and differ in print.
    times.iter_mut().for_each(|time| *time += 0.0);
    times.dedup_by(|later, earlier| *later - *earlier <= 1e-12 * end);
    times.retain(|time| end - *time > 1e-12 * end);
    times.push(end);
    times
}

fn probes(root: &mut Table<'_>, faults: &mut Faults) -> Vec<PlacedProbe> {
    let mut probes: Vec<PlacedProbe> = Vec::new();
    for mut table in root.tables("probe", faults) {
        let name =
            name_of(&mut table, "probe", |name| probes.iter().any(|other| other.probe.name == name), faults);
        let position = table.required_pair("position", faults);
        if !table.has("medium") {
            table.missing("medium", "give `medium = \"fluid\"` or \"solid\"", faults);
        }
        let medium = table.choice("medium", &Medium::NAMES, faults);
        table.finish(faults);
        if let (Some(name), Some(position), Some(medium)) = (name, position, medium) {
            let probe = Probe { name, position: position.value, medium: medium.value };
            probes.push(PlacedProbe { probe, position, medium });
        }
    }
    probes
}

/// - `end`: of the run, s, where known.
fn output(root: &mut Table<'_>, end: Option<f64>, faults: &mut Faults) -> OutputCase {
    let mut output = OutputCase {
        directory: None,
        fields: None,
        compression: records::COMPRESSION,
        interface_cells: None,
        interface_every: None,
        mean_time: None,
    };
    let Some(mut table) = root.table("output", faults) else { return output };
    if let Some(directory) = table.string("directory", faults) {
        if directory.value.is_empty() {
            faults.of(&directory, "is empty", "name a directory, or remove the key");
        }
        output.directory = Some(PathBuf::from(directory.value));
    }
    if let Some(given) = table.raw("fields") {
        let allowed = records::fields();
        let mut fields: Vec<String> = Vec::new();
        for element in array(&given, "a list of field names", "quotes", faults).unwrap_or_default() {
            match element.value.as_str() {
                Some(name) if allowed.contains(&name) => {
                    if fields.iter().all(|field| field != name) {
                        fields.push(name.to_owned());
                    }
                }
                Some(name) => {
                    let help = suggest(name, allowed.iter().copied());
                    faults.of(&element, format!("unknown field `{name}`"), help);
                }
                None => faults.of(&element, "must be a field's name in quotes", suggest("", allowed.clone())),
            }
        }
        output.fields = Some(fields);
    }
    if let Some(level) = table.whole("compression", faults) {
        output.compression = u8::try_from(level.value).unwrap_or(9);
    }
    output.interface_cells = table.whole("interface_cells", faults).map(|given| given.value);
    output.interface_every = table.positive("interface_every", faults);
    if let (Some(every), Some(end), Some(given)) =
        (output.interface_every, end, table.place("interface_every"))
        && end / every > MOST_ROWS * (1.0 + 1e-9)
    {
        let message = format!("{every:?} s means more than {MOST_ROWS:e} rows until time.end = {end:?} s");
        faults.of(&given, message, format!("give {:?} s or more", end / MOST_ROWS));
    }
    output.mean_time = table.positive("mean_time", faults);
    if let (Some(mean), Some(end), Some(given)) = (output.mean_time, end, table.place("mean_time"))
        && mean > end
    {
        let message = format!("{mean:?} s is longer than the run, which ends at {end:?} s");
        faults.of(&given, message, format!("give {end:?} s at most"));
    }
    table.finish(faults);
    output
}
