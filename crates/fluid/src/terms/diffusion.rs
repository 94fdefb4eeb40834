//! What viscosity and conduction have in common: how far something may spread in a step.

/// The most that Δt D (1/h_z² + 1/h_r²) may be in a cell; D is (4μ/3 + κ)/ρ of momentum, λ/C of heat.
///
/// In the plane the midpoint rule is stable up to ½: the largest rate of decay is 4D(1/h_z² + 1/h_r²), and Δt times it at most 2. Next
/// to the axis, where the hoop stress damps the radial velocity besides, up to 0.43.
const MOST_DIFFUSION: f64 = 0.375;

/// The most stages that a step is divided into: each costs as much as a small part of a step.
pub(super) const MOST_STAGES: usize = 255;

/// How many times as diffusive as a step without stages bears a cell may be in one with the most stages: (s² + s − 2)/4 of what is stable,
/// with something to spare.
pub(super) const BY_STAGES: f64 = 1e4;

mesh::named! {
    /// What gas does that is so thin that its momentum or its heat spreads over more than a cell in a step.
    #[derive(Default)]
    pub enum ThinGas {
        /// It is taken to be as viscous, and to conduct as much, as the step is stable with, which is counted. The liquid alone limits the
        /// step.
        #[default]
        Bounded = "bounded",
        /// It limits the step.
        Resolved = "resolved",
        /// It has all of its viscosity or conductivity, in stages within the step; neither it nor the liquid limits that.
        SuperTimeStepping = "super-time-stepping",
    }
}

/// The largest diffusivity that a step is stable with, m²/s; see [`MOST_DIFFUSION`].
pub(crate) fn most_diffusivity(dt: f64, [inverse_z, inverse_r]: [f64; 2]) -> f64 {
    MOST_DIFFUSION / (dt * (inverse_z * inverse_z + inverse_r * inverse_r))
}

/// The longest step that a diffusivity (m²/s) is stable with in cells of these widths, s.
pub(super) fn step_limit([h_z, h_r]: [f64; 2], diffusivity: f64) -> f64 {
    MOST_DIFFUSION / (diffusivity * (1.0 / (h_z * h_z) + 1.0 / (h_r * h_r)))
}

/// The largest of η(φ)/ρ in cells of these densities and gas fractions, at least 0; NaN is skipped. To be inlined where it may vectorise.
#[inline(always)]
pub(super) fn largest_per_density(density: &[f64], phi: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    const LANES: usize = 16;
    let larger = |most: f64, density: f64, phi: f64| {
        let own = of(phi) / density;
        if own > most { own } else { most }
    };
    let (densities, phis) = (density.as_chunks::<LANES>(), phi.as_chunks::<LANES>());
    let mut most = [0.0; LANES];
    for (density, phi) in densities.0.iter().zip(phis.0) {
        for lane in 0..LANES {
            most[lane] = larger(most[lane], density[lane], phi[lane]);
        }
    }
    let rest = densities.1.iter().zip(phis.1).fold(0.0, |most, (density, phi)| larger(most, *density, *phi));
    most.into_iter().fold(rest, f64::max)
}
