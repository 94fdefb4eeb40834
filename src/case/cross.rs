//! What can only be checked when both sides are known.

use coupler::Scheme;

use super::read_grid::GridPlace;
use super::reader::{Faults, Given};
use super::shared::PlacedProbe;
use super::{GridCase, Medium, Probe};

/// Coordinates closer than this, relative to the domain, are the same.
const SAME: f64 = 1e-12;

/// The scheme says which media there must be.
pub(super) fn media(scheme: &Given<Scheme>, has_fluid: bool, has_solid: bool, faults: &mut Faults) {
    match scheme.value {
        Scheme::Riemann | Scheme::Explicit | Scheme::Weak | Scheme::Strong => {
            let name = scheme.value.name();
            for (here, table) in [(has_fluid, "fluid"), (has_solid, "solid")] {
                if !here {
                    let message = format!("scheme = \"{name}\" couples two media, but there is no [{table}]");
                    let help = format!(
                        "write [{table}]; or under [coupling] take scheme = \"none\" for one medium alone, \
                         \"rigid\" for a fluid above a rigid wall"
                    );
                    faults.of(scheme, message, help);
                }
            }
        }
        Scheme::External => {
            if has_fluid == has_solid {
                let which = if has_fluid { "both are there" } else { "there is neither" };
                let help = "leave out what the other program is, [fluid] or [solid]";
                faults.of(scheme, format!("scheme = \"external\" is for one medium, but {which}"), help);
            }
        }
        Scheme::Rigid => {
            if !has_fluid {
                let help = "write [fluid], or take scheme = \"none\" for a solid alone";
                faults.of(scheme, "scheme = \"rigid\" needs a [fluid]", help);
            }
        }
        Scheme::Load => {
            if has_fluid {
                let help = "remove [fluid], or couple it with scheme = \"riemann\"";
                faults.of(scheme, "scheme = \"load\" is for a solid alone, but there is a [fluid]", help);
            }
            if !has_solid {
                faults.of(
                    scheme,
                    "scheme = \"load\" needs a [solid]",
                    "write [solid], or take another scheme",
                );
            }
        }
        Scheme::None => match (has_fluid, has_solid) {
            (true, true) => {
                let help = "remove [fluid] or [solid], or couple them with scheme = \"riemann\"";
                faults.of(scheme, "scheme = \"none\" is for one medium alone, but both are there", help);
            }
            (false, false) => {
                faults.of(scheme, "there is neither a [fluid] nor a [solid]", "write one of the two");
            }
            _ => {}
        },
    }
}

/// The paper's schemes exchange pressures and velocities of cells: they know of no friction.
pub(super) fn friction(scheme: &Given<Scheme>, is_viscous: bool, faults: &mut Faults) {
    if is_viscous && scheme.value.exchanges_cells() {
        let message = format!(
            "scheme = \"{}\" passes no shear stress, but the fluid has viscosity",
            scheme.value.name()
        );
        let help = "take scheme = \"riemann\", or remove `viscosity` from [fluid.terms]";
        faults.of(scheme, message, help);
    }
}

/// A run that ends when the surface is still needs a last load, which only a given one has; what a bubble does ends with its fluid.
pub(super) fn settles(scheme: Option<&Given<Scheme>>, faults: &mut Faults) {
    if let Some(scheme) = scheme.filter(|given| given.value != Scheme::Load) {
        let message = "only a solid under a given load can be waited for with end = \"settled\": of a fluid nobody knows which \
                       load is the last";
        let help = "give time.end in s, and look at surface_still in the summary; or take scheme = \"load\"";
        faults.at("time.end", &scheme.span, message, help);
    }
}

/// The solid ends where the fluid begins, and both are equally wide.
pub(super) fn domains_meet(fluid: &GridPlace, solid: &GridPlace, faults: &mut Faults) {
    let (fluid_z, solid_z) = (fluid.z.value, solid.z.value);
    let height = (fluid_z[1] - fluid_z[0]).max(solid_z[1] - solid_z[0]);
    if (fluid_z[0] - solid_z[1]).abs() > SAME * height {
        let message = format!(
            "the domains do not meet: the solid ends at z = {:?} m, the fluid begins at z = {:?} m",
            solid_z[1], fluid_z[0]
        );
        let help = format!("end the solid where the fluid begins: z = [{:?}, {:?}]", solid_z[0], fluid_z[0]);
        faults.of(&solid.z, message, help);
    }
    let (fluid_r, solid_r) = (fluid.r.value, solid.r.value);
    let width = fluid_r[1] - fluid_r[0];
    if (0..2).any(|end| (fluid_r[end] - solid_r[end]).abs() > SAME * width) {
        let message = format!(
            "the domains do not meet: r is [{:?}, {:?}] m in the solid, [{:?}, {:?}] m in the fluid",
            solid_r[0], solid_r[1], fluid_r[0], fluid_r[1]
        );
        faults.of(&solid.r, message, format!("make both ranges r = [{:?}, {:?}]", fluid_r[0], fluid_r[1]));
    }
}

/// Every probe is in its medium. Those of a solid that the scheme ignores are left out.
pub(super) fn probes(
    probes: Vec<PlacedProbe>,
    fluid: Option<&GridCase>,
    solid: Option<&GridCase>,
    there: [bool; 2],
    ignores_solid: bool,
    notes: &mut Vec<String>,
    faults: &mut Faults,
) -> Vec<Probe> {
    let mut kept = Vec::new();
    for PlacedProbe { probe, position, medium } in probes {
        let (grid, there, name) = match probe.medium {
            Medium::Fluid => (fluid, there[0], "fluid"),
            Medium::Solid => (solid, there[1], "solid"),
        };
        if probe.medium == Medium::Solid && ignores_solid {
            notes.push(format!("scheme = \"rigid\" has no solid: the probe `{}` is ignored", probe.name));
            continue;
        }
        if !there {
            let help = format!("write [{name}], or remove the probe");
            faults.of(&medium, format!("this case has no {name}"), help);
        }
        if let Some(grid) = grid.filter(|grid| !grid.contains(probe.position)) {
            let ([z, r], [z0, z1], [r0, r1]) = (probe.position, grid.z, grid.r);
            let message = format!("the point ({z:?}, {r:?}) m is outside the {name}");
            faults.of(
                &position,
                message,
                format!("the {name} is z = {z0:?} to {z1:?} m, r = {r0:?} to {r1:?} m"),
            );
        }
        kept.push(probe);
    }
    kept
}
