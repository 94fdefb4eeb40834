//! Why numbers are no hardening law.

/// What is wrong with a law's constants: which one, its value, and what it may be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlasticityError {
    /// A constant outside its range.
    #[error("{name} must be {range}, got {value} {unit}")]
    OutOfRange {
        /// Which one.
        name: &'static str,
        /// What was given.
        value: f64,
        /// What it may be, in words.
        range: &'static str,
        /// Its unit.
        unit: &'static str,
    },
    /// The material would have no strength at the temperature at which it has its full one.
    #[error(
        "melting_temperature must exceed reference_temperature = {reference} K, got \
         melting_temperature = {melting} K"
    )]
    MeltingBelowReference {
        /// Melting temperature, K.
        melting: f64,
        /// Reference temperature, K.
        reference: f64,
    },
    /// A table without points.
    #[error("table must hold at least one point [plastic strain, stress]")]
    EmptyTable,
    /// A point of a table that is no number in its range.
    #[error(
        "table, point {point}: the plastic strain must be finite and not negative, the stress finite and \
         positive, got [{strain}, {stress}]"
    )]
    TablePoint {
        /// Which point, from 1 on.
        point: usize,
        /// Its plastic strain.
        strain: f64,
        /// Its stress, Pa.
        stress: f64,
    },
    /// Plastic strains of a table that do not grow from point to point.
    #[error(
        "table, point {point}: the plastic strain must exceed the point's before, {before}, got {strain}"
    )]
    TableNotIncreasing {
        /// Which point, from 1 on.
        point: usize,
        /// Plastic strain of the point before.
        before: f64,
        /// Plastic strain of this one.
        strain: f64,
    },
    /// Stresses of a table that fall.
    #[error(
        "table, point {point}: the stress must not fall below the point's before, {before} Pa, got {stress} \
         Pa: where a material softens with plastic strain, the width of the bands of shear is that of the \
         cells"
    )]
    TableSoftens {
        /// Which point, from 1 on.
        point: usize,
        /// Stress of the point before, Pa.
        before: f64,
        /// Stress of this one, Pa.
        stress: f64,
    },
}

/// `value` where it is finite and `allowed`.
pub(super) fn within(
    allowed: bool,
    name: &'static str,
    value: f64,
    range: &'static str,
    unit: &'static str,
) -> Result<f64, PlasticityError> {
    if allowed && value.is_finite() {
        Ok(value)
    } else {
        Err(PlasticityError::OutOfRange { name, value, range, unit })
    }
}

/// A number above zero.
pub(super) fn positive(name: &'static str, value: f64, unit: &'static str) -> Result<f64, PlasticityError> {
    within(value > 0.0, name, value, "positive", unit)
}

/// A number that is not below zero.
pub(super) fn not_negative(
    name: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<f64, PlasticityError> {
    within(value >= 0.0, name, value, "zero or positive", unit)
}
