//! Gas that flows past the liquid of mixed cells, to an interface where it condenses and away from one where it evaporates.

use super::heating::CellInHeat;
use super::{FinishedCells, GasMass, Term, TermBlock};
use crate::phase_change::{HELD, Saturation, facing};
use crate::state::primitive::{PHI, PRESSURE, RHO, VELOCITY};
use crate::step::clips::Clips;
use crate::step::face_rows::FaceRows;
use crate::{EvaporationLaw, Mixture, PhaseChange};

/// The largest part of a cell's gas that slips through one of its faces in a step.
const MOST: f64 = 0.1;

/// The slip of gas past liquid, where masses change phase.
///
/// A cell of the two-phase models has one velocity. Vapour could come into a mixed cell, or leave it, only as fast as the liquid in it gives
/// way: Δp over the impedance of the mixture, which is some thousand times the gas's. Gas at an interface does not wait for the liquid. On the face
/// between cells of gas fractions φ_n > φ_m it crosses the liquid's motion u* with a speed w towards m. With the impedance Z = √(γ p_n ρ_g) of the gas in
/// n, p* = p_n + Z (u_n − u*) is its pressure were it to stop on the liquid.
///
/// Vapour condenses by Hertz's and Knudsen's j at the pressure p_s that is left on the surface, x p* − Z w_c for a part x of vapour. So both
/// resist in series,
///
/// w_c = (x p* − p_eq(T_l, p_l))/(ρ_g √(2πRT_l)/α + Z), p_s = p* − Z w_c,
///
/// and w_c = 0 where it would evaporate. It is vapour that condenses; the other gas stays. The gas of a mixed cell m comes to p_s besides, in an implicit step of that pressure, with
/// K_m = γ p_m/φ_m:
///
/// w = φ_n (1 − Y_m) [|n| w_c + (p_s − p_m)/(Z + K_m Δt/h)].
///
/// In equilibrium 1/α = 0, and the gas of m is at p_eq itself: only w_c is left. To let vapour leave m besides made bubbles in superheated liquid
/// grow bumps, `study_of_scrivens_bubbles`.
///
/// n is the interface's normal along the face's, Y the gas's part of the mass: without liquid in m the faces' Riemann problem has the
/// gas's velocity already. Mass, momentum and enthalpy pass with w. The face's pressure falls by Y_n Z w, as far as the cell n moves as its gas does. In
/// the end the gas of mixed cells has the enthalpy that came with it, and both phases come to one pressure.
///
/// At one pressure and one velocity nothing slips in equilibrium.
///
/// - valid for: an ideal gas, phases with masses of their own. errors: none.
/// - tested by: `tests/verification/condensation.rs`, fronts in `phase_change.rs`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GasSlip {
    saturation: Saturation,
    /// α, infinite where phases are in equilibrium.
    accommodation: f64,
}

/// The gas of a cell.
struct Gas {
    /// kg/m³.
    density: f64,
    /// Pa.
    pressure: f64,
    /// The vapour's part of its mass.
    vapour: f64,
}

/// A face, and the cells on both sides of it.
struct Between {
    /// The padded cell of more gas, and that of less.
    from: usize,
    to: usize,
    /// 1 where that is upwards along the axis, −1 else.
    sign: f64,
    /// 0: z, 1: r.
    axis: usize,
    /// The velocity through the face, m/s.
    star: f64,
}

impl GasSlip {
    /// `None` where the phases have no equilibrium.
    pub fn of(asked: &PhaseChange, mixture: &Mixture) -> Option<Self> {
        let accommodation = match asked.law {
            EvaporationLaw::HertzKnudsen { accommodation } => accommodation,
            EvaporationLaw::Equilibrium => f64::INFINITY,
        };
        Some(Self { saturation: Saturation::of(mixture)?, accommodation })
    }

