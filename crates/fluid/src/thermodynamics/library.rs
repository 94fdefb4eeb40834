//! The fluids known by name.

use super::noble_abel::{Heat, NobleAbelStiffenedGas};

/// A fluid of the library.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedFluid {
    /// Its name.
    pub name: &'static str,
    /// Its equation of state.
    pub law: NobleAbelStiffenedGas,
    /// Dynamic viscosity μ at 20 °C, Pa s.
    pub viscosity: f64,
    /// Thermal conductivity λ at 20 °C, W/(m K).
    pub conductivity: f64,
    /// Where the constants of the equation of state are from.
    pub source: &'static str,
}

impl NamedFluid {
    /// All of them; viscosities and conductivities are those of the CRC Handbook of Chemistry and Physics.
    pub fn library() -> &'static [Self] {
        &LIBRARY
    }

    /// The one of a name.
    #[must_use]
    pub fn of(name: &str) -> Option<&'static Self> {
        LIBRARY.iter().find(|fluid| fluid.name == name)
    }
}

const fn law(gamma: f64, pi: f64, covolume: f64, heat: Option<Heat>) -> NobleAbelStiffenedGas {
    NobleAbelStiffenedGas { gamma, pi, covolume, heat }
}

const fn heat(capacity: f64, energy: f64, entropy: f64) -> Option<Heat> {
    Some(Heat { capacity, energy, entropy })
}

const WATER: [f64; 2] = [1.0016e-3, 0.598];
const VAPOUR: [f64; 2] = [9.7e-6, 0.0182];

const fn fluid(
    name: &'static str,
    law: NobleAbelStiffenedGas,
    [viscosity, conductivity]: [f64; 2],
    source: &'static str,
) -> NamedFluid {
    NamedFluid { name, law, viscosity, conductivity, source }
}

// γ of Le Metayer & Saurel (2016) is c_p/c_v: with 1.19 and 1.47, as it is rounded there, water's vapour pressure is 45 % off.
static LIBRARY: [NamedFluid; 9] = [
    fluid(
        "water",
        law(7.15, 3e8, 0.0, None),
        WATER,
        "Dickopp, Gartz & Mueller 2012, as printed; no temperature",
    ),
    fluid(
        "water-tait",
        law(7.15, 3.046e8, 0.0, None),
        WATER,
        "Tait's constants as bubble dynamics has them (Cole 1948); no temperature",
    ),
    fluid(
        "water-4.4",
        law(4.4, 6e8, 0.0, None),
        WATER,
        "Saurel & Abgrall 1999, fitted to shocks; no temperature",
    ),
    fluid(
        "water-2.35",
        law(2.35, 1e9, 0.0, heat(1816.0, -1_167e3, 0.0)),
        WATER,
        "Le Metayer, Massoni & Saurel 2004, saturation from 298 to 473 K; dense by a third at room temperature",
    ),
    fluid(
        "water-nasg",
        law(4285.0 / 3610.0, 7.028e8, 6.61e-4, heat(3610.0, -1_177_788.0, 0.0)),
        WATER,
        "Le Metayer & Saurel 2016, saturation from 300 to 500 K",
    ),
    fluid(
        "water-vapour",
        law(1401.0 / 955.0, 0.0, 0.0, heat(955.0, 2_077_616.0, 14_317.0)),
        VAPOUR,
        "Le Metayer & Saurel 2016, beside water-nasg",
    ),
    fluid(
        "water-vapour-1.43",
        law(1.43, 0.0, 0.0, heat(1040.0, 2_030e3, -23_400.0)),
        VAPOUR,
        "Le Metayer, Massoni & Saurel 2004, beside water-2.35",
    ),
    fluid(
        "air",
        law(1.4, 0.0, 0.0, heat(717.5, 0.0, 0.0)),
        [1.82e-5, 0.0257],
        "ideal gas of 287.0 J/(kg K), CRC Handbook",
    ),
    fluid(
        "argon",
        law(1.667, 0.0, 0.0, heat(312.1, 0.0, 0.0)),
        [2.23e-5, 0.0177],
        "ideal gas of 208.1 J/(kg K), CRC Handbook",
    ),
];
