//! The field of bubbles that meet each other or the wall, or that sides surround: charges beyond the outline, by least squares.

use super::bubbles::{Bubble, largest_excess};
use super::charges::{Charge, Charges, Cut};
use super::error::RayleighError;
use super::least_squares::LeastSquares;
use super::outline::{Outline, Owner, Piece};
use super::space::{End, Floor, Space};

/// Lengths of the outline's pieces relative to the distance to what is near, tried one after the other.
const FINENESS: [f64; 4] = [0.8, 0.5, 0.35, 0.25];
/// Error relative to the largest difference of pressure at which no finer pieces are tried.
const ENOUGH: f64 = 1e-8;
/// Unknowns of the linear system at most.
pub(super) const MOST_UNKNOWNS: usize = 1000;
/// Charges of which nobody would see the field, relative to the largest difference of pressure, are left out.
const SMALL: f64 = 1e-10;

/// The harmonic pressure of [`Charges`] within the bubbles and beyond the sides, with their images in the floor.
///
/// Every piece of the outline has a charge behind it, as deep as the piece is long or deeper: towards the circle in which
/// a bubble meets the wall or another one they cluster exponentially, which is what a field that is no analytic function there needs
/// (Gopal & Trefethen 2019, SIAM J. Numer. Anal. 57, 2074: rational functions with such poles converge root-exponentially). On
/// four points of each piece the gas's pressure, the pressure far away or no normal gradient is imposed; least squares by QR, the
/// columns scaled to one, give the strengths. The field is harmonic, and has no gradient on the floor (or no excess, where that is
/// a reservoir), to round-off whatever these are. The error is measured between the points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fit {
    floor: Option<Floor>,
    within: Charges,
    beyond: Charges,
    /// Between sides: of what is uniform above a wall, Pa, or grows from a reservoir, Pa/m.
    level: f64,
    bubbles: usize,
}

impl Fit {
    /// The field about bubbles, and the largest error: of the pressure on bubbles and reservoirs, of the gradient along the
    /// normal on walls times the largest radius, both relative to the largest difference of pressure.
    ///
    /// - errors: [`RayleighError::TooMany`].
    pub(super) fn about(bubbles: &[Bubble], space: &Space) -> Result<(Self, f64), RayleighError> {
        let outline = Outline { bubbles, space };
        let mut best: Option<(Self, f64)> = None;
        let mut least_unknowns = 0;
        for fineness in FINENESS {
            let pieces = outline.pieces(fineness);
            let mut fit = Self::unsolved(&pieces, bubbles, space);
            let unknowns = fit.unknowns(space);
            if unknowns > MOST_UNKNOWNS {
                least_unknowns = unknowns;
                break;
            }
            fit.solve(&pieces, bubbles, space);
            fit.drop_small_charges(largest_excess(bubbles));
            let error = fit.error(&pieces, bubbles, space);
            if best.as_ref().is_none_or(|(_, least)| error < *least) {
                best = Some((fit, error));
            }
            if error < ENOUGH {
                break;
            }
        }
        best.ok_or(RayleighError::TooMany { unknowns: least_unknowns, most: MOST_UNKNOWNS })
    }

    fn unsolved(pieces: &[Piece], bubbles: &[Bubble], space: &Space) -> Self {
        let of = |in_bubbles: bool| {
            let charge = move |piece: &Piece| {
                let bubble = match piece.owner {
                    Owner::Bubble(k) => Some(k),
                    Owner::Side(_) => None,
                };
                let unit = Charge { place: piece.charge, depth: piece.depth, bubble, strength: [0.0; 2] };
                (bubble.is_some() == in_bubbles).then_some(unit)
            };
            pieces.iter().filter_map(charge).collect()
        };
        Self {
            floor: space.floor,
            within: Charges::new(of(true), Cut::Disc),
            beyond: Charges::new(of(false), Cut::Beyond),
            level: 0.0,
            bubbles: bubbles.len(),
        }
    }

    /// Pressure minus that far away, Pa.
    pub(super) fn excess(&self, [z, r]: [f64; 2]) -> f64 {
        let at = |z: f64| self.within.sum([z, r]) + self.beyond.sum([z, r]);
        match self.floor {
            None => at(z),
            Some(Floor { z: floor, sign }) => {
                let level = if sign > 0.0 { self.level } else { self.level * (z - floor) };
                at(z) + sign * at(2.0 * floor - z) + level
            }
        }
    }

    /// The charge of each bubble, Pa m. Of bubbles that meet the sum is certain, and the shares are those of their charges.
    pub(super) fn monopoles(&self) -> Vec<f64> {
        let mut monopoles = vec![0.0; self.bubbles];
        for charge in self.within.each() {
            if let Some(bubble) = charge.bubble {
                monopoles[bubble] += charge.strength[0];
            }
        }
        monopoles
    }

