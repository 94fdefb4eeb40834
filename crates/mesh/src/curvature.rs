//! What linear reconstruction leaves out at the faces of smooth waves.

/// The share of the difference of two neighbouring cells' differences that face states lack, a twelfth of (1 − ν)(1 − 2ν).
///
/// In MUSCL–Hancock with central differences d a wave's state on a face is off by −(1 − ν)(1 − 2ν) h² w″/12: waves of
/// short length lag, the more so the smaller the Courant number ν. As d_{i+1} − d_i = h² w″, this share of it, added to
/// the states on both sides of the face, puts that right; the jump between them, which is what the scheme damps with, stays.
/// Of a wave along the cells nothing is left of third order; of oblique ones a part of 3ν.
///
/// - `courant`: ν = c Δt/h of the wave. returns: 0 from ν = ½ on, where the error changes its sign.
#[must_use]
pub fn curvature_share(courant: f64) -> f64 {
    ((1.0 - courant) * (1.0 - 2.0 * courant).max(0.0)).max(0.0) / 12.0
}

#[cfg(test)]
mod tests {
    use super::curvature_share;

    /// A parabola that moves with the Courant number ν: the mean over the step on a face, from cell averages.
    #[test]
    fn the_upwind_state_of_a_moving_parabola_becomes_exact() {
        let mean = |z: f64| z * z + 1.0 / 12.0;
        for courant in [0.0, 0.11, 0.3, 0.5] {
            let difference = |z: f64| 0.5 * (mean(z + 1.0) - mean(z - 1.0));
            let trace = mean(-0.5) + 0.5 * (1.0 - courant) * difference(-0.5);
            let corrected = trace + curvature_share(courant) * (difference(0.5) - difference(-0.5));
            let exact = courant * courant / 3.0;
            assert!((corrected - exact).abs() < 1e-15, "{courant}: {corrected} {exact}");
        }
    }

    #[test]
    fn fast_waves_are_left_alone() {
        assert_eq!(curvature_share(0.5), 0.0);
        assert_eq!(curvature_share(0.8), 0.0);
    }
}
