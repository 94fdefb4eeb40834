//! What linear reconstruction leaves out at the faces of smooth waves.

/// The share of the difference of two neighbouring cells' differences that face states lack, a twelfth of (1 − ν)(1 − 2ν).
///
/// In MUSCL–Hancock with central differences d a wave's state on a face is off by −(1 − ν)(1 − 2ν) h² w″/12: waves of
/// short length lag, the more so the smaller the Courant number ν. As d_{i+1} − d_i = h² w″, this share of it, added to
/// the states on both sides of the face, puts that right; the jump between them, which is what the scheme damps with, stays.
/// Of a wave along the cells nothing is left of third order; for oblique ones see [`oblique_dispersion_shares`].
///
/// - `courant`: ν = c Δt/h of the wave. returns: 0 from ν = ½ on, where the error changes its sign.
#[inline(always)]
#[must_use]
pub fn dispersion_share(courant: f64) -> f64 {
    // A select, so that rows vectorise and a Courant number that is none gives nothing.
    if courant < 0.5 { (1.0 - courant) * (1.0 - 2.0 * courant) * (1.0 / 12.0) } else { 0.0 }
}

/// The shares of the second difference along a face, δ²w = h_s² ∂²w/∂s², that its normal velocity and its pressure lack in
/// sound that crosses it at an angle.
///
/// The mean over a step of a state on a face is w + ½Δt ∂t w + ⅙Δt² ∂t² w. The predictor of a cell has ∂t w at its
/// centre, half a cell from the face, and the Riemann problem turns what ∂t p = −ρc² div v is off there into a velocity,
/// −¼ c Δt h_n ∂n div v; and ∂t² w = c² ∇²w is left out. The derivatives along the normal are
/// [`dispersion_share`]'s. Those along the face, with ∂n div v = ∇²v_n in irrotational flow, leave
/// (⅙ν_s² − ¼ν_n h_n²/h_s²) δ²v_n and ⅙ν_s² δ²p, ν_s = ν_n h_n/h_s. With both, nothing of third order is left of a plane
/// wave in any direction while ν_n < ½, and the scheme is stable where it was without (von Neumann).
///
/// - `courant`: ν_n = c Δt/h_n. `aspect`: h_n/h_s, the cell's width along the normal over that along the face.
/// - returns: of the normal velocity, of the pressure; nothing from ν_n = ½ on, as [`dispersion_share`].
#[inline(always)]
#[must_use]
pub fn oblique_dispersion_shares(courant: f64, aspect: f64) -> [f64; 2] {
    let along = courant * aspect;
    let pressure = along * along * (1.0 / 6.0);
    let velocity = pressure - 0.25 * courant * aspect * aspect;
    if courant < 0.5 { [velocity, pressure] } else { [0.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::{dispersion_share, oblique_dispersion_shares};

    /// A parabola that moves with the Courant number ν: the mean over the step on a face, from cell averages.
    #[test]
    fn the_upwind_state_of_a_moving_parabola_becomes_exact() {
        let mean = |z: f64| z * z + 1.0 / 12.0;
        for courant in [0.0, 0.11, 0.3, 0.5] {
            let difference = |z: f64| 0.5 * (mean(z + 1.0) - mean(z - 1.0));
            let trace = mean(-0.5) + 0.5 * (1.0 - courant) * difference(-0.5);
            let corrected = trace + dispersion_share(courant) * (difference(0.5) - difference(-0.5));
            let exact = courant * courant / 3.0;
            assert!((corrected - exact).abs() < 1e-15, "{courant}: {corrected} {exact}");
        }
    }

    /// A plane wave w = s², s = n·x − ct, in sound with ρc = c = 1: p = w, v = n w. What the Riemann problem makes of the
    /// states on both sides of the face at the origin is the mean over the face and the step.
    #[test]
    fn the_star_state_of_an_oblique_parabola_becomes_exact() {
        let [h, k] = [1.0, 0.7];
        for (courant, angle) in [(0.05, 0.3), (0.2, 1.0), (0.45, 0.8), (0.45, 2.5), (0.499, -0.6)] {
            let [n, t]: [f64; 2] = [f64::cos(angle), f64::sin(angle)];
            let dt = courant * h;
            let mean =
                |x: f64, y: f64| (n * x + t * y).powi(2) + (n * h).powi(2) / 12.0 + (t * k).powi(2) / 12.0;
            let across = |x: f64, y: f64| 0.5 * (mean(x + h, y) - mean(x - h, y));
            let along = |x: f64, y: f64| 0.5 * (mean(x, y + k) - mean(x, y - k));
            let second = |x: f64| 0.5 * (along(x, k) - along(x, -k));
            let more = dispersion_share(courant) * (across(0.5 * h, 0.0) - across(-0.5 * h, 0.0));
            let [of_velocity, of_pressure] = oblique_dispersion_shares(courant, h / k)
                .map(|share| share * 0.5 * (second(-0.5 * h) + second(0.5 * h)));
            // The pressure and the normal velocity on the side `sign` of the face.
            let state = |sign: f64| {
                let x = 0.5 * sign * h;
                let [d_n, d_t] = [across(x, 0.0), along(x, 0.0)];
                let divergence = n * d_n / h + t * d_t / k;
                let p = mean(x, 0.0) - 0.5 * dt * divergence - 0.5 * sign * d_n;
                let v = n * mean(x, 0.0) - 0.5 * dt * d_n / h - 0.5 * sign * n * d_n;
                [p + more + of_pressure, v + n * (more + of_velocity)]
            };
            let [[p_l, v_l], [p_r, v_r]] = [state(-1.0), state(1.0)];
            let star = [0.5 * (p_l + p_r) + 0.5 * (v_l - v_r), 0.5 * (v_l + v_r) + 0.5 * (p_l - p_r)];
            let exact = (t * k).powi(2) / 12.0 + dt * dt / 3.0;
            for (found, wanted) in star.into_iter().zip([exact, n * exact]) {
                assert!((found - wanted).abs() < 1e-14, "{courant} {angle}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn fast_waves_are_left_alone() {
        for courant in [0.5, 0.8, 1.8, f64::NAN] {
            assert_eq!(dispersion_share(courant), 0.0);
            assert_eq!(oblique_dispersion_shares(courant, 1.0), [0.0; 2]);
        }
    }
}
