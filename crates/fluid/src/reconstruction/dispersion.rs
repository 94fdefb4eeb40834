//! What second order leaves out at the faces of weak waves in liquid, see [`mesh::dispersion_share`] and
//! [`mesh::oblique_dispersion_shares`].

use mesh::{dispersion_share, oblique_dispersion_shares};

/// What face states of weak waves in liquid get besides.
///
/// How much depends on the Courant number of the sound that crosses the face. It is that of the two cells beside it, in the
/// step that they really make: elsewhere in the domain there may be faster sound, and the level may make longer steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Dispersion {
    /// Δt/h_n, s/m: with a speed it makes a Courant number.
    pub per_speed: f64,
    /// h_n/h_s: the cells' width along the normal over that along the face.
    pub aspect: f64,
    /// π of the liquid, Pa.
    pub liquid_pi: f64,
}

/// The shares that make what is left out of second differences.
#[derive(Clone, Copy)]
pub(crate) struct Shares {
    /// Of the difference of two neighbours' differences along the normal, see [`mesh::dispersion_share`].
    across: f64,
    /// Of the second differences of v_n and p along the face, see [`mesh::oblique_dispersion_shares`].
    along: [f64; 2],
}

/// Second differences along the faces of v_n and p.
#[derive(Clone, Copy)]
pub(crate) struct AlongFaces<'a> {
    /// Differences along the faces, in the cell before and in the one behind.
    before: [&'a [f64]; 2],
    behind: [&'a [f64]; 2],
    /// Distance of neighbours along the faces; the rows begin with the neighbour of this cell.
    pub step: usize,
}

impl<'a> AlongFaces<'a> {
    /// - `differences`: across the cells along the faces, of v_n and p. `step`: distance of neighbours along the faces.
    pub fn new(differences: [&'a [f64]; 2], step: usize) -> Self {
        Self { before: differences, behind: differences.map(|row| &row[2 * step..]), step }
    }

    /// `n` cells from `at` on; neighbours are found no more.
    #[inline(always)]
    pub fn cut(&self, at: usize, n: usize) -> Self {
        let ([a, b], [c, d], at) = (self.before, self.behind, at - self.step);
        Self { before: [&a[at..][..n], &b[at..][..n]], behind: [&c[at..][..n], &d[at..][..n]], step: 0 }
    }

    /// Twice the second difference in cell `k` of what was cut: 0 for v_n, 1 for p.
    #[inline(always)]
    pub fn twice_second_difference(&self, component: usize, k: usize) -> f64 {
        self.behind[component][k] - self.before[component][k]
    }
}

impl Dispersion {
    /// Differences of the pressure across a cell above this share of p + π belong to a strong front. The correction is a
    /// sixth of the larger difference at most; below, it keeps shocks that a few cells carry from being clipped. And it cannot make
    /// a face's p + π negative: of the cell's a tenth goes with half the difference, a thirtieth with the correction.
    /// Half and twice of it: `docs/verification/constants.md`.
    const WEAK: f64 = 0.2;
    /// Below this share waves are sound, of which alone it is known how it changes along a face while it crosses it. With
    /// δp/(p + π) = γ δv/c what the linear equations leave out of the correction, (γ + 1)/2 δv/c of it, is 0.3 % in water then.
    /// Half and twice of it: `docs/verification/constants.md`.
    const ACOUSTIC: f64 = 0.005;
    /// Gas fractions up to this count as liquid.
    const LIQUID: f64 = 1e-6;

    /// Whether a cell takes what is left out across its faces, and what is left out along them: its pressure, its gas
    /// fraction, and the difference of the pressure across it.
    #[inline(always)]
    pub fn takes(self, p: f64, phi: f64, difference: f64) -> [bool; 2] {
        let (size, scale, is_liquid) = (difference.abs(), p + self.liquid_pi, phi.abs() < Self::LIQUID);
        [(size < Self::WEAK * scale) & is_liquid, (size < Self::ACOUSTIC * scale) & is_liquid]
    }

    /// What v_n (component 0) or p (1) of a cell on a wall below it along z gets, the differences across the cells continued in
    /// a line beyond the wall.
    ///
    /// - `p`, `phi`, `difference`: of the cell, see above; `speed`: its |v_n| + c, m/s. `across`, `along`: second differences.
    pub fn on_wall(self, component: usize, cell: [f64; 3], speed: f64, across: f64, along: f64) -> f64 {
        let [p, phi, difference] = cell;
        let [is_weak, is_acoustic] = self.takes(p, phi, difference);
        let kept = [is_weak, is_acoustic].map(|takes| if takes { 1.0 } else { 0.0 });
        self.shares(speed).left_out(component, kept, across, along)
    }

    /// Of sound that crosses the face with `speed`, m/s.
    #[inline(always)]
    pub fn shares(self, speed: f64) -> Shares {
        let courant = self.per_speed * speed;
        Shares { across: dispersion_share(courant), along: oblique_dispersion_shares(courant, self.aspect) }
    }
}

impl Shares {
    /// What v_n (component 0) or p (1) lacks, of which `kept` stays for the differences across and along.
    #[inline(always)]
    pub fn left_out(self, component: usize, kept: [f64; 2], across: f64, along: f64) -> f64 {
        kept[0] * (self.across * across) + kept[1] * (self.along[component] * along)
    }
}
