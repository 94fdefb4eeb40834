//! The cut of a bubble's gas where it is at its largest: what condenses and dissolves until the collapse, at once.

use mesh::BlockSolver;

use super::content::{GasState, compressed};
use super::rule::{BubbleReset, ResetReport};
use crate::physics::Fluid;
use crate::state::conserved::{ENERGY, MOMENTUM_R, MOMENTUM_Z, PHI, RHO};
use crate::state::primitive::PRESSURE;
use crate::state::primitive_of;
use crate::{BubbleCuts, NobleAbelStiffenedGas, Totals};

/// From this gas fraction on the pressure and the density of a cell are those of the gas.
const PURE: f64 = 0.99;

/// Factors of the gas's density and pressure.
#[derive(Clone, Copy, Debug)]
struct Factors {
    density: f64,
    pressure: f64,
}

/// Cuts the gas of a bubble: in each cell its mass per volume is multiplied by one factor and its internal energy as its pressure
/// by another, velocities and gas fractions stay. The liquid of mixed cells keeps its mass and its energy.
///
/// The factors are those from the mean state of the gas (cells with φ ≥ 0.99) to that of [`super::content::BubbleContent::cut`]; with a share s of
/// the mass s and s^γ, the same isentrope. Where phases have no masses of their own, the gas of a cell counts with the mean density.
///
/// - `radius`, `volume`: of the bubble, m, m³. errors: none. tested by: ledgers, the pressure after it, both models.
pub(crate) fn cut<const N: usize>(
    fluid: &mut BlockSolver<Fluid, N>,
    bubble: (&BubbleCuts, usize),
    [radius, volume]: [f64; 2],
    rule: &BubbleReset,
) -> ResetReport {
    let cells = cells_of(fluid, bubble);
    let gas = mean_state(&cells);
    let factors = match rule {
        BubbleReset::GasShare(share) => {
            let left = compressed(&fluid.model().mixture.gas, gas, share * gas.density);
            Factors { density: *share, pressure: left.pressure / gas.pressure }
        }
        BubbleReset::EquilibriumRadius(equilibrium, content) => {
            let left = content.cut(gas, radius, *equilibrium);
            Factors { density: left.density / gas.density, pressure: left.pressure / gas.pressure }
        }
    };
    let came = multiply(fluid, &cells, factors, gas.density);
    let before: f64 = cells.iter().map(|cell| cell.volume * cell.gas_mass(gas.density)).sum();
    ResetReport {
        time: fluid.time(),
        radius,
        volume,
        pressure: [gas.pressure, factors.pressure * gas.pressure],
        gas_mass: [before, before + came.gas_mass],
        mass: came.mass,
        momentum_z: came.momentum_z,
        energy: came.energy,
    }
}

/// A cell with gas in it.
#[derive(Clone, Copy)]
struct GasCell {
    slot: usize,
    /// j N + i.
    cell: usize,
    volume: f64,
    density: f64,
    pressure: f64,
    phi: f64,
    /// The gas's mass per volume where phases have masses of their own.
    own: Option<f64>,
}

impl GasCell {
    /// Mass of the gas per volume, kg/m³.
    ///
    /// - `mean`: density of the gas where the cell does not know.
    fn gas_mass(&self, mean: f64) -> f64 {
        self.own.unwrap_or_else(|| self.phi * self.density.min(mean))
    }
}

/// The cells of a bubble that have gas in them, in the order of their slots.
fn cells_of<const N: usize>(
    fluid: &BlockSolver<Fluid, N>,
    (cuts, number): (&BubbleCuts, usize),
) -> Vec<GasCell> {
    let (mesh, state, model) = (fluid.mesh(), fluid.state(), fluid.model());
    let gas = model.scheme.phases.gas_component();
    let mut cells = Vec::new();
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        for cell in 0..N * N {
            let u = std::array::from_fn(|c| state.component(slot, c)[cell]);
            let own = gas.map(|component| state.component(slot, component)[cell]);
            let (i, j) = (cell % N, cell / N);
            let has_gas = u[PHI] > 0.0 || own.is_some_and(|own| own > 0.0);
            if has_gas && cuts.bubble_at(mesh.centre(*id, i, j)[0]) == number {
                let pressure = primitive_of::<true>(u, own.unwrap_or(0.0), &model.mixture)[PRESSURE];
                let volume = mesh.volume(*id, j);
                cells.push(GasCell { slot, cell, volume, density: u[RHO], pressure, phi: u[PHI], own });
            }
        }
    }
    cells
}

