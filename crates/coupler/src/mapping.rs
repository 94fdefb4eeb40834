//! The common refinement of two non-matching sets of interface faces.

/// A piece of the interface that belongs to one face of each side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubFace {
    /// Face of the first side.
    pub first: usize,
    /// Face of the second side.
    pub second: usize,
    /// Share of the first side's face.
    pub share_of_first: f64,
    /// Share of the second side's face.
    pub share_of_second: f64,
    /// Distance of its centroid from that of the first side's face, m; weighted with the shares they add up to zero.
    pub offset_in_first: f64,
    /// The same from that of the second side's face, m.
    pub offset_in_second: f64,
}

/// All sub-faces, in the order of the radius.
///
/// Sums over the sub-faces of a face weighted with their shares are means over the face. Both sides' means
/// times their areas add up to the same, so impulse and work pass from one to the other to round-off; the mean
/// of a constant is that constant exactly, see [`CommonRefinement::means`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CommonRefinement {
    first_edges: Vec<f64>,
    second_edges: Vec<f64>,
    axisymmetric: bool,
    sub_faces: Vec<SubFace>,
}

impl CommonRefinement {
    /// Edges closer than this share of the whole interface are one.
    pub(crate) const SAME_EDGE: f64 = 1e-12;

    /// Brings the refinement up to date with the outer edges of both sides' faces. Does nothing, and allocates nothing, if
    /// they are what they were.
    ///
    /// - `first`, `second`: ascending; the last ones are taken as one, whatever round-off says. Of anything else come
    ///   sub-faces that mean nothing, but no more of them than edges.
    /// - `axisymmetric`: whether areas carry the weight r.
    pub fn update(&mut self, begin: f64, first: &[f64], second: &[f64], axisymmetric: bool) {
        if self.first_edges == first && self.second_edges == second && self.axisymmetric == axisymmetric {
            return;
        }
        self.first_edges = first.to_vec();
        self.second_edges = second.to_vec();
        self.axisymmetric = axisymmetric;
        self.sub_faces.clear();
        let end = first.last().copied().unwrap_or(begin).max(second.last().copied().unwrap_or(begin));
        let same = Self::SAME_EDGE * (end - begin).abs();
        let area = |low: f64, high: f64| {
            if axisymmetric { 0.5 * (high - low) * (high + low) } else { high - low }
        };
        // Of the area between two radii.
        let centroid = |low: f64, high: f64| {
            if axisymmetric && low + high > 0.0 {
                2.0 / 3.0 * (low * low + low * high + high * high) / (low + high)
            } else {
                0.5 * (low + high)
            }
        };
        let (mut a, mut b, mut low) = (0, 0, begin);
        let (mut low_a, mut low_b) = (begin, begin);
        while a < first.len() && b < second.len() {
            let (high_a, high_b) = (first[a], second[b]);
            // One of both always ends, so this comes to an end.
            let (ends_a, ends_b) = match (a + 1 == first.len(), b + 1 == second.len()) {
                (false, false) => {
                    let ends_a = high_a <= high_b + same;
                    (ends_a, !ends_a || high_b <= high_a + same)
                }
                // The last face of one side goes on for as long as the other one has faces.
                (last_a, last_b) => (!last_a || last_b, !last_b || last_a),
            };
            let high = if ends_a { high_a } else { high_b };
            // A sub-face that is the whole face has a share of exactly one.
            let share = |whole_low: f64, whole_high: f64, ends: bool| {
                if ends && whole_low == low { 1.0 } else { area(low, high) / area(whole_low, whole_high) }
            };
            let offset = |whole_low: f64, whole_high: f64, ends: bool| {
                if ends && whole_low == low {
                    0.0
                } else {
                    centroid(low, high) - centroid(whole_low, whole_high)
                }
            };
            self.sub_faces.push(SubFace {
                first: a,
                second: b,
                share_of_first: share(low_a, high_a, ends_a),
                share_of_second: share(low_b, high_b, ends_b),
                offset_in_first: offset(low_a, high_a, ends_a),
                offset_in_second: offset(low_b, high_b, ends_b),
            });
            low = high;
            if ends_a {
                (a, low_a) = (a + 1, low);
            }
            if ends_b {
                (b, low_b) = (b + 1, low);
            }
        }
    }

    /// The sub-faces.
    pub fn sub_faces(&self) -> &[SubFace] {
        &self.sub_faces
    }

    /// Means over the faces of one side of a quantity given on the sub-faces.
    ///
    /// Formed as the first value plus weighted differences to it, so that constants stay themselves.
    ///
    /// - `second`: whether the means are over the second side's faces; `value`: by number of the sub-face.
    /// - `put`: gets (face, mean) for each face in order.
    pub fn means(&self, second: bool, value: impl Fn(usize) -> f64, mut put: impl FnMut(usize, f64)) {
        self.means_of(second, |k| [value(k)], |face, [mean]| put(face, mean));
    }

