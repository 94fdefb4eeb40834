//! The columns of the fluid's histories.

use crate::output::Column;
use crate::run::record::{PROBE_VELOCITY, TIME_AFTER_STEP, column};

/// Name, unit and description of what is recorded of each of several bubbles.
pub(super) const BUBBLE_COLUMNS: [(&str, &str, &str); 4] = [
    ("volume", "m3", "volume integral of the gas fraction where it exceeds 1e-6, between this bubble's cuts"),
    ("equivalent_radius", "m", "radius of the ball of that volume"),
    ("centroid_z", "m", "mean z weighted with the gas fraction"),
    ("gas_mass", "kg", "mass of the gas (planar: kg/m); NaN where phases have no masses"),
];

/// Every step.
pub(super) const STEP_COLUMNS: [Column<'static>; 12] = [
    TIME_AFTER_STEP,
    column("time_step", "s", "length of the step"),
    column("bubble/volume", "m3", "volume integral of the gas fraction where it exceeds 1e-6"),
    column("bubble/equivalent_radius", "m", "radius of the ball of that volume"),
    column("bubble/centroid_z", "m", "mean z weighted with the gas fraction"),
    column("bubble/jet_tip_z", "m", "distal crossing of gas fraction 1/2 on the axis"),
    column("bubble/jet_velocity", "m/s", "fastest liquid on the axis, positive towards the wall"),
    column("bubble/trace_gas_volume", "m3", "volume integral of the gas fraction where it is at most 1e-6"),
    column(
        "bubble/thin_gas_volume",
        "m3",
        "volume integral of the gas fraction where it is between 1e-6 and 1e-2",
    ),
    column("bubble/gas_mass", "kg", "mass of the gas (planar: kg/m); NaN where phases have no masses"),
    column("wall/pressure_axis", "Pa", "cell mean at z_min on the axis"),
    column("wall/pressure_max", "Pa", "largest cell mean along z_min"),
];

/// At a probe.
pub(super) const PROBE_COLUMNS: [Column<'static>; 6] = [
    TIME_AFTER_STEP,
    column("pressure", "Pa", "pressure; on the interface that of the star state"),
    column("density", "kg/m3", "density"),
    PROBE_VELOCITY[0],
    PROBE_VELOCITY[1],
    column("gas_fraction", "1", "gas fraction"),
];
