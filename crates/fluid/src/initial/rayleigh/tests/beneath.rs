use super::*;

/// One bubble at d/R = 0 to 3, three at once; the wall is at z = 0.3.
fn fields() -> Vec<RayleighField> {
    let stand_offs = [0.0, 0.3, 0.9, 0.99, 1.0, 1.02, 1.2, 2.0, 3.0];
    let mut fields: Vec<_> = stand_offs.map(|d| field(&[[0.3 + d, 1.0, 2e3]], WALL)).into();
    fields.push(field(&THREE, WALL));
    fields
}

#[test]
fn on_the_wall_it_is_the_pressure_there() {
    for (case, field) in fields().into_iter().enumerate() {
        let beneath = field.beneath().expect("a wall");
        assert!(beneath.error() < 5e-5, "{case}: {:e}", beneath.error());
        for r in (0..400).map(|k| 0.0113 * f64::from(k)) {
            let (own, want) = (beneath.at(0.0, r).value, field.pressure([0.3, r]) - FAR);
            assert!((own - want).abs() < 5e-5 * 3e5, "{case}, r = {r}: {own} for {want}");
        }
    }
}

/// Far from the wall a bubble is a charge, and its image another one: h = 2 a R/s about the bubble's centre.
#[test]
fn of_a_bubble_far_away_it_is_that_of_a_charge() {
    let height = 40.0;
    let field = field(&[[0.3 + height, 1.0, 2e3]], WALL);
    let (beneath, charge) = (field.beneath().expect("a wall"), 2.0 * field.monopoles()[0]);
    for [depth, r] in [[0.0, 5.0], [20.0, 1e-3], [50.0, 60.0]] {
        let (along, found) = (depth + height, beneath.at(depth, r));
        let s = along.hypot(r);
        let want = [1.0 / s, along / s.powi(3), -r / s.powi(3), 2.0 / (s + along), 2.0 / (s * (s + along))];
        let [along_z, along_r] = found.gradient;
        let found = [found.value, along_z, along_r, found.disc_mean, found.disc_mean_along_z];
        for (part, (found, want)) in found.into_iter().zip(want).enumerate() {
            let (found, want) = (found / charge * s, want * s);
            assert!((found - want).abs() < 1e-3 * want.abs(), "{part} at {depth}, {r}: {found} for {want}");
        }
    }
}

/// ∂²h/∂z² + (1/r) ∂(r ∂h/∂r)/∂r = 0, its gradient, and r m/2 = (1/r) ∫ h r dr: ∂(r² m/2)/∂r = r h.
#[test]
fn it_is_harmonic_with_its_gradient_and_its_means() {
    const H: f64 = 1e-3;
    for field in fields() {
        let beneath = field.beneath().expect("a wall");
        for [depth, r] in [[0.5, 0.2], [0.3, 1.1], [2.0, 3.0]] {
            let here = beneath.at(depth, r);
            let slope = |part: &dyn Fn(f64) -> f64| (part(H) - part(-H)) / (2.0 * H);
            let [along_z, along_r] = here.gradient;
            let second_z = slope(&|step| beneath.at(depth - step, r).gradient[0]);
            let second_r = slope(&|step| (r + step) * beneath.at(depth, r + step).gradient[1]) / r;
            let largest = second_z.abs().max(along_z.abs());
            let pairs = [
                (second_z, -second_r),
                (along_z, slope(&|step| beneath.at(depth - step, r).value)),
                (along_r, slope(&|step| beneath.at(depth, r + step).value)),
                (here.disc_mean_along_z, slope(&|step| beneath.at(depth - step, r).disc_mean)),
                (
                    here.value,
                    slope(&|step| 0.5 * (r + step).powi(2) * beneath.at(depth, r + step).disc_mean) / r,
                ),
            ];
            for (part, (found, want)) in pairs.into_iter().enumerate() {
                assert!((found - want).abs() < 1e-4 * largest, "{part} at {depth}, {r}: {found} for {want}");
            }
        }
    }
}

#[test]
fn beside_other_sides_nothing_is_known_beneath() {
    use Boundary::{Axis, NonReflecting, Wall};
    let beneath = |sides| {
        let field = RayleighField::between(&bubbles(&[[2.5, 1.0, 2e3]]), &BOX, sides).expect("a field");
        field.beneath().is_some()
    };
    assert!(beneath([Wall, NonReflecting, Axis, NonReflecting]));
    assert!(!beneath([NonReflecting, NonReflecting, Axis, NonReflecting]));
    assert!(!beneath([NonReflecting, Wall, Axis, NonReflecting]));
    assert!(!beneath([Wall, NonReflecting, Axis, Wall]));
}
