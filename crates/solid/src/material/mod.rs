//! Isotropic, linear-elastic materials and a small library of them.

mod library;
pub(crate) mod yield_criterion;

use library::LIBRARY;

/// Why three numbers are no elastic material.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// A number that must be positive is not.
    #[error("{name} must be positive, got {value} {unit}")]
    NotPositive {
        /// Which one.
        name: &'static str,
        /// What was given.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// Poisson's ratio outside the range of positive elastic energy.
    #[error("poisson must lie between -1 and 0.5 (both excluded), got {0}")]
    PoissonOutOfRange(f64),
    /// The speeds mean a compression modulus K = ρ(c₁² − 4/3 c₂²) that is not positive.
    #[error("c1 must exceed c2 * sqrt(4/3) = {least} m/s for c2 = {c2} m/s, got c1 = {c1} m/s")]
    NegativeCompression {
        /// Speed of the dilatational wave, m/s.
        c1: f64,
        /// Speed of the shear wave, m/s.
        c2: f64,
        /// The bound on c₁, m/s.
        least: f64,
    },
    /// The Lamé constants mean a compression modulus K = λ + 2/3 μ that is not positive.
    #[error("lambda must exceed -2/3 mu = {least} Pa, got lambda = {lambda} Pa")]
    NegativeLambda {
        /// First Lamé constant, Pa.
        lambda: f64,
        /// The bound on λ, Pa.
        least: f64,
    },
}

/// An isotropic, linear-elastic material, kept as density and the two wave speeds.
///
/// Its elastic energy is positive: c₂ > 0 and K = ρ(c₁² − 4/3 c₂²) > 0. Every constructor checks that.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    name: String,
    density: f64,
    c1: f64,
    c2: f64,
    yield_strength: Option<f64>,
    source: String,
}

/// How a material conducts heat at room temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialHeat {
    /// Conductivity λ, W/(m K).
    pub conductivity: f64,
    /// Heat capacity c, J/(kg K).
    pub capacity: f64,
}

impl Material {
    /// From density ρ (kg/m³) and the speeds c₁, c₂ (m/s) of dilatational and shear waves.
    ///
    /// # Errors
    /// A number that is not positive and finite, or c₁ ≤ c₂ √(4/3).
    pub fn from_speeds(density: f64, c1: f64, c2: f64) -> Result<Self, MaterialError> {
        positive("density", density, "kg/m3")?;
        positive("c1", c1, "m/s")?;
        positive("c2", c2, "m/s")?;
        let least = c2 * (4.0_f64 / 3.0).sqrt();
        if c1 <= least {
            return Err(MaterialError::NegativeCompression { c1, c2, least });
        }
        Ok(Self {
            name: "unnamed".to_owned(),
            density,
            c1,
            c2,
            yield_strength: None,
            source: "given by its numbers".to_owned(),
        })
    }

    /// From density ρ (kg/m³), Young's modulus E (Pa) and Poisson's ratio ν.
    ///
    /// # Errors
    /// A number that is not positive and finite, or ν outside (−1, ½).
    pub fn from_young(density: f64, young: f64, poisson: f64) -> Result<Self, MaterialError> {
        positive("density", density, "kg/m3")?;
        positive("young", young, "Pa")?;
        if !(poisson > -1.0 && poisson < 0.5) {
            return Err(MaterialError::PoissonOutOfRange(poisson));
        }
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        let mu = young / (2.0 * (1.0 + poisson));
        Self::from_lame(density, lambda, mu)
    }

    /// From density ρ (kg/m³) and Lamé's constants λ, μ (Pa).
    ///
    /// # Errors
    /// ρ or μ not positive and finite, or λ ≤ −2/3 μ.
    pub fn from_lame(density: f64, lambda: f64, mu: f64) -> Result<Self, MaterialError> {
        positive("density", density, "kg/m3")?;
        positive("mu", mu, "Pa")?;
        let least = -2.0 / 3.0 * mu;
        if !(lambda > least && lambda.is_finite()) {
            return Err(MaterialError::NegativeLambda { lambda, least });
        }
        Self::from_speeds(density, ((lambda + 2.0 * mu) / density).sqrt(), (mu / density).sqrt())
    }

