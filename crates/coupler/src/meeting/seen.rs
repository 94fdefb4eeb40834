//! What one side's trace shows at a place and a time.

use crate::exchange::TraceRow;
use crate::star::{FluidTrace, SolidTrace};

/// A place on one side's trace, and how long after it was taken.
pub(super) struct Seen<'a> {
    pub rows: &'a [f64],
    pub count: usize,
    pub face: usize,
    pub after: f64,
    pub offset: f64,
}

impl Seen<'_> {
    /// The middle of the face on an interface that begins at `low`, m.
    pub fn radius(&self, low: f64) -> f64 {
        let edges = TraceRow::Edge.of(self.rows, self.count);
        0.5 * (edges[self.face] + self.face.checked_sub(1).map_or(low, |before| edges[before]))
    }

    pub fn value(&self, row: TraceRow) -> f64 {
        row.of(self.rows, self.count)[self.face]
    }

    /// Value, rate and slope at the place and the time.
    fn moved(&self, row: TraceRow, rate: TraceRow, slope: TraceRow) -> f64 {
        self.value(row) + self.after * self.value(rate) + self.offset * self.value(slope)
    }

    fn pressure(&self) -> f64 {
        self.moved(TraceRow::Pressure, TraceRow::PressureRate, TraceRow::PressureSlope)
    }

    fn velocity(&self) -> f64 {
        self.moved(TraceRow::NormalVelocity, TraceRow::NormalVelocityRate, TraceRow::NormalVelocitySlope)
    }

    pub fn tangential_velocity(&self) -> f64 {
        self.value(TraceRow::TangentialVelocity) + self.after * self.value(TraceRow::TangentialVelocityRate)
    }

    pub fn fluid(&self) -> FluidTrace {
        FluidTrace {
            pressure: self.pressure(),
            velocity: self.velocity(),
            density: self.moved(TraceRow::Density, TraceRow::DensityRate, TraceRow::DensitySlope),
            gamma: self.value(TraceRow::Gamma),
            pi: self.value(TraceRow::Pi),
        }
    }

    pub fn solid(&self) -> SolidTrace {
        SolidTrace {
            pressure: self.pressure(),
            velocity: self.velocity(),
            impedance: self.value(TraceRow::Impedance),
        }
    }
}
