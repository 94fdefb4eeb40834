//! The rectangle of the (z, r) half-plane that a medium fills, and the metric on it.

crate::named! {
    /// How the (z, r) plane is measured.
    pub enum Geometry {
        /// Rotation about the axis r = 0: volumes and face areas carry the weight r (per radian).
        Axisymmetric = "axisymmetric",
        /// Plane strain: unit depth, r is a Cartesian coordinate.
        Planar = "planar",
    }
}

impl Geometry {
    /// The whole of what is counted per radian: 2π, or 1 in planar geometry, where it is counted per metre of depth.
    pub fn turn(self) -> f64 {
        match self {
            Self::Axisymmetric => std::f64::consts::TAU,
            Self::Planar => 1.0,
        }
    }
}

crate::named! {
    /// A side of a rectangle, of a block or of the whole domain.
    pub enum Side {
        /// The side of smallest z.
        ZMin = "z_min",
        /// The side of largest z.
        ZMax = "z_max",
        /// The side of smallest r; the axis of an axisymmetric domain that starts at r = 0.
        RMin = "r_min",
        /// The side of largest r.
        RMax = "r_max",
    }
}

impl Side {
    /// All four, in the order in which arrays over sides are laid out.
    pub const ALL: [Self; 4] = [Self::ZMin, Self::ZMax, Self::RMin, Self::RMax];

    /// All four, in the order in which ghosts beyond them are filled: r first, the z sides then complete the corners.
    pub const FOR_GHOSTS: [Self; 4] = [Self::RMin, Self::RMax, Self::ZMin, Self::ZMax];

    /// The side across.
    pub fn opposite(self) -> Self {
        match self {
            Self::ZMin => Self::ZMax,
            Self::ZMax => Self::ZMin,
            Self::RMin => Self::RMax,
            Self::RMax => Self::RMin,
        }
    }

    /// The axis that crosses it: 0 z, 1 r.
    pub fn axis_across(self) -> usize {
        usize::from(matches!(self, Self::RMin | Self::RMax))
    }
}
