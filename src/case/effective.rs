//! A case written out in full, and its hash.

mod bubble;

use std::fmt::Write as _;

use coupler::Scheme;
use fluid::{PhaseState, PulseShape, Shape};
use mesh::{LevelBound, Side, Zone};
use solid::plasticity::Hardening;

use super::{Case, FluidCase, GridCase, LoadCase, SolidCase};

mod phase_change;
mod terms;

impl Case {
    /// The case as TOML with all defaults filled in; reading it gives this case again.
    pub fn effective_toml(&self) -> String {
        let output = &self.output;
        let mut table = Lines(self.write(true));
        table.head("[output]");
        if let Some(directory) = &output.directory {
            table.key("directory", quoted(&directory.to_string_lossy()));
        }
        if let Some(fields) = &output.fields {
            let fields: Vec<String> = fields.iter().map(|field| quoted(field)).collect();
            table.key("fields", format!("[{}]", fields.join(", ")));
        }
        table.key("compression", output.compression);
        if let Some(cells) = output.interface_cells {
            table.key("interface_cells", cells);
        }
        if let Some(seconds) = output.interface_every {
            table.number("interface_every", seconds);
        }
        if let Some(seconds) = output.mean_time {
            table.number("mean_time", seconds);
        }
        table.0
    }

    /// The effective case without `[output]`, and without the waiting times unless asked for.
    pub(super) fn write(&self, waiting: bool) -> String {
        let mut text = Lines(String::new());
        text.name("geometry", &mesh::Geometry::NAMES, self.geometry);
        text.head("[time]");
        if self.time.settles {
            text.key("end", quoted("settled"));
            text.number("longest", self.time.end);
        } else {
            text.number("end", self.time.end);
        }
        text.number("cfl", self.time.cfl);
        text.key("local_steps", self.time.local_steps);
        text.list("snapshots", &self.time.snapshots);
        if let Some(fluid) = &self.fluid {
            write_fluid(&mut text, fluid, self.coupling.scheme);
        }
        if let Some(solid) = &self.solid {
            write_solid(&mut text, solid);
        }
        text.head("[coupling]");
        text.name("scheme", &coupler::Scheme::NAMES, self.coupling.scheme);
        text.name("star", &coupler::StarSolver::NAMES, self.coupling.star);
        text.name("kappa", &coupler::Kappa::NAMES, self.coupling.kappa);
        text.key("step_ratio", self.coupling.step_ratio);
        if matches!(self.coupling.scheme, Scheme::Weak | Scheme::Strong) {
            text.name("first", &coupler::Participant::NAMES, self.coupling.first);
        }
        if self.coupling.scheme == Scheme::Strong {
            text.number("tolerance", self.coupling.tolerance);
            text.key("max_iterations", self.coupling.max_iterations);
        }
        if waiting {
            text.number("connect_timeout", self.coupling.connect_timeout);
            text.number("patience", self.coupling.patience);
        }
        if let Some(load) = &self.coupling.load {
            text.head("[coupling.load]");
            match load {
                LoadCase::Gaussian(load) => {
                    text.number("amplitude", load.amplitude);
                    text.number("radius", load.radius);
                    text.rows("history", &load.history);
                }
                LoadCase::Recorded(load) => text.key("run", quoted(&load.run().to_string_lossy())),
            }
        }
        if let Some(region) = self.region_of_interest() {
            text.head("[region_of_interest]");
            text.list("centre", &region.centre);
            text.number("radius", region.radius);
        }
        for probe in &self.probes {
            text.head("[[probe]]");
            text.key("name", quoted(&probe.name));
            text.list("position", &probe.position);
            text.name("medium", &super::Medium::NAMES, probe.medium);
        }
        for sensor in &self.sensors {
            text.head("[[sensor]]");
            text.key("name", quoted(&sensor.name));
            text.number("radius", sensor.radius);
            if sensor.rise_time > 0.0 {
                text.number("rise_time", sensor.rise_time);
            }
        }
        text.0
    }
}

