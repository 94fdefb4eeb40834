//! The outline of the liquid in the plane (z, r), in pieces as small as what is near them asks.

use std::f64::consts::PI;

use super::bubbles::{Bubble, Meeting};
use super::space::{End, Floor, Hull, Space};

/// Pieces near an edge are no smaller than this, relative to the bubble's radius.
const SMALLEST: f64 = 1e-7;
/// How deep in the gas the charge of a piece is: relative to the distance to what is near, and to the radius at most.
const DEPTH: [f64; 2] = [0.7, 0.6];
/// How far beyond a side the charge of a piece is, relative to the distance of what is mirrored in it, or to the cylinder's size
/// at most.
const BEYOND: f64 = 0.8;

/// What a line of the outline belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Owner {
    Bubble(usize),
    Side(End),
}

/// A line of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Line {
    /// Of bubble number k, from the angle 0 at +z on.
    Arc(usize),
    /// z = const, from the axis on.
    Top,
    /// r = const, upwards.
    Outer,
}

/// A piece of the outline.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    pub owner: Owner,
    /// Where its charge is, beyond the outline.
    pub charge: [f64; 2],
    /// How far beyond, m.
    pub depth: f64,
    /// Where the conditions are imposed, and where the error is measured, with the normal out of the liquid.
    pub imposed: Vec<[[f64; 2]; 2]>,
    pub checked: Vec<[[f64; 2]; 2]>,
}

/// Where along a piece conditions are imposed, and where the error is measured.
const IMPOSED: [f64; 4] = [0.125, 0.375, 0.625, 0.875];
const CHECKED: [f64; 3] = [0.02, 0.27, 0.5];

/// The bubbles and sides whose outline it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outline<'a> {
    pub bubbles: &'a [Bubble],
    pub space: &'a Space,
}

