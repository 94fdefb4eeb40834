//! What walls do with the heat that a fluid conducts to them.

use std::f64::consts::PI;
use std::ops::Range;

use mesh::{BlockId, Mesh};
use serde::{Deserialize, Serialize};

/// What walls do with heat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum WallHeat {
    /// They let nothing through.
    #[default]
    Adiabatic,
    /// All walls are kept at this temperature, K.
    Isothermal(f64),
    /// The wall on z_min conducts heat itself; others let nothing through.
    Conducting(ConductingWall),
}

/// A wall that is a half-space of a conductor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductingWall {
    /// At first, and far within at all times, K.
    pub temperature: f64,
    /// Effusivity e = √(λρc), J/(m² K s^½): all that its surface shows of it.
    pub effusivity: f64,
}

/// Rates of decay that the memory of a wall has: 10⁻² to 10¹⁵ 1/s, in steps of e^0.9, and 0.
const MODES: usize = 45;
/// The step between two, as a logarithm.
const SPACING: f64 = 0.9;
/// The slowest but 0, 1/s.
const SLOWEST: f64 = 1e-2;

/// The rate of a mode, 1/s, and its weight in the kernel, s^-½.
fn mode(number: usize) -> [f64; 2] {
    match number {
        // What all slower ones come to.
        0 => [0.0, 2.0 / PI * (SLOWEST * (-0.5 * SPACING).exp()).sqrt()],
        number => {
            let rate = SLOWEST * (SPACING * (number - 1) as f64).exp();
            [rate, SPACING / PI * rate.sqrt()]
        }
    }
}

/// What a step of some length makes of the modes.
#[derive(Clone, Debug)]
pub(crate) struct Decays {
    /// s.
    dt: f64,
    /// e^{−sΔt}.
    left: [f64; MODES],
    /// (1 − e^{−sΔt})/s, s: what a flux of 1 adds in the step, and Δt times the mean of what decays from 1.
    gained: [f64; MODES],
}

impl Decays {
    pub fn of(dt: f64) -> Self {
        let (mut left, mut gained) = ([1.0; MODES], [dt; MODES]);
        for number in 1..MODES {
            let [rate, _] = mode(number);
            left[number] = (-rate * dt).exp();
            gained[number] = -(-rate * dt).exp_m1() / rate;
        }
        Self { dt, left, gained }
    }
}

/// A conducting wall's memory of the heat that it got, on radial cells of the finest level.
///
/// Below each cell is a half-space that conducts heat normal to its surface: the heat goes deep less far than a cell is wide. Its surface has,
/// exactly (Carslaw & Jaeger 1959, §2.9),
///
/// T(t) = T₀ + 1/(e√π) ∫ q(t′)/√(t − t′) dt′,   1/√(πt) = 1/π ∫ e^{−st}/√s ds ≈ Σ w_j e^{−s_j t},
///
/// the sum by the trapezoidal rule in ln s, right to 5·10⁻⁵ from 10⁻¹⁴ to 10⁻² s, to 10⁻³ up to 1 s. With a flux that is constant in each step the
/// modes y_j = ∫ q e^{−s_j(t − t′)} dt′ advance exactly, whatever the step.
///
/// - tested by: a constant flux in steps of all lengths; media in contact.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct WallMemory {
    /// T₀, K.
    temperature: f64,
    /// e, J/(m² K s^½).
    effusivity: f64,
    /// y_j of each cell, J/m².
    modes: Vec<f64>,
}

impl WallMemory {
    /// A wall of so many cells that has got no heat yet.
    pub fn new(wall: ConductingWall, cells: usize) -> Self {
        let ConductingWall { temperature, effusivity } = wall;
        Self { temperature, effusivity, modes: vec![0.0; cells * MODES] }
    }

    /// Whether another one is of such a wall.
    pub fn fits(&self, other: &Self) -> bool {
        let of = |wall: &Self| (wall.temperature, wall.effusivity, wall.modes.len());
        of(self) == of(other)
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.modes.len() / MODES
    }

