//! Johnson–Cook constants of the library's metals.

use super::johnson_cook::{JohnsonCook, ThermalSoftening};
use super::rate::RateFactor;

/// The constants of a material of the library, and where they come from.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MaterialHardening {
    /// The material's name, as [`crate::Material::by_name`] knows it.
    pub material: &'static str,
    /// Its law.
    pub law: JohnsonCook,
    /// Where its constants come from, and what other sources say.
    pub source: &'static str,
}

impl MaterialHardening {
    /// The constants of all materials that have some.
    pub fn library() -> &'static [Self] {
        &LIBRARY
    }

    /// Those of the material of that name.
    pub fn of(material: &str) -> Option<&'static Self> {
        LIBRARY.iter().find(|entry| entry.material == material)
    }
}

/// χ where the source gives none; the usual choice, and the reference solutions'.
const TAYLOR_QUINNEY: f64 = 0.9;

/// A, B (Pa), n, C, ε̇₀ (1/s).
const fn law(a: f64, b: f64, n: f64, c: f64, reference_rate: f64) -> JohnsonCook {
    JohnsonCook {
        yield_strength: a,
        hardening_modulus: b,
        hardening_exponent: n,
        rate: RateFactor { rate_coefficient: c, reference_rate },
        softening: None,
    }
}

/// The same with m, T_m, T_r (K), c_p (J/(kg K)).
const fn warm(cold: JohnsonCook, m: f64, melting: f64, reference: f64, heat_capacity: f64) -> JohnsonCook {
    let softening = ThermalSoftening {
        softening_exponent: m,
        melting_temperature: melting,
        reference_temperature: reference,
        heat_capacity,
        taylor_quinney: TAYLOR_QUINNEY,
    };
    JohnsonCook { softening: Some(softening), ..cold }
}

const LIBRARY: [MaterialHardening; 9] = [
    MaterialHardening {
        material: "structural-steel",
        law: warm(law(286.1e6, 500.1e6, 0.2282, 0.022, 1.0), 0.917, 1811.0, 293.0, 486.0),
        source: "ASTM A36: Seidt, Gilat, Klein & Leach (2007), as cited by others; the material's yield strength, 250 \
                 MPa, is the least that A36 promises. S355: A 448, B 782 MPa, n 0.562, C 0.0247, m 1.13, Forni, Chiaia \
                 & Cadoni (2016), as cited by others",
    },
    MaterialHardening {
        material: "stainless-316l",
        law: warm(law(305e6, 1161e6, 0.61, 0.01, 1.0), 0.517, 1673.0, 293.0, 500.0),
        source: "Umbrello, M'Saoubi & Outeiro (2007), Int. J. Mach. Tools Manuf. 47, 462, first of five sets, as cited \
                 by others; another there, of Tounsi et al. (2002): A 514, B 514 MPa, n 0.508, C 0.042 (0.001 1/s), m \
                 0.533",
    },
    MaterialHardening {
        material: "duplex-2205",
        law: law(508e6, 832e6, 0.51, 0.031, 1.0),
        source: "Roy, Franc, Fivel & Pellone (2015), J. Appl. Phys. 118, 164905; Joshi (2018), as cited by others; no \
                 softening given. Hsiao et al. (2014) take Y 515 MPa, H 705 MPa without rate",
    },
    MaterialHardening {
        material: "al-1100-o",
        law: warm(law(34e6, 148e6, 0.27, 0.001, 1.0), 0.859, 893.0, 293.0, 920.0),
        source: "no constants of temper O found: A the handbook's yield strength, B and n fitted to 180 MPa strain^0.20 \
                 (Kalpakjian & Schmid) at strains 0.1 to 0.5; C, m of 1100-H12 (A 148, B 346 MPa, n 0.183), Gupta, \
                 Iqbal & Sekhon (2006), as cited by others",
    },
    MaterialHardening {
        material: "al-6061-t6",
        law: warm(law(324e6, 114e6, 0.42, 0.002, 1.0), 1.34, 925.0, 293.0, 896.0),
        source: "Lesuer, Kay & LeBlanc (2001), UCRL-JC-134118, as cited by others; Corbett (2006): A 293.4, B 121.3 MPa, \
                 n 0.23, C 0.002, m 1.34, as cited by others",
    },
    MaterialHardening {
        material: "al-7075-t6",
        law: warm(law(546e6, 678e6, 0.71, 0.024, 1.0), 1.56, 908.0, 293.0, 960.0),
        source: "Brar, Joshi & Harris (2009), AIP Conf. Proc. 1195, 945, as cited by others; their abstract (APS \
                 2009.SHOCK.B5.2) has B 674 MPa, n 0.72, C 0.059, and for T651 A 527, B 676 MPa, n 0.71, C 0.017, m \
                 1.61. Roy et al. (2015), T651: A 335, B 396 MPa, n 0.32, C 0.0068",
    },
    MaterialHardening {
        material: "copper-ofhc",
        law: warm(law(90e6, 292e6, 0.31, 0.025, 1.0), 1.09, 1356.0, 298.0, 383.0),
        source: "Johnson & Cook (1983), Proc. 7th Int. Symp. Ballistics, 541",
    },
    MaterialHardening {
        material: "nickel-aluminium-bronze",
        law: law(300e6, 1162e6, 0.6, 0.012, 1.0),
        source: "Roy, Franc, Fivel & Pellone (2015), J. Appl. Phys. 118, 164905, as cited by others; no softening given",
    },
    MaterialHardening {
        material: "ti-6al-4v",
        law: warm(law(1098e6, 1092e6, 0.93, 0.014, 1.0), 1.1, 1878.0, 293.0, 526.0),
        source: "Lesuer (2000), DOT/FAA/AR-00/25, as cited by others; Johnson (1985): A 862, B 331 MPa, n 0.34, C 0.012, \
                 m 0.8, as cited by others. Lee & Lin (1998): A 782.7, B 498.4 MPa, n 0.28, C 0.028, m 1",
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Material;
    use crate::plasticity::PlasticityError;

    #[test]
    fn the_constants_are_those_of_laws_of_known_materials() -> Result<(), PlasticityError> {
        for entry in MaterialHardening::library() {
            let material = Material::by_name(entry.material);
            let material = material.unwrap_or_else(|| panic!("no {}", entry.material));
            let law = entry.law;
            JohnsonCook::new(law.yield_strength, law.hardening_modulus, law.hardening_exponent)?;
            RateFactor::new(law.rate.rate_coefficient, law.rate.reference_rate)?;
            if let Some(heat) = law.softening {
                ThermalSoftening::new(
                    heat.softening_exponent,
                    heat.melting_temperature,
                    heat.reference_temperature,
                    heat.heat_capacity,
                    heat.taylor_quinney,
                )?;
            }
            assert!(!entry.source.is_empty());
            assert_eq!(MaterialHardening::of(entry.material), Some(entry));
            // Structural steel's is the printed least.
            let same = material.yield_strength() == Some(law.yield_strength);
            assert!(same || entry.material == "structural-steel", "{}", entry.material);
        }
        assert!(MaterialHardening::of("gelatine").is_none());
        Ok(())
    }

    #[test]
    fn annealed_aluminium_follows_the_power_law_it_was_fitted_to() {
        let law = MaterialHardening::of("al-1100-o").expect("in the library").law;
        for strain in [0.1_f64, 0.2, 0.5] {
            let stress = law.flow(strain, 0.0, 0.0).stress;
            let power = 180e6 * strain.powf(0.2);
            assert!((stress / power - 1.0).abs() < 0.01, "{stress} at {strain}");
        }
    }
}