    /// The same material with a yield strength Y₀, Pa.
    ///
    /// # Errors
    /// Y₀ not positive and finite.
    pub fn with_yield_strength(mut self, yield_strength: f64) -> Result<Self, MaterialError> {
        positive("yield_strength", yield_strength, "Pa")?;
        self.yield_strength = Some(yield_strength);
        Ok(self)
    }

    /// The same material under a name.
    #[must_use]
    pub fn named(mut self, name: &str, source: &str) -> Self {
        name.clone_into(&mut self.name);
        source.clone_into(&mut self.source);
        self
    }

    /// Name, as in case files.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where the numbers come from.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Density ρ, kg/m³.
    pub fn density(&self) -> f64 {
        self.density
    }

    /// Speed c₁ of dilatational waves, m/s.
    pub fn c1(&self) -> f64 {
        self.c1
    }

    /// Speed c₂ of shear waves, m/s.
    pub fn c2(&self) -> f64 {
        self.c2
    }

    /// Yield strength Y₀, Pa. A material without one never yields: it has no yield function and no yielded volume.
    pub fn yield_strength(&self) -> Option<f64> {
        self.yield_strength
    }

    /// Second Lamé constant (shear modulus) μ = ρc₂², Pa.
    pub fn mu(&self) -> f64 {
        self.density * self.c2 * self.c2
    }

    /// First Lamé constant λ = ρ(c₁² − 2c₂²), Pa.
    pub fn lambda(&self) -> f64 {
        self.density * (self.c1 * self.c1 - 2.0 * self.c2 * self.c2)
    }

    /// Young's modulus E = μ(3λ + 2μ)/(λ + μ), Pa.
    pub fn young(&self) -> f64 {
        let (lambda, mu) = (self.lambda(), self.mu());
        mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu)
    }

    /// Poisson's ratio ν = λ / (2(λ + μ)).
    pub fn poisson(&self) -> f64 {
        let (lambda, mu) = (self.lambda(), self.mu());
        lambda / (2.0 * (lambda + mu))
    }

    /// α = 1 − 2(c₂/c₁)² = λ/(λ + 2μ), the paper's coupling of the normal stresses.
    pub fn alpha(&self) -> f64 {
        let ratio = self.c2 / self.c1;
        1.0 - 2.0 * ratio * ratio
    }

    /// Impedance ρc₁ of dilatational waves, Pa s/m.
    pub fn impedance_p(&self) -> f64 {
        self.density * self.c1
    }

    /// Impedance ρc₂ of shear waves, Pa s/m.
    pub fn impedance_s(&self) -> f64 {
        self.density * self.c2
    }

    /// How it conducts heat, where it has the name of one of the library.
    pub fn heat(&self) -> Option<MaterialHeat> {
        let entry = LIBRARY.iter().find(|entry| entry.name == self.name)?;
        let [conductivity, capacity] = entry.heat;
        Some(MaterialHeat { conductivity, capacity })
    }

    /// Thermal effusivity √(λρc), J/(m² K s^½), likewise.
    pub fn effusivity(&self) -> Option<f64> {
        self.heat().map(|heat| (heat.conductivity * self.density * heat.capacity).sqrt())
    }

    /// The materials known by name.
    pub fn library() -> Vec<Self> {
        LIBRARY
            .iter()
            .map(|entry| Self {
                name: entry.name.to_owned(),
                density: entry.density,
                c1: entry.c1,
                c2: entry.c2,
                yield_strength: entry.yield_strength,
                source: entry.source.to_owned(),
            })
            .collect()
    }

    /// The library's material of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::library().into_iter().find(|material| material.name == name)
    }
}