    /// [`CommonRefinement::means`] of several quantities at once.
    pub fn means_of<const K: usize>(
        &self,
        second: bool,
        value: impl Fn(usize) -> [f64; K],
        mut put: impl FnMut(usize, [f64; K]),
    ) {
        let key = |s: &SubFace| if second { s.second } else { s.first };
        let share = |s: &SubFace| if second { s.share_of_second } else { s.share_of_first };
        let mut k = 0;
        while k < self.sub_faces.len() {
            let face = key(&self.sub_faces[k]);
            let base = value(k);
            let mut mean = base;
            k += 1;
            while k < self.sub_faces.len() && key(&self.sub_faces[k]) == face {
                for ((mean, value), base) in mean.iter_mut().zip(value(k)).zip(base) {
                    *mean += share(&self.sub_faces[k]) * (value - base);
                }
                k += 1;
            }
            put(face, mean);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(n: usize, end: f64) -> Vec<f64> {
        (1..=n).map(|k| end * k as f64 / n as f64).collect()
    }

    fn refinement(first: &[f64], second: &[f64], axisymmetric: bool) -> CommonRefinement {
        let mut map = CommonRefinement::default();
        map.update(0.0, first, second, axisymmetric);
        map
    }

    #[test]
    fn equal_faces_map_one_to_one_with_share_one() {
        let map = refinement(&edges(7, 0.05), &edges(7, 0.05), true);
        assert_eq!(map.sub_faces().len(), 7);
        for (k, s) in map.sub_faces().iter().enumerate() {
            assert_eq!((s.first, s.second, s.share_of_first, s.share_of_second), (k, k, 1.0, 1.0));
        }
    }

    #[test]
    fn impulse_passes_to_round_off_whatever_the_faces() {
        for (n, m) in [(4, 8), (6, 4), (5, 3), (16, 16), (7, 48)] {
            for axisymmetric in [false, true] {
                let (first, second) = (edges(n, 0.05), edges(m, 0.05));
                let map = refinement(&first, &second, axisymmetric);
                let value = |k: usize| 1e8 * (1.0 + (k as f64 * 1.7).sin());
                let total = |faces: &[f64], is_second: bool| {
                    let mut sum = 0.0;
                    map.means(is_second, value, |face, mean| {
                        let low = if face == 0 { 0.0 } else { faces[face - 1] };
                        let (low, high) = (low, faces[face]);
                        sum += mean * if axisymmetric { 0.5 * (high * high - low * low) } else { high - low };
                    });
                    sum
                };
                let (a, b) = (total(&first, false), total(&second, true));
                assert!((a - b).abs() <= 1e-14 * a.abs(), "{n}:{m} {a} {b}");
                // A trace that is linear along a face has that face's value in the mean.
                let mut moments = vec![0.0_f64; n];
                map.sub_faces().iter().for_each(|s| moments[s.first] += s.share_of_first * s.offset_in_first);
                assert!(moments.iter().all(|moment| moment.abs() < 1e-16), "{moments:?}");
                // Every face has shares that add up to one.
                let mut shares = vec![0.0; n];
                map.sub_faces().iter().for_each(|s| shares[s.first] += s.share_of_first);
                assert!(shares.iter().all(|s| (s - 1.0).abs() < 1e-13), "{shares:?}");
            }
        }
    }

    #[test]
    fn the_mean_of_a_constant_is_that_constant() {
        let map = refinement(&edges(7, 0.05), &edges(48, 0.05), true);
        for second in [false, true] {
            map.means(second, |_| 5e7, |_, mean| assert_eq!(mean, 5e7));
        }
    }

    /// Edges that nobody should send, and that no receiver lets in: still as many sub-faces as edges at most.
    #[test]
    fn any_edges_come_to_an_end() {
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 0.01, 0.05, 1e300];
        for first in bad {
            for second in bad {
                for third in bad {
                    let hostile = [first, second, third];
                    for map in [
                        refinement(&hostile, &edges(4, 0.05), true),
                        refinement(&edges(4, 0.05), &hostile, false),
                        refinement(&hostile, &hostile[..2], true),
                    ] {
                        assert!(map.sub_faces().len() <= 7, "{hostile:?}");
                    }
                }
            }
        }
        assert!(refinement(&[], &edges(4, 0.05), true).sub_faces().is_empty());
    }

    #[test]
    fn last_edges_that_differ_by_round_off_are_one() {
        for end in [0.05 * (1.0 - 1e-10), 0.05 * (1.0 + 1e-10)] {
            let map = refinement(&edges(4, end), &edges(8, 0.05), true);
            let mut shares = [0.0; 8];
            map.sub_faces().iter().for_each(|s| shares[s.second] += s.share_of_second);
            assert!(shares.iter().all(|share| (share - 1.0_f64).abs() < 1e-9), "{shares:?}");
        }
    }
}
