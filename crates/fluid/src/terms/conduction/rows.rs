//! Loops over the padded cells of a block; written as the kernels of `step/rows.rs`.

use std::ops::Range;

use super::caloric::{Caloric, CellHeat};
use crate::Mixture;
use crate::step::update::Metric;
use crate::terms::GasMass;
use crate::terms::diffusion::largest_per_density;

/// There is no gas, there is one of unknown mass, its share of the mass is known: as constants.
const ABSENT: u8 = 0;
const UNKNOWN: u8 = 1;
const SHARES: u8 = 2;

/// The heat in cells.
///
/// - `cells`: ρ, p, φ; `heat`: T, C and the gas's part of it, in rows as long.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn heat(caloric: &Caloric, cells: [&[f64]; 3], gas: GasMass<'_>, heat: [&mut [f64]; 3]) {
    let [temperature, capacity, gas_share] = heat;
    match gas {
        GasMass::Absent => heat_body::<ABSENT>(caloric, cells, cells[0], temperature, capacity, gas_share),
        GasMass::Unknown => heat_body::<UNKNOWN>(caloric, cells, cells[0], temperature, capacity, gas_share),
        GasMass::Shares(of) => heat_body::<SHARES>(caloric, cells, of, temperature, capacity, gas_share),
    }
}

// The rows that are written as arguments of their own: so it is known that they are no others.
#[inline(always)]
fn heat_body<const GAS: u8>(
    caloric: &Caloric,
    [rho, p, phi]: [&[f64]; 3],
    shares: &[f64],
    temperature: &mut [f64],
    capacity: &mut [f64],
    gas_share: &mut [f64],
) {
    let n = rho.len();
    let (p, phi, shares) = (&p[..n], &phi[..n], &shares[..n]);
    let (temperature, capacity, gas_share) = (&mut temperature[..n], &mut capacity[..n], &mut gas_share[..n]);
    for k in 0..n {
        let heat = match GAS {
            ABSENT => caloric.of_phases([rho[k], p[k], 0.0], 0.0),
            UNKNOWN => caloric.of_mixture([rho[k], p[k], phi[k]]),
            _ => caloric.of_phases([rho[k], p[k], phi[k]], shares[k] * rho[k]),
        };
        let CellHeat { temperature: own, capacity: held, gas_share: of_gas } = heat;
        (temperature[k], capacity[k], gas_share[k]) = (own, held, of_gas);
    }
}

/// What cells gain of energy and of pressure in half a step, −½ Δt ∇·q and that over β₁: of a block and its first ghosts.
///
/// - `cells`: ρ and φ; `fluxes`: along z and r; `gains`: written, J/m³, and added to, Pa.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn gain(
    mixture: &Mixture,
    (metric, count): (&Metric<'_>, usize),
    (cells, gas, inverse_r): ([&[f64]; 2], GasMass<'_>, &[f64]),
    fluxes: [&[f64]; 2],
    [gain, pressure]: [&mut [f64]; 2],
) {
    let side = count + 2;
    for first in (0..side).map(|j| metric.origin + j * metric.stride - metric.stride - 1) {
        let faces = first..first + side;
        let (gain, pressure) = (&mut gain[faces.clone()], &mut pressure[faces.clone()]);
        match gas {
            GasMass::Absent => gain_body::<ABSENT>(
                mixture, metric, faces, cells, cells[0], inverse_r, fluxes, gain, pressure,
            ),
            GasMass::Unknown => gain_body::<UNKNOWN>(
                mixture, metric, faces, cells, cells[0], inverse_r, fluxes, gain, pressure,
            ),
            GasMass::Shares(of) => {
                gain_body::<SHARES>(mixture, metric, faces, cells, of, inverse_r, fluxes, gain, pressure)
            }
        }
    }
}

#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias")]
#[inline(always)]
fn gain_body<const GAS: u8>(
    mixture: &Mixture,
    metric: &Metric<'_>,
    range: Range<usize>,
    [rho, phi]: [&[f64]; 2],
    shares: &[f64],
    inverse_r: &[f64],
    [z, r]: [&[f64]; 2],
    gain: &mut [f64],
    pressure: &mut [f64],
) {
    let (first, n) = (range.start, range.len());
    let (gain, pressure) = (&mut gain[..n], &mut pressure[..n]);
    let (rho, phi, shares) = (&rho[first..][..n], &phi[first..][..n], &shares[first..][..n]);
    let inverse_r = &inverse_r[first..][..n];
    let (z_above, z_below) = (&z[first..][..n], &z[first - 1..][..n]);
    let (r_above, r_below) = (&r[first..][..n], &r[first - metric.stride..][..n]);
    let [inverse_z, inverse_h] = metric.inverse_h;
    for k in 0..n {
        // r_j±1/2 / r_j.
        let half_width = 0.5 * (inverse_r[k] / inverse_h);
        let (low, high) = (1.0 - half_width, 1.0 + half_width);
        let out = inverse_z * (z_above[k] - z_below[k]) + inverse_h * (high * r_above[k] - low * r_below[k]);
        gain[k] = -0.5 * metric.dt * out;
        let beta1 = match GAS {
            ABSENT => mixture.free_betas::<true>(0.0, rho[k], 0.0)[0],
            UNKNOWN => mixture.free_betas::<false>(phi[k], rho[k], 0.0)[0],
            _ => mixture.free_betas::<true>(phi[k], rho[k], shares[k] * rho[k])[0],
        };
        pressure[k] += gain[k] / beta1;
    }
}

/// Conductances of the faces of liquid, W/(m² K), no more than the cell of less heat capacity bears.
///
/// - `faces`: by the cells below them, `step` to those above; `most`: the most that a cell bears per heat capacity, m²/s.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn conductances_of_liquid(
    (conductivity, most, inverse_h): (f64, f64, f64),
    (faces, step): (Range<usize>, usize),
    capacity: &[f64],
    conductance: &mut [f64],
) {
    let (first, n) = (faces.start, faces.len());
    let (low, high) = (&capacity[first..][..n], &capacity[first + step..][..n]);
    let conductance = &mut conductance[faces];
    for k in 0..n {
        conductance[k] = inverse_h * bounded(conductivity, most, [low[k], high[k]]);
    }
}

