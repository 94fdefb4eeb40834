//! The states beyond the sides of the domain at mid-step.

use std::ops::Range;

use mesh::{Side, Tile, TileRows};

use crate::boundary::absorbing::Absorption;
use crate::boundary::{Boundaries, parity};
use crate::physics::SolidStep;
use crate::reconstruction::predictor::{ALONG_R, ALONG_Z};
use crate::state::component::COUNT;
use crate::{Boundary, ElasticState};

/// What the faces are made of, all padded rows of a tile or some.
pub(crate) struct MidStep<'a> {
    /// The padded cell that they begin with.
    pub first: usize,
    /// The states at mid-step.
    pub half: [&'a mut [f64]; COUNT],
    /// Differences of the components [`ALONG_Z`] and [`ALONG_R`].
    pub differences: [[&'a mut [f64]; 4]; 2],
}

impl Boundaries {
    /// Puts the outer states into the ghost cells at mid-step: on open sides so that the face has just that state, with
    /// the slope of the cell within, elsewhere the reflected inner ones, so that what the side holds at zero is zero to
    /// the last bit. Only the components that the face's Riemann problem has.
    ///
    /// - `cells`: the state at the beginning of the step; `rows`: of the tile's cells that `mid_step` holds, two at least, ghosts counted.
    pub fn impose_outer<const N: usize>(
        &self,
        ctx: &SolidStep<'_, N>,
        tile: Tile,
        cells: &TileRows<N>,
        rows: Range<isize>,
        mid_step: &mut MidStep<'_>,
    ) {
        let mesh = ctx.mesh;
        let (id, frame) = (mesh.first_of(tile), cells.frame());
        let n = frame.cells() as isize;
        let first_row = mid_step.first;
        for side in Side::ALL {
            let kind = self.kind(side);
            if kind == Boundary::Interface || !mesh.tile_touches(tile, side) {
                continue;
            }
            let along_side = match side {
                Side::ZMin | Side::ZMax => rows.start.max(0)..rows.end.min(n),
                Side::RMin if rows.contains(&-1) => 0..n,
                Side::RMax if rows.contains(&n) => 0..n,
                Side::RMin | Side::RMax => continue,
            };
            let axis = side.axis_across();
            let components = [ALONG_Z, ALONG_R][axis];
            let MidStep { half, differences, .. } = &mut *mid_step;
            let differences = &mut differences[axis];
            let first = id.first_face::<N>(side);
            let inwards = if matches!(side, Side::ZMin | Side::RMin) { 0.5 } else { -0.5 };
            let mut absorption = (kind == Boundary::Absorbing).then(|| {
                (
                    Absorption::new(mesh, side, id.level, ctx.dt, &ctx.model.elasticity),
                    ctx.model.sides.follow(side),
                )
            });
            for a in along_side {
                let [k, inner] = [-1, 0].map(|depth| frame.below(side, depth, a) - first_row);
                if !kind.is_open() {
                    for (component, slopes) in components.into_iter().zip(differences.iter_mut()) {
                        let sign = parity(kind, side, component).unwrap_or(1.0);
                        half[component][k] = sign * half[component][inner];
                        slopes[k] = -sign * slopes[inner];
                    }
                    continue;
                }
                let along = first + a as usize;
                let held = self.initial.at(side, id.level, along);
                let mut outer = held.face;
                if let Some((absorption, followed)) = &mut absorption {
                    let before = ctx.model.sides.at(side, id.level, along);
                    let initial = held.cells.map(ElasticState::to_array);
                    let change = |depth: isize, c: usize| {
                        cells.component(c)[frame.below(side, depth, a)] - initial[depth as usize][c]
                    };
                    let after = absorption.follow(before, change);
                    followed.of_mut(id.level, along).fill(after);
                    outer = absorption.outer(after, outer);
                }
                let outer = outer.to_array();
                for (component, slopes) in components.into_iter().zip(differences.iter_mut()) {
                    slopes[k] = slopes[inner];
                    half[component][k] = outer[component] - inwards * slopes[k];
                }
            }
        }
    }
}
