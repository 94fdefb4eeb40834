//! Cell averages of the initial condition.

use mesh::{Field, Geometry, Mesh, for_some_blocks};

use crate::initial::shapes::{may_cut, samples};
use crate::state::Contents;
use crate::{
    Gravity, InitialCondition, Mixture, NobleAbelStiffenedGas, Phase, PhaseState, Primitive, PulseShape,
    RayleighField, TRACE_GAS,
};

/// The initial condition's average over a cell.
///
/// Cells that the edge of a region cuts hold the volume fractions of what they contain; a mixed cell has
/// density φρ_g + (1 − φ)ρ_l and the *gas's* pressure. At the liquid's pressure the gas in it would be
/// compressed gas that expands as soon as the run starts.
///
/// - `field`: the pressure that cells of pure ambient liquid have at their centres, and their density along the isentrope
///   of the ambient state; that state itself without. The liquid of cells that a bubble cuts is at the gas's pressure.
pub(crate) fn average(
    initial: &InitialCondition,
    field: Option<&RayleighField>,
    geometry: Geometry,
    mixture: &Mixture,
    centre: [f64; 2],
    widths: [f64; 2],
) -> Contents {
    let mut contents = match field {
        None => cell(initial, &initial.ambient, geometry, centre, widths),
        Some(field) => cell_in_field(initial, field, geometry, mixture, centre, widths),
    };
    if contents.state.phi > TRACE_GAS {
        // A pulse is one of the liquid, at whose amplitude a thin gas would be no gas.
        return contents;
    }
    for pulse in &initial.pulses {
        let density = contents.state.density;
        add_pulse(pulse, centre, mixture, &mut contents.state);
        contents.gas *= contents.state.density / density;
    }
    contents
}

/// Pulses are followed to this many widths, where exp(−x²) is 1e-7, by cells of at most a quarter of a width.
const PULSE_REACH: f64 = 4.0;
const PULSE_CELLS: f64 = 4.0;

/// Whether the initial condition has something in a block that its cells may be too coarse to show: the edge of a
/// region, or a pulse narrower than a few of them.
///
/// - `low`, `high`: the block's corners; `widths`: of its cells.
pub(crate) fn asks_for_finer(
    initial: &InitialCondition,
    low: [f64; 2],
    high: [f64; 2],
    widths: [f64; 2],
) -> bool {
    let centre = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let extent = [0, 1].map(|axis| high[axis] - low[axis]);
    if initial.regions.iter().any(|region| may_cut(&region.shape, centre, extent)) {
        return true;
    }
    initial.pulses.iter().any(|pulse| {
        let radius = 0.5 * extent[0].hypot(extent[1]);
        let nearest = (distance(pulse, centre).0.abs() - radius).max(0.0);
        nearest < PULSE_REACH * pulse.width && widths[0].max(widths[1]) * PULSE_CELLS > pulse.width
    })
}

impl InitialCondition {
    /// Whether it has something in a block that the block's cells may be too coarse to show: the edge of a region, or a pulse
    /// narrower than a few of them. An adaptive grid begins with finer blocks there.
    ///
    /// - `low`, `high`: the block's corners (z, r), m; `widths`: of its cells, m.
    pub fn asks_for_finer(&self, low: [f64; 2], high: [f64; 2], widths: [f64; 2]) -> bool {
        asks_for_finer(self, low, high, widths)
    }
}

/// What a cell holds where liquid at rest carries its own weight; gas stays as it is.
pub(crate) fn under_gravity(mut contents: Contents, gravity: Option<Gravity>, centre: [f64; 2]) -> Contents {
    if let Some(gravity) = gravity {
        let Primitive { density, phi, .. } = contents.state;
        if phi <= TRACE_GAS {
            contents.state.pressure += gravity.head(density, centre[0]);
        }
    }
    contents
}

/// Fills a field of conserved variables with what `state` says of each cell (centre, widths).
pub(crate) fn fill<const N: usize>(
    mesh: &Mesh<N>,
    mixture: &Mixture,
    field: &mut Field,
    state: &(impl Fn([f64; 2], [f64; 2]) -> Contents + Sync + ?Sized),
) {
    let components = field.components();
    for_some_blocks(
        field,
        &mut vec![(); mesh.blocks()],
        |_| true,
        |slot, block, ()| {
            let id = mesh.tree().leaves()[slot];
            let widths = mesh.widths(id.level);
            for j in 0..N {
                for i in 0..N {
                    let cell = state(mesh.centre(id, i, j), widths);
                    let values = cell.state.to_conserved(cell.gas, mixture).into_iter().chain([cell.gas]);
                    for (component, value) in values.take(components).enumerate() {
                        block[(component * N + j) * N + i] = value;
                    }
                }
            }
        },
    );
}

