//! How long a step may be.

/// The longest step of cells in which signals run so fast, s: cfl · min(h_z/s_z, h_r/s_r), and no longer than the unsplit scheme
/// holds.
///
/// The fluxes of both directions are added in one step: it is stable while s_z Δt/h_z + s_r Δt/h_r ≤ 1 (von Neumann). With square
/// cells and Courant numbers up to ½ that bound says nothing; larger ones are for cells that are much longer one way, as in a tube.
///
/// - `cfl`: the Courant number asked for; `widths`: h_z, h_r, m; `speeds`: s_z, s_r, m/s.
/// - valid for positive widths and speeds; a speed that is not finite gives 0. errors: none.
#[must_use]
pub fn longest_step(cfl: f64, [h_z, h_r]: [f64; 2], [s_z, s_r]: [f64; 2]) -> f64 {
    let of_sum = 1.0 / (s_z / h_z + s_r / h_r);
    (cfl * h_z / s_z).min(cfl * h_r / s_r).min(of_sum)
}

#[cfg(test)]
mod tests {
    use super::longest_step;

    #[test]
    fn both_directions_together_hold_the_step() {
        // Square cells: half a cell at most, whatever is asked for.
        assert_eq!(longest_step(0.45, [2.0, 2.0], [10.0, 10.0]), 0.45 * 2.0 / 10.0);
        assert_eq!(longest_step(0.8, [2.0, 2.0], [10.0, 10.0]), 0.1);
        // A tube of cells that are long across has all of what is asked for.
        assert_eq!(longest_step(0.8, [2.0, 20.0], [10.0, 10.0]), 0.8 * 2.0 / 10.0);
        assert_eq!(longest_step(0.45, [2.0, 2.0], [f64::INFINITY, 10.0]), 0.0);
    }
}