    /// The pressure of the gas of a padded cell, Pa.
    fn pressure(block: &TermBlock<'_>, cell: usize) -> f64 {
        block.before[PRESSURE][cell] + block.capillary.excess().map_or(0.0, |excess| excess[cell])
    }

    /// The gas of a padded cell; `None` without a pressure of its own.
    fn gas(block: &TermBlock<'_>, [shares, vapour]: [&[f64]; 2], cell: usize) -> Option<Gas> {
        let density = shares[cell] * block.before[RHO][cell] / block.before[PHI][cell];
        let pressure = Self::pressure(block, cell);
        let vapour = (vapour[cell] / shares[cell]).clamp(0.0, 1.0);
        (density > 0.0 && pressure > 0.0).then_some(Gas { density, pressure, vapour })
    }

    /// The speed with which gas of a cell flows to liquid beside it on which it condenses, m/s; 0 where it does not.
    ///
    /// - `arriving`: the pressure of that gas were it to come to rest on the liquid, p*, Pa; `impedance`: Z.
    fn condensing(
        &self,
        block: &TermBlock<'_>,
        shares: &[f64],
        cell: usize,
        (gas, arriving, impedance): (&Gas, f64, f64),
    ) -> f64 {
        let [density, phi] = [RHO, PHI].map(|c| block.before[c][cell]);
        let mass = density * (1.0 - shares[cell]);
        let pressure = Self::pressure(block, cell) - block.capillary.jump(cell);
        let temperature = self.saturation.liquid_temperature(mass, 1.0 - phi, pressure);
        if !(temperature > 0.0 && temperature < Saturation::CRITICAL[0] && pressure < Saturation::CRITICAL[1])
        {
            return 0.0;
        }
        let beyond = gas.vapour * arriving - self.saturation.vapour_pressure(temperature, pressure);
        if !(beyond > 0.0) {
            return 0.0;
        }
        let per_pressure = self.accommodation / self.saturation.kinetic_speed(temperature);
        beyond / (gas.density / per_pressure + impedance)
    }

    /// What slips through a face; `None` if nothing.
    fn through(&self, block: &TermBlock<'_>, rows: [&[f64]; 2], face: &Between) -> Option<Slip> {
        let Between { from, to, sign, axis, star } = *face;
        let [shares, _] = rows;
        let (phi, metric) = (block.before[PHI], block.metric);
        let heavy = 1.0 - shares[to];
        if !(heavy > 0.0 && phi[from] > HELD) {
            return None;
        }
        let there = Self::gas(block, rows, from)?;
        let gamma = self.saturation.mixture().gas.gamma;
        let impedance = (gamma * there.pressure * there.density).sqrt();
        let velocity = |cell: usize, axis: usize| block.before[VELOCITY[axis]][cell];
        let arriving = there.pressure + impedance * sign * (velocity(from, axis) - star);
        let courant = metric.dt * metric.inverse_h[axis];
        let is_mixed = phi[to] > HELD;
        let mut condensing = self.condensing(block, shares, to, (&there, arriving, impedance));
        if condensing > 0.0 {
            // Of what faces along both axes bring to a front each brings its part.
            let place = if is_mixed { to } else { from };
            let facing = facing(phi, place, metric.stride, metric.inverse_h)[axis];
            condensing = facing * condensing.min(MOST / courant * there.vapour);
        }
        let (mut speed, mut donor) = (condensing, (from, &there));
        let comes_to_rest = is_mixed && self.accommodation.is_finite();
        let here = if comes_to_rest { Some(Self::gas(block, rows, to)?) } else { None };
        if let Some(here) = &here {
            let surface = arriving - impedance * condensing;
            speed += (surface - here.pressure) / (impedance + gamma * here.pressure / phi[to] * courant);
            donor = if speed < 0.0 { (to, here) } else { donor };
        }
        let least = if comes_to_rest { -MOST / courant * phi[to] } else { 0.0 };
        let selected = if speed > 0.0 { (condensing / speed).min(1.0) * (1.0 - there.vapour) } else { 0.0 };
        let speed = (phi[from] * heavy * speed).max(least).min(MOST / courant * phi[from]);
        let (cell, gas) = donor;
        let flow = sign * speed;
        let mass = gas.density * flow;
        let [normal, along] = [velocity(cell, axis), velocity(cell, 1 - axis)];
        (speed != 0.0).then(|| Slip {
            mass,
            vapour: selected * mass,
            enthalpy: gamma / (gamma - 1.0) * gas.pressure * flow,
            kinetic: 0.5 * mass * (normal * normal + along * along),
            shear: mass * along,
            pull: shares[from] * impedance * speed,
        })
    }
}

