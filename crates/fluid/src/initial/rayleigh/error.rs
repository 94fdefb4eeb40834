//! Why an initial condition has no harmonic pressure.

/// Why an initial condition has no such field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RayleighError {
    /// Discs in a plane have a logarithm for a field, and no pressure far away.
    #[error("it is about spheres, and the geometry is planar")]
    Planar,
    /// It is the liquid that has the field.
    #[error("it is the field of a liquid, and the ambient phase is gas")]
    GasAmbient,
    /// Without gas it would be uniform.
    #[error("it is the field about bubbles, and no region is gas")]
    NoGas,
    /// The field is made of spheres' fields.
    #[error("it needs spheres on the axis, and the gas of region {region} is none")]
    NotASphere {
        /// Number of the region, from 0.
        region: usize,
    },
    /// The liquid along the wall would end in an edge of more than a right angle, where its acceleration has no bound.
    #[error(
        "it needs bubbles with their centres above the wall or on it, and that of region {region} is {depth:?} m beyond it"
    )]
    BeyondWall {
        /// Number of the region, from 0.
        region: usize,
        /// Distance of the centre beyond the wall, m.
        depth: f64,
    },
    /// Beside walls the field ends at the sides, and it is the image in z_min or z_max alone that may cut a bubble.
    #[error("between these walls it needs bubbles clear of {side}, and that of region {region} meets it")]
    MeetsSide {
        /// Number of the region, from 0.
        region: usize,
        /// Name of the side.
        side: &'static str,
    },
    /// A point would have two pressures.
    #[error(
        "it needs one pressure in bubbles that overlap or touch, and those of regions {first} and {second} have two"
    )]
    Overlap {
        /// Number of a region, from 0.
        first: usize,
        /// Number of the other.
        second: usize,
    },
    /// Whatever the liquid leaves nothing replaces.
    #[error(
        "all sides are walls, and an incompressible liquid in a closed box cannot start to move about a bubble"
    )]
    ClosedBox,
    /// A row of images without end has no pressure far away.
    #[error("it has one pressure far away, and periodic sides repeat the bubbles without end")]
    Periodic,
    /// The linear system would take minutes.
    #[error("so many bubbles that meet each other or walls would take {unknowns} unknowns, more than {most}")]
    TooMany {
        /// How many there would be at least.
        unknowns: usize,
        /// How many there may be.
        most: usize,
    },
    /// The field does not get near enough to the gas's pressure on the bubbles.
    #[error(
        "the bubbles are too near to each other or to a wall for it: on their surfaces or on the sides it would be wrong by \
         {error:.1e} of the largest difference of pressure"
    )]
    TooNear {
        /// The largest error, relative to the largest difference of pressure.
        error: f64,
    },
}
