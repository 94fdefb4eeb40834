//! Bad cases are refused with the key, what is wrong and the remedy; good ones survive being written out.

#![allow(missing_docs)]

use std::path::{Path, PathBuf};

use fluid::PulseShape;

use cav::case::{Case, CaseErrors};

/// A small coupled case that is right.
const GOOD: &str = r#"
geometry = "axisymmetric"
[time]
end = 1e-6
[fluid]
z = [0.0, 0.01]
r = [0.0, 0.01]
cells = [4, 4]
levels = 3
[fluid.liquid]
gamma = 7.15
pi = 3e8
[fluid.ambient]
density = 1000.0
pressure = 1e6
[[fluid.region]]
shape = "sphere"
centre = [0.004, 0.0]
radius = 0.002
phase = "gas"
density = 1.2
pressure = 1e5
[solid]
z = [-0.01, 0.0]
r = [0.0, 0.01]
cells = [4, 4]
levels = 3
material = "structural-steel"
[coupling]
scheme = "riemann"
[[probe]]
name = "wall"
position = [0.0, 0.0]
medium = "fluid"
"#;

/// What is done to the good case.
enum Edit {
    Whole(&'static str),
    Replace(&'static str, &'static str),
    Append(&'static str),
    Sets(&'static [&'static str]),
}
use Edit::{Append, Replace, Sets, Whole};

fn read(edit: &Edit) -> Result<Case, CaseErrors> {
    match edit {
        Whole(text) => Case::from_toml(text, "bad", &[]),
        Replace(from, to) => {
            assert!(GOOD.contains(from), "the good case has no `{from}`");
            Case::from_toml(&GOOD.replacen(from, to, 1), "bad", &[])
        }
        Append(more) => Case::from_toml(&format!("{GOOD}\n{more}"), "bad", &[]),
        Sets(sets) => {
            let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
            Case::from_toml(GOOD, "bad", &sets)
        }
    }
}

fn good() -> Case {
    Case::from_toml(GOOD, "good", &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

fn with(sets: &[&str]) -> Case {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::from_toml(GOOD, "good", &sets).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Edit, then what the message must have in it: the key, the value or cause, the remedy.
#[rustfmt::skip]
const BAD: &[(Edit, &[&str])] = &[
    // Text and tables.
    (Whole("[time\nend = 1"), &["not TOML", "bad.toml:1:6"]),
    (Whole(""), &["time: `time` is missing", "[time]"]),
    (Whole("time = 3\n"), &["time: must be a table", "the whole number 3", "[time]"]),
    (Replace("geometry = \"axisymmetric\"", "geometry = \"spherical\""), &["geometry", "`spherical`", "`planar`"]),
    (Replace("[time]", "[tmie]"), &["unknown key `tmie`", "did you mean `time`?", "`time` is missing"]),
    (Append("[fluids]\n"), &["fluids: unknown key", "did you mean `fluid`?"]),
    (Append("adapt = true\n"), &["unknown key `adapt`"]),
    (Replace("radius = 0.002", "raduis = 0.002"), &["fluid.region.0.raduis: unknown key", "did you mean `radius`?", "fluid.region.0.radius: `radius` is missing", "in m"]),
    (Replace("levels = 3", "level = 3"), &["fluid.level: unknown key", "did you mean `levels`?"]),
    (Append("[[probe]]\n[probe.x]\n"), &["probe.1.x: unknown key", "probe.1.name: `name` is missing", "probe.1.medium"]),
    (Replace("[[fluid.region]]", "[fluid.region]"), &["fluid.region: must be an array of tables", "[[fluid.region]]"]),
    // Time.
    (Replace("end = 1e-6", ""), &["time.end: `end` is missing", "in s"]),
    (Replace("end = 1e-6", "end = \"1e-6\""), &["time.end: must be a number", "without quotes", "in s"]),
    (Replace("end = 1e-6", "end = 0"), &["time.end: must be positive, got 0.0", "in s"]),
    (Replace("end = 1e-6", "end = nan"), &["time.end: must be finite"]),
    (Replace("end = 1e-6", "end = 1e999"), &["time.end", "1e999"]),
    (Replace("end = 1e-6", "end = 1e-6\ncfl = 0.95"), &["time.cfl: must lie in (0, 0.9], got 0.95", "0.45"]),
    (Replace("end = 1e-6", "end = 1e-6\ncfl = 0.0"), &["time.cfl: must lie in (0, 0.9], got 0.0"]),
    (Replace("end = 1e-6", "end = 1e-6\nsnapshots = [5e-7, 2e-6]"), &["time.snapshots: snapshot 1 at 2e-6 s", "make `end` later"]),
    (Replace("end = 1e-6", "end = 1e-6\nsnapshots = [-1e-7]"), &["time.snapshots: snapshot 0 at -1e-7 s"]),
    (Replace("end = 1e-6", "end = 1e-6\nsnapshots = [1e-7]\nsnapshot_every = 1e-7"), &["time.snapshot_every", "exclude each other", "remove one"]),
    (Replace("end = 1e-6", "end = 1e-6\nsnapshot_every = 0.0"), &["time.snapshot_every: must be positive"]),
    (Replace("end = 1e-6", "end = 1e-6\nsnapshot_every = 1e-15"), &["time.snapshot_every", "longer interval"]),
    (Replace("end = 1e-6", "end = 1e-6\nsnapshots = [\"x\"]"), &["time.snapshots.0: must be a number"]),
    // Steps that never get to the end, by the side that has them.
    (Replace("end = 1e-6", "end = 1e3"), &["time.end: 1000.0 s are", "steps of", "more than 1e9: the fluid has cells of", "fluid.ambient", "time.cfl = 0.45", "end earlier"]),
    (Replace("density = 1.2", "density = 1e-40"), &["time.end", "m/s in fluid.region.0", "density, pressure, velocity", "wider cells (fluid.z"]),
    (Replace("material = \"structural-steel\"", "material = { density = 1e-30, young = 1e11, poisson = 0.3 }"), &["time.end", "the solid has cells of", "solid.material", "c1, or the moduli and density"]),
    // Magnitudes of which products cannot be held.
    (Replace("end = 1e-6", "end = 1e-61"), &["time.end: must be 1e-60 at least, got 1e-61", "in s"]),
    (Replace("pressure = 1e6", "pressure = 1e61"), &["fluid.ambient.pressure: must not exceed 1e60 in magnitude, got 1e61", "in Pa"]),
    (Replace("r = [0.0, 0.01]", "r = [0.0, 1e-61]"), &["fluid.r: must be 1e-60 m wide at least", "further apart"]),
    (Replace("\"structural-steel\"", "{ density = 1e-61, c1 = 5990, c2 = 3458 }"), &["solid.material: density 1e-61 kg/m3", "1e-60 to 1e60", "belong together"]),
    // Grids.
    (Replace("cells = [4, 4]", "cells = [0, 4]"), &["fluid.cells.0: must be from 1 to", "got 0"]),
    (Replace("cells = [4, 4]", "cells = [-4, 4]"), &["fluid.cells.0", "got -4", "whole number from 1"]),
    (Replace("cells = [4, 4]", "cells = [4.0, 4]"), &["fluid.cells.0: must be a whole number", "4.0"]),
    (Replace("cells = [4, 4]", "cells = [4]"), &["fluid.cells: must be two whole numbers, got 1"]),
    (Replace("cells = [4, 4]", "cells = [6, 5]"), &["fluid.cells: the finest grid has 48 x 40 cells", "blocks of 16", "nearest that is: cells = [6, 6], finest 48 x 48", "levels = 4"]),
    (Replace("cells = [4, 4]\nlevels = 3", "cells = [5, 5]"), &["fluid.cells: the finest grid has 5 x 5", "cells = [16, 16]", "levels = 4"]),
    (Replace("levels = 3", "levels = 21"), &["fluid.levels: must be from 0 to 20, got 21"]),
    (Replace("levels = 3", "levels = 20"), &["fluid.cells", "more than 1048576"]),
    (Replace("z = [0.0, 0.01]", "z = [0.01, 0.0]"), &["fluid.z: must increase", "z = [0.0, 0.01]"]),
    (Replace("r = [0.0, 0.01]", "r = [-0.01, 0.01]"), &["fluid.r", "no negative r", "planar"]),
    (Replace("r = [0.0, 0.01]", "r = [0.001, 0.01]"), &["fluid.r", "must start at the axis", "start at r = 0.0"]),
    (Replace("z = [-0.01, 0.0]", "z = [-0.01, -0.001]"), &["solid.z: the domains do not meet", "z = [-0.01, 0.0]"]),
    (Replace("z = [-0.01, 0.0]\nr = [0.0, 0.01]", "z = [-0.01, 0.0]\nr = [0.0, 0.02]"), &["solid.r: the domains do not meet", "make both ranges r = [0.0, 0.01]"]),
    // Adaptation.
    (Replace("[fluid.liquid]", "adapt = \"no\"\n[fluid.liquid]"), &["fluid.adapt: must be true or false", "the string \"no\"", "without quotes"]),
    (Replace("[fluid.liquid]", "adapts = true\n[fluid.liquid]"), &["fluid.adapts: unknown key", "did you mean `adapt`?"]),
    (Replace("[fluid.liquid]", "epsilon = 1.0\n[fluid.liquid]"), &["fluid.epsilon: must lie in (0, 1), got 1.0", "it follows from `error`"]),
    (Replace("[fluid.liquid]", "error = 0\n[fluid.liquid]"), &["fluid.error: must lie in (0, 1), got 0.0", "0.01 is the default"]),
    (Replace("[fluid.liquid]", "error = 1e-3\nepsilon = 1e-4\n[fluid.liquid]"), &["fluid.error: `error` sets the thresholds", "give `error` alone"]),
    (Replace("[fluid.liquid]", "epsilon = 0\n[fluid.liquid]"), &["fluid.epsilon: must lie in (0, 1), got 0.0"]),
    (Replace("[fluid.liquid]", "adapt_every = 0\n[fluid.liquid]"), &["fluid.adapt_every: must be from 1 to 1000, got 0"]),
    (Replace("[fluid.liquid]", "adapt_every = 1.5\n[fluid.liquid]"), &["fluid.adapt_every: must be a whole number", "1.5"]),
    (Replace("[fluid.liquid]", "scale_pressure = -1.0\n[fluid.liquid]"), &["fluid.scale_pressure: must be positive, got -1.0", "in Pa"]),
    (Replace("[fluid.liquid]", "scale_density = 0\n[fluid.liquid]"), &["fluid.scale_density: must be positive, got 0.0", "in kg/m3"]),
    (Replace("[fluid.liquid]", "scale_stress = 1e6\n[fluid.liquid]"), &["fluid.scale_stress: unknown key", "`scale_pressure`"]),
    (Replace("material =", "scale_stress = 0\nmaterial ="), &["solid.scale_stress: must be positive, got 0.0", "in Pa"]),
    (Append("[[fluid.refine]]\nshape = \"interface\""), &["fluid.refine.0: neither at_least nor at_most is given", "levels from 0 to 3"]),
    (Append("[[fluid.refine]]\nshape = \"interface\"\nat_least = 4"), &["fluid.refine.0.at_least: must be from 0 to 3, got 4"]),
    (Append("[[solid.refine]]\nshape = \"interface\"\nat_least = 3\nat_most = 2"), &["solid.refine.0.at_least: at_least = 3 is above at_most = 2", "the coarser"]),
    (Append("[[fluid.refine]]\nat_least = 3"), &["fluid.refine.0.shape: `shape` is missing", "\"interface\""]),
    (Append("[[fluid.refine]]\nshape = \"spere\"\nat_least = 3"), &["fluid.refine.0.shape", "did you mean `sphere`?"]),
    (Append("[[fluid.refine]]\nshape = \"sphere\"\nat_least = 3\nradius = 0"), &["fluid.refine.0.centre: `centre` is missing", "fluid.refine.0.radius: must be positive, got 0.0"]),
    (Append("[[fluid.refine]]\nshape = \"sphere\"\nat_least = 3\ncentre = [0, 0]\nradius = 1e-3\nwhere = \"out\""), &["fluid.refine.0.where", "`out`", "`outside`"]),
    (Append("[[fluid.refine]]\nshape = \"box\"\nat_least = 3\nz = [0.002, 0.001]\nr = [0, 0.001]"), &["fluid.refine.0.z: must increase", "[0.001, 0.002]"]),
    (Append("[[fluid.refine]]\nshape = \"box\"\nwhere = \"outside\"\nat_least = 3\nz = [0, 0.001]\nr = [0, 0.001]"), &["fluid.refine.0.where: unknown key"]),
    (Whole("[time]\nend = 1\n[coupling]\nscheme = \"none\"\n[solid]\nz = [0, 1]\nr = [0, 1]\ncells = [16, 16]\nlevels = 2\nmaterial = \"copper\"\n[[solid.refine]]\nshape = \"interface\"\nat_least = 2"), &["solid.refine.0.shape: scheme = \"none\" has no interface", "\"box\""]),
    // Equations of state and what fills the fluid.
    (Replace("gamma = 7.15", "gamma = 1.0"), &["fluid.liquid.gamma: must be greater than 1, got 1.0", "7.15 for water"]),
    (Replace("pi = 3e8", "pi = -3e8"), &["fluid.liquid.pi: must not be negative", "3e8 Pa for water"]),
    (Replace("density = 1000.0", "density = -1000.0"), &["fluid.ambient.density: must be positive, got -1000.0", "kg/m3"]),
    (Replace("pressure = 1e6", "pressure = -3e8"), &["fluid.ambient.pressure", "p + pi > 0", "above -300000000.0 Pa"]),
    (Replace("pressure = 1e5", "pressure = -1e5"), &["fluid.region.0.pressure", "p + pi > 0", "above"]),
    (Replace("phase = \"gas\"", "phase = \"gass\""), &["fluid.region.0.phase", "did you mean `gas`?"]),
    (Replace("phase = \"gas\"\n", ""), &["fluid.region.0.phase: `phase` is missing", "\"gas\""]),
    (Replace("shape = \"sphere\"", "shape = \"circle\""), &["fluid.region.0.shape", "unknown name `circle`", "`sphere`, `box`"]),
    (Replace("radius = 0.002", "radius = -0.002"), &["fluid.region.0.radius: must be positive, got -0.002", "in m", "bad.toml:19:10"]),
    (Replace("centre = [0.004, 0.0]", "centre = [0.04, 0.0]"), &["fluid.region.0.centre", "outside the fluid", "z = 0.0 to 0.01 m"]),
    (Replace("centre = [0.004, 0.0]", "centre = [0.004, 0.001]"), &["fluid.region.0.centre", "on the axis", "[0.004, 0.0]"]),
    (Append("[[fluid.region]]\nshape = \"box\"\nz = [0.02, 0.03]\nr = [0.0, 0.01]\nphase = \"gas\"\ndensity = 1\npressure = 1e5"), &["fluid.region.1.z", "lies outside the fluid"]),
    (Append("[[fluid.pulse]]\nshape = \"sphere\"\ncentre = [0.004, 0.0]\nwidth = 0.0\namplitude = 1e4"), &["fluid.pulse.0.width: must be positive"]),
    (Append("[[fluid.pulse]]\nshape = \"sphere\"\ncentre = [0.004, 0.0]\nwidth = 1e-3\namplitude = -4e8"), &["fluid.pulse.0.amplitude", "p + pi > 0", "smaller amplitude"]),
    (Append("[[fluid.pulse]]\nshape = \"plane\"\ncentre = 0.004\nwidth = 1e-3\namplitude = 1e4\ndirection = [0, 0]"), &["fluid.pulse.0.direction: has no length", "[1.0, 0.0]"]),
    (Append("[[fluid.pulse]]\nshape = \"plane\"\ncentre = 0.004\nwidth = 1e-3\namplitude = 1e4\ndirection = [1, 1]"), &["fluid.pulse.0.direction", "goes along z"]),
    (Append("[[fluid.pulse]]\nshape = \"sphere\"\ncentre = [0.004, 0]\nwidth = 1e-3\namplitude = 1e4\ndirection = [1, 0]"), &["fluid.pulse.0.direction: unknown key"]),
    (Append("[fluid.gas]\ngamma = 0.4"), &["fluid.gas.gamma: must be greater than 1"]),
    // The pressure of the start.
    (Sets(&["fluid.initial_pressure=raileigh"]), &["fluid.initial_pressure", "did you mean `rayleigh`?", "`uniform`"]),
    (Sets(&["fluid.initial_pressure=rayleigh", "fluid.region.0.phase=liquid"]), &["fluid.initial_pressure: \"rayleigh\"", "no region is gas", "[[fluid.region]]", "\"uniform\""]),
    (Sets(&["fluid.initial_pressure=rayleigh", "fluid.ambient.phase=gas"]), &["fluid.initial_pressure: \"rayleigh\"", "the ambient phase is gas", "\"liquid\""]),
    (Sets(&["fluid.initial_pressure=rayleigh", "fluid.region=[{ shape = \"box\", z = [1e-3, 2e-3], r = [0, 1e-3], phase = \"gas\", density = 1, pressure = 1e5 }]"]), &["fluid.initial_pressure: \"rayleigh\"", "the gas of region 0 is none", "make fluid.region.0 a \"sphere\""]),
    (Sets(&["fluid.initial_pressure=rayleigh", "fluid.region.0.radius=0.004"]), &["fluid.initial_pressure: \"rayleigh\"", "region 0 is 0.004 m above it with a radius of 0.004 m", "move fluid.region.0 up"]),
    (Sets(&["fluid.initial_pressure=rayleigh", "fluid.region=[{ shape = \"sphere\", centre = [0.003, 0], radius = 1e-3, phase = \"gas\", density = 1, pressure = 1e5 }, { shape = \"sphere\", centre = [0.005, 0], radius = 1.5e-3, phase = \"gas\", density = 1, pressure = 1e5 }]"]), &["fluid.initial_pressure: \"rayleigh\"", "regions 0 and 1 overlap", "fluid.region.0 and fluid.region.1 apart"]),
    (Sets(&["fluid.initial_pressure=rayleigh", "fluid.region=[{ shape = \"sphere\", centre = [0.003, 0], radius = 1e-3, phase = \"gas\", density = 1, pressure = 1e5 }, { shape = \"sphere\", centre = [0.005000001, 0], radius = 1e-3, phase = \"gas\", density = 1, pressure = 9e5 }]"]), &["fluid.initial_pressure: \"rayleigh\"", "too near to each other", "more space"]),
    (Sets(&["fluid.initial_pressure=rayleigh", "geometry=planar"]), &["fluid.initial_pressure: \"rayleigh\"", "the geometry is planar", "axisymmetric"]),
    // Boundaries.
    (Append("[fluid.boundary]\nz_min = \"wall\""), &["fluid.boundary.z_min", "is the interface", "remove `z_min`"]),
    (Append("[fluid.boundary]\nr_min = \"wall\""), &["fluid.boundary.r_min", "is the axis"]),
    (Append("[fluid.boundary]\nz_max = \"open\""), &["fluid.boundary.z_max", "`open`", "`non-reflecting`"]),
    (Append("[fluid.boundary]\nz_max = \"periodic\""), &["fluid.boundary.z_max", "z_min, is not periodic", "both sides"]),
    (Append("[fluid.boundary]\nz_max = \"inflow\""), &["fluid.inflow", "pressure history is missing", "[fluid.inflow]"]),
    (Append("[fluid.inflow]\npressure = [[0.0, 1e5]]"), &["fluid.inflow: no side is an \"inflow\"", "remove the table"]),
    (Append("[fluid.boundary]\nz_max = \"inflow\"\n[fluid.inflow]\npressure = [[1e-6, 1e5], [0.0, 1e6]]"), &["fluid.inflow.pressure: times must ascend"]),
    (Append("[fluid.boundary]\nz_max = \"inflow\"\n[fluid.inflow]\npressure = []"), &["fluid.inflow.pressure: is empty"]),
    (Append("[fluid.boundary]\nz_max = \"inflow\"\n[fluid.inflow]\npressure = [[0.0, -4e8]]"), &["fluid.inflow.pressure", "p + pi > 0", "above"]),
    (Append("[solid.boundary]\nz_max = \"free\""), &["solid.boundary.z_max", "is the interface"]),
    (Append("[solid.boundary]\nr_max = \"wall\""), &["solid.boundary.r_max", "`wall`", "`symmetry`"]),
    // Names.
    (Replace("[fluid.liquid]", "riemann = \"hlc\"\n[fluid.liquid]"), &["fluid.riemann", "did you mean `hllc`?"]),
    (Replace("[fluid.liquid]", "model = \"abgrall\"\n[fluid.liquid]"), &["fluid.model", "`saurel-abgrall`"]),
    (Replace("[fluid.liquid]", "limiter = 2\n[fluid.liquid]"), &["fluid.limiter: must be a name in quotes", "`minmod`"]),
    // Materials.
    (Replace("\"structural-steel\"", "\"structural-stel\""), &["solid.material: unknown material", "did you mean `structural-steel`?", "`copper`"]),
    (Replace("\"structural-steel\"", "7"), &["solid.material: must be a material's name or a table", "cav materials"]),
    (Replace("material = \"structural-steel\"", ""), &["solid.material: `material` is missing", "[solid.material]"]),
    (Replace("\"structural-steel\"", "{ density = 7800, c1 = 5990 }"), &["solid.material.c2: `c2` is missing", "exactly one pair"]),
    (Replace("\"structural-steel\"", "{ density = 7800 }"), &["solid.material: neither speeds nor moduli", "exactly one pair"]),
    (Replace("\"structural-steel\"", "{ density = 7800, c1 = 5990, c2 = 3458, young = 2e11, poisson = 0.3 }"), &["solid.material: c1/c2 and young/poisson", "exactly one pair"]),
    (Replace("\"structural-steel\"", "{ c1 = 5990, c2 = 3458 }"), &["solid.material.density: `density` is missing", "kg/m3"]),
    (Replace("\"structural-steel\"", "{ density = 7800, c1 = 3458, c2 = 5990 }"), &["solid.material.c1", "must exceed c2 * sqrt(4/3)", "faster"]),
    (Replace("\"structural-steel\"", "{ density = 7800, young = 2e11, poisson = 0.5 }"), &["solid.material.poisson: poisson must lie between -1 and 0.5", "0.25 to 0.35"]),
    (Replace("\"structural-steel\"", "{ density = 7800, lambda = -1e11, mu = 1e11 }"), &["solid.material.lambda", "must exceed -2/3 mu"]),
    (Replace("\"structural-steel\"", "{ density = 7800, c1 = 5990, c2 = 3458, yield_strength = 0 }"), &["solid.material.yield_strength", "must be positive"]),
    (Append("[[solid.pulse]]\ncentre = [-0.005, 0.001]\nwidth = 1e-3\namplitude = 1e-9"), &["solid.pulse.0.centre", "on the axis"]),
    // Coupling.
    (Replace("scheme = \"riemann\"", "scheme = \"reimann\""), &["coupling.scheme", "did you mean `riemann`?"]),
    (Replace("scheme = \"riemann\"", "scheme = \"none\""), &["coupling.scheme", "one medium alone", "remove [fluid] or [solid]"]),
    (Replace("scheme = \"riemann\"", "kappa = \"printed\""), &["coupling.kappa", "only scheme = \"weak\""]),
    (Replace("scheme = \"riemann\"", "step_ratio = 17"), &["coupling.step_ratio", "17", "1 to 16"]),
    (Replace("scheme = \"riemann\"", "scheme = \"weak\"\nstep_ratio = 4"), &["coupling.step_ratio", "both sides make the same steps", "\"riemann\""]),
    (Replace("scheme = \"riemann\"", "scheme = \"external\""), &["coupling.scheme", "for one medium, but both are there", "leave out what the other program is"]),
    (Replace("scheme = \"riemann\"", "scheme = \"strong\"\nstep_ratio = 2"), &["coupling.step_ratio", "scheme = \"strong\" both sides make the same steps"]),
    (Replace("scheme = \"riemann\"", "first = \"solid\""), &["coupling.first", "only scheme = \"weak\" or \"strong\" knows this key"]),
    (Replace("scheme = \"riemann\"", "scheme = \"strong\"\nfirst = \"slid\""), &["coupling.first", "did you mean `solid`?"]),
    (Replace("scheme = \"riemann\"", "scheme = \"strong\"\ntolerance = 1.0\nmax_iterations = 0"), &["coupling.tolerance: must be above 0 and below 1, got 1.0", "coupling.max_iterations", "1 to 10000"]),
    (Replace("scheme = \"riemann\"", "scheme = \"explicit\"\ntolerance = 1e-3\nmax_iterations = 3"), &["coupling.tolerance: only scheme = \"strong\"", "coupling.max_iterations: only scheme = \"strong\""]),
    (Replace("scheme = \"riemann\"", "patience = -1"), &["coupling.patience: must be positive"]),
    (Replace("scheme = \"riemann\"", "patience = 1e10\nconnect_timeout = 1e-4"), &["coupling.patience: must be from 0.001 to 1e9 s, got 10000000000.0", "coupling.connect_timeout: must be from", "give seconds from 0.001 to 1e9"]),
    (Replace("scheme = \"riemann\"", "scheme = \"load\""), &["coupling.scheme", "for a solid alone", "remove [fluid]", "needs a load", "[coupling.load]"]),
    (Append("[coupling.load]\namplitude = 1e6\nradius = 1e-3\nhistory = [[0.0, 1.0]]"), &["coupling.load: only scheme = \"load\" has a load", "remove it"]),
    (Sets(&["coupling.scheme=load", "coupling.load={ amplitude = \"x\", radius = -1, histroy = [] }"]), &["coupling.load.amplitude: must be a number", "in Pa", "coupling.load.radius: must be positive, got -1.0", "in m", "unknown key `histroy`", "did you mean `history`?", "`history = [[t, value], ...]` in s and 1"]),
    (Sets(&["coupling.scheme=load", "coupling.load={ amplitude = 1, radius = 1, history = [[1, 0], [0, 1]] }"]), &["coupling.load.history: times must ascend"]),
    (Whole("[time]\nend = 1\n[coupling]\nscheme = \"load\""), &["scheme = \"load\" needs a [solid]", "write [solid]", "needs a load"]),
    (Whole("[time]\nend = 1\n[coupling]\nscheme = \"none\""), &["neither a [fluid] nor a [solid]", "write one"]),
    (Whole("[time]\nend = 1\n[coupling]\nscheme = \"rigid\""), &["scheme = \"rigid\" needs a [fluid]", "write [fluid]"]),
    (Whole("[time]\nend = 1\n[fluid]"), &["there is no [solid]", "\"rigid\"", "fluid.liquid: `liquid` is missing", "fluid.ambient", "fluid.cells"]),
    // Probes and output.
    (Replace("name = \"wall\"", "name = \"the wall\""), &["probe.0.name", "letters, digits"]),
    (Append("[[probe]]\nname = \"wall\"\nposition = [0.0, 0.0]\nmedium = \"solid\""), &["probe.1.name: another probe is called `wall`"]),
    (Replace("position = [0.0, 0.0]", "position = [-0.001, 0.0]"), &["probe.0.position", "outside the fluid", "z = 0.0 to 0.01"]),
    (Replace("position = [0.0, 0.0]", "position = 0.0"), &["probe.0.position: must be two numbers"]),
    (Replace("medium = \"fluid\"", "medium = \"water\""), &["probe.0.medium", "`fluid`, `solid`"]),
    (Append("[output]\nfields = [\"preasure\"]"), &["output.fields.0: unknown field `preasure`", "did you mean `pressure`?"]),
    (Append("[output]\ncompression = 10"), &["output.compression: must be from 0 to 9, got 10"]),
    (Append("[output]\ninterface_every = 1e-13"), &["output.interface_every: 1e-13 s means more than 1e6 rows until time.end = 1e-6 s", "s or more"]),
    (Append("[output]\ninterface_every = 0"), &["output.interface_every: must be positive"]),
    (Append("[output]\ndirectory = \"\""), &["output.directory: is empty"]),
    // Changes from the command line.
    (Sets(&["time.end"]), &["`--set time.end` has no `=`", "KEY=VALUE"]),
    (Sets(&["time..end=1"]), &["empty key"]),
    (Sets(&["fluid.region.1.radius=1e-3"]), &["fluid.region.1.radius", "no element `1`", "one element, number 0"]),
    (Sets(&["fluid.region.x.radius=1e-3"]), &["`fluid.region` has no element `x`"]),
    (Sets(&["fluid.pulse.0.width=1e-3"]), &["there is no array `fluid.pulse`"]),
    (Sets(&["time.end.late=1"]), &["`time.end` is 1e-6 and has no keys", "set the whole of it"]),
    (Sets(&["fluid.z=[0, 1"]), &["fluid.z", "no TOML value", "close the brackets"]),
    (Sets(&["fluid.region.0=3"]), &["fluid.region.0", "whole table"]),
    (Sets(&["fluid.region.0.radius=-1"]), &["bad.toml with --set:", "fluid.region.0.radius: must be positive, got -1"]),
    (Sets(&["fluid.limitter=mc"]), &["unknown key `limitter`", "did you mean `limiter`?"]),
];

#[test]
fn every_bad_case_is_refused_with_key_and_remedy() {
    assert!(BAD.len() >= 35);
    good();
    let mut wrong = String::new();
    for (number, (edit, fragments)) in BAD.iter().enumerate() {
        match read(edit) {
            Ok(_) => wrong += &format!("row {number} ({fragments:?}) was accepted\n"),
            Err(errors) => {
                let text = errors.to_string();
                assert!(errors.faults().iter().all(|fault| !fault.message.contains('\u{1b}')));
                for missing in fragments.iter().filter(|fragment| !text.contains(**fragment)) {
                    wrong += &format!("row {number}: no `{missing}` in:\n{text}\n\n");
                }
                for fault in errors.faults() {
                    assert!(fault.help.as_ref().is_some_and(|help| !help.is_empty()), "{fault}: no remedy");
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn all_faults_of_a_case_come_together_and_are_drawn() {
    let text = GOOD.replace("gamma = 7.15", "gamma = 0.9").replace("radius = 0.002", "raduis = 0.002");
    let errors = Case::from_toml(&text, "bubble", &[]).expect_err("two mistakes");
    assert_eq!(errors.faults().len(), 3, "{errors}");
    let drawn = errors.render(false);
    assert!(!drawn.contains('\u{1b}'), "{drawn}");
    for part in ["gamma = 0.9", "raduis = 0.002", "bubble.toml:11:9", "did you mean `radius`?"] {
        assert!(drawn.contains(part), "no `{part}` in:\n{drawn}");
    }
    assert!(errors.render(true).contains('\u{1b}'));
}

proptest::proptest! {
    /// Whatever a line is replaced by, reading ends with a case or with faults, and a case can be written out.
    #[test]
    fn damaged_cases_do_not_panic(
        line in 1_usize..32,
        value in "[-+.eE0-9]{1,9}|[\\[\\]{}=\"'.a-z0-9, ]{0,12}|inf|nan|\\[1e308, -1e308\\]|1e308|9223372036854775807",
        set in "(time|fluid|solid|probe)(\\.(end|cells|levels|z|r|region|material|0|1|x)){0,3}=[\\[\\]{}0-9ae.,]{0,5}",
    ) {
        let damaged: Vec<String> = GOOD
            .lines()
            .enumerate()
            .map(|(number, text)| match text.split_once('=') {
                Some((key, _)) if number == line => format!("{key}= {value}"),
                None if number == line => value.clone(),
                _ => text.to_owned(),
            })
            .collect();
        for (text, sets) in [(damaged.join("\n"), vec![]), (GOOD.to_owned(), vec![set])] {
            match Case::from_toml(&text, "damaged", &sets) {
                Ok(case) => {
                    round_trip(&case);
                    cav::case::report(&case);
                }
                Err(errors) => assert!(!errors.faults().is_empty() && !errors.render(false).is_empty()),
            }
        }
    }
}

#[test]
fn a_missing_file_and_a_directory_are_named() {
    for (path, part) in [("no/such/case.toml", "check the path"), ("cases", "give the TOML file")] {
        let errors = Case::load(Path::new(path), &[]).expect_err("no case there").to_string();
        assert!(errors.contains(path) && errors.contains(part), "{errors}");
    }
    let dir = tempfile::tempdir().expect("a temporary directory");
    let path = dir.path().join("binary.toml");
    std::fs::write(&path, [0xff, 0xfe, 0x00]).expect("written");
    let errors = Case::load(&path, &[]).expect_err("no text").to_string();
    assert!(errors.contains("UTF-8"), "{errors}");
}

/// The case files of the repository.
fn shipped() -> Vec<PathBuf> {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(&dir)
        .expect("cases/ is there")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    paths.sort();
    assert!(paths.len() >= 4);
    paths
}

fn load(path: &Path) -> Case {
    Case::load(path, &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Written out in full and read again, a case is the same, and so is its hash.
fn round_trip(case: &Case) {
    let text = case.effective_toml();
    let again = Case::from_toml(&text, &case.name, &[]).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    assert_eq!(again, *case, "{text}");
    assert_eq!(again.hash(), case.hash());
    assert_eq!(again.effective_toml(), text);
}

#[test]
fn shipped_cases_load_without_warnings_and_survive_being_written_out() {
    let listed = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/cases.md"))
        .expect("docs/cases.md is there");
    for path in shipped() {
        let case = load(&path);
        assert!(case.warnings().is_empty(), "{}: {:?}", path.display(), case.warnings());
        round_trip(&case);
        let report = cav::case::report(&case);
        assert!(report.contains("time step") && report.contains("run time"), "{report}");
        let text = std::fs::read_to_string(&path).expect("readable");
        for part in ["# Source:", "# Expected", "# Cost:"] {
            assert!(text.contains(part), "{} does not say `{part}`", path.display());
        }
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        assert!(listed.contains(&name), "docs/cases.md does not list {name}");
    }
}

#[test]
fn every_kind_of_value_survives_being_written_out() {
    round_trip(&good());
    let all = with(&[
        "time.snapshot_every=3.1e-7",
        "fluid.riemann=exact",
        "fluid.limiter=eno",
        "fluid.initial_pressure=rayleigh",
        "fluid.boundary={ z_max = \"inflow\", r_max = \"wall\" }",
        "fluid.inflow.pressure=[[0, 1e6], [0.1e-6, 2e7]]",
        "fluid.pulse=[{ shape = \"plane\", centre = 0.008, width = 1e-3, amplitude = 1e5, direction = [-2, 0] }, \
         { shape = \"sphere\", centre = [0.008, 0], width = 1e-3, amplitude = 1e5 }]",
        "solid.material={ name = \"m\\\"x\", density = 7850, young = 210e9, poisson = 0.29, yield_strength = 3e8 }",
        "solid.initial_stress=hydrostatic",
        "solid.pulse=[{ centre = [-0.004, 0.0], width = 1e-3, amplitude = 1e-9 }]",
        "fluid.epsilon=2e-4",
        "fluid.adapt_every=3",
        "fluid.scale_density=7.5",
        "fluid.refine=[{ shape = \"sphere\", centre = [0.004, 0.0], radius = 1e-3, at_least = 3 }, \
         { shape = \"sphere\", centre = [0.004, 0.0], radius = 5e-3, where = \"outside\", at_most = 2 }, \
         { shape = \"box\", z = [0, 1e-3], r = [1e-3, 2e-3], at_least = 2, at_most = 3 }]",
        "solid.refine=[{ shape = \"interface\", at_least = 3 }]",
        "coupling.scheme=weak",
        "coupling.kappa=jump",
        "coupling.star=acoustic",
        "coupling.connect_timeout=3",
        "output={ directory = \"a \\\"b\\\"\", fields = [\"pressure\"], compression = 0, interface_cells = 7 }",
        "output.interface_every=1e-8",
    ]);
    let times = [0.0, 3.1e-7, 6.2e-7, 9.3e-7, 1e-6];
    assert!(all.time.snapshots.iter().zip(times).all(|(a, b)| (a - b).abs() < 1e-18), "{:?}", all.time);
    assert_eq!(all.time.snapshots.len(), times.len());
    let direction = all.fluid.as_ref().map(|fluid| fluid.initial.pulses[0].shape);
    assert_eq!(direction, Some(PulseShape::Plane { direction: Some([-1.0, 0.0]) }));
    round_trip(&all);

    let planar = "geometry = \"planar\"\n[time]\nend = 1.0\n[solid]\nz = [0, 1]\nr = [-1, 0]\ncells = [16, 16]\n\
        material = \"gelatine\"\n[solid.boundary]\nz_min = \"periodic\"\nz_max = \"periodic\"\n[coupling]\nscheme = \"none\"\n";
    let planar = Case::from_toml(planar, "planar", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let sides = planar.solid.as_ref().map(|solid| solid.boundary);
    let periodic = solid::Boundary::Periodic;
    assert_eq!(sides, Some([periodic, periodic, solid::Boundary::Symmetry, solid::Boundary::Absorbing]));
    round_trip(&planar);
}

/// What a wave loses to adaptation is the same whether there is a bubble beside it or not.
#[test]
fn a_bubble_does_not_coarsen_the_waves_beside_it() {
    const PULSE: &str =
        "fluid.pulse=[{ shape = \"sphere\", centre = [0.002, 0.0], width = 1e-3, amplitude = 1e4 }]";
    // In pascals, on the finest level of the fluid and of the solid.
    let thresholds = |sets: &[&str]| {
        let case = with(sets);
        let (fluid, solid) = (case.fluid.expect("a fluid"), case.solid.expect("a solid"));
        let epsilon = solid.grid.adaptation.expect("adaptive").epsilon;
        [fluid.wave_epsilon * fluid.scale_pressure, epsilon * solid.scale_stress]
    };
    let alone = thresholds(&[PULSE, "fluid.region=[]"]);
    let beside = thresholds(&[PULSE]);
    for (beside, alone) in beside.into_iter().zip(alone) {
        assert!((beside / alone - 1.0).abs() < 0.06, "{beside} Pa, not {alone} Pa: ε has two digits");
    }
}

#[test]
fn grids_adapt_unless_they_are_told_not_to_or_cannot() {
    use mesh::{LevelBound, Side, Zone};
    let fluid = good().fluid.expect("a fluid");
    let adaptation = fluid.grid.adaptation.as_ref().expect("adaptive");
    assert_eq!((fluid.grid.root_level(), fluid.grid.cells_on(2)), (2, [16, 16]));
    assert_eq!((adaptation.epsilon, fluid.wave_epsilon), (3e-4, 1e-4));
    let solid = good().solid.expect("a solid");
    assert_eq!(solid.grid.adaptation.map(|adaptation| adaptation.epsilon), Some(1e-4));

    assert_eq!((adaptation.every, adaptation.bounds.len()), (8, 0));
    // The bubble's differences to the liquid; the solid's scale is the fluid's.
    assert_eq!((fluid.scale_pressure, fluid.scale_density), (9e5, 998.8));
    assert_eq!(good().solid.map(|solid| solid.scale_stress), Some(9e5));

    let levels = |sets: &[&str]| with(sets).fluid.expect("a fluid").grid.adaptation;
    assert_eq!(levels(&["fluid.adapt=false"]), None);
    assert_eq!(levels(&["fluid.cells=[32, 48]", "fluid.levels=0"]), None);
    assert_eq!(levels(&["fluid.levels=2"]), None, "the roots are on level 2");

    // Levels below the roots' are the roots'; what is not given does not bound.
    let case = with(&[
        "fluid.refine=[{ shape = \"sphere\", centre = [0, 0], radius = 0.01, where = \"outside\", at_most = 0 }]",
        "solid.refine=[{ shape = \"interface\", at_least = 3 }, { shape = \"box\", z = [-1, 0], r = [0, 1], at_least = 1 }]",
    ]);
    let bounds = |grid: &cav::case::GridCase| grid.adaptation.as_ref().map(|a| a.bounds.clone());
    let zone = Zone::Beyond { centre: [0.0; 2], radius: 0.01 };
    let outside = LevelBound { zone, at_least: 2, at_most: 2 };
    assert_eq!(case.fluid.as_ref().and_then(|fluid| bounds(&fluid.grid)), Some(vec![outside]));
    let surface = LevelBound { zone: Zone::Along(Side::ZMax), at_least: 3, at_most: 3 };
    let all = LevelBound { zone: Zone::Box { z: [-1.0, 0.0], r: [0.0, 1.0] }, at_least: 2, at_most: 3 };
    assert_eq!(case.solid.as_ref().and_then(|solid| bounds(&solid.grid)), Some(vec![surface, all]));
    round_trip(&case);

    // A threshold of the fluid is both of its thresholds, unless waves have one of their own.
    let thresholds = |sets: &[&str]| {
        let fluid = with(sets).fluid.expect("a fluid");
        (fluid.grid.adaptation.map(|adaptation| adaptation.epsilon), fluid.wave_epsilon)
    };
    assert_eq!(thresholds(&["fluid.epsilon=2e-3"]), (Some(2e-3), 2e-3));
    assert_eq!(thresholds(&["fluid.epsilon=2e-3", "fluid.epsilon_waves=1e-5"]), (Some(2e-3), 1e-5));
    assert_eq!(thresholds(&["fluid.error=1e-3"]), (Some(3e-5), 1e-5));

    let text = case.effective_toml();
    for part in
        ["adapt = true\nepsilon = 0.0003\nadapt_every = 8", "scale_stress = 900000.0", "where = \"outside\""]
    {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
}

#[test]
fn a_load_on_a_solid_alone_survives_being_written_out() {
    let text = "[time]\nend = 1e-6\n[solid]\nz = [-0.01, 0]\nr = [0, 0.01]\ncells = [16, 16]\nmaterial = \"copper\"\n\
        [coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = -2e6\nradius = 1e-3\n\
        history = [[0, 0], [1e-7, 1.5]]\n[[probe]]\nname = \"s\"\nposition = [0, 0]\nmedium = \"solid\"\n";
    let case = Case::from_toml(text, "load", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    round_trip(&case);
    let load = case.coupling.load.as_ref().expect("the load");
    assert_eq!((load.amplitude, load.radius, load.history.len()), (-2e6, 1e-3, 2));
    let solid = case.solid.as_ref().expect("the solid");
    // Thresholds are relative to the largest pressure of the history.
    assert_eq!(solid.scale_stress, 3e6);
    assert_eq!(solid.boundary[1], solid::Boundary::Interface);
    let stronger =
        Case::from_toml(text, "load", &["coupling.load.amplitude=3e6".to_owned()]).expect("a case");
    assert_ne!(stronger.hash(), case.hash());
}

#[test]
fn sides_that_are_not_named_have_what_the_scheme_means() {
    use fluid::Boundary::{Axis, FarField, Interface, Wall};
    let fluid_sides = |case: &Case| case.fluid.as_ref().map(|fluid| fluid.boundary);
    assert_eq!(fluid_sides(&good()), Some([Interface, FarField, Axis, FarField]));
    assert_eq!(
        good().solid.map(|solid| solid.boundary),
        Some([
            solid::Boundary::Absorbing,
            solid::Boundary::Interface,
            solid::Boundary::Axis,
            solid::Boundary::Absorbing
        ])
    );
    let rigid = with(&["coupling.scheme=rigid", "probe.0.medium=solid"]);
    assert_eq!(fluid_sides(&rigid), Some([Wall, FarField, Axis, FarField]));
    assert!(rigid.solid.is_none() && rigid.probes.is_empty());
    let named = with(&["fluid.boundary={ z_min = \"interface\", r_min = \"axis\" }"]);
    assert_eq!(named, good());
    assert_eq!(rigid.warnings().len(), 2, "{:?}", rigid.warnings());
    round_trip(&rigid);
}

#[test]
fn the_hash_ignores_form_and_output_and_nothing_else() {
    let hash = good().hash();
    let same =
        |text: &str| Case::from_toml(text, "other", &[]).unwrap_or_else(|errors| panic!("{errors}")).hash();
    assert_eq!(same(&format!("# a comment\n{GOOD}\n[output]\ncompression = 9\ndirectory = \"x\"\n")), hash);
    assert_eq!(
        same(&GOOD.replace("1000.0", "1e3").replace("end = 1e-6", "end = 0.000001\ncfl = 0.45")),
        hash
    );
    assert_eq!(same(&GOOD.replace("scheme = \"riemann\"", "patience = 5\nconnect_timeout = 1")), hash);
    let mut hashes = vec![hash];
    for set in [
        "time.end=1.1e-6",
        "time.cfl=0.4",
        "time.snapshots=[5e-7]",
        "fluid.z=[0.0, 0.02]",
        "fluid.levels=4",
        "fluid.cells=[8, 4]",
        "fluid.riemann=exact",
        "fluid.limiter=minmod",
        "fluid.adapt=false",
        "fluid.epsilon=2e-3",
        "fluid.adapt_every=4",
        "fluid.scale_pressure=1e6",
        "fluid.scale_density=1.0",
        "fluid.initial_pressure=rayleigh",
        "fluid.refine=[{ shape = \"interface\", at_least = 3 }]",
        "solid.scale_stress=1e7",
        "fluid.liquid.gamma=7.0",
        "fluid.liquid.pi=3.1e8",
        "fluid.gas.gamma=1.3",
        "fluid.ambient.pressure=1.0000000001e6",
        "fluid.ambient.velocity=[1.0, 0.0]",
        "fluid.region.0.radius=0.0021",
        "fluid.region.0.density=1.3",
        "fluid.boundary.r_max=wall",
        "solid.z=[-0.02, 0.0]",
        "solid.material=aluminium",
        "solid.material=stainless-steel",
        "solid.limiter=eno",
        "solid.initial_stress=hydrostatic",
        "solid.boundary.z_min=fixed",
        "coupling.scheme=weak",
        "coupling={ scheme = \"weak\", first = \"solid\" }",
        "coupling.scheme=explicit",
        "coupling.scheme=strong",
        "coupling={ scheme = \"strong\", first = \"solid\" }",
        "coupling={ scheme = \"strong\", tolerance = 1e-3 }",
        "coupling={ scheme = \"strong\", max_iterations = 7 }",
        "coupling.star=acoustic",
        "probe.0.position=[0.001, 0.0]",
    ] {
        let other = with(&[set]).hash();
        assert!(!hashes.contains(&other), "{set} does not change the hash");
        hashes.push(other);
    }
}

#[test]
fn set_changes_what_it_names() {
    let case =
        with(&["fluid.region.0.radius = 1e-3", "fluid.region.0.centre.0=0.005", "coupling.scheme=\"weak\""]);
    let region = case.fluid.map(|fluid| fluid.initial.regions[0].shape);
    assert_eq!(region, Some(fluid::Shape::Sphere { centre: [0.005, 0.0], radius: 1e-3 }));
    assert_eq!(case.coupling.scheme, coupler::Scheme::Weak);

    // A later change wins, and a name gives way to a table and a table to a name.
    let table = "solid.material={ density = 1000, lambda = 1e9, mu = 1e9 }";
    let material = |sets: &[&str]| with(sets).solid.map(|solid| solid.material);
    assert_eq!(material(&[table]).map(|m| m.density()), Some(1000.0));
    assert_eq!(material(&[table, "solid.material=copper"]), solid::Material::by_name("copper"));
    let text =
        GOOD.replace("material = \"structural-steel\"", "[solid.material]\ndensity = 1\nc1 = 2\nc2 = 1");
    let sets = ["solid.material=copper".to_owned()];
    let case = Case::from_toml(&text, "good", &sets).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(case.solid.map(|solid| solid.material), solid::Material::by_name("copper"));
    assert!(material(&["solid.material=copper", table]).is_some_and(|m| m.name() == "custom"));
}

#[test]
fn the_report_knows_the_papers_case() {
    let case = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012-coarse.toml"));
    let report = cav::case::report(&case);
    for part in [
        "256 x 256 = 65536 cells of 195.3 um",
        "256 blocks of 16 x 16",
        "51.2 cells per radius",
        "stand-off d/R = 2.000",
        "Rayleigh collapse time 40.92 us",
        "reflection coefficient of pressure 0.934501",
        "4 in one of the fluid's",
    ] {
        assert!(report.contains(part), "no `{part}` in:\n{report}");
    }
    assert!(!report.contains("adaptive") && !report.contains("warning"), "{report}");
    let fine = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012.toml"));
    let report = cav::case::report(&fine);
    for part in [
        "adaptive, level 2 to 9: 16 x 16 to 2048 x 2048 cells of 24.41 um",
        "adaptive, level 0 to 9: 16 x 16 to 8192 x 8192 cells of 6.104 um",
        "thresholds on the finest level 50 kPa (0.001 of 50 MPa)",
        "67108864 cells",
        "if all cells were on the finest level",
        "409.6 cells per radius at the finest level",
        "a guess",
    ] {
        assert!(report.contains(part), "no `{part}` in:\n{report}");
    }
    // Two mirrored spheres at one potential: by the series of image charges 11.25 MPa on the plane between them.
    let sets = ["fluid.initial_pressure=rayleigh".to_owned()];
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012-coarse.toml");
    let start = Case::load(&path, &sets).unwrap_or_else(|errors| panic!("{errors}"));
    let report = cav::case::report(&start);
    assert!(report.contains("rayleigh, 11.25 MPa at z_min on the axis"), "{report}");
    // The same bubble above a rigid wall is the rigid case, to the last key.
    let rigid = load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/rigid-wall.toml"));
    let text = case.effective_toml();
    let same = Case::from_toml(&text, "rigid-wall", &["coupling.scheme=rigid".to_owned()]);
    assert_eq!(same.unwrap_or_else(|errors| panic!("{errors}")).hash(), rigid.hash());
    let coarse = Case::load(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dickopp2012-coarse.toml"),
        &["fluid.levels=2".to_owned(), "time.cfl=0.6".to_owned()],
    )
    .unwrap_or_else(|errors| panic!("{errors}"));
    let warnings = coarse.warnings().join("\n");
    assert!(warnings.contains("3.2 cells per radius") && warnings.contains("time.cfl = 0.6"), "{warnings}");
    let table = cav::case::materials_table();
    assert!(table.contains("structural-steel") && table.contains("gelatine"), "{table}");
}
