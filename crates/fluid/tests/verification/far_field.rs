//! Sides near a bubble act as if they were far away.

use fluid::{
    Boundary, FarField, FluidSetup, FluidSolver, InitialCondition, InitialPressure, Mixture, Model, Phase,
    PhaseState, Pulse, PulseShape, Region, Shape, Sharpening,
};
use mesh::{Adaptation, Domain};

use crate::helpers::*;

/// 1 bar; the gas in the bubbles, Pa; their radius, m.
const FAR: f64 = 1e5;
const GAS_PRESSURE: f64 = 1e3;
const RADIUS: f64 = 1e-3;
/// Rayleigh's time of a free one, s.
const RAYLEIGH: f64 = 91.823e-6;
const FREE: [Boundary; 4] = [Boundary::FarField, Boundary::FarField, Boundary::Axis, Boundary::FarField];
const HELD: [Boundary; 4] =
    [Boundary::NonReflecting, Boundary::NonReflecting, Boundary::Axis, Boundary::NonReflecting];

/// A fluid of `cells` per radius about bubbles of `radii` radii at `places` radii along z, its sides at so many radii.
struct Setting {
    z: [f64; 2],
    r: f64,
    cells: f64,
    boundaries: [Boundary; 4],
    gas_pressure: f64,
    bubbles: Vec<[f64; 2]>,
    pulses: Vec<Pulse>,
}

impl Setting {
    fn free(sides: f64) -> Self {
        Self {
            z: [-sides, sides],
            r: sides,
            cells: 8.0,
            boundaries: FREE,
            gas_pressure: GAS_PRESSURE,
            bubbles: vec![[0.0, 1.0]],
            pulses: vec![],
        }
    }

    fn fluid(&self) -> FluidSolver<16> {
        let levels = 2;
        let coarsest = [self.z[1] - self.z[0], self.r].map(|radii| (radii * self.cells) as usize >> levels);
        let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
        let bubble = |&[z, radius]: &[f64; 2]| Region {
            shape: Shape::Sphere { centre: [z * RADIUS, 0.0], radius: radius * RADIUS },
            state: state(Phase::Gas, 1.2e-5 * self.gas_pressure, self.gas_pressure),
        };
        let initial = InitialCondition {
            ambient: state(Phase::Liquid, 1000.0, FAR),
            pressure: InitialPressure::Uniform,
            regions: self.bubbles.iter().map(bubble).collect(),
            pulses: self.pulses.clone(),
        };
        let domain =
            Domain { geometry: AXIAL, z: self.z.map(|radii| radii * RADIUS), r: [0.0, self.r * RADIUS] };
        let far_field =
            FarField::of(&initial, &Mixture::new(LIQUID, GAS), &domain, self.boundaries, None, 1.0).ok();
        let setup = FluidSetup {
            domain,
            levels,
            model: Model::FiveEquation,
            sharpening: Sharpening::Thinc,
            adaptation: Some(Adaptation::by_details(3e-4, 8)),
            scales: fluid::Scales { pressure: FAR, density: 1e3 },
            far_field,
            ..setup(AXIAL, coarsest, self.boundaries)
        };
        FluidSolver::new(&setup, &initial).unwrap()
    }
}

/// Time and equivalent radius of the first minimum of the gas's volume, and radius of the maximum after it, in radii and
/// Rayleigh's times.
fn collapse(mut fluid: FluidSolver<16>) -> [f64; 3] {
    let (mut least, mut largest) = ([f64::INFINITY, f64::INFINITY], 0.0_f64);
    while fluid.time() < 2.1 * RAYLEIGH {
        let (dt, steps) = step_locally(&mut fluid);
        fluid.adapt_if_due(dt, steps);
        let radius = fluid.bubble().equivalent_radius / RADIUS;
        if radius < least[1] {
            (least, largest) = ([fluid.time() / RAYLEIGH, radius], 0.0);
        }
        largest = largest.max(radius);
    }
    [least[0], least[1], largest]
}

