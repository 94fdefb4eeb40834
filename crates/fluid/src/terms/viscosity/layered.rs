//! How the liquid of mixed cells is deformed.

use std::ops::Range;

use super::stress::{FaceStress, Motion, share};

/// What is needed of mixed cells, padded rows.
#[derive(Clone, Copy)]
pub(super) struct Layers<'a> {
    /// μ and κ of the liquid, Pa s.
    pub liquid: [f64; 2],
    /// φ.
    pub phi: &'a [f64],
    /// (1 − φ)(1 − K/K_l): the liquid's volume, times the part of the cell's dilatation that it does not take. 0 in cells of one phase.
    pub spared: &'a [f64],
}

/// How much more than (4μ/3 + κ) a layer of liquid resists that is stretched along itself, of μ: a sheet has 4μ (Trouton).
pub(super) const SHEET: f64 = 8.0 / 3.0;

/// Takes the liquid of mixed cells for a layer: puts other stresses on the faces that such a cell has.
///
/// A mixed cell is gas beside liquid, with the normal n = ∇φ/|∇φ| between. Both are stretched alike along the interface. Across it
/// the gas takes nearly all of the dilatation D, and the liquid is left with
///
/// e_l = e − s D nn,   s = 1 − K/K_l,   tr e_l = (1 − s) D.
///
/// Around a bubble it is stretched by −2 V/R across the interface, as the liquid outside is, though the cell may be stretched by as little as
/// the gas is. Its stress τ_l resists with what it has in common with the cell's motion, so that τ : e is its friction τ_l : e_l:
///
/// τ = (1 − φ)(τ_l − s (n·τ_l n) I).
///
/// Across the interface nothing is left with s = 1: the pressure of a mixed cell is its gas's, and that of its liquid is higher by n·τ_l n.
/// The gas has the cell's own motion.
///
/// - `range`: of the cells below the faces; others as in [`super::stress::stresses`], which has been there.
/// - tested by: liquid around a bubble, sheets, orientation.
pub(super) fn take_for_layers(
    m: &Motion<'_>,
    layers: &Layers<'_>,
    axis: usize,
    range: Range<usize>,
    out: &mut FaceStress<'_>,
) {
    let (step, along) = if axis == 0 { (1, m.stride) } else { (m.stride, 1) };
    let [u, w] = [m.velocity[axis], m.velocity[1 - axis]];
    let (across, sideways) = (m.inverse_h[axis], 0.25 * m.inverse_h[1 - axis]);
    let v_r = m.velocity[1];
    for k in range {
        let n = k + step;
        let spared = 0.5 * (layers.spared[k] + layers.spared[n]);
        if spared == 0.0 {
            continue;
        }
        let slope = |v: &[f64]| across * (v[n] - v[k]);
        let slide = |v: &[f64]| sideways * ((v[k + along] - v[k - along]) + (v[n + along] - v[n - along]));
        let around = 0.5 * (v_r[k] * m.inverse_r[k] + v_r[n] * m.inverse_r[n]);
        let strain = Strain { normal: slope(u), tangential: slide(w), sheared: slope(w) + slide(u), around };
        let [mu, kappa] = [m.shear, m.bulk].map(|row| 0.5 * (row[k] + row[n]));
        let of_liquid = 1.0 - 0.5 * (layers.phi[k].clamp(0.0, 1.0) + layers.phi[n].clamp(0.0, 1.0));
        let liquid = layers.liquid.map(|viscosity| of_liquid * viscosity);
        let less = strain.spared(liquid, spared / of_liquid, [slope(layers.phi), slide(layers.phi)]);
        let stretch = strain.normal;
        let divergence = stretch + strain.tangential + around;
        let least = if m.density[k] < m.density[n] { m.density[k] } else { m.density[n] };
        let share = share(m.most * least, 4.0 / 3.0 * mu + kappa + SHEET * spared * layers.liquid[0]);
        out.normal[k] = share * (2.0 * mu * stretch + (kappa - 2.0 / 3.0 * mu) * divergence + less.normal);
        out.shear[k] = share * (mu * strain.sheared + less.shear);
        out.hoop[k] = share * (2.0 * mu * (stretch - around) + less.hoop);
    }
}

