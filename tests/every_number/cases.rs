//! Tiny cases that have every table and every number between them.

/// Coupled, adaptive, with local steps.
const FULL: &str = r#"
geometry = "axisymmetric"
[time]
end = 4e-8
cfl = 0.4
local_steps = true
snapshots = [1e-8, 2e-8]
[fluid]
z = [0.0, 0.01]
r = [0.0, 0.01]
cells = [16, 16]
levels = 1
epsilon = 1e-3
adapt_every = 2
scale_pressure = 1e6
scale_density = 1e3
[fluid.liquid]
gamma = 7.15
pi = 3e8
[fluid.gas]
gamma = 1.4
pi = 0.0
[fluid.ambient]
density = 1000.0
pressure = 1e6
velocity = [0.0, 0.0]
[[fluid.region]]
shape = "sphere"
centre = [0.004, 0.0]
radius = 0.002
phase = "gas"
density = 1.2
pressure = 1e5
velocity = [0.0, 0.0]
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
[solid]
z = [-0.01, 0.0]
r = [0.0, 0.01]
cells = [16, 16]
levels = 1
epsilon = 1e-3
adapt_every = 2
scale_stress = 1e6
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
[coupling]
scheme = "riemann"
step_ratio = 16
connect_timeout = 10.0
patience = 20.0
[[probe]]
name = "wall"
position = [0.0, 0.0]
medium = "fluid"
[[probe]]
name = "steel"
position = [-0.002, 0.001]
medium = "solid"
[output]
compression = 4
interface_cells = 32
interface_every = 1e-8
"#;

/// The paper's mixture under the strong scheme.
const STRONG: &str = r#"
[time]
end = 1e-7
snapshot_every = 6e-8
[fluid]
z = [0.0, 0.01]
r = [0.0, 0.01]
cells = [16, 16]
model = "saurel-abgrall"
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
cells = [16, 16]
[solid.material]
density = 7800.0
lambda = 1e11
mu = 8e10
[coupling]
scheme = "strong"
tolerance = 1e-5
max_iterations = 20
"#;

/// A solid alone under a load, in plane strain.
const LOAD: &str = r#"
geometry = "planar"
[time]
end = "settled"
longest = 2e-7
[solid]
z = [-0.01, 0.0]
r = [0.0, 0.01]
cells = [16, 16]
levels = 1
[solid.material]
density = 7800.0
c1 = 5900.0
c2 = 3200.0
[coupling]
scheme = "load"
[coupling.load]
amplitude = 1e6
radius = 2e-3
history = [[0.0, 0.0], [1e-7, 1.0]]
[[probe]]
name = "steel"
position = [-0.002, 0.001]
medium = "solid"
"#;

/// Bubbles above a rigid wall, adaptive, with the pressure of the start that is not uniform.
const RAYLEIGH: &str = r#"
[time]
end = 2e-7
local_steps = true
[fluid]
z = [0.0, 0.02]
r = [0.0, 0.02]
cells = [16, 16]
levels = 1
initial_pressure = "rayleigh"
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
[[fluid.region]]
shape = "sphere"
centre = [0.01, 0.0]
radius = 0.002
phase = "gas"
density = 1.2
pressure = 1e5
[coupling]
scheme = "rigid"
[[probe]]
name = "water"
position = [0.002, 0.001]
medium = "fluid"
"#;

/// The numbers of its `[coupling]` are tried in two processes.
pub const IN_TWO: &str = "full";

/// By name.
pub const ALL: [(&str, &str); 4] =
    [("full", FULL), ("strong", STRONG), ("load", LOAD), ("rayleigh", RAYLEIGH)];
