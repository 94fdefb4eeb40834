//! What the mass carries at t = 0.

use mesh::{Field, Mesh};

use super::Component;
use crate::state::conserved::{GAS, RHO};

/// Fills what the mass carries besides: ρY with the mass fraction Y of each component; the other components hold what they do.
///
/// - `first`: the number of the first of them in the field.
pub(crate) fn fill_carried<const N: usize>(
    mesh: &Mesh<N>,
    carried: &[Component],
    first: usize,
    field: &mut Field,
) {
    if carried.is_empty() {
        return;
    }
    let has_phases = first > GAS;
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        let widths = mesh.widths(id.level);
        let block = field.block_mut(slot);
        for (component, carried) in carried.iter().enumerate() {
            for cell in 0..N * N {
                let centre = mesh.centre(*id, cell % N, cell / N);
                let gas = if has_phases { block[GAS * N * N + cell] } else { 0.0 };
                let masses = [block[RHO * N * N + cell], gas];
                block[(first + component) * N * N + cell] =
                    carried.initial(mesh.domain().geometry, (centre, widths), masses);
            }
        }
    }
}