    /// Writes the mean temperatures that the wall would have in a step without heat coming in, K: on the faces of a block and one more
    /// at both ends, or the same as on the last.
    pub fn temperatures<const N: usize>(&self, mesh: &Mesh<N>, id: BlockId, dt: f64, put: &mut [f64]) {
        let decays = Decays::of(dt);
        let last = self.cells() / self.under_face(mesh, id.level, 0).len() - 1;
        for (along, put) in put.iter_mut().enumerate() {
            let face = (id.j as usize * N + along).saturating_sub(1).min(last);
            let (mut sum, mut whole) = (0.0, 0.0);
            for cell in self.under_face(mesh, id.level, face) {
                let weight = self.weight(mesh, cell);
                sum += weight * self.temperature(cell, &decays);
                whole += weight;
            }
            *put = sum / whole;
        }
    }

    /// Takes the fluxes that a block's faces got in a step, W/m².
    pub fn take_from<const N: usize>(&mut self, mesh: &Mesh<N>, id: BlockId, dt: f64, fluxes: &[f64]) {
        let decays = Decays::of(dt);
        for (j, flux) in fluxes.iter().enumerate() {
            self.take(self.under_face(mesh, id.level, id.j as usize * N + j), *flux, &decays);
        }
    }

    /// The cells under a face of a level.
    fn under_face<const N: usize>(&self, mesh: &Mesh<N>, level: u8, face: usize) -> Range<usize> {
        let each = 1 << (mesh.tree().finest() - level);
        face * each..(face + 1) * each
    }

    /// Weight of a cell's area.
    fn weight<const N: usize>(&self, mesh: &Mesh<N>, cell: usize) -> f64 {
        let h_r = mesh.widths(mesh.tree().finest())[1];
        mesh.weight(mesh.domain().r[0] + (cell as f64 + 0.5) * h_r)
    }

    /// The mean temperature that the surface of a cell would have in a step without heat coming in, K.
    pub fn temperature(&self, cell: usize, decays: &Decays) -> f64 {
        let inverse = 1.0 / decays.dt;
        let modes = &self.modes[cell * MODES..(cell + 1) * MODES];
        let memory: f64 = (0..MODES).map(|j| mode(j)[1] * modes[j] * (decays.gained[j] * inverse)).sum();
        self.temperature + memory / self.effusivity
    }

    /// How much warmer the surface is in the mean of a step by a constant flux within it, per flux, m² K/W: 4/3 √(Δt/π)/e.
    pub fn resistance(&self, dt: f64) -> f64 {
        4.0 / 3.0 * (dt / PI).sqrt() / self.effusivity
    }

    /// Takes the flux that some cells got in a step, W/m².
    pub fn take(&mut self, cells: Range<usize>, flux: f64, decays: &Decays) {
        for modes in self.modes[cells.start * MODES..cells.end * MODES].chunks_exact_mut(MODES) {
            for (j, mode) in modes.iter_mut().enumerate() {
                *mode = *mode * decays.left[j] + flux * decays.gained[j];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WALL: ConductingWall = ConductingWall { temperature: 300.0, effusivity: 7000.0 };

    /// T − T₀ = 2q√(t/π)/e, and its mean over a step.
    #[test]
    fn a_constant_flux_warms_the_surface_by_the_root_of_time() {
        let flux = 3e6;
        for first in [1e-12, 1e-9, 1e-4] {
            let mut wall = WallMemory::new(WALL, 2);
            let (mut time, mut dt): (f64, f64) = (0.0, first);
            for step in 0..120 {
                let decays = Decays::of(dt);
                let got = wall.temperature(1, &decays) + flux * wall.resistance(dt);
                let integral = |t: f64| 4.0 / 3.0 * flux * t * (t / PI).sqrt() / WALL.effusivity;
                let mean = (integral(time + dt) - integral(time)) / dt;
                assert!((got - 300.0 - mean).abs() < 1e-3 * mean, "{first} {step}: {got} {mean}");
                wall.take(1..2, flux, &decays);
                time += dt;
                dt *= if step % 7 == 0 { 1.7 } else { 0.97 };
            }
            assert_eq!(wall.temperature(0, &Decays::of(1e-9)), 300.0, "the other cell got nothing");
        }
    }

    /// The kernel itself, over all the times that it is for.
    #[test]
    fn modes_add_up_to_the_root_of_time() {
        for exponent in -28..=0 {
            let t = 10_f64.powf(0.5 * f64::from(exponent));
            let sum: f64 = (0..MODES).map(mode).map(|[rate, weight]| weight * (-rate * t).exp()).sum();
            let wanted = 1.0 / (PI * t).sqrt();
            let most = if t > 5e-3 { 1e-3 } else { 6e-5 };
            assert!((sum / wanted - 1.0).abs() < most, "{t}: {sum} {wanted}");
        }
    }
}