/// Rates of strain on a face, 1/s.
#[derive(Clone, Copy, Debug)]
struct Strain {
    /// ∂n u, across the face.
    normal: f64,
    /// ∂t w, along it.
    tangential: f64,
    /// ∂n w + ∂t u.
    sheared: f64,
    /// v_r/r.
    around: f64,
}

/// What the layer of liquid adds to the stresses on a face, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Added {
    normal: f64,
    shear: f64,
    /// To τ_nn − τ_φφ.
    hoop: f64,
}

impl Strain {
    /// - `liquid`: (1 − φ)μ, (1 − φ)κ; `spared`: s; `slopes`: of φ across the face and along it, 1/m.
    fn spared(&self, [mu, kappa]: [f64; 2], spared: f64, slopes: [f64; 2]) -> Added {
        let size = slopes[0] * slopes[0] + slopes[1] * slopes[1];
        let per_size = if size > 0.0 { 1.0 / size } else { 0.0 };
        let [nn, tt, nt] =
            [slopes[0] * slopes[0], slopes[1] * slopes[1], slopes[0] * slopes[1]].map(|a| a * per_size);
        let dilatation = self.normal + self.tangential + self.around;
        let gone = spared * dilatation;
        let left = dilatation - gone;
        let stretched = nn * self.normal + tt * self.tangential + nt * self.sheared;
        // n·τ_l n, and what all normal stresses gain.
        let across = 2.0 * mu * (stretched - gone - left / 3.0) + kappa * left;
        let all = (2.0 / 3.0 * mu - kappa) * gone - spared * across;
        let normal = -2.0 * mu * gone * nn;
        Added { normal: normal + all, shear: -2.0 * mu * gone * nt, hoop: normal }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Liquid of a mixed cell around a bubble, on a face across any direction in the plane.
    #[test]
    fn liquid_around_a_bubble_has_the_friction_of_that_outside() {
        for (phi, angle) in [(0.1, 0.0_f64), (0.5, 0.6), (0.9, 2.0)] {
            let (c, s) = (angle.cos(), angle.sin());
            // Across the interface, and twice along it; the azimuth is along it.
            let [across, along] = [-2.0 + 3.0 * phi, 1.0];
            let strain = Strain {
                normal: across * c * c + along * s * s,
                tangential: across * s * s + along * c * c,
                sheared: 2.0 * (across - along) * c * s,
                around: along,
            };
            let (mu, dilatation) = (1.0 - phi, 3.0 * phi);
            let added = strain.spared([mu, 0.0], 1.0, [c, s]);
            let normal = 2.0 * mu * (strain.normal - dilatation / 3.0) + added.normal;
            let shear = mu * strain.sheared + added.shear;
            // 0 across the interface and 6 along it, turned.
            approx::assert_relative_eq!(normal, 6.0 * mu * s * s, epsilon = 1e-12);
            approx::assert_relative_eq!(shear, -6.0 * mu * c * s, epsilon = 1e-12);
            let around = normal - (2.0 * mu * (strain.normal - along) + added.hoop);
            approx::assert_relative_eq!(around, 6.0 * mu, epsilon = 1e-12);
            // The friction is 2 μ (4 + 1 + 1), not less by (1 − φ)² of it.
            let tangential = 6.0 * mu * c * c;
            let work =
                normal * strain.normal + tangential * strain.tangential + shear * strain.sheared + around;
            approx::assert_relative_eq!(work, 12.0 * mu, epsilon = 1e-12);
        }
    }

    #[test]
    fn a_sheet_that_is_stretched_resists_with_troutons_viscosity() {
        // Along z, with the gas across r; the liquid keeps its volume and the gas fills what it leaves.
        let strain = Strain { normal: 1.0, tangential: 0.0, sheared: 0.0, around: 0.0 };
        let added = strain.spared([1.0, 0.0], 1.0, [0.0, 1.0]);
        let plain = 4.0 / 3.0;
        approx::assert_relative_eq!(plain + added.normal, plain + SHEET, epsilon = 1e-12);
    }

    #[test]
    fn liquid_that_gives_way_as_the_cell_does_adds_nothing() {
        let strain = Strain { normal: 0.3, tangential: -0.7, sheared: 0.2, around: 0.4 };
        let added = strain.spared([1.0, 0.5], 0.0, [0.6, -0.8]);
        assert_eq!([added.normal, added.shear, added.hoop].map(f64::abs), [0.0; 3]);
    }
}
