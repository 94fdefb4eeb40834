//! The mesh that the initial condition asks for, filled with it.

use mesh::{Field, Mesh};

use crate::analysis::Analysis;
use crate::setup::{AsksForFiner, InitialState};
use crate::{FluidError, FluidSetup};

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
    let at_least = |mesh: &Mesh<N>, slot: usize| {
        let id = mesh.tree().leaves()[slot];
        let (low, widths) = (mesh.origin(id), mesh.widths(id.level));
        let high = [0, 1].map(|axis| low[axis] + N as f64 * widths[axis]);
        if asks_for_finer(low, high, widths) { id.level + 1 } else { 0 }
    };
    let adaptation = setup.adaptation.as_ref();
    let FluidSetup { domain, coarsest, levels, .. } = *setup;
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, at_least)?)
}