/// The average over one cell, without pulses, where the ambient liquid has a pressure field.
fn cell_in_field(
    initial: &InitialCondition,
    field: &RayleighField,
    geometry: Geometry,
    mixture: &Mixture,
    centre: [f64; 2],
    widths: [f64; 2],
) -> Contents {
    let ambient = |pressure: f64| compressed(&initial.ambient, mixture, pressure);
    let cut = initial
        .regions
        .iter()
        .rev()
        .find(|region| region.state.phase == Phase::Gas && may_cut(&region.shape, centre, widths));
    if let Some(region) = cut {
        let contents = cell(initial, &ambient(region.state.pressure), geometry, centre, widths);
        if contents.state.phi > 0.0 {
            return contents;
        }
    }
    cell(initial, &ambient(field.pressure(centre)), geometry, centre, widths)
}

/// A state brought to another pressure along its isentrope, (p + π)/ρ^γ = const.
fn compressed(state: &PhaseState, mixture: &Mixture, pressure: f64) -> PhaseState {
    let phi = pure(*state).phi;
    let at = mixture.law_at(state.density, phi, phi);
    let density = raised(&at, state.density, (pressure + at.pi) / (state.pressure + at.pi));
    PhaseState { density, pressure, ..*state }
}

/// Density where p + π has become `ratio` times as large along an isentrope.
fn raised(law: &NobleAbelStiffenedGas, density: f64, ratio: f64) -> f64 {
    let ratio = ratio.powf(1.0 / law.gamma);
    // Without a covolume to the last bit the stiffened gas's.
    if law.covolume == 0.0 { density * ratio } else { law.density_of_free(law.free_density(density) * ratio) }
}

/// The average over one cell, without pulses, with `ambient` where no region is.
fn cell(
    initial: &InitialCondition,
    ambient: &PhaseState,
    geometry: Geometry,
    centre: [f64; 2],
    widths: [f64; 2],
) -> Contents {
    if !initial.regions.iter().any(|region| may_cut(&region.shape, centre, widths)) {
        return pure(*at_point(initial, ambient, centre)).into();
    }
    let mut sums = Sums::default();
    for (weight, point) in samples(geometry, centre, widths) {
        sums.add(weight, at_point(initial, ambient, point));
    }
    sums.average()
}

/// Weighted sums over the samples of a cell.
#[derive(Default)]
struct Sums {
    weight: f64,
    gas: f64,
    mass: f64,
    gas_mass: f64,
    momentum: [f64; 2],
    pressure: f64,
    gas_pressure: f64,
}

impl Sums {
    fn add(&mut self, weight: f64, state: &PhaseState) {
        self.weight += weight;
        self.mass += weight * state.density;
        for axis in 0..2 {
            self.momentum[axis] += weight * state.density * state.velocity[axis];
        }
        self.pressure += weight * state.pressure;
        if state.phase == Phase::Gas {
            self.gas += weight;
            self.gas_mass += weight * state.density;
            self.gas_pressure += weight * state.pressure;
        }
    }

    fn average(&self) -> Contents {
        let phi = self.gas / self.weight;
        let pressure =
            if phi > TRACE_GAS { self.gas_pressure / self.gas } else { self.pressure / self.weight };
        let state = Primitive {
            density: self.mass / self.weight,
            v_z: self.momentum[0] / self.mass,
            v_r: self.momentum[1] / self.mass,
            pressure,
            phi,
        };
        Contents { state, gas: self.gas_mass / self.weight }
    }
}

fn pure(state: PhaseState) -> Primitive {
    Primitive {
        density: state.density,
        v_z: state.velocity[0],
        v_r: state.velocity[1],
        pressure: state.pressure,
        phi: if state.phase == Phase::Gas { 1.0 } else { 0.0 },
    }
}

