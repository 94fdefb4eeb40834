//! What bounds the solid: ghost cells before the slopes, outer states and interface tractions after them.

pub(crate) mod absorbing;
pub(crate) mod coming;
mod even;
pub(crate) mod held;
pub(crate) mod outer_states;
pub(crate) mod participant;

use mesh::{FaceState, Limiter, Mesh, Padded, Side, SideStates, Tile, TileRows};

use crate::Boundary;
use crate::boundary::even::lead_to_even_slopes;
use crate::boundary::held::Held;
use crate::riemann::{Outward, star_interface};
use crate::state::component::{S_NORMAL, S_ZR, V_R, V_Z};
use crate::step::rows::{Elasticity, FaceRows, Reconstruction};

/// The four sides of the domain.
#[derive(Clone, Debug)]
pub(crate) struct Boundaries {
    kinds: [Boundary; 4],
    /// The initial state at each side.
    pub(crate) initial: SideStates<Held>,
}

impl Boundaries {
    pub fn new(kinds: [Boundary; 4], initial: SideStates<Held>) -> Self {
        Self { kinds, initial }
    }

    pub fn kind(&self, side: Side) -> Boundary {
        self.kinds[side as usize]
    }

    /// Fills the ghosts of a tile beyond the domain.
    ///
    /// - `limiter`: of the slopes that are made with them.
    pub fn fill_ghosts<const N: usize>(
        &self,
        mesh: &Mesh<N>,
        tile: Tile,
        limiter: Limiter,
        cells: &mut TileRows<N>,
    ) {
        let frame = cells.frame();
        // r first: the z sides then find the ghosts beyond r filled and complete the corners.
        for side in Side::FOR_GHOSTS {
            if !mesh.tile_touches(tile, side) {
                continue;
            }
            for component in 0..6 {
                let row = cells.component_mut(component);
                match mirrored(self.kind(side), side, component) {
                    Some(sign) => {
                        frame.reflect(row, side, sign);
                        if sign > 0.0 {
                            lead_to_even_slopes(limiter, row, frame, side);
                        }
                    }
                    None => frame.extrapolate(row, side),
                }
            }
        }
    }

    /// Makes the differences of v_r and σ_zr across the cells on the surface (z_max) as accurate as those of the cells below,
    /// see [`surface_difference`]. (Not those of v_z and σ_zz: what the wall is given is made of them, and they would let
    /// round-off grow.)
    ///
    /// - `cells`: a component of the block's padded cells.
    pub fn complete_shear_differences<'a, const N: usize>(
        limiter: Limiter,
        cells: impl Fn(usize) -> &'a [f64],
        s_z: &mut Padded<N>,
    ) {
        for component in [V_R, S_ZR] {
            let w = cells(component);
            let differences = s_z.component_mut(component);
            for j in 0..N as isize {
                let k = Padded::<N>::index(N as isize - 1, j);
                let cells = [w[k], w[k - 1], w[k - 2], w[k - 3]];
                differences[k] = surface_difference(limiter, cells, [differences[k], differences[k - 1]]);
            }
        }
    }

    /// Replaces the star states on the surface under the fluid (z_max): the wall's velocity, the fluid's
    /// pressure, the shear stress of a viscous one; the tangential velocity follows from the arriving shear wave.
    ///
    /// - `surface`: the states of the surface's faces in the block, in the order of r.
    pub fn impose_surface<const N: usize>(
        surface: &[FaceState],
        cells: &Reconstruction<'_>,
        elasticity: &Elasticity,
        faces: &mut FaceRows,
    ) {
        for (j, state) in surface.iter().enumerate() {
            let k = Padded::<N>::index(N as isize - 1, j as isize);
            let trace = cells.shear_at_surface(k);
            let stresses = [-state.pressure, state.shear];
            let face = star_interface(trace, Outward::High, state.velocity, stresses, elasticity.z2);
            faces.v_n[k] = face.v_n;
            faces.s_nn[k] = face.sigma_nn;
            faces.s_nt[k] = face.sigma_nt;
            faces.v_t[k] = face.v_t;
        }
    }
}