impl Outline<'_> {
    /// All pieces, each at most `fineness` times as long as the distance to what is near.
    pub(super) fn pieces(&self, fineness: f64) -> Vec<Piece> {
        let mut pieces = Vec::new();
        for k in 0..self.bubbles.len() {
            if let Some(range) = self.exposed(k) {
                self.cut(Line::Arc(k), range, fineness, &mut pieces);
            }
        }
        if let Some((hull, floor)) = self.hull() {
            self.cut(Line::Top, [0.0, hull.radius], fineness, &mut pieces);
            self.cut(Line::Outer, [floor.z, hull.top], fineness, &mut pieces);
        }
        pieces
    }

    /// The hull, and the floor that there is with it.
    fn hull(&self) -> Option<(Hull, Floor)> {
        self.space.hull.zip(self.space.floor)
    }

    /// The angles from +z between which bubble number k borders on liquid.
    fn exposed(&self, k: usize) -> Option<[f64; 2]> {
        let own = self.bubbles[k];
        let mut range = [0.0, PI];
        for (j, other) in self.bubbles.iter().enumerate() {
            match own.meets(other.centre, other.radius) {
                // The first of two that are the same stands for both.
                Meeting::Within if (other.radius, k) > (own.radius, j) && j != k => return None,
                Meeting::Circle([z, r]) => {
                    let angle = r.atan2(z - own.centre);
                    if other.centre > own.centre {
                        range[0] = range[0].max(angle);
                    } else {
                        range[1] = range[1].min(angle);
                    }
                }
                _ => {}
            }
        }
        if let Some(floor) = self.space.floor
            && own.centre - floor.z < own.radius
        {
            range[1] = range[1].min(PI - ((own.centre - floor.z) / own.radius).acos());
        }
        (range[0] < range[1]).then_some(range)
    }

    /// Halves a range of a line until its pieces are short enough.
    fn cut(&self, line: Line, [low, high]: [f64; 2], fineness: f64, pieces: &mut Vec<Piece>) {
        let middle = 0.5 * (low + high);
        let (point, normal) = self.at(line, middle);
        let (owner, unit, scale, offset, smallest) = match line {
            Line::Arc(k) => {
                let radius = self.bubbles[k].radius;
                let scale = self.scale_on_bubble(k, point).min(radius);
                let offset = (DEPTH[0] * scale).min(DEPTH[1] * radius);
                (Owner::Bubble(k), radius, scale, offset, SMALLEST * radius)
            }
            Line::Top | Line::Outer => {
                let scale = BEYOND * self.scale_on_side(point);
                (Owner::Side(self.end(line)), 1.0, scale, scale, 0.0)
            }
        };
        let length = unit * (high - low);
        if length > smallest && length > fineness * scale {
            self.cut(line, [low, middle], fineness, pieces);
            self.cut(line, [middle, high], fineness, pieces);
            return;
        }
        let place = |share: &f64| {
            let (point, normal) = self.at(line, low + share * (high - low));
            [point, normal]
        };
        pieces.push(Piece {
            owner,
            charge: [point[0] + offset * normal[0], point[1] + offset * normal[1]],
            depth: offset,
            imposed: IMPOSED.iter().map(place).collect(),
            checked: CHECKED.iter().map(place).collect(),
        });
    }

    fn end(&self, line: Line) -> End {
        match (line, self.space.hull) {
            (Line::Outer, Some(hull)) => hull.outer_is,
            (_, Some(hull)) => hull.top_is,
            (_, None) => End::Reservoir,
        }
    }

    /// A point of a line, and the normal out of the liquid.
    fn at(&self, line: Line, along: f64) -> ([f64; 2], [f64; 2]) {
        let (top, outer) = self.space.hull.map_or((0.0, 0.0), |hull| (hull.top, hull.radius));
        match line {
            Line::Arc(k) => {
                let Bubble { centre, radius, .. } = self.bubbles[k];
                let (sin, cos) = along.sin_cos();
                ([centre + radius * cos, radius * sin], [-cos, -sin])
            }
            Line::Top => ([top, along], [1.0, 0.0]),
            Line::Outer => ([along, outer], [0.0, 1.0]),
        }
    }

    /// Over what distance the field about a point of a bubble changes, m: that to the circle where it meets another sphere, or
    /// that of what two surfaces that come near each other mirror in each other, √(2δR) for a small gap δ.
    fn scale_on_bubble(&self, k: usize, [z, r]: [f64; 2]) -> f64 {
        let own = self.bubbles[k];
        let mut scale = f64::INFINITY;
        let mut beside = |centre: f64, radius: f64| match own.meets(centre, radius) {
            Meeting::Circle([edge_z, edge_r]) => scale = scale.min((z - edge_z).hypot(r - edge_r)),
            Meeting::Within => {}
            Meeting::Apart => {
                let gap = ((z - centre).hypot(r) - radius).max(0.0);
                let both = 1.0 / (1.0 / own.radius + 1.0 / radius);
                scale = scale.min((gap * (gap + 2.0 * both)).sqrt());
            }
        };
        for (j, other) in self.bubbles.iter().enumerate() {
            if j != k {
                beside(other.centre, other.radius);
            }
            if let Some(floor) = self.space.floor {
                beside(2.0 * floor.z - other.centre, other.radius);
            }
        }
        if let Some(hull) = self.space.hull {
            for gap in [hull.top - z, hull.radius - r] {
                scale = scale.min((gap * (gap + 2.0 * own.radius)).sqrt());
            }
        }
        scale
    }

    /// How far beyond a point of a side the nearest of what is mirrored in it is, m, and at most as far as the sides are apart.
    fn scale_on_side(&self, [z, r]: [f64; 2]) -> f64 {
        let mut scale = self.hull().map_or(1.0, |(hull, floor)| hull.radius.min(hull.top - floor.z));
        for bubble in self.bubbles {
            let gap = ((z - bubble.centre).hypot(r) - bubble.radius).max(0.0);
            scale = scale.min(gap + 0.5 * (gap * (gap + 2.0 * bubble.radius)).sqrt());
        }
        scale
    }
}