/// With the incoming characteristic held, sides at 8 radii take a third of the collapse's time more, and at 4 radii the bubble
/// does not collapse.
#[test]
fn a_free_bubble_collapses_between_near_sides_as_between_far_ones() {
    let [near, far, shifted] =
        [Setting::free(4.0), Setting::free(16.0), Setting { z: [-4.0, 12.0], ..Setting::free(4.0) }]
            .map(|setting| collapse(setting.fluid()));
    eprintln!("4, 16 radii, off-centre: {near:.4?} {far:.4?} {shifted:.4?}");
    for found in [near, shifted] {
        for (k, bound) in [2e-3, 1e-2, 1e-2].into_iter().enumerate() {
            assert!((found[k] / far[k] - 1.0).abs() < bound, "{found:?} {far:?}");
        }
    }
    let held = collapse(Setting { boundaries: HELD, ..Setting::free(8.0) }.fluid());
    assert!(held[0] > 1.2 * far[0], "what the far field is there for: {held:?}");
}

/// The wall's image is a second source, and the bubble moves towards it.
#[test]
fn a_bubble_above_a_wall_collapses_between_near_sides_as_between_far_ones() {
    let boundaries = [Boundary::Wall, Boundary::FarField, Boundary::Axis, Boundary::FarField];
    let [near, far] = [4.0, 16.0].map(|sides| {
        let setting =
            Setting { z: [0.0, sides + 2.0], boundaries, bubbles: vec![[1.5, 1.0]], ..Setting::free(sides) };
        collapse(setting.fluid())
    });
    eprintln!("4, 16 radii: {near:.4?} {far:.4?}");
    for (k, bound) in [2e-3, 1e-2, 1e-2].into_iter().enumerate() {
        assert!((near[k] / far[k] - 1.0).abs() < bound, "{near:?} {far:?}");
    }
}

/// A bubble in equilibrium: round-off must not grow in the impulses that the sides remember.
#[test]
fn at_rest_nothing_moves() {
    let mut fluid = Setting { gas_pressure: FAR, ..Setting::free(4.0) }.fluid();
    let (mass, radius) = (fluid.totals().mass, fluid.bubble().equivalent_radius);
    while fluid.time() < 2.0 * RAYLEIGH {
        step_locally(&mut fluid);
    }
    let [drift, growth] = [fluid.totals().mass / mass - 1.0, fluid.bubble().equivalent_radius / radius - 1.0];
    eprintln!("mass {drift:.1e}, radius {growth:.1e} after {} steps", fluid.steps());
    assert!(drift.abs() < 1e-12 && growth.abs() < 1e-11, "{drift} {growth}");
}

/// The pressure at a point while a pulse comes by.
fn record(setting: &Setting, [z, r]: [f64; 2], end: f64) -> Vec<f64> {
    let mut fluid = setting.fluid();
    let mut pressures = vec![];
    while fluid.time() < end {
        let dt = fluid.time_step_limit(CFL).min(4e-8).min(end - fluid.time());
        fluid.step(dt).unwrap();
        fluid.adapt_if_due(dt, 1);
        pressures.push(fluid.sample([z * RADIUS, r * RADIUS]).unwrap().pressure - FAR);
    }
    pressures
}

/// A plane wave along open r_max, and a spherical one across it: neither has the afterflow of a bubble. The bubble is small and in
/// equilibrium; the reference are sides so far away that nothing comes back.
#[test]
fn waves_from_elsewhere_pass_the_sides() {
    let plane = Pulse {
        shape: PulseShape::Plane { direction: Some([1.0, 0.0]) },
        centre: [-2e-3, 0.0],
        width: 1e-3,
        amplitude: 1e4,
    };
    let sphere = Pulse { shape: PulseShape::Sphere, centre: [1.5e-3, 0.0], ..plane };
    for (name, pulse, bounds) in [("plane", plane, [0.02, 0.3]), ("spherical", sphere, [0.02, 0.05])] {
        let setting = |sides: f64, boundaries| Setting {
            boundaries,
            gas_pressure: FAR,
            bubbles: vec![[-3.0, 0.25]],
            pulses: vec![pulse],
            ..Setting::free(sides)
        };
        let (probe, end) = ([2.0, 2.0], 6e-6);
        let far = record(&setting(16.0, HELD), probe, end);
        let height = far.iter().fold(0.0_f64, |height, p| height.max(p.abs()));
        let off = |boundaries| {
            let near = record(&setting(4.0, boundaries), probe, end);
            assert_eq!(near.len(), far.len());
            near.iter().zip(&far).fold(0.0_f64, |off, (a, b)| off.max((a - b).abs())) / height
        };
        let [open, held] = [off(FREE), off(HELD)];
        eprintln!("{name}: {height:.0} Pa, off by {open:.3} of it, held sides {held:.3}");
        assert!(open < bounds[0] && held > bounds[1], "{name}: {open} {held}");
    }
}