/// The difference across a cell on the surface from it and the three below, where they are smooth.
///
/// (3w₀ − 4w₁ + w₂)/2 + (w₀ − 3w₁ + 3w₂ − w₃)/2: the difference of the parabola through three cells, and half a third difference.
/// A central difference is off by h³w‴/6, the parabola's by −h³w‴/3. On the face below the surface's cell the errors of two
/// central differences would cancel; these add up to a shear stress that is off by h³w‴/8, and as the one on the
/// surface is not, the force on the cell is off: a boundary layer of some cells that keeps a stress from every wave that
/// passes. Nor must the parabola's slope be limited while a wave passes: where the differences to the cells below
/// have two signs, which limiters take for a peak, that is off in first order.
///
/// Beside a front, where the third difference is more than half of what the two first differ from zero, the limited difference
/// and as much of half the third one as is a fifth of the slopes; so, too, with limiters that clip smooth waves in the cells
/// below.
///
/// - `cells`: w₀, w₁, w₂, w₃ from the surface down; `limited`: the limited differences of the first two.
fn surface_difference(
    limiter: Limiter,
    [own, first, second, third]: [f64; 4],
    [limited, below]: [f64; 2],
) -> f64 {
    // Half and twice of it: `docs/verification/constants.md`.
    const IN_FRONTS: f64 = 0.2;
    let (near, far) = (own - first, first - second);
    let third_difference = (own - third) - 3.0 * far;
    let is_smooth = third_difference.abs() <= 0.5 * (near.abs() + far.abs());
    if is_smooth && matches!(limiter, Limiter::Mc | Limiter::None) {
        (1.5 * near - 0.5 * far) + 0.5 * third_difference
    } else {
        let bound = IN_FRONTS * (limited.abs() + below.abs());
        limited + (0.5 * third_difference).max(-bound).min(bound)
    }
}

/// The sign with which a component's cells are mirrored at a side; `None` where they are continued: at open sides, and what is even about a
/// free or fixed one, as it has a slope there.
pub(crate) fn mirrored(kind: Boundary, side: Side, component: usize) -> Option<f64> {
    parity(kind, side, component).filter(|sign| *sign < 0.0 || kind.is_mirror())
}

/// The sign with which a component's states at mid-step are reflected at a side; `None` where other states meet them.
fn parity(kind: Boundary, side: Side, component: usize) -> Option<f64> {
    let across_z = matches!(side, Side::ZMin | Side::ZMax);
    let v_normal = if across_z { V_Z } else { V_R };
    let s_normal = S_NORMAL[usize::from(!across_z)];
    let odd = match kind {
        Boundary::Axis | Boundary::Symmetry => component == v_normal || component == S_ZR,
        Boundary::Fixed => component == V_Z || component == V_R,
        Boundary::Free => component == s_normal || component == S_ZR,
        Boundary::Absorbing | Boundary::NonReflecting | Boundary::Interface => return None,
        Boundary::Periodic => unreachable!("a periodic side has neighbours"),
    };
    Some(if odd { -1.0 } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use mesh::Limiter;

    use super::surface_difference;

    /// What the parabola through the means of four cells of a cubic is off by is what a central difference is off by.
    #[test]
    fn the_difference_at_the_surface_is_off_as_central_ones_are() {
        let mean = |x: f64| 2.0 - 3.0 * x + 5.0 * x * x + 0.25 * (x * x * x + 0.25 * x) + 5.0 / 12.0;
        let cells = [0.0, 1.0, 2.0, 3.0].map(|depth: f64| mean(-depth));
        let central = 0.5 * (mean(1.0) - mean(-1.0));
        assert!((surface_difference(Limiter::Mc, cells, [f64::NAN; 2]) - central).abs() < 1e-14);
        // With a peak between the cells, where a limiter finds no slope.
        let peak = [0.0, 1.0, 2.0, 3.0].map(|depth: f64| -(depth - 0.9) * (depth - 0.9));
        assert!((surface_difference(Limiter::Mc, peak, [0.0; 2]) - -1.8).abs() < 1e-14);
        assert_eq!(surface_difference(Limiter::Minmod, peak, [0.0; 2]), 0.0);
    }

    #[test]
    fn beside_a_front_the_limited_difference_counts() {
        for front in 1..4 {
            let cells = [0, 1, 2, 3].map(|depth| if depth < front { 0.0 } else { 1.0 });
            let found = surface_difference(Limiter::Mc, cells, [0.125, 0.0]);
            assert!((found - 0.125).abs() <= 0.2 * 0.125, "{front}: {found}");
        }
    }
}
