//! What the two sides tell each other: the rows of a frame's payload.
//!
//! One round trip a step: the side with the longer step sends its trace on the interface and the trace's rate
//! of change and slope along the interface; the other side meets it in a Riemann problem per common sub-face in
//! each of its own steps, and returns the means over the long step of p*, v* and p*v* on the faces of the first. All
//! rows are there in every frame, tangential velocity and shear included, so that a viscous fluid needs no other
//! format.

/// A row of a trace frame: one number per interface face of the sender. Velocities along +z and +r.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraceRow {
    /// Outer radius of the face, m.
    Edge,
    /// Pressure, Pa.
    Pressure,
    /// Velocity normal to the interface, m/s.
    NormalVelocity,
    /// Velocity along the interface, m/s.
    TangentialVelocity,
    /// Shear stress σ_zr on the interface, Pa: of a solid its own, of a viscous fluid that with which it drags the wall, at mid-step.
    Shear,
    /// Density, kg/m³.
    Density,
    /// ∂p/∂t, Pa/s.
    PressureRate,
    /// ∂v_n/∂t, m/s².
    NormalVelocityRate,
    /// ∂v_t/∂t, m/s².
    TangentialVelocityRate,
    /// ∂ρ/∂t, kg/(m³ s).
    DensityRate,
    /// Adiabatic exponent of the stiffened gas that the cell behaves as.
    Gamma,
    /// Its stiffness, Pa.
    Pi,
    /// ∂p/∂r along the face, Pa/m.
    PressureSlope,
    /// ∂v_n/∂r along the face, 1/s.
    NormalVelocitySlope,
    /// ∂ρ/∂r along the face, kg/m⁴.
    DensitySlope,
    /// Impedance of the wave that leaves the interface into this side, Pa s/m: ρc, in a solid ρ̄c₁, where it flows that of its plastic wave.
    Impedance,
}

impl TraceRow {
    /// How many rows a trace frame has.
    pub const COUNT: usize = 16;

    /// What they are, as people say it.
    pub const NAMES: [&'static str; Self::COUNT] = [
        "outer radius",
        "pressure",
        "normal velocity",
        "tangential velocity",
        "shear traction",
        "density",
        "rate of the pressure",
        "rate of the normal velocity",
        "rate of the tangential velocity",
        "rate of the density",
        "adiabatic exponent",
        "stiffness",
        "slope of the pressure",
        "slope of the normal velocity",
        "slope of the density",
        "impedance",
    ];

    /// What the row counts in the state a time after that of the trace: rates so many times, s, all others once.
    #[inline]
    #[must_use]
    pub fn weight_after(self, time: f64) -> f64 {
        match self {
            Self::PressureRate
            | Self::NormalVelocityRate
            | Self::TangentialVelocityRate
            | Self::DensityRate => time,
            _ => 1.0,
        }
    }

    /// This row's part of a payload of `count` faces.
    pub fn of(self, payload: &[f64], count: usize) -> &[f64] {
        &payload[self as usize * count..][..count]
    }

    /// All but the edge: what a solver knows of a face.
    const OF_A_FACE: [Self; Self::COUNT - 1] = [
        Self::Pressure,
        Self::NormalVelocity,
        Self::TangentialVelocity,
        Self::Shear,
        Self::Density,
        Self::PressureRate,
        Self::NormalVelocityRate,
        Self::TangentialVelocityRate,
        Self::DensityRate,
        Self::Gamma,
        Self::Pi,
        Self::PressureSlope,
        Self::NormalVelocitySlope,
        Self::DensitySlope,
        Self::Impedance,
    ];
}

/// The rows of a trace on one face, its edge left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaceTrace([f64; TraceRow::COUNT]);

impl FaceTrace {
    /// With these values; of rows that are not among them 0.
    pub fn of<const ROWS: usize>(values: [(TraceRow, f64); ROWS]) -> Self {
        let mut trace = Self::default();
        values.into_iter().for_each(|(row, value)| trace.0[row as usize] = value);
        trace
    }

    /// Calls `put(row, face, value)` for all rows of some faces.
    ///
    /// - `first`: the number of the first of them.
    pub fn put_all(traces: &[Self], first: usize, mut put: impl FnMut(TraceRow, usize, f64)) {
        for (face, trace) in (first..).zip(traces) {
            TraceRow::OF_A_FACE.into_iter().for_each(|row| put(row, face, trace.0[row as usize]));
        }
    }
}

/// A row of a register frame: one number per interface face of the *receiver*, means over its step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegisterRow {
    /// Mean of p*, Pa.
    Pressure,
    /// Mean of v*, m/s.
    NormalVelocity,
    /// Mean of p*v*, W/m²; with friction less σ_zr* v_r*.
    Power,
    /// Mean of the tangential velocity of the other side, m/s.
    TangentialVelocity,
    /// Mean of the shear stress σ_zr*, Pa: what the fluid's trace has shown; 0 without friction.
    Shear,
}

impl RegisterRow {
    /// How many rows a register frame has.
    pub const COUNT: usize = 5;

    /// What they are, as people say it.
    pub const NAMES: [&'static str; Self::COUNT] =
        ["mean pressure", "mean velocity", "mean power", "mean tangential velocity", "mean shear traction"];

    /// This row's part of a payload of `count` faces.
    pub fn of(self, payload: &[f64], count: usize) -> &[f64] {
        &payload[self as usize * count..][..count]
    }
}

/// What a register frame says of the wall.
#[derive(Clone, Copy, Debug)]
pub struct WallRegister<'a> {
    /// Mean of p* on each face, Pa.
    pub pressure: &'a [f64],
    /// Mean of v* along +z, m/s.
    pub velocity: &'a [f64],
    /// Mean of p*v* − σ_zr* v_r*, W/m².
    pub power: &'a [f64],
    /// Mean of the shear stress σ_zr*, Pa; 0 without friction.
    pub shear: &'a [f64],
    /// Mean velocity along the wall of the side that sends it, m/s.
    pub tangential_velocity: &'a [f64],
}

impl<'a> WallRegister<'a> {
    /// Its rows of the normal direction: p*, v*, the power.
    pub fn rows(&self) -> [&'a [f64]; 3] {
        [self.pressure, self.velocity, self.power]
    }

    /// Its rows of friction: σ_zr*, v_r.
    pub fn friction(&self) -> [&'a [f64]; 2] {
        [self.shear, self.tangential_velocity]
    }

    /// From the payload of a register frame.
    pub fn of(payload: &'a [f64], count: usize) -> Self {
        Self {
            pressure: RegisterRow::Pressure.of(payload, count),
            velocity: RegisterRow::NormalVelocity.of(payload, count),
            power: RegisterRow::Power.of(payload, count),
            shear: RegisterRow::Shear.of(payload, count),
            tangential_velocity: RegisterRow::TangentialVelocity.of(payload, count),
        }
    }
}