/// The mean pressure and density of the gas, weighted with its volume.
fn mean_state(cells: &[GasCell]) -> GasState {
    let is_pure = |cell: &&GasCell| cell.phi >= PURE;
    // A bubble of a few cells may have none of pure gas.
    let least = if cells.iter().any(|cell| is_pure(&cell)) { PURE } else { 0.0 };
    let mut sums = [0.0; 3];
    for cell in cells.iter().filter(|cell| cell.phi >= least) {
        let weight = cell.phi * cell.volume;
        let density = cell.own.map_or(cell.density, |own| own / cell.phi.max(f64::MIN_POSITIVE));
        for (sum, value) in sums.iter_mut().zip([1.0, cell.pressure, density]) {
            *sum += weight * value;
        }
    }
    GasState { pressure: sums[1] / sums[0], density: sums[2] / sums[0] }
}

/// What the gas of a cell gains in internal energy per volume: that of its own density and of the cell's pressure.
///
/// - `mean`: density of the gas where the cell does not know.
fn internal_gained(gas: &NobleAbelStiffenedGas, at: &GasCell, factors: Factors, mean: f64) -> f64 {
    if at.phi <= 0.0 {
        return 0.0;
    }
    let density = at.gas_mass(mean) / at.phi;
    let [before, after] = [(1.0, 1.0), (factors.density, factors.pressure)].map(|(mass, pressure)| {
        let pressure = pressure * (at.pressure + gas.pi) - gas.pi;
        gas.internal_energy(mass * density, pressure)
    });
    at.phi * (after - before)
}

/// Multiplies the gas of cells; returns what came in by it.
///
/// - `mean`: density of the gas where cells do not know.
fn multiply<const N: usize>(
    fluid: &mut BlockSolver<Fluid, N>,
    cells: &[GasCell],
    factors: Factors,
    mean: f64,
) -> Totals {
    let gas = fluid.model().mixture.gas;
    let component = fluid.model().scheme.phases.gas_component();
    let carried = fluid.model().carried_components();
    let mut came = Totals::default();
    for at in cells {
        let &GasCell { slot, cell, volume, density, .. } = at;
        let block = fluid.state_mut().block_mut(slot);
        let gained = (factors.density - 1.0) * at.gas_mass(mean);
        let internal = internal_gained(&gas, at, factors, mean);
        let [m_z, m_r] = [MOMENTUM_Z, MOMENTUM_R].map(|c| block[c * N * N + cell]);
        let kinetic = 0.5 * gained * (m_z * m_z + m_r * m_r) / (density * density);
        let mut add = |c: usize, gained: f64| {
            let value = &mut block[c * N * N + cell];
            let before = *value;
            *value += gained;
            // As rounded: the ledger is to balance to the last bits.
            volume * (*value - before)
        };
        came.mass += add(RHO, gained);
        came.momentum_z += add(MOMENTUM_Z, gained * m_z / density);
        add(MOMENTUM_R, gained * m_r / density);
        came.energy += add(ENERGY, internal + kinetic);
        came.gas_mass += component.map_or(volume * gained, |component| add(component, gained));
        for component in carried.clone() {
            block[component * N * N + cell] *= 1.0 + gained / density;
        }
    }
    let mut slots: Vec<usize> = cells.iter().map(|cell| cell.slot).collect();
    slots.dedup();
    fluid.state_changed(slots);
    came
}