/// The state at a point: the last region painted over it, else the ambient.
fn at_point<'a>(initial: &'a InitialCondition, ambient: &'a PhaseState, point: [f64; 2]) -> &'a PhaseState {
    (initial.regions.iter().rev())
        .find(|region| region.shape.contains(point))
        .map_or(ambient, |region| &region.state)
}

/// Adds p' = A exp(−d²/a²) with isentropic density and, if it travels, v = p'/(ρc).
fn add_pulse(pulse: &crate::Pulse, [z, r]: [f64; 2], mixture: &Mixture, state: &mut Primitive) {
    let (distance, direction) = distance(pulse, [z, r]);
    let excess = pulse.amplitude * (-(distance / pulse.width).powi(2)).exp();
    // Pulses are of one phase, whose part of the mass is φ.
    let at = mixture.law_at(state.density, state.phi, state.phi);
    let modulus = mixture.bulk_modulus(state.density, state.pressure, state.phi, state.phi);
    let impedance = (modulus * state.density).sqrt();
    state.density = raised(&at, state.density, (state.pressure + excess + at.pi) / (state.pressure + at.pi));
    state.pressure += excess;
    if let Some(n) = direction {
        state.v_z += excess / impedance * n[0];
        state.v_r += excess / impedance * n[1];
    }
}