fn positive(name: &'static str, value: f64, unit: &'static str) -> Result<(), MaterialError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(MaterialError::NotPositive { name, value, unit })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_three_ways_to_give_steel_agree() {
        let steel = Material::from_speeds(7800.0, 5990.0, 3458.0).expect("steel");
        let young = Material::from_young(7800.0, steel.young(), steel.poisson()).expect("steel");
        let lame = Material::from_lame(7800.0, steel.lambda(), steel.mu()).expect("steel");
        for other in [young, lame] {
            assert_relative_eq!(other.c1(), 5990.0, max_relative = 1e-13);
            assert_relative_eq!(other.c2(), 3458.0, max_relative = 1e-13);
        }
        // The paper's speeds mean these, not the printed E = 210 GPa.
        assert_relative_eq!(steel.poisson(), 0.25, max_relative = 2e-3);
        assert_relative_eq!(steel.young(), 233e9, max_relative = 2e-3);
        assert_relative_eq!(
            steel.alpha(),
            steel.lambda() / (steel.lambda() + 2.0 * steel.mu()),
            max_relative = 1e-13
        );
    }

    #[test]
    fn young_210_gpa_gives_the_slower_speeds() {
        let steel = Material::from_young(7800.0, 210e9, 0.25).expect("steel");
        // The speeds are known to the metre per second.
        assert_relative_eq!(steel.c1(), 5684.0, epsilon = 0.5);
        assert_relative_eq!(steel.c2(), 3282.0, epsilon = 0.5);
    }

    #[test]
    fn a_soft_gel_and_an_auxetic_solid_are_materials() {
        assert!(Material::from_speeds(1100.0, 1550.0, 20.0).is_ok());
        assert!(Material::from_young(1000.0, 1e9, -0.5).is_ok());
        assert!(Material::from_lame(1000.0, -0.5e9, 1e9).is_ok());
    }

    #[test]
    fn energy_that_is_not_positive_is_refused() {
        for bad in [
            Material::from_speeds(7800.0, 5990.0, 5190.0),
            Material::from_speeds(7800.0, 3458.0, 5990.0),
            Material::from_speeds(-1.0, 5990.0, 3458.0),
            Material::from_speeds(7800.0, f64::NAN, 3458.0),
            Material::from_speeds(7800.0, f64::INFINITY, 3458.0),
            Material::from_speeds(7800.0, 5990.0, 0.0),
            Material::from_young(7800.0, 210e9, 0.5),
            Material::from_young(7800.0, 210e9, -1.0),
            Material::from_young(7800.0, -210e9, 0.3),
            Material::from_lame(7800.0, -1e9, 1e9),
            Material::from_lame(7800.0, 1e9, 0.0),
            Material::library()[0].clone().with_yield_strength(0.0),
        ] {
            assert!(bad.is_err(), "{bad:?}");
        }
    }

    #[test]
    fn the_library_is_sound() {
        let library = Material::library();
        for material in &library {
            let again = Material::from_speeds(material.density(), material.c1(), material.c2());
            assert!(again.is_ok(), "{}", material.name());
            assert!(material.yield_strength().is_none_or(|y| y > 1e6), "{}", material.name());
            assert!(!material.source().is_empty());
            let heat = material.heat().expect("all of the library have it");
            assert!((0.1..500.0).contains(&heat.conductivity) && (150.0..5000.0).contains(&heat.capacity));
            assert_eq!(library.iter().filter(|other| other.name() == material.name()).count(), 1);
        }
        for (name, young, poisson) in [
            ("stainless-316l", 193e9, 0.3),
            ("duplex-2205", 186e9, 0.3),
            ("al-1100-o", 68.9e9, 0.33),
            ("al-6061-t6", 68.9e9, 0.33),
            ("al-7075-t6", 71.7e9, 0.33),
            ("copper-ofhc", 124e9, 0.34),
            ("nickel-aluminium-bronze", 122e9, 0.32),
            ("ti-6al-4v", 113.8e9, 0.342),
        ] {
            // The speeds are rounded to 0.1 m/s.
            let material = Material::by_name(name).expect("in the library");
            assert_relative_eq!(material.young(), young, max_relative = 1e-4);
            assert_relative_eq!(material.poisson(), poisson, max_relative = 1e-3);
        }
        let steel = Material::by_name("structural-steel").expect("in the library");
        assert_eq!(
            (steel.density(), steel.c1(), steel.c2(), steel.yield_strength()),
            (7800.0, 5990.0, 3458.0, Some(250e6))
        );
        assert_relative_eq!(steel.effusivity().expect("steel"), 14_026.5, max_relative = 1e-4);
        assert!(Material::by_name("unobtainium").is_none());
    }
}
