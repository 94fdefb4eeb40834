//! Tiny cases that have every table and every number between them.

use crate::fixture::{AIR, bubble, grid, probe, sensor, water};

/// Coupled, adaptive, with local steps.
fn full() -> String {
    let fluid = grid([0.0, 0.01], 0.01, [16, 16])
        + "levels = 1\nepsilon = 1e-3\nadapt_every = 2\nscale_pressure = 1e6\nscale_density = 1e3\ngravity = -9.81\n";
    let solid = grid([-0.01, 0.0], 0.01, [16, 16])
        + "levels = 1\nepsilon = 1e-3\nadapt_every = 2\nscale_stress = 1e6\ngravity = -9.81\n";
    let at_rest = "velocity = [0.0, 0.0]\n";
    let text = [
        "[time]\nend = 4e-8\ncfl = 0.4\nlocal_steps = true\nsnapshots = [1e-8, 2e-8]\n",
        &water(&fluid, 1e6),
        at_rest,
        &bubble([0.004, 0.0], 0.002, AIR),
        at_rest,
        IN_FLUID,
        "[solid]\n",
        &solid,
        IN_SOLID,
        "[coupling]\nscheme = \"riemann\"\nstep_ratio = 16\nconnect_timeout = 10.0\npatience = 20.0\n",
        &probe("wall", [0.0, 0.0], "fluid"),
        &probe("steel", [-0.002, 0.001], "solid"),
        &sensor("disc", 0.001, 1e-8),
        "[region_of_interest]\ncentre = [0.0, 0.0]\nradius = 0.003\n",
        "[output]\ncompression = 1\ninterface_cells = 32\ninterface_every = 1e-8\nmean_time = 1e-8\n",
    ];
    text.concat()
}

/// What else there is in its fluid.
const IN_FLUID: &str = r#"
[fluid.near_wall]
shock_levels = 1
film_levels = 2
film_cells = 4
[fluid.gas]
gamma = 1.4
pi = 0.0
covolume = 1.5e-3
heat_capacity = 717.5
energy = 0.0
entropy = 0.0
[[fluid.region]]
shape = "box"
z = [0.008, 0.009]
r = [0.004, 0.006]
phase = "liquid"
density = 1001.0
pressure = 1.1e6
[[fluid.pulse]]
shape = "sphere"
centre = [0.008, 0.0]
width = 1e-3
amplitude = 1e5
[[fluid.pulse]]
shape = "plane"
centre = [0.0085, 0.0]
width = 1e-3
amplitude = 1e5
direction = [-1.0, 0.0]
[fluid.tracer]
shape = "box"
z = [0.001, 0.003]
r = [0.0, 0.002]
[[fluid.refine]]
shape = "sphere"
centre = [0.004, 0.0]
radius = 0.001
at_least = 1
[[fluid.refine]]
shape = "outer"
centre = [0.004, 0.0]
radius = 0.004
[fluid.boundary]
z_max = "inflow"
[fluid.inflow]
pressure = [[0.0, 1e6], [1e-7, 1.2e6]]
"#;

/// What there is in its solid.
const IN_SOLID: &str = r#"
[solid.material]
density = 7800.0
young = 2e11
poisson = 0.3
yield_strength = 3e8
[[solid.pulse]]
centre = [-0.004, 0.0]
width = 2e-3
amplitude = 1e-12
[[solid.refine]]
shape = "box"
z = [-0.002, -0.001]
r = [0.0, 0.001]
at_least = 1
at_most = 1
[[solid.refine]]
shape = "interface"
at_least = 1
"#;

/// The paper's mixture under the strong scheme.
fn strong() -> String {
    let text = [
        "[time]\nend = 1e-7\nsnapshot_every = 6e-8\n",
        &water(&(grid([0.0, 0.01], 0.01, [16, 16]) + "model = \"saurel-abgrall\"\n"), 1e6),
        &bubble([0.004, 0.0], 0.002, AIR),
        "[solid]\n",
        &grid([-0.01, 0.0], 0.01, [16, 16]),
        "[solid.material]\ndensity = 7800.0\nlambda = 1e11\nmu = 8e10\n",
        "[coupling]\nscheme = \"strong\"\ntolerance = 1e-5\nmax_iterations = 20\n",
    ];
    text.concat()
}

/// A solid alone under a load, in plane strain.
fn load() -> String {
    let text = [
        "geometry = \"planar\"\n[time]\nend = \"settled\"\nlongest = 2e-7\n[solid]\n",
        &grid([-0.01, 0.0], 0.01, [16, 16]),
        "levels = 1\n[solid.material]\ndensity = 7800.0\nc1 = 5900.0\nc2 = 3200.0\n",
        "[coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = 1e6\nradius = 2e-3\n",
        "history = [[0.0, 0.0], [1e-7, 1.0]]\n",
        &probe("steel", [-0.002, 0.001], "solid"),
    ];
    text.concat()
}

/// Bubbles above a rigid wall, adaptive, with the pressure of the start that is not uniform.
fn rayleigh() -> String {
    let lines = grid([0.0, 0.02], 0.02, [16, 16]) + "levels = 1\ninitial_pressure = \"rayleigh\"\n";
    let text = [
        "[time]\nend = 2e-7\nlocal_steps = true\n",
        &water(&lines, 1e6),
        &bubble([0.004, 0.0], 0.002, AIR),
        &bubble([0.01, 0.0], 0.002, AIR),
        "[coupling]\nscheme = \"rigid\"\n",
        &probe("water", [0.002, 0.001], "fluid"),
    ];
    text.concat()
}