/// Distance of a point from the pulse's crest, and the direction in which it travels.
fn distance(pulse: &crate::Pulse, [z, r]: [f64; 2]) -> (f64, Option<[f64; 2]>) {
    let (dz, dr) = (z - pulse.centre[0], r - pulse.centre[1]);
    match pulse.shape {
        PulseShape::Sphere => (dz.hypot(dr), None),
        PulseShape::Plane { direction: None } => (dz, None),
        PulseShape::Plane { direction: Some(n) } => (dz * n[0] + dr * n[1], Some(n)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Boundary, InitialPressure, Region, Shape};
    use mesh::Domain;

    fn bubble(centre: f64) -> InitialCondition {
        let state = |phase, density, pressure| PhaseState { phase, density, pressure, velocity: [0.0; 2] };
        InitialCondition {
            ambient: state(Phase::Liquid, 1000.0, 5e7),
            pressure: InitialPressure::Uniform,
            regions: vec![Region {
                shape: Shape::Sphere { centre: [centre, 0.0], radius: 0.3 },
                state: state(Phase::Gas, 0.0266, 2118.0),
            }],
            pulses: vec![],
        }
    }

    fn filled(initial: &InitialCondition) -> (Mesh<8>, Field, Mixture) {
        let domain = Domain { geometry: Geometry::Axisymmetric, z: [0.0, 1.0], r: [0.0, 1.0] };
        let mesh = Mesh::<8>::uniform(domain, [1, 1], 6, [false; 2]).unwrap();
        let mixture = Mixture::water_and_air();
        let mut state = Field::zeros(mesh.blocks(), 64, 5);
        let open = Boundary::NonReflecting;
        let sides = [Boundary::Wall, open, Boundary::Axis, open];
        let field = RayleighField::of(initial, None, &domain, sides).unwrap();
        fill(&mesh, &mixture, &mut state, &|centre, widths| {
            average(initial, field.as_ref(), Geometry::Axisymmetric, &mixture, centre, widths)
        });
        (mesh, state, mixture)
    }

    #[test]
    fn the_bubble_has_its_volume_wherever_it_sits() {
        for centre in [0.5, 0.5037, 0.0] {
            let (mesh, field, _) = filled(&bubble(centre));
            let mut volume = 0.0;
            for (slot, id) in mesh.tree().leaves().iter().enumerate() {
                for j in 0..8 {
                    for i in 0..8 {
                        volume += field.component(slot, 4)[j * 8 + i] * mesh.volume(*id, j);
                    }
                }
            }
            let share = if centre == 0.0 { 0.5 } else { 1.0 };
            let exact = share * 2.0 / 3.0 * 0.3_f64.powi(3);
            assert!((volume / exact - 1.0).abs() < 2e-4, "{centre}: {volume} {exact}");
        }
    }

    #[test]
    fn mixed_cells_hold_the_gas_pressure() {
        let (_, field, mixture) = filled(&bubble(0.5));
        let mut mixed = 0;
        for slot in 0..64 {
            for k in 0..64 {
                let u = std::array::from_fn(|c| field.component(slot, c)[k]);
                let w = Primitive::from_conserved(u, 0.0, &mixture);
                let expected = if w.phi > TRACE_GAS { 2118.0 } else { 5e7 };
                assert!((w.pressure - expected).abs() < 1e-6 * 5e7, "{w:?}");
                let density = w.phi * 0.0266 + (1.0 - w.phi) * 1000.0;
                assert!((w.density - density).abs() < 1e-9 * 1000.0);
                mixed += usize::from(w.phi > 1e-6 && w.phi < 1.0 - 1e-6);
            }
        }
        assert!(mixed > 50, "{mixed} mixed cells");
    }

    /// Pure liquid has the field's pressure on the ambient isentrope, up to the bubble; mixed cells the gas's pressure
    /// and a liquid that is as light as at it.
    #[test]
    fn liquid_in_a_field_lies_on_the_ambient_isentrope() {
        let mut initial = bubble(0.5);
        initial.pressure = InitialPressure::Rayleigh;
        let (mesh, state, mixture) = filled(&initial);
        let field = RayleighField::new(&initial, Geometry::Axisymmetric, Some(0.0)).unwrap();
        let isentrope = |p: f64| 1000.0 * ((p + 3e8) / 3.5e8_f64).powf(1.0 / 7.15);
        let (mut mixed, mut lowest) = (0, f64::INFINITY);
        for (slot, id) in mesh.tree().leaves().iter().enumerate() {
            for (j, i) in (0..8).flat_map(|j| (0..8).map(move |i| (j, i))) {
                let u = std::array::from_fn(|c| state.component(slot, c)[j * 8 + i]);
                let w = Primitive::from_conserved(u, 0.0, &mixture);
                let liquid = w.phi == 0.0;
                let pressure = if liquid { field.pressure(mesh.centre(*id, i, j)) } else { 2118.0 };
                let density = w.phi * 0.0266 + (1.0 - w.phi) * isentrope(pressure);
                assert!((w.pressure - pressure).abs() < 1e-6 * 5e7, "{w:?} {pressure}");
                assert!((w.density - density).abs() < 1e-9 * 1000.0, "{w:?} {density}");
                mixed += usize::from(w.phi > 0.0 && w.phi < 1.0);
                lowest = lowest.min(if liquid { pressure } else { lowest });
            }
        }
        assert!(mixed > 50 && lowest < 0.05 * 5e7, "{mixed} mixed cells, lowest pressure {lowest}");
    }

    #[test]
    fn a_pulse_stays_out_of_the_gas() {
        let mut initial = bubble(0.5);
        let (_, before, _) = filled(&initial);
        initial.pulses = vec![crate::Pulse {
            shape: PulseShape::Plane { direction: Some([-1.0, 0.0]) },
            centre: [0.5, 0.0],
            width: 0.2,
            amplitude: -1e6,
        }];
        let (mesh, after, _) = filled(&initial);
        let (mut gas, mut changed) = (0, 0);
        for slot in 0..mesh.blocks() {
            for k in 0..64 {
                let [old, new] =
                    [&before, &after].map(|field| [0, 1, 2, 3, 4].map(|c| field.component(slot, c)[k]));
                gas += usize::from(old[4] > 0.0);
                changed += usize::from(old != new);
                assert!(old[4] == 0.0 || old == new, "{old:?} {new:?}");
            }
        }
        assert!(gas > 300 && changed > 1000, "{gas} cells with gas, {changed} changed");
    }

    #[test]
    fn a_travelling_pulse_is_acoustic() {
        let mut initial = bubble(0.5);
        initial.regions.clear();
        initial.pulses = vec![crate::Pulse {
            shape: PulseShape::Plane { direction: Some([-1.0, 0.0]) },
            centre: [0.5, 0.0],
            width: 0.1,
            amplitude: 1e4,
        }];
        let (mesh, field, mixture) = filled(&initial);
        let (slot, i, j) = mesh.locate([0.5 + 1e-3, 0.3]).unwrap();
        let u = std::array::from_fn(|c| field.component(slot, c)[j * 8 + i]);
        let w = Primitive::from_conserved(u, 0.0, &mixture);
        let impedance = 1000.0 * 1_581.929_201_955_64;
        assert!((w.pressure - 5e7 - 1e4).abs() < 70.0);
        assert!((w.v_z * impedance + (w.pressure - 5e7)).abs() < 1.0, "{w:?}");
    }
}
