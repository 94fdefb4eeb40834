//! What second order leaves out at the faces of weak waves in liquid, see [`mesh::dispersion_share`] and
//! [`mesh::oblique_dispersion_shares`].

use mesh::{Mesh, dispersion_share, oblique_dispersion_shares};

use crate::physics::Fluid;
use crate::rows::{Reconstruction, fraction};

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
struct Shares {
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

    /// `n` cells from `at` on; not to be cut again.
    #[inline(always)]
    pub fn cut(&self, at: usize, n: usize) -> Self {
        let ([a, b], [c, d], at) = (self.before, self.behind, at - self.step);
        Self { before: [&a[at..][..n], &b[at..][..n]], behind: [&c[at..][..n], &d[at..][..n]], step: 0 }
    }

    /// In cell `k` of what was cut: 0 for v_n, 1 for p.
    #[inline(always)]
    fn second_difference(&self, component: usize, k: usize) -> f64 {
        0.5 * (self.behind[component][k] - self.before[component][k])
    }
}

impl Dispersion {
    /// Differences of the pressure across a cell above this share of p + π belong to a strong front. The correction is a
    /// sixth of the larger difference at most; below, it keeps shocks that a few cells carry from being clipped. And it cannot make
    /// a face's p + π negative: of the cell's a tenth goes with half the difference, a thirtieth with the correction.
    /// Half and twice of it: `docs/verification.md`, "Constants".
    const WEAK: f64 = 0.2;
    /// Below this share waves are sound, of which alone it is known how it changes along a face while it crosses it. With
    /// δp/(p + π) = γ δv/c what the linear equations leave out of the correction, (γ + 1)/2 δv/c of it, is 0.3 % in water then.
    /// Half and twice of it: `docs/verification.md`, "Constants".
    const ACOUSTIC: f64 = 0.005;
    /// Gas fractions up to this count as liquid.
    const LIQUID: f64 = 1e-6;

    /// Whether a cell takes what is left out across its faces, and what is left out along them: its pressure, its gas
    /// fraction, and the difference of the pressure across it.
    #[inline(always)]
    fn takes(self, p: f64, phi: f64, difference: f64) -> [bool; 2] {
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
    fn shares(self, speed: f64) -> Shares {
        let courant = self.per_speed * speed;
        Shares { across: dispersion_share(courant), along: oblique_dispersion_shares(courant, self.aspect) }
    }
}

impl Shares {
    /// What v_n (component 0) or p (1) lacks, of which `kept` stays for the differences across and along.
    #[inline(always)]
    fn left_out(self, component: usize, kept: [f64; 2], across: f64, along: f64) -> f64 {
        kept[0] * (self.across * across) + kept[1] * (self.along[component] * along)
    }
}

impl Fluid {
    /// For the faces normal to an axis (0: z, 1: r) of a block of a level, in a step of length `dt`.
    pub(crate) fn dispersion<const N: usize>(
        &self,
        mesh: &Mesh<N>,
        dt: f64,
        level: u8,
        axis: usize,
    ) -> Dispersion {
        let widths = mesh.widths(level);
        Dispersion {
            per_speed: dt / widths[axis],
            aspect: widths[axis] / widths[1 - axis],
            liquid_pi: self.mixture.at(0.0).pi,
        }
    }
}

/// What v_n (component 0) or p (1) lacks on the face between cells `k`, of which both keep `kept` of their slopes and take
/// what is left out across and along it.
#[inline(always)]
fn left_out(
    lower: &Reconstruction<'_>,
    upper: &Reconstruction<'_>,
    component: usize,
    k: usize,
    shares: Shares,
    kept: [f64; 2],
) -> f64 {
    let row = [1, 3][component];
    let across = upper.differences[row][k] - lower.differences[row][k];
    let low = lower.along_faces.second_difference(component, k);
    let high = upper.along_faces.second_difference(component, k);
    shares.left_out(component, kept, across, 0.5 * (low + high))
}

/// The states on both sides of the face between cells `k` of `lower` and of `upper`.
///
/// Normal velocity and pressure are all that matters in a weak wave; density and the rest stay as they are.
#[inline(always)]
pub(crate) fn states_at_face<const WITH_GAS: bool>(
    lower: &Reconstruction<'_>,
    upper: &Reconstruction<'_>,
    k: usize,
) -> [[f64; 5]; 2] {
    let dispersion = lower.dispersion;
    let takes = |cells: &Reconstruction<'_>| {
        dispersion.takes(cells.half[3][k], fraction::<WITH_GAS>(cells.half[4][k]), cells.differences[3][k])
    };
    let (low, high) = (takes(lower), takes(upper));
    let keep = lower.keep[k] * upper.keep[k];
    let kept = [if low[0] & high[0] { keep } else { 0.0 }, if low[1] & high[1] { keep } else { 0.0 }];
    let speed = |cells: &Reconstruction<'_>| cells.half[1][k].abs() + cells.sound[k];
    let shares = dispersion.shares(0.5 * (speed(lower) + speed(upper)));
    let velocity = left_out(lower, upper, 0, k, shares, kept);
    let pressure = left_out(lower, upper, 1, k, shares, kept);
    [lower.face_state(k, 1.0), upper.face_state(k, -1.0)]
        .map(|[rho, v_n, v_t, p, phi]| [rho, v_n + velocity, v_t, p + pressure, fraction::<WITH_GAS>(phi)])
}
