//! The mesh that the initial state asks for, and the state on it.

use mesh::{Field, Mesh, Side, for_some_blocks};

use crate::analysis::Analysis;
use crate::components::Component;
use crate::state::component::COUNT;
use crate::{Boundary, ElasticState, SolidError, SolidSetup};

/// The mesh that the initial state asks for, filled with it.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &SolidSetup,
    analysis: &Analysis,
    components: &[Component],
    initial: &(impl Fn([f64; 2]) -> ElasticState + Sync),
) -> Result<(Mesh<N>, Field), SolidError> {
    let kinds = setup.boundaries;
    let periodic = [Side::ZMin, Side::RMin].map(|side| kinds[side as usize] == Boundary::Periodic);
    let fill = |mesh: &Mesh<N>| fill(mesh, components, initial);
    let adaptation = setup.adaptation.as_ref();
    let SolidSetup { domain, coarsest, levels, .. } = *setup;
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, |_, _| 0)?)
}

/// The initial state at the cells' centres.
fn fill<const N: usize>(
    mesh: &Mesh<N>,
    components: &[Component],
    initial: &(impl Fn([f64; 2]) -> ElasticState + Sync),
) -> Field {
    let mut state = Field::zeros(mesh.blocks(), N * N, COUNT + components.len());
    let mut reports = vec![(); mesh.blocks()];
    for_some_blocks(
        &mut state,
        &mut reports,
        |_| true,
        |slot, block, ()| {
            let id = mesh.tree().leaves()[slot];
            for j in 0..N {
                for i in 0..N {
                    for (c, value) in initial(mesh.centre(id, i, j)).to_array().into_iter().enumerate() {
                        block[(c * N + j) * N + i] = value;
                    }
                }
            }
            let rest = block.chunks_exact_mut(N * N).skip(COUNT);
            rest.zip(components).for_each(|(cells, component)| cells.fill(component.initial));
        },
    );
    state
}