/// A conductivity, but no more than the cell of less heat capacity bears in a step.
#[inline(always)]
pub(super) fn bounded(conductivity: f64, most: f64, [low, high]: [f64; 2]) -> f64 {
    let bound = most * if low < high { low } else { high };
    if conductivity > bound { bound } else { conductivity }
}

/// The largest of λ/C per density, of mixtures of gas and liquid that have these.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn most_diffusivity([gas, liquid]: [f64; 2], density: &[f64], phi: &[f64]) -> f64 {
    largest_per_density(density, phi, |phi| {
        let phi = phi.clamp(0.0, 1.0);
        phi * gas + (1.0 - phi) * liquid
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NamedFluid;

    #[test]
    fn rows_have_the_heat_of_their_cells() {
        let [liquid, gas] =
            ["water-nasg", "air"].map(|name| NamedFluid::of(name).expect("it is in the library").law);
        let caloric = Caloric::of(&Mixture::new(liquid, gas)).expect("both have heat capacities");
        let phi: Vec<f64> = (0..37).map(|k| (f64::from(k) * 0.7).sin().max(0.0)).collect();
        let pressure: Vec<f64> = (0..37).map(|k| 1e5 * f64::from(k + 1)).collect();
        let density: Vec<f64> = phi.iter().map(|phi| 1000.0 - 998.0 * phi).collect();
        let shares: Vec<f64> = phi.iter().zip(&density).map(|(phi, density)| phi * 1.2 / density).collect();
        for kind in [GasMass::Absent, GasMass::Unknown, GasMass::Shares(&shares)] {
            let mut found = [0, 1, 2].map(|_| vec![0.0; 37]);
            heat(&caloric, [&density, &pressure, &phi], kind, found.each_mut().map(|row| &mut row[..]));
            for k in 0..37 {
                let expected = match kind {
                    GasMass::Absent => caloric.of_phases([density[k], pressure[k], 0.0], 0.0),
                    GasMass::Unknown => caloric.of_mixture([density[k], pressure[k], phi[k]]),
                    GasMass::Shares(_) => {
                        caloric.of_phases([density[k], pressure[k], phi[k]], shares[k] * density[k])
                    }
                };
                let CellHeat { temperature, capacity, gas_share } = expected;
                assert_eq!(found.each_ref().map(|row| row[k]), [temperature, capacity, gas_share], "{k}");
            }
        }
    }

    #[test]
    fn liquid_conducts_no_more_than_the_cell_of_less_heat_capacity_bears() {
        let capacity: Vec<f64> = (0..40).map(|k| 1.0 + f64::from(k % 7)).collect();
        let mut conductance = vec![0.0; 40];
        conductances_of_liquid((2.5, 0.8, 10.0), (3..30, 4), &capacity, &mut conductance);
        for k in 0..40 {
            let expected = if (3..30).contains(&k) {
                10.0 * (0.8 * capacity[k].min(capacity[k + 4])).min(2.5)
            } else {
                0.0
            };
            assert_eq!(conductance[k], expected, "{k}");
        }
    }
}
