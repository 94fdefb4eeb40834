//! The mesh that the initial state asks for, and the state on it.

pub(crate) mod half_space;

use mesh::{BlockId, Field, Mesh, MeshError, Side, for_some_blocks};

use crate::analysis::Analysis;
use crate::components::Component;
use crate::state::component::{COUNT, V_R, V_Z};
use crate::{Boundary, ElasticState, SolidError, SolidSetup};

/// The state at a cell's centre (z, r): one type, so that meshes are not made by code of their own for each function.
pub(crate) type InitialState<'a> = dyn Fn([f64; 2]) -> ElasticState + Sync + 'a;

/// The mesh that the initial state asks for, filled with it.
pub(crate) fn initial_mesh<const N: usize>(
    setup: &SolidSetup,
    analysis: &Analysis,
    components: &[Component],
    initial: &InitialState<'_>,
) -> Result<(Mesh<N>, Field), SolidError> {
    let periodic = periodic(setup);
    let fill = |mesh: &Mesh<N>| fill(mesh, components, initial);
    let adaptation = setup.adaptation.as_ref();
    let SolidSetup { domain, coarsest, levels, .. } = *setup;
    let base = adaptation.map_or(levels, |adaptation| adaptation.base(levels));
    let demanded = |mesh: &Mesh<N>, _: &Field| setup.demanded_levels(mesh, base, 0.0);
    Ok(Mesh::initial(domain, coarsest, levels, periodic, adaptation, analysis, fill, demanded)?)
}

/// Which pairs of sides are one.
fn periodic(setup: &SolidSetup) -> [bool; 2] {
    [Side::ZMin, Side::RMin].map(|side| setup.boundaries[side as usize] == Boundary::Periodic)
}

/// The mesh of an earlier solid, with its cells at rest and their stresses changed.
pub(crate) fn earlier_cells<const N: usize>(
    setup: &SolidSetup,
    components: &[Component],
    leaves: Vec<BlockId>,
    cells: &Field,
    change: &InitialState<'_>,
) -> Result<(Mesh<N>, Field), SolidError> {
    let SolidSetup { domain, coarsest, levels, .. } = *setup;
    let blocks = leaves.len();
    let mesh = Mesh::<N>::uniform(domain, coarsest, levels, periodic(setup))?.restored(leaves, 0)?;
    if !cells.has_shape(blocks, N * N, cells.components()) || cells.components() < COUNT {
        return Err(MeshError::NoTiling { blocks }.into());
    }
    let mut state = fill(&mesh, components, change);
    let stays = COUNT..state.components().min(cells.components());
    for slot in 0..blocks {
        let block = state.block_mut(slot);
        for component in [V_Z, V_R] {
            block[component * N * N..(component + 1) * N * N].fill(0.0);
        }
        for component in V_R + 1..COUNT {
            let own = &mut block[component * N * N..(component + 1) * N * N];
            own.iter_mut().zip(cells.component(slot, component)).for_each(|(own, earlier)| *own += earlier);
        }
        // Plastic strain, and the temperature if both have one.
        for component in stays.clone() {
            block[component * N * N..(component + 1) * N * N]
                .copy_from_slice(cells.component(slot, component));
        }
    }
    Ok((mesh, state))
}

/// The initial state at the cells' centres.
fn fill<const N: usize>(mesh: &Mesh<N>, components: &[Component], initial: &InitialState<'_>) -> Field {
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
