//! The materials known by name.

/// One row of the library.
pub(super) struct Entry {
    pub name: &'static str,
    pub density: f64,
    pub c1: f64,
    pub c2: f64,
    pub yield_strength: Option<f64>,
    /// Conductivity at 20 °C, W/(m K), and heat capacity, J/(kg K).
    pub heat: [f64; 2],
    pub source: &'static str,
}

/// Speeds other than the paper's are those of the CRC Handbook of Chemistry and Physics, "Speed of sound in various
/// media"; yield strengths are those the paper's reference [71] tabulates unless said otherwise. Materials whose source gives
/// Young's modulus and Poisson's ratio have the speeds that follow from them.
pub(super) const LIBRARY: [Entry; 16] = [
    Entry {
        name: "structural-steel",
        density: 7800.0,
        c1: 5990.0,
        c2: 3458.0,
        yield_strength: Some(250e6),
        heat: [51.9, 486.0],
        source: "Dickopp, Gartz & Mueller 2012: density and speeds as printed; yield from its reference [71], \
                 engineeringtoolbox.com (ASTM A36); heat: matweb.com (AISI 1018)",
    },
    Entry {
        name: "stainless-steel",
        density: 7800.0,
        c1: 5990.0,
        c2: 3458.0,
        yield_strength: Some(502e6),
        heat: [16.2, 500.0],
        source: "Dickopp, Gartz & Mueller 2012: density and speeds as printed; yield from its reference [71], \
                 engineeringtoolbox.com (AISI 302, cold-rolled); heat: matweb.com (AISI 302)",
    },
    Entry {
        name: "aluminium",
        density: 2700.0,
        c1: 6420.0,
        c2: 3040.0,
        yield_strength: Some(95e6),
        heat: [237.0, 897.0],
        source: "CRC Handbook (aluminium, rolled); yield from engineeringtoolbox.com (aluminium); heat: CRC Handbook",
    },
    Entry {
        name: "copper",
        density: 8930.0,
        c1: 5010.0,
        c2: 2270.0,
        yield_strength: Some(70e6),
        heat: [401.0, 385.0],
        source: "CRC Handbook (copper, rolled); yield from engineeringtoolbox.com (copper); heat: CRC Handbook",
    },
    Entry {
        name: "pmma",
        density: 1180.0,
        c1: 2680.0,
        c2: 1100.0,
        yield_strength: Some(70e6),
        heat: [0.19, 1466.0],
        source: "CRC Handbook (Lucite); tensile strength of acrylic from engineeringtoolbox.com, taken as yield; heat: engineeringtoolbox.com (acrylic)",
    },
    Entry {
        name: "titanium",
        density: 4500.0,
        c1: 6070.0,
        c2: 3125.0,
        yield_strength: Some(275e6),
        heat: [21.9, 523.0],
        source: "CRC Handbook (titanium); least yield of ASTM B265 grade 2; heat: CRC Handbook",
    },
    Entry {
        name: "tungsten-carbide",
        density: 13800.0,
        c1: 6655.0,
        c2: 3980.0,
        yield_strength: None,
        heat: [110.0, 203.0],
        source: "CRC Handbook (tungsten carbide); brittle, so without yield strength; heat: Kurlov & Gusev (2013), Tungsten Carbides",
    },
    Entry {
        name: "gelatine",
        density: 1100.0,
        c1: 1550.0,
        c2: 20.0,
        yield_strength: None,
        heat: [0.6, 4000.0],
        source: "illustrative: a stiff water-based gel, c1 near water's, shear modulus 0.44 MPa; heat: nearly that of water",
    },
    Entry {
        name: "stainless-316l",
        density: 8000.0,
        c1: 5698.8,
        c2: 3046.1,
        yield_strength: Some(305e6),
        heat: [16.3, 500.0],
        source: "ASM Handbook vol. 1 (316L, annealed): E = 193 GPa, nu = 0.3; yield: its law's A, see its \
                 hardening; heat: matweb.com (316L)",
    },
    Entry {
        name: "duplex-2205",
        density: 7805.0,
        c1: 5663.9,
        c2: 3027.5,
        yield_strength: Some(508e6),
        heat: [15.0, 500.0],
        source: "Joshi (2018), after Roy, Franc, Fivel & Pellone (2015): E = 186 GPa, nu = 0.3; yield: \
                 its law's A; heat: EN 10088-1 (1.4462)",
    },
    Entry {
        name: "al-1100-o",
        density: 2710.0,
        c1: 6137.6,
        c2: 3091.6,
        yield_strength: Some(34e6),
        heat: [222.0, 904.0],
        source: "ASM Handbook vol. 2 (1100-O): E = 68.9 GPa, nu = 0.33, yield 34 MPa; heat: matweb.com (1100-O)",
    },
    Entry {
        name: "al-6061-t6",
        density: 2700.0,
        c1: 6148.9,
        c2: 3097.3,
        yield_strength: Some(324e6),
        heat: [167.0, 896.0],
        source: "matweb.com (6061-T6): E = 68.9 GPa, nu = 0.33, yield there 276 MPa; yield here: its \
                 law's A; heat: matweb.com",
    },
    Entry {
        name: "al-7075-t6",
        density: 2810.0,
        c1: 6148.6,
        c2: 3097.2,
        yield_strength: Some(546e6),
        heat: [130.0, 960.0],
        source: "matweb.com (7075-T6): E = 71.7 GPa, nu = 0.33, yield there 503 MPa; yield here: its \
                 law's A; heat: matweb.com",
    },
    Entry {
        name: "copper-ofhc",
        density: 8960.0,
        c1: 4615.3,
        c2: 2272.4,
        yield_strength: Some(90e6),
        heat: [391.0, 385.0],
        source: "Johnson & Cook (1983): E = 124 GPa, nu = 0.34; yield: its law's A; heat: matweb.com (C10100)",
    },
    Entry {
        name: "nickel-aluminium-bronze",
        density: 7640.0,
        c1: 4780.2,
        c2: 2459.4,
        yield_strength: Some(300e6),
        heat: [36.0, 440.0],
        source: "Roy, Franc, Fivel & Pellone (2015): E = 122 GPa, yield; density and nu of UNS C95800, \
                 copper.org; heat: copper.org (C95800)",
    },
    Entry {
        name: "ti-6al-4v",
        density: 4430.0,
        c1: 6313.4,
        c2: 3093.7,
        yield_strength: Some(1098e6),
        heat: [6.7, 526.0],
        source: "matweb.com (Ti-6Al-4V, annealed): E = 113.8 GPa, nu = 0.342, yield there 880 MPa; yield \
                 here: its law's A; heat: matweb.com",
    },
];