/// What slips through a face, per area and time.
struct Slip {
    /// kg/(m² s), and what of it is vapour beyond the vapour's part of the gas.
    mass: f64,
    vapour: f64,
    /// W/m²; and the kinetic energy.
    enthalpy: f64,
    kinetic: f64,
    /// Momentum along the face, Pa.
    shear: f64,
    /// What the pressure on the face falls by, Pa.
    pull: f64,
}

impl Term for GasSlip {
    fn add_fluxes(&self, block: &TermBlock<'_>, faces: [&mut FaceRows; 2], work: &mut Vec<f64>) -> Clips {
        let len = block.before[RHO].len();
        work.clear();
        work.resize(4 * len, 0.0);
        let (GasMass::Shares(shares), Some(vapour)) = (block.gas, block.vapour) else {
            return Clips::default();
        };
        let (n, metric, phi) = (block.cells, block.metric, block.before[PHI]);
        let last = metric.origin + (n - 1) * metric.stride + n;
        let steps = [1, metric.stride];
        let (enthalpies, selected) = work.split_at_mut(2 * len);
        let rows = enthalpies.chunks_exact_mut(len).zip(selected.chunks_exact_mut(len));
        for (axis, ((faces, (enthalpies, selected)), step)) in
            faces.into_iter().zip(rows).zip(steps).enumerate()
        {
            for k in metric.origin - step..last {
                if phi[k] == phi[k + step] {
                    continue;
                }
                let star = faces.velocity[k];
                let (from, to, sign) =
                    if phi[k] > phi[k + step] { (k, k + step, 1.0) } else { (k + step, k, -1.0) };
                let between = Between { from, to, sign, axis, star };
                let Some(slip) = self.through(block, [shares, vapour], &between) else { continue };
                (enthalpies[k], selected[k]) = (slip.enthalpy, slip.vapour);
                let (gas, _) = faces.gas_mut();
                gas[k] += slip.mass;
                let [mass, _, pressure, shear, energy, _] = faces.fluxes_mut();
                mass[k] += slip.mass;
                pressure[k] -= slip.pull;
                shear[k] += slip.shear;
                energy[k] += slip.enthalpy + slip.kinetic - slip.pull * star;
            }
        }
        Clips::default()
    }

    fn selected_vapour<'w>(&self, work: &'w [f64], padded: usize) -> Option<[&'w [f64]; 2]> {
        Some([2, 3].map(|row| &work[row * padded..][..padded]))
    }

    /// Gives the gas of mixed cells the enthalpy that came with what slipped in.
    fn finish(&self, cells: &mut FinishedCells<'_>, work: &[f64]) {
        let [z, r] = [0, 1].map(|axis| &work[axis * cells.phi.len()..][..cells.phi.len()]);
        cells.change_mixed(
            |_| true,
            |cells, state, (k, j)| {
                let row = cells.metric.row(j);
                let gained = -(row.axial(z[k], z[k - 1]) + row.radial(r[k], r[k - cells.metric.stride]));
                if gained == 0.0 {
                    return None;
                }
                let cell = CellInHeat::of(state, cells.capillary.jump(k), cells.mixture);
                cell.heated(&cell.without(gained)?, [gained, 0.0])
            },
        );
    }
}
