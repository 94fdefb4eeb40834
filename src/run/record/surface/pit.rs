//! The pit in a surface: numbers of a profile.

use mesh::Geometry;

use crate::run::record::collapse::vertex;

/// The part of the surface that counts as far away, of its extent in r.
const FAR: f64 = 0.1;

/// u_z on faces of equal width that follow each other in r.
#[derive(Clone, Copy, Debug)]
pub struct Profile<'a> {
    /// Where the first face begins, m.
    pub begin: f64,
    /// The width of a face, m.
    pub width: f64,
    /// Whether r is a radius.
    pub geometry: Geometry,
    /// u_z, m.
    pub displacement: &'a [f64],
}

/// What a surface is deeper than far away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pit {
    /// At the deepest point, m.
    pub depth: f64,
    /// At r = 0, m.
    pub depth_axis: f64,
    /// Where, outside the deepest point, the depth is half the largest one, m; `None` if nowhere.
    pub radius: Option<f64>,
    /// Between the surface and its level far away, up to where they meet outside the deepest point, in a domain that reaches below r = 0 on
    /// both sides of it, m³ (planar: m²).
    pub volume: f64,
    /// How far the surface rises above that level outside of that, m.
    pub rim: f64,
}

/// Whether the face number `k` of `count` is far away.
pub fn is_far(k: usize, count: usize) -> bool {
    k as f64 + 0.5 >= (1.0 - FAR) * count as f64
}

/// The level far away: the mean of u_z over the outer tenth in r, m.
pub fn far(displacement: &[f64]) -> f64 {
    let far = || displacement.iter().enumerate().filter(|(k, _)| is_far(*k, displacement.len()));
    far().map(|(_, u)| u).sum::<f64>() / far().count().max(1) as f64
}