fn write_fluid(text: &mut Lines, fluid: &FluidCase, scheme: Scheme) {
    text.head("[fluid]");
    write_grid(text, &fluid.grid);
    if fluid.grid.adaptation.is_some() {
        text.number("epsilon_waves", fluid.wave_epsilon);
    }
    text.name("riemann", &fluid::RiemannSolver::NAMES, fluid.riemann);
    text.name("model", &fluid::Model::NAMES, fluid.model);
    text.name("interface", &fluid::Sharpening::NAMES, fluid.sharpening);
    text.name("limiter", &mesh::Limiter::NAMES, fluid.limiter);
    text.name("initial_pressure", &fluid::InitialPressure::NAMES, fluid.initial.pressure);
    text.number("scale_pressure", fluid.scale_pressure);
    text.number("scale_density", fluid.scale_density);
    if let Some(gravity) = fluid.gravity {
        text.number("gravity", gravity.acceleration);
    }
    if fluid.grid.adaptation.is_some() {
        let near = &fluid.near_wall;
        text.head("[fluid.near_wall]");
        text.key("shock_levels", near.shock_levels);
        text.key("film_levels", near.film_levels);
        text.key("film_cells", near.film_cells);
    }
    write_refine(text, "[[fluid.refine]]", &fluid.grid);
    for (head, eos) in [("[fluid.liquid]", fluid.liquid), ("[fluid.gas]", fluid.gas)] {
        text.head(head);
        text.number("gamma", eos.gamma);
        text.number("pi", eos.pi);
        if eos.covolume != 0.0 {
            text.number("covolume", eos.covolume);
        }
        if let Some(heat) = eos.heat {
            text.number("heat_capacity", heat.capacity);
            text.number("energy", heat.energy);
            text.number("entropy", heat.entropy);
        }
    }
    terms::write(text, &fluid.terms);
    text.head("[fluid.ambient]");
    write_state(text, &fluid.initial.ambient);
    for region in &fluid.initial.regions {
        text.head("[[fluid.region]]");
        write_shape(text, &region.shape);
        write_state(text, &region.state);
    }
    if let Some(bubble) = &fluid.bubble {
        bubble::write(text, bubble);
    }
    if let Some(shape) = &fluid.tracer {
        text.head("[fluid.tracer]");
        write_shape(text, shape);
    }
    for pulse in &fluid.initial.pulses {
        text.head("[[fluid.pulse]]");
        match pulse.shape {
            PulseShape::Sphere => text.key("shape", "\"sphere\""),
            PulseShape::Plane { direction } => {
                text.key("shape", "\"plane\"");
                if let Some(direction) = direction {
                    text.list("direction", &direction);
                }
            }
        }
        text.list("centre", &pulse.centre);
        text.number("width", pulse.width);
        text.number("amplitude", pulse.amplitude);
    }
    text.head("[fluid.boundary]");
    // The rigid wall is the scheme's and cannot be named.
    let first = usize::from(scheme == Scheme::Rigid);
    write_sides(text, fluid.boundary, &fluid::Boundary::NAMES, first);
    if let Some(inflow) = &fluid.inflow {
        text.head("[fluid.inflow]");
        text.rows("pressure", &inflow.pressure);
    }
}

fn write_shape(text: &mut Lines, shape: &Shape) {
    match shape {
        Shape::Sphere { centre, radius } => {
            text.key("shape", "\"sphere\"");
            text.list("centre", centre);
            text.number("radius", *radius);
        }
        Shape::Box { z, r } => {
            text.key("shape", "\"box\"");
            text.list("z", z);
            text.list("r", r);
        }
    }
}

fn write_solid(text: &mut Lines, solid: &SolidCase) {
    text.head("[solid]");
    write_grid(text, &solid.grid);
    text.name("initial_stress", &solid::InitialStress::NAMES, solid.initial_stress);
    if let Some(run) = &solid.initial {
        text.key("initial", quoted(&run.to_string_lossy()));
    }
    text.name("limiter", &mesh::Limiter::NAMES, solid.limiter);
    text.number("scale_stress", solid.scale_stress);
    if let Some(weight) = solid.weight {
        text.number("gravity", weight.acceleration);
    }
    write_refine(text, "[[solid.refine]]", &solid.grid);
    // The numbers, not only the name: a case stays what it is when the library changes.
    text.head("[solid.material]");
    let material = &solid.material;
    text.key("name", quoted(material.name()));
    text.number("density", material.density());
    text.number("c1", material.c1());
    text.number("c2", material.c2());
    if let Some(yield_strength) = material.yield_strength() {
        text.number("yield_strength", yield_strength);
    }
    if let Some(law) = &solid.plasticity {
        write_plasticity(text, law);
    }
    for pulse in &solid.pulses {
        text.head("[[solid.pulse]]");
        text.list("centre", &pulse.centre);
        text.number("width", pulse.width);
        text.number("amplitude", pulse.amplitude);
    }
    text.head("[solid.boundary]");
    write_sides(text, solid.boundary, &solid::Boundary::NAMES, 0);
}

