//! The mesh that the initial condition asks for, filled with it.

use mesh::{BlockId, Field, Mesh, Side};

use crate::analysis::Analysis;
use crate::setup::{AsksForFiner, InitialState};
use crate::{FluidError, FluidSetup, NearWall, near_wall};

/// The mesh that the initial condition asks for, filled with it.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &FluidSetup,
    periodic: [bool; 2],
    analysis: &Analysis,
    initial: &InitialState<'_>,
    asks_for_finer: &AsksForFiner<'_>,
) -> Result<(Mesh<N>, Field), FluidError> {
    let carried = crate::components::of(setup);
    let fill = |mesh: &Mesh<N>| {
        let mut state = Field::zeros(mesh.blocks(), N * N, setup.field_components());
        crate::initial::fill::fill(mesh, &analysis.mixture, &mut state, initial);
        crate::components::initial::fill_carried(mesh, &carried, setup.model.components(), &mut state);
        state
    };
    let asked = |mesh: &Mesh<N>, id: &BlockId| {
        let (low, widths) = (mesh.origin(*id), mesh.widths(id.level));
        let high = [0, 1].map(|axis| low[axis] + N as f64 * widths[axis]);
        if asks_for_finer(low, high, widths) { id.level + 1 } else { 0 }
    };
    let adaptation = setup.adaptation.as_ref();
    let base = adaptation.map_or(setup.levels, |adaptation| adaptation.base(setup.levels));
    let has_wall = setup.boundaries[Side::ZMin as usize].is_wall();
    // What moves is looked at again before it has moved far.
    let near = NearWall { shock_levels: 0, ..setup.near_wall };
    let demanded = |mesh: &Mesh<N>, state: &Field| {
        let mut levels: Vec<u8> = mesh.tree().leaves().iter().map(|id| asked(mesh, id).min(base)).collect();
        if near.levels() > 0 && has_wall {
            let films = near_wall::demanded_levels(&near, (mesh, state, &analysis.mixture), base, &|_| 0.0);
            levels.iter_mut().zip(films).for_each(|(level, film)| *level = film.max(*level));
        }
        levels
    };
    let FluidSetup { domain, coarsest, levels, .. } = *setup;
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, demanded)?)
}
