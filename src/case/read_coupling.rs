//! The `[coupling]` table.

use coupler::{Kappa, Scheme, StarSolver};

use super::read::history;
use super::reader::{Faults, Given, Table};
use super::{CouplingCase, LoadCase};

pub(super) fn coupling(root: &mut Table<'_>, faults: &mut Faults) -> (CouplingCase, Option<Given<Scheme>>) {
    let mut coupling = CouplingCase {
        scheme: Scheme::Riemann,
        star: StarSolver::Exact,
        kappa: Kappa::Off,
        load: None,
        connect_timeout: 30.0,
        patience: 600.0,
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
    if let Some(star) = table.choice("star", &StarSolver::NAMES, faults) {
        coupling.star = star.value;
    }
    if let Some(kappa) = table.choice("kappa", &Kappa::NAMES, faults) {
        coupling.kappa = kappa.value;
        if kappa.value != Kappa::Off && scheme.as_ref().is_some_and(|given| given.value != Scheme::Weak) {
            faults.of(&kappa, "only scheme = \"weak\" has factors kappa", "remove it, or take that scheme");
        }
    }
    if let Some(seconds) = table.positive("connect_timeout", "s", faults) {
        coupling.connect_timeout = seconds;
    }
    if let Some(seconds) = table.positive("patience", "s", faults) {
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
            let help = "write [coupling.load] with `amplitude`, `radius` and `history`";
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
    let amplitude = table.required("amplitude", "Pa", faults);
    let radius = table.required_positive("radius", "m", faults);
    let history = history(&mut table, "history", "s and 1", faults);
    table.finish(faults);
    Some(LoadCase { amplitude: amplitude?.value, radius: radius?, history: history?.value })
}