/// A solid alone that yields under a load, with these lines of `[time]`, `[solid]` and `[solid.plasticity]`.
fn yielding_by(time: &str, solid: &str, law: &str) -> String {
    let text = [
        "[time]\n",
        time,
        "[solid]\n",
        &grid([-0.01, 0.0], 0.01, [16, 16]),
        solid,
        "[solid.material]\ndensity = 7800.0\nc1 = 5900.0\nc2 = 3200.0\n[solid.plasticity]\n",
        law,
        "[coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = 2e9\nradius = 3e-3\n",
        "history = [[0.0, 0.0], [1e-7, 1.0]]\n",
    ];
    text.concat()
}

/// With all constants of the Johnson–Cook law.
fn yielding() -> String {
    let law = "law = \"johnson-cook\"\nyield_strength = 3e8\nhardening_modulus = 5e8\nhardening_exponent = 0.3\n\
               rate_coefficient = 0.02\nreference_rate = 1.0\nsoftening_exponent = 1.0\nmelting_temperature = 1700.0\n\
               reference_temperature = 293.0\nheat_capacity = 480.0\ntaylor_quinney = 0.9\n";
    yielding_by("end = 2e-7\nlocal_steps = true\n", "levels = 1\nadapt = true\n", law)
}

/// By a table.
fn table() -> String {
    let law =
        "law = \"table\"\ntable = [[0.0, 3e8], [0.1, 4e8]]\nrate_coefficient = 0.02\nreference_rate = 1.0\n";
    yielding_by("end = 1e-7\n", "", law)
}

/// A bubble by what is in it, which grows and whose gas is cut, on a grid that follows it.
fn laser() -> String {
    let lines = grid([0.0, 0.01], 0.01, [16, 16]) + "levels = 2\n";
    let text = [
        "[time]\nend = 2e-7\n",
        &water(&lines, 1e6),
        "[fluid.bubble]\ncentre = [0.005, 0.0]\nradius = 1e-3\nequilibrium_radius = 2e-3\nvapour_pressure = 2339.0\n\
         vapour_gamma = 1.33\ngas_density = 100.0\ntemperature = 300.0\nsurface_tension = 0.07\ncells_per_radius = 6.0\n\
         reset = { equilibrium_radius = 5e-4 }\n[coupling]\nscheme = \"none\"\n",
    ];
    text.concat()
}

/// With viscosity and surface tension.
fn sticky() -> String {
    let text = [
        "[time]\nend = 1e-7\n",
        &water(&grid([0.0, 0.02], 0.02, [16, 16]), 1e6),
        &bubble([0.01, 0.0], 0.004, AIR),
        "[fluid.terms]\nsurface_tension = 0.0728\ncontact_angle = 90.0\n[fluid.terms.viscosity]\nliquid = 1e-3\n\
         gas = 1.8e-5\nbulk_liquid = 2.5e-3\nbulk_gas = 1e-5\n[coupling]\nscheme = \"rigid\"\n",
    ];
    text.concat()
}

/// A bubble of a gas of the library in water of the library, beside a rigid wall, with some terms.
fn with_terms(gas: &str, state: [f64; 2], terms: &str) -> String {
    let text = [
        "[time]\nend = 1e-6\n[fluid]\n",
        &grid([0.0, 0.02], 0.02, [16, 16]),
        &format!("[fluid.liquid]\nfluid = \"water-nasg\"\n[fluid.gas]\nfluid = \"{gas}\"\n"),
        "[fluid.ambient]\ndensity = 1050.0\npressure = 1e6\n",
        &bubble([0.01, 0.0], 0.004, state),
        terms,
        "[coupling]\nscheme = \"rigid\"\n",
    ];
    text.concat()
}

/// Water and its vapour, which change into each other, and water that opens.
fn changing() -> String {
    let terms = "[fluid.terms.phase_change]\nlaw = \"hertz-knudsen\"\naccommodation = 0.5\nvapour_fraction = 0.9\n\
                 [fluid.terms.cavitation]\nthreshold = -1e5\n";
    with_terms("water-vapour", [0.6, 1e5], terms)
}

/// With conduction, and a wall that conducts.
fn conducting() -> String {
    let terms = "[fluid.terms.conduction]\nliquid = 0.6\ngas = 0.026\nthin_gas = \"super-time-stepping\"\nwall = \"conducting\"\n\
                 wall_temperature = 293.15\nwall_effusivity = 8000.0\n[fluid.terms.viscosity]\nliquid = 1e-3\ngas = 1.8e-5\n\
                 thin_gas = \"super-time-stepping\"\n";
    with_terms("air", AIR, terms)
}

/// The numbers of its `[coupling]` are tried in two processes.
pub const IN_TWO: &str = "full";

/// By name.
pub fn all() -> [(&'static str, String); 10] {
    [
        ("full", full()),
        ("strong", strong()),
        ("load", load()),
        ("rayleigh", rayleigh()),
        ("yielding", yielding()),
        ("table", table()),
        ("laser", laser()),
        ("changing", changing()),
        ("sticky", sticky()),
        ("conducting", conducting()),
    ]
}
