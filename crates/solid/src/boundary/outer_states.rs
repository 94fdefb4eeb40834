//! The states beyond the sides of the domain at mid-step.

use mesh::{Padded, Side};

use crate::boundary::absorbing::Absorption;
use crate::boundary::{Boundaries, parity};
use crate::physics::SolidStep;
use crate::{Boundary, ElasticState};

impl Boundaries {
    /// Puts the outer states into the ghost cells at mid-step: on open sides so that the face has just that state, with
    /// the slope of the cell within, elsewhere the reflected inner ones, so that what the side holds at zero is zero to
    /// the last bit.
    ///
    /// - `cells`: the state at the beginning of the step.
    pub fn impose_outer<const N: usize>(
        &self,
        ctx: &SolidStep<'_, N>,
        slot: usize,
        cells: &Padded<N>,
        half: &mut Padded<N>,
        s_z: &mut Padded<N>,
        s_r: &mut Padded<N>,
    ) {
        let mesh = ctx.mesh;
        let id = mesh.tree().leaves()[slot];
        for side in Side::ALL {
            let kind = self.kind(side);
            if kind == Boundary::Interface || !mesh.touches(slot, side) {
                continue;
            }
            let across_z = side.axis_across() == 0;
            let first = id.first_face::<N>(side);
            let inwards = if matches!(side, Side::ZMin | Side::RMin) { 0.5 } else { -0.5 };
            let mut absorption = (kind == Boundary::Absorbing).then(|| {
                (
                    Absorption::new(mesh, side, id.level, ctx.dt, &ctx.model.elasticity),
                    ctx.model.sides.follow(side),
                )
            });
            for along in 0..N {
                let (n, a) = (N as isize, along as isize);
                let (i, j) = match side {
                    Side::ZMin => (-1, a),
                    Side::ZMax => (n, a),
                    Side::RMin => (a, -1),
                    Side::RMax => (a, n),
                };
                let k = Padded::<N>::index(i, j);
                if !kind.is_open() {
                    let inner = Padded::<N>::index(i.clamp(0, n - 1), j.clamp(0, n - 1));
                    for component in 0..6 {
                        let row = half.component_mut(component);
                        row[k] = parity(kind, side, component).unwrap_or(1.0) * row[inner];
                    }
                    continue;
                }
                let held = self.initial.at(side, id.level, first + along);
                let mut outer = held.face;
                let inner = Padded::<N>::index(i.clamp(0, n - 1), j.clamp(0, n - 1));
                if let Some((absorption, followed)) = &mut absorption {
                    let before = ctx.model.sides.at(side, id.level, first + along);
                    let (di, dj) = (i - i.clamp(0, n - 1), j - j.clamp(0, n - 1));
                    let within =
                        |depth: isize| Padded::<N>::index(i - (1 + depth) * di, j - (1 + depth) * dj);
                    let initial = held.cells.map(ElasticState::to_array);
                    let change = |depth: isize, c: usize| {
                        cells.component(c)[within(depth)] - initial[depth as usize][c]
                    };
                    let after = absorption.follow(before, change);
                    followed.of_mut(id.level, first + along).fill(after);
                    outer = absorption.outer(after, outer);
                }
                for (component, value) in outer.to_array().into_iter().enumerate() {
                    let slopes = if across_z { &mut *s_z } else { &mut *s_r };
                    let slopes = slopes.component_mut(component);
                    slopes[k] = slopes[inner];
                    half.component_mut(component)[k] = value - inwards * slopes[k];
                }
            }
        }
    }
}
