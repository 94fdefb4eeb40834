//! The mesh that the initial condition asks for, filled with it.

use mesh::{BlockId, Domain, Field, Mesh, Side};

use crate::analysis::Analysis;
use crate::boundary::inflow::{IncomingWave, raise};
use crate::setup::{AsksForFiner, InitialState};
use crate::{FluidError, FluidSetup, NearWall, near_wall};

/// The mesh that the initial condition asks for, filled with it.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &FluidSetup,
    periodic: [bool; 2],
    (analysis, incoming): (&Analysis, Option<&IncomingWave>),
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
    let FluidSetup { domain, coarsest, levels, .. } = *setup;
    let ending = setup.adaptation.as_ref().map(|adaptation| {
        let base = adaptation.base(levels);
        adaptation.ending_at(followed_level(setup, base), levels)
    });
    let adaptation = ending.as_deref();
    let base = adaptation.map_or(levels, |adaptation| adaptation.base(levels));
    let has_wall = setup.boundaries[Side::ZMin as usize].is_wall();
    // What moves is looked at again before it has moved far.
    let near = NearWall { shock_levels: 0, ..setup.near_wall };
    let demanded = |mesh: &Mesh<N>, state: &Field| {
        let mut levels: Vec<u8> = mesh.tree().leaves().iter().map(|id| asked(mesh, id).min(base)).collect();
        if near.levels() > 0 && has_wall {
            let films = near_wall::demanded_levels(&near, (mesh, state, &analysis.mixture), base, &|_| 0.0);
            raise(&mut levels, films);
        }
        if let Some(wave) = incoming {
            raise(&mut levels, wave.demanded_levels(mesh, analysis, base, 0.0));
        }
        levels
    };
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, demanded)?)
}

/// The finest level that details may ask for at t = 0, `base` at the most.
fn followed_level(setup: &FluidSetup, base: u8) -> u8 {
    let Some(followed) = &setup.followed else { return base };
    let FluidSetup { domain: Domain { z, r, .. }, coarsest, .. } = *setup;
    let widths = [(z[1] - z[0]) / coarsest[0] as f64, (r[1] - r[0]) / coarsest[1] as f64];
    let widest = widths[0].max(widths[1]);
    followed.finest_level(followed.radius, |level| widest / f64::from(1u32 << level), base)
}
