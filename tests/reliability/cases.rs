//! Small cases in which everything happens that a checkpoint has to hold.

/// A bubble over steel, adaptive on three levels, up to 64 × 64 cells a side.
pub const COUPLED: &str = r#"
[time]
end = 4e-5
snapshot_every = 1.3e-6
[fluid]
z = [0.01, 0.06]
r = [0.0, 0.05]
cells = [4, 4]
levels = 4
adapt_every = 3
limiter = "minmod"
[fluid.liquid]
gamma = 7.15
pi = 3e8
[fluid.gas]
gamma = 1.4
pi = 0.0
[fluid.ambient]
phase = "liquid"
density = 1000.0
pressure = 5e7
[[fluid.region]]
shape = "sphere"
centre = [0.03, 0.0]
radius = 0.01
phase = "gas"
density = 0.0266
pressure = 2118.0
[solid]
z = [-0.04, 0.01]
r = [0.0, 0.05]
cells = [4, 4]
levels = 4
adapt_every = 3
limiter = "minmod"
material = "structural-steel"
[[probe]]
name = "wall"
position = [0.01, 0.0]
medium = "fluid"
[[probe]]
name = "steel"
position = [0.01, 0.004]
medium = "solid"
"#;

/// A second bubble above the first.
pub const SECOND_BUBBLE: &str = r#"
[[fluid.region]]
shape = "sphere"
centre = [0.048, 0.0]
radius = 0.006
phase = "gas"
density = 0.0266
pressure = 2118.0
"#;

/// The fluid above a rigid wall, from the text of a coupled case.
pub fn fluid_alone() -> String {
    let head = COUPLED.split("[solid]").next().unwrap();
    format!("{head}[coupling]\nscheme = \"rigid\"\n")
}

/// A spherical wave in an elastic solid, adaptive.
pub const SOLID: &str = r#"
[time]
end = 6e-6
snapshot_every = 1.3e-6
[solid]
z = [0.0, 0.05]
r = [0.0, 0.05]
cells = [4, 4]
levels = 4
adapt_every = 3
material = "structural-steel"
[coupling]
scheme = "none"
[[solid.pulse]]
centre = [0.02, 0.0]
width = 0.004
amplitude = 1e-9
[[probe]]
name = "steel"
position = [0.03, 0.004]
medium = "solid"
"#;

/// A load on a solid's surface, adaptive.
pub const LOADED: &str = r#"
[time]
end = 6e-6
snapshot_every = 1.3e-6
[solid]
z = [-0.05, 0.0]
r = [0.0, 0.05]
cells = [4, 4]
levels = 4
adapt_every = 3
material = "structural-steel"
[coupling]
scheme = "load"
[coupling.load]
amplitude = 1e6
radius = 0.006
history = [[0.0, 0.0], [1e-6, 1.0], [2e-6, 0.3]]
[[probe]]
name = "steel"
position = [0.0, 0.004]
medium = "solid"
"#;
