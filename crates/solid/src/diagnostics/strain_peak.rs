//! The largest plastic strain of the field that the cells are means of.
//!
//! A cell on the axis holds the mean over a disc, and one of a few cells' width is 1 to 2 % lower there than what is on the axis itself.

use mesh::{Geometry, Side};

use crate::components::PLASTIC_STRAIN;
use crate::{Boundary, SolidSolver};

/// The largest plastic strain and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainPeak {
    /// ε_p.
    pub strain: f64,
    /// Where (z, r), m.
    pub position: [f64; 2],
}

/// What a field is even about that begins with a cell.
#[derive(Clone, Copy, Debug)]
enum Even {
    /// The axis, about which cells are rings.
    InRings,
    /// A plane of symmetry.
    InCells,
}

/// How far above a cell's mean the field rises along one direction, and where, in widths from the cell's centre.
///
/// Of the parabola whose means over the cell and its two neighbours are theirs; at the axis, or a plane of symmetry, of the one that is even in r.
///
/// - `own`: the largest mean of all; `even`: see [`Even`]; `mean`: that of the cell so many widths away, `None` where there is none of that size.
/// - returns: zeros where a neighbour is missing. At a side that is so on purpose: the cell there may be too high by itself.
fn summit(own: f64, even: Option<Even>, mean: impl Fn(isize) -> Option<f64>) -> (f64, f64) {
    let found = if let Some(even) = even {
        let share = match even {
            // Means of r² over the disc of radius h and the ring about it: h²/2 and 5h²/2.
            Even::InRings => 0.25,
            // Over the first cell and the second: h²/3 and 7h²/3.
            Even::InCells => 1.0 / 6.0,
        };
        mean(1).map(|next| (share * (own - next), -0.5))
    } else {
        mean(-1).zip(mean(1)).map(|(lower, upper)| {
            let (slope, bend) = (0.5 * (upper - lower), lower + upper - 2.0 * own);
            if bend < 0.0 { (-bend / 24.0 - 0.5 * slope * slope / bend, -slope / bend) } else { (0.0, 0.0) }
        })
    };
    found.unwrap_or((0.0, 0.0))
}

impl<const N: usize> SolidSolver<N> {
    /// The largest plastic strain and where it is; `None` where nothing has yielded.
    ///
    /// About the cell with the largest mean: see [`SolidSolver::plastic_strain_max`] for that itself. Along each direction the field is
    /// taken for a parabola. What it rises above the mean is of second order in the cells' width.
    ///
    /// - valid for: strains that are smooth on the scale of cells. Along a direction in which a side of the domain or cells of another
    ///   size are next it is the mean.
    /// - tested by: means of known fields; pits against converged finite elements.
    pub fn plastic_strain_peak(&self) -> Option<StrainPeak> {
        let own = self.plastic_strain_max();
        if own <= 0.0 {
            return None;
        }
        let holds = |slot: usize| self.reports().finished[slot].plastic.strain == own;
        let slot = (0..self.mesh().blocks()).find(|slot| holds(*slot))?;
        let cell = self.component(slot, PLASTIC_STRAIN).iter().position(|strain| *strain == own)?;
        let (mesh, id) = (self.mesh(), self.mesh().tree().leaves()[slot]);
        let (centre, widths) = (mesh.centre(id, cell % N, cell / N), mesh.widths(id.level));
        let even = match self.model().boundaries.kind(Side::RMin) {
            Boundary::Axis => Some(Even::InRings),
            Boundary::Symmetry if mesh.domain().geometry == Geometry::Planar => Some(Even::InCells),
            _ => None,
        };
        let even = even.filter(|_| cell / N == 0 && mesh.touches(slot, Side::RMin));
        let along = |axis: usize| {
            summit(own, even.filter(|_| axis == 1), |widths_away| {
                let mut point = centre;
                point[axis] += widths_away as f64 * widths[axis];
                let (slot, i, j) = mesh.locate(point)?;
                let is_of_size = mesh.tree().leaves()[slot].level == id.level;
                is_of_size.then(|| self.plastic_strain(slot, i, j))
            })
        };
        let [(along_z, z), (along_r, r)] = [along(0), along(1)];
        let position = [centre[0] + z * widths[0], centre[1] + r * widths[1]];
        Some(StrainPeak { strain: own + along_z + along_r, position })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Means over cells of width 1 of f, whose integral is `whole`, about a cell from `low` on.
    fn means(low: f64, whole: impl Fn(f64) -> f64) -> impl Fn(isize) -> Option<f64> {
        move |k| Some(whole(low + k as f64 + 1.0) - whole(low + k as f64))
    }

    #[test]
    fn parabolas_are_exact() {
        // 3 − (x − 0.2)²/8 about the cell from −0.5 to 0.5.
        let mean = means(-0.5, |x| 3.0 * x - (x - 0.2).powi(3) / 24.0);
        let own = mean(0).unwrap_or(0.0);
        let (rise, place) = summit(own, None, &mean);
        assert!((own + rise - 3.0).abs() < 1e-14 && (place - 0.2).abs() < 1e-14, "{own} {rise} {place}");
        // 3 − r²/8 in rings, those of r² being (outer⁴ − inner⁴)/2/(outer² − inner²).
        let ring = |k: isize| {
            let (low, high) = (k as f64, k as f64 + 1.0);
            Some(3.0 - (high.powi(4) - low.powi(4)) / (high * high - low * low) / 16.0)
        };
        let own = ring(0).unwrap_or(0.0);
        let (rise, place) = summit(own, Some(Even::InRings), ring);
        assert!((own + rise - 3.0).abs() < 1e-14 && place == -0.5, "{own} {rise}");
        // 3 − x²/8 beside a plane of symmetry.
        let mean = means(0.0, |x| 3.0 * x - x.powi(3) / 24.0);
        let own = mean(0).unwrap_or(0.0);
        let (rise, place) = summit(own, Some(Even::InCells), mean);
        assert!((own + rise - 3.0).abs() < 1e-14 && place == -0.5, "{own} {rise}");
    }

    #[test]
    fn nothing_is_added_without_neighbours_or_a_bend() {
        assert_eq!(summit(1.0, None, |k| (k < 0).then_some(0.5)), (0.0, 0.0));
        assert_eq!(summit(1.0, Some(Even::InRings), |_| None), (0.0, 0.0));
        assert_eq!(summit(1.0, None, |_| Some(1.0)), (0.0, 0.0));
    }
}