fn write_plasticity(text: &mut Lines, law: &Hardening) {
    text.head("[solid.plasticity]");
    text.key("law", quoted(law.name()));
    match law {
        Hardening::Perfect(law) => text.number("yield_strength", law.yield_strength),
        Hardening::Linear(law) => {
            text.number("yield_strength", law.yield_strength);
            text.number("hardening_modulus", law.hardening_modulus);
        }
        Hardening::JohnsonCook(law) => {
            text.number("yield_strength", law.yield_strength);
            text.number("hardening_modulus", law.hardening_modulus);
            text.number("hardening_exponent", law.hardening_exponent);
            text.number("rate_coefficient", law.rate.rate_coefficient);
            text.number("reference_rate", law.rate.reference_rate);
            if let Some(heat) = &law.softening {
                text.number("softening_exponent", heat.softening_exponent);
                text.number("melting_temperature", heat.melting_temperature);
                text.number("reference_temperature", heat.reference_temperature);
                text.number("heat_capacity", heat.heat_capacity);
                text.number("taylor_quinney", heat.taylor_quinney);
            }
        }
        Hardening::Table(law) => {
            text.rows("table", &law.points().collect::<Vec<_>>());
            if law.rate().rate_coefficient > 0.0 {
                text.number("rate_coefficient", law.rate().rate_coefficient);
                text.number("reference_rate", law.rate().reference_rate);
            }
        }
    }
}

fn write_grid(text: &mut Lines, grid: &GridCase) {
    text.list("z", &grid.z);
    text.list("r", &grid.r);
    text.key("cells", format!("[{}, {}]", grid.cells[0], grid.cells[1]));
    text.key("levels", grid.levels);
    text.key("adapt", grid.adaptation.is_some());
    if let Some(adaptation) = &grid.adaptation {
        text.number("epsilon", adaptation.epsilon);
        text.key("adapt_every", adaptation.every);
    }
}

fn write_refine(text: &mut Lines, head: &str, grid: &GridCase) {
    for LevelBound { zone, at_least, at_most } in grid.adaptation.iter().flat_map(|a| &a.bounds) {
        text.head(head);
        match zone {
            Zone::Within { centre, radius } | Zone::Beyond { centre, radius } => {
                text.key("shape", "\"sphere\"");
                text.list("centre", centre);
                text.number("radius", *radius);
                let inside = matches!(zone, Zone::Within { .. });
                text.key("where", quoted(if inside { "inside" } else { "outside" }));
            }
            Zone::Box { z, r } => {
                text.key("shape", "\"box\"");
                text.list("z", z);
                text.list("r", r);
            }
            Zone::Along(_) => text.key("shape", "\"interface\""),
        }
        text.key("at_least", at_least);
        text.key("at_most", at_most);
    }
}

fn write_state(text: &mut Lines, state: &PhaseState) {
    text.name("phase", &fluid::Phase::NAMES, state.phase);
    text.number("density", state.density);
    text.number("pressure", state.pressure);
    text.list("velocity", &state.velocity);
}

/// The sides from `first` on that a case may name: neither the axis nor the interface.
fn write_sides<B: Copy + PartialEq>(
    text: &mut Lines,
    sides: [B; 4],
    names: &[(&'static str, B)],
    first: usize,
) {
    for ((key, _), side) in Side::NAMES.iter().zip(sides).skip(first) {
        if names.iter().any(|(_, named)| *named == side) {
            text.name(key, names, side);
        }
    }
}

/// TOML being written line by line.
struct Lines(String);

impl Lines {
    fn head(&mut self, head: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "\n{head}");
    }

    fn key(&mut self, key: &str, value: impl std::fmt::Display) {
        let _ = writeln!(self.0, "{key} = {value}");
    }

    /// The shortest digits that give the same number again.
    fn number(&mut self, key: &str, value: f64) {
        self.key(key, format_args!("{value:?}"));
    }

    fn list(&mut self, key: &str, values: &[f64]) {
        self.key(key, format_args!("{values:?}"));
    }

    fn rows(&mut self, key: &str, rows: &[[f64; 2]]) {
        let rows: Vec<String> = rows.iter().map(|[t, value]| format!("[{t:?}, {value:?}]")).collect();
        self.key(key, format!("[{}]", rows.join(", ")));
    }

    fn name<T: Copy + PartialEq>(&mut self, key: &str, names: &[(&'static str, T)], value: T) {
        if let Some((name, _)) = names.iter().find(|(_, named)| *named == value) {
            self.key(key, format_args!("\"{name}\""));
        }
    }
}

fn quoted(text: &str) -> String {
    toml_edit::Value::from(text).to_string()
}
