//! The `[coupling]` table.

use std::path::Path;

use coupler::{Kappa, Participant, Scheme, StarSolver};

use super::keys::coupling as keys;
use super::reader::{Faults, Given, Table};
use super::recorded_load::RecordedLoad;
use super::shared::history;
use super::{CouplingCase, GaussianLoad, LoadCase};

pub(super) fn coupling(root: &mut Table<'_>, faults: &mut Faults) -> (CouplingCase, Option<Given<Scheme>>) {
    let mut coupling = CouplingCase {
        scheme: Scheme::Riemann,
        star: StarSolver::Exact,
        kappa: Kappa::Off,
        step_ratio: keys::MOST_STEPS_IN_ONE as u32,
        first: Participant::Fluid,
        tolerance: keys::TOLERANCE,
        max_iterations: keys::ITERATIONS as u32,
        load: None,
        connect_timeout: keys::CONNECT_TIMEOUT,
        patience: keys::PATIENCE,
    };
    let default =
        Given { value: Scheme::Riemann, path: "coupling.scheme".to_owned(), span: root.span.clone() };
    if !root.has("coupling") {
        root.table("coupling", faults);
        return (coupling, Some(default));
    }
    let Some(mut table) = root.table("coupling", faults) else { return (coupling, None) };
    let scheme = if table.has("scheme") {
        table.choice("scheme", &Scheme::NAMES, faults)
    } else {
        table.raw("scheme");
        Some(Given { span: table.span.clone(), ..default })
    };
    if let Some(scheme) = &scheme {
        coupling.scheme = scheme.value;
    }
    coupling.star = table.name("star", &StarSolver::NAMES, faults);
    if let Some(kappa) = table.choice("kappa", &Kappa::NAMES, faults) {
        coupling.kappa = kappa.value;
        if kappa.value != Kappa::Off && scheme.as_ref().is_some_and(|given| given.value != Scheme::Weak) {
            faults.of(&kappa, "only scheme = \"weak\" has factors kappa", "remove it, or take that scheme");
        }
    }
    if coupling.scheme.exchanges_cells() {
        coupling.step_ratio = 1;
    }
    if let Some(ratio) = table.whole("step_ratio", faults) {
        coupling.step_ratio = ratio.value as u32;
        if ratio.value > 1
            && let Some(scheme) = scheme.as_ref().filter(|given| given.value.exchanges_cells())
        {
            let message = format!("with scheme = \"{}\" both sides make the same steps", scheme.value.name());
            faults.of(&ratio, message, "remove it, or take scheme = \"riemann\"");
        }
    }
    let only_in = |schemes: &[Scheme], faults: &mut Faults, path: &str, span: &_| {
        if scheme.as_ref().is_some_and(|given| !schemes.contains(&given.value)) {
            let names: Vec<String> = schemes.iter().map(|s| format!("\"{}\"", s.name())).collect();
            let message = format!("only scheme = {} knows this key", names.join(" or "));
            faults.at(path, span, message, "remove it, or take such a scheme");
        }
    };
    if let Some(first) = table.choice("first", &Participant::NAMES, faults) {
        coupling.first = first.value;
        only_in(&[Scheme::Weak, Scheme::Strong], faults, &first.path, &first.span);
    }
    if let Some(tolerance) = table.within("tolerance", "give a small share, as 1e-6", faults) {
        coupling.tolerance = tolerance.value;
        only_in(&[Scheme::Strong], faults, &tolerance.path, &tolerance.span);
    }
    if let Some(most) = table.whole("max_iterations", faults) {
        coupling.max_iterations = most.value as u32;
        only_in(&[Scheme::Strong], faults, &most.path, &most.span);
    }
    if let Some(seconds) = table.waiting("connect_timeout", faults) {
        coupling.connect_timeout = seconds;
    }
    if let Some(seconds) = table.waiting("patience", faults) {
        coupling.patience = seconds;
    }
    coupling.load = load(&mut table, scheme.as_ref(), faults);
    table.finish(faults);
    (coupling, scheme)
}

/// `[coupling.load]`, which belongs to one scheme and that scheme to it.
fn load(coupling: &mut Table<'_>, scheme: Option<&Given<Scheme>>, faults: &mut Faults) -> Option<LoadCase> {
    if !coupling.has("load") {
        if let Some(scheme) = scheme.filter(|given| given.value == Scheme::Load) {
            let help = "write [coupling.load] with `amplitude`, `radius` and `history`, or with `run`";
            faults.of(scheme, "scheme = \"load\" needs a load", help);
        }
        coupling.table("load", faults);
        return None;
    }
    let mut table = coupling.table("load", faults)?;
    if scheme.is_some_and(|given| given.value != Scheme::Load) {
        let help = "remove it, or take scheme = \"load\" for a solid alone";
        faults.at(&table.path, &table.span, "only scheme = \"load\" has a load", help);
    }
    if table.has("run") {
        return recorded(table, faults);
    }
    let amplitude = table.required("amplitude", faults);
    let radius = table.required_positive("radius", faults);
    let history = history(&mut table, "history", faults);
    table.finish(faults);
    let load = GaussianLoad { amplitude: amplitude?.value, radius: radius?, history: history?.value };
    Some(LoadCase::Gaussian(load))
}

/// `run = "DIR"`: what the wall got there.
fn recorded(mut table: Table<'_>, faults: &mut Faults) -> Option<LoadCase> {
    let run = table.string("run", faults);
    for key in ["amplitude", "radius", "history"] {
        if let Some(given) = table.raw(key) {
            let help = format!("remove `{key}`, or `run`");
            faults.of(&given, "a load is either a pulse or what a run has recorded", help);
        }
    }
    table.finish(faults);
    let run = run?;
    match RecordedLoad::read(Path::new(run.value)) {
        Ok(load) => Some(LoadCase::Recorded(load)),
        Err(fault) => {
            let help = "give the directory of a finished run with a wall, as `cav run` has left it";
            faults.of(&run, format!("cannot repeat the load of that run: {fault}"), help);
            None
        }
    }
}