    fn unknowns(&self, space: &Space) -> usize {
        2 * (self.within.each().len() + self.beyond.each().len()) + usize::from(space.hull.is_some())
    }

    /// One row of the linear system: what each unknown contributes to the pressure, or to its gradient along a normal.
    fn row(&self, [[z, r], normal]: [[f64; 2]; 2], is_gradient: bool, space: &Space) -> Vec<f64> {
        let mut row = Vec::with_capacity(self.unknowns(space));
        for charges in [&self.within, &self.beyond] {
            for charge in charges.each() {
                let of = |z: f64, along: f64| match is_gradient {
                    false => charges.units(charge.place, [z, r]),
                    true => charges
                        .unit_gradients(charge.place, [z, r])
                        .map(|[d_z, d_r]| along * normal[0] * d_z + normal[1] * d_r),
                };
                let mut both = of(z, 1.0);
                if let Some(floor) = self.floor {
                    let image = of(2.0 * floor.z - z, -1.0);
                    both = [0, 1].map(|part| both[part] + floor.sign * image[part]);
                }
                row.extend(both);
            }
        }
        if let Some((_, floor)) = space.hull.zip(self.floor) {
            let odd = floor.sign < 0.0;
            row.push(match (is_gradient, odd) {
                (false, false) => 1.0,
                (false, true) => z - floor.z,
                (true, false) => 0.0,
                (true, true) => normal[0],
            });
        }
        row
    }

    /// Sets the charges to what meets the conditions best.
    fn solve(&mut self, pieces: &[Piece], bubbles: &[Bubble], space: &Space) {
        let conditions: Vec<_> = (pieces.iter())
            .flat_map(|piece| piece.imposed.iter().map(|place| (*place, Condition::of(piece.owner, bubbles))))
            .collect();
        let mut system = LeastSquares::new(conditions.len(), self.unknowns(space));
        for (i, (place, condition)) in conditions.iter().enumerate() {
            let row = self.row(*place, condition.is_gradient, space);
            system.set(i, row.into_iter().map(|value| condition.unit * value), condition.value);
        }
        // The ridge makes it regular; if round-off says otherwise, the error shows it.
        let Some(found) = system.solve() else { return };
        let (pairs, level) = found.as_chunks::<2>();
        let (within, beyond) = pairs.split_at(self.within.each().len());
        self.within.set(within);
        self.beyond.set(beyond);
        self.level = level.first().copied().unwrap_or(0.0);
    }

    /// Leaves out what nobody would see, as the field is evaluated in every cell.
    fn drop_small_charges(&mut self, largest: f64) {
        for charges in [&mut self.within, &mut self.beyond] {
            charges.drop_below(SMALL * largest);
        }
    }

    /// The largest error between the points where the conditions are imposed.
    fn error(&self, pieces: &[Piece], bubbles: &[Bubble], space: &Space) -> f64 {
        let largest = largest_excess(bubbles);
        if largest == 0.0 {
            return 0.0;
        }
        let mut found: Vec<f64> = Vec::with_capacity(self.unknowns(space));
        for charges in [&self.within, &self.beyond] {
            found.extend(charges.each().iter().flat_map(|charge| charge.strength));
        }
        found.push(self.level);
        let mut error = 0.0_f64;
        for piece in pieces {
            let condition = Condition::of(piece.owner, bubbles);
            for place in &piece.checked {
                let row = self.row(*place, condition.is_gradient, space);
                let sum: f64 = row.iter().zip(&found).map(|(value, strength)| value * strength).sum();
                let off = (condition.unit * sum - condition.value).abs() / largest;
                error = if off.is_nan() { f64::INFINITY } else { error.max(off) };
            }
        }
        error
    }
}

/// What is to hold on a piece of the outline.
#[derive(Clone, Copy, Debug)]
struct Condition {
    /// Of the gradient along the normal, not of the pressure.
    is_gradient: bool,
    /// By which the equation is multiplied: 1, or the largest radius of a gradient.
    unit: f64,
    /// Pa.
    value: f64,
}

impl Condition {
    fn of(owner: Owner, bubbles: &[Bubble]) -> Self {
        let largest_radius = bubbles.iter().fold(0.0, |largest: f64, bubble| largest.max(bubble.radius));
        match owner {
            Owner::Bubble(k) => Self { is_gradient: false, unit: 1.0, value: bubbles[k].excess },
            Owner::Side(End::Reservoir) => Self { is_gradient: false, unit: 1.0, value: 0.0 },
            Owner::Side(End::Wall) => Self { is_gradient: true, unit: largest_radius, value: 0.0 },
        }
    }
}