impl Profile<'_> {
    /// The centre of a face, m.
    fn centre(&self, k: usize) -> f64 {
        self.begin + (k as f64 + 0.5) * self.width
    }

    /// The area of a face, m² (planar: m).
    fn area(&self, k: usize) -> f64 {
        match self.geometry {
            Geometry::Planar => self.width,
            Geometry::Axisymmetric => std::f64::consts::TAU * self.centre(k) * self.width,
        }
    }

    /// Where, from face `from` on outwards, the depth has fallen to `level`: the first face below it, and r in between, m.
    fn crossing(&self, depths: &[f64], from: usize, level: f64) -> Option<(usize, f64)> {
        let after = (from + 1..depths.len()).find(|k| depths[*k] <= level)?;
        let share = (depths[after - 1] - level) / (depths[after - 1] - depths[after]);
        Some((after, self.centre(after - 1) + share * self.width))
    }

    /// Half the width of the pit, m, where it is half as deep as at its deepest; in axial symmetry the radius out there.
    fn half_width(&self, depths: &[f64], deepest: usize, level: f64) -> Option<f64> {
        let (_, outer) = self.crossing(depths, deepest, level)?;
        if self.geometry == Geometry::Axisymmetric {
            return Some(outer);
        }
        // A pit that reaches the end of the wall goes on beyond it as in a mirror.
        let before = (0..deepest).rfind(|k| depths[*k] <= level);
        Some(before.map_or(outer - self.begin, |before| {
            let share = (depths[before + 1] - level) / (depths[before + 1] - depths[before]);
            0.5 * (outer - (self.centre(before + 1) - share * self.width))
        }))
    }

    /// The pit.
    pub fn pit(&self) -> Pit {
        let far = far(self.displacement);
        let depths: Vec<f64> = self.displacement.iter().map(|u| far - u).collect();
        let deepest = (0..depths.len()).fold(0, |best, k| if depths[k] > depths[best] { k } else { best });
        if depths.get(deepest).is_none_or(|depth| *depth <= 0.0) {
            return Pit::default();
        }
        let depth_axis = self.on_axis(&depths);
        let depth = self.deepest(&depths, deepest).max(depth_axis);
        let end = self.crossing(&depths, deepest, 0.0).map_or(depths.len(), |(after, _)| after);
        // Below r = 0 the surface goes on, which otherwise begins with the pit.
        let goes_on = self.begin < -1e-6 * self.width;
        let begin = if goes_on { (0..deepest).rfind(|k| depths[*k] <= 0.0).map_or(0, |k| k + 1) } else { 0 };
        Pit {
            depth,
            depth_axis,
            radius: self.half_width(&depths, deepest, 0.5 * depth),
            volume: (begin..end).map(|k| depths[k] * self.area(k)).sum(),
            rim: depths[..begin].iter().chain(&depths[end..]).fold(0.0, |rim, depth| rim.max(-depth)),
        }
    }

    /// At the deepest point, by the parabola through the centres of the deepest face and both neighbours.
    fn deepest(&self, depths: &[f64], face: usize) -> f64 {
        let own = depths[face];
        let neighbour = |offset: isize| face.checked_add_signed(offset).and_then(|k| depths.get(k));
        let Some((inner, outer)) = neighbour(-1).zip(neighbour(1)) else { return own };
        vertex([[-1.0, *inner], [0.0, own], [1.0, *outer]])[1]
    }

    /// At r = 0: between the faces' centres, or even in r where the domain begins there; of a domain elsewhere, on the nearest face.
    fn on_axis(&self, depths: &[f64]) -> f64 {
        let position = -self.begin / self.width - 0.5;
        match depths {
            [first, second, ..] if position <= -0.5 && position > -0.5 - 1e-6 => (9.0 * first - second) / 8.0,
            _ => {
                let last = depths.len() - 1;
                let low = (position.max(0.0) as usize).min(last);
                let share = (position - low as f64).clamp(0.0, 1.0);
                depths[low] + share * (depths[(low + 1).min(last)] - depths[low])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXISYMMETRIC: Geometry = Geometry::Axisymmetric;

    /// Means of u over faces of [begin, end), as values at their centres.
    fn profile(count: usize, [begin, end]: [f64; 2], u: impl Fn(f64) -> f64) -> (f64, Vec<f64>) {
        let width = (end - begin) / count as f64;
        (width, (0..count).map(|k| u(begin + (k as f64 + 0.5) * width)).collect())
    }

    fn near(what: &str, found: f64, expected: f64, tolerance: f64) {
        assert!((found / expected - 1.0).abs() < tolerance, "{what}: {found:e}, expected {expected:e}");
    }

    #[test]
    fn a_pit_with_a_rim_on_a_surface_that_has_moved() {
        // −D (1 − s) exp(−s), s = (r/b)²: zero at r = b, its highest point e⁻² D at s = 2; all of it adds up to nothing.
        let (depth, b, shift) = (2e-6, 1e-4, -3e-5);
        let shape = |r: f64| {
            let s = (r / b).powi(2);
            shift - depth * (1.0 - s) * (-s).exp()
        };
        let (width, u) = profile(640, [0.0, 16.0 * b], shape);
        let pit = Profile { begin: 0.0, width, geometry: AXISYMMETRIC, displacement: &u }.pit();
        near("depth", pit.depth, depth, 1e-6);
        near("on the axis", pit.depth_axis, depth, 1e-6);
        // (1 − s) exp(−s) = ½ at s = 0.314923.
        near("radius", pit.radius.expect("there is one"), b * 0.314_923_f64.sqrt(), 1e-3);
        near("volume", pit.volume, depth * std::f64::consts::PI * b * b / std::f64::consts::E, 2e-3);
        near("rim", pit.rim, depth * (-2.0_f64).exp(), 1e-3);
    }

    #[test]
    fn a_ring_is_deepest_off_the_axis() {
        let (b, depth) = (1e-4, 1e-6);
        let shape = |r: f64| -depth * (0.2 + (r / b).powi(2)) * (-(r / b).powi(2)).exp();
        let (width, u) = profile(400, [0.0, 10.0 * b], shape);
        let pit = Profile { begin: 0.0, width, geometry: AXISYMMETRIC, displacement: &u }.pit();
        near("on the axis", pit.depth_axis, 0.2 * depth, 1e-3);
        // s = 0.8 there: exp(−0.8).
        near("depth", pit.depth, depth * (-0.8_f64).exp(), 1e-5);
        // Half of it at s = 2.38335 outside, not at the smaller s inside.
        let s = (pit.radius.expect("there is one") / b).powi(2);
        near("half", (0.2 + s) * (-s).exp(), 0.5 * (-0.8_f64).exp(), 2e-3);
        assert!(s > 0.8);
    }

    #[test]
    fn in_the_plane_volumes_are_areas_and_r_may_begin_below_zero() {
        let shape = |r: f64| -1e-6 * (-r * r).exp();
        let (width, u) = profile(801, [-8.0, 8.0], shape);
        let pit = Profile { begin: -8.0, width, geometry: Geometry::Planar, displacement: &u }.pit();
        near("on the axis", pit.depth_axis, 1e-6, 1e-6);
        near("volume", pit.volume, 1e-6 * std::f64::consts::PI.sqrt(), 1e-3);
        near("radius", pit.radius.expect("there is one"), std::f64::consts::LN_2.sqrt(), 1e-3);
    }

    #[test]
    fn in_the_plane_a_pit_is_as_wide_wherever_it_is() {
        for (begin, place) in [(-8.0, 0.0), (-8.0, 3.0), (-8.0, -2.0), (0.0, 4.0), (0.0, 0.0), (-3.0, -3.0)] {
            let (width, u) = profile(800, [begin, begin + 16.0], |r| -1e-6 * (-(r - place).powi(2)).exp());
            let pit = Profile { begin, width, geometry: Geometry::Planar, displacement: &u }.pit();
            near("radius", pit.radius.expect("there is one"), std::f64::consts::LN_2.sqrt(), 1e-3);
        }
    }

    #[test]
    fn a_rim_on_both_sides_is_no_part_of_the_volume() {
        // As above, in the plane: zero at r = ±b, between which there is 2 D b/e of ∫(1 − s) exp(−s) dx.
        let (b, depth) = (1e-4, 1e-6);
        let shape = |r: f64| {
            let s = (r / b).powi(2);
            -depth * (1.0 - s) * (-s).exp()
        };
        let of = |begin: f64| {
            let (width, u) = profile(if begin < 0.0 { 1600 } else { 800 }, [begin, 10.0 * b], shape);
            Profile { begin, width, geometry: Geometry::Planar, displacement: &u }.pit()
        };
        let [half, whole] = [0.0, -10.0 * b].map(of);
        near("volume", whole.volume, 2.0 * half.volume, 1e-12);
        near("rim", whole.rim, half.rim, 1e-12);
        assert!(whole.volume > depth * b, "{whole:?}");
    }

    #[test]
    fn a_plane_surface_and_a_hill_have_no_pit() {
        for shape in [|_: f64| -3e-5, |r: f64| 1e-6 * (-r * r).exp()] {
            let (width, u) = profile(100, [0.0, 10.0], shape);
            let pit = Profile { begin: 0.0, width, geometry: AXISYMMETRIC, displacement: &u }.pit();
            assert!(pit.depth < 1e-20 && pit.volume < 1e-17, "{pit:?}");
        }
    }
}
