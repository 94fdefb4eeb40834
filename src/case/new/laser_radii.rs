//! The radii of a laser bubble: those that are given, and those that follow from its largest one.

use super::super::error::CaseErrors;
use super::checks::Checks;
use super::gilmore::turns;
use super::laser::LaserBubble;

/// R_n is given to so many digits: the largest radius comes within 10⁻³ of what was asked.
const DIGITS: usize = 4;

/// The radii of a laser bubble that are known, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LaserRadii {
    /// At the start.
    pub start: Option<f64>,
    /// R_n of its gas.
    pub equilibrium: Option<f64>,
    /// The largest one, in the place of R_n: what a camera sees.
    pub largest: Option<f64>,
    /// R_n of what is left of the gas after that; `Some(None)`: all of it.
    pub left: Option<Option<f64>>,
}

impl LaserRadii {
    /// The bubble with these radii; it has those of the default one where none is given.
    ///
    /// With a largest radius R_n is that of which Gilmore's equation makes it, and the others are to it as in the default bubble,
    /// which grows from 20 µm to 494 µm, and of the gas of which 64 µm are left.
    ///
    /// - `pressure`: of the liquid far away, Pa.
    ///
    /// # Errors
    /// A largest radius that is no positive number, or that no gas makes of the radius at the start.
    /// - tested by: the default bubble comes back; bubbles of other sizes and pressures.
    pub fn bubble(&self, pressure: f64) -> Result<LaserBubble, CaseErrors> {
        let of = LaserBubble { pressure, ..LaserBubble::default() };
        let Some(largest) = self.largest else {
            return Ok(LaserBubble {
                radius: self.start.unwrap_or(of.radius),
                equilibrium_radius: self.equilibrium.unwrap_or(of.equilibrium_radius),
                left_radius: self.left.unwrap_or(of.left_radius),
                ..of
            });
        };
        let scale = largest / LaserBubble::GROWS_TO;
        let radius = self.start.unwrap_or(scale * of.radius);
        let mut checks = Checks::default();
        checks
            .positive("largest_radius", largest, "m")
            .positive("radius", radius, "m")
            .positive("pressure", pressure, "Pa");
        checks.done()?;
        let grown =
            |equilibrium: f64| turns::<1>(&of.content(), radius, equilibrium, None).map(|[top]| top.radius);
        let Some(equilibrium_radius) = found(largest, 2.0 * radius, grown) else {
            let help = "take a smaller radius at the start, or a larger one in the end";
            checks.hold(
                false,
                "largest_radius",
                largest,
                "what a bubble of more than twice its radius at rest grows to",
                help,
            );
            checks.done()?;
            return Ok(of);
        };
        let left_radius = self.left.unwrap_or_else(|| of.left_radius.map(|left| rounded(scale * left)));
        Ok(LaserBubble {
            radius: if self.start.is_some() { radius } else { rounded(radius) },
            equilibrium_radius,
            left_radius,
            ..of
        })
    }
}

/// R_n between the least one and the largest radius itself, beyond which every bubble grows, of which that radius is made; by halving, in logarithms.
fn found(largest: f64, least: f64, grown: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    // What does not turn within the steps that are made is still too small, or rests.
    let is_below = |equilibrium: f64| grown(equilibrium).is_some_and(|radius| radius < largest);
    let [mut low, mut high] = [least, largest];
    if !(low < high && is_below(low)) {
        return None;
    }
    while high / low - 1.0 > 1e-6 {
        let middle = (low * high).sqrt();
        *if is_below(middle) { &mut low } else { &mut high } = middle;
    }
    Some(rounded(high))
}

fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(largest: f64) -> LaserRadii {
        LaserRadii { largest: Some(largest), ..LaserRadii::default() }
    }

    #[test]
    fn radii_are_those_of_which_gilmores_equation_makes_the_largest() {
        let same = of(LaserBubble::GROWS_TO).bubble(1e5).expect("a bubble");
        assert_eq!(same, LaserBubble::default());
        for (largest, pressure, start) in [(1.3e-3, 1e5, None), (30e-6, 1e6, Some(2e-6)), (5e-3, 3e4, None)] {
            let bubble = LaserRadii { start, ..of(largest) }.bubble(pressure).expect("a bubble");
            let [top, ..] =
                turns::<4>(&bubble.content(), bubble.radius, bubble.equilibrium_radius, bubble.left_radius)
                    .expect("four turns");
            eprintln!("{bubble:?} {top:?}");
            approx::assert_relative_eq!(top.radius, largest, max_relative = 1e-3);
        }
        for (radii, words) in [
            (of(-1.0), "largest_radius: must be positive"),
            (of(f64::NAN), "largest_radius"),
            (LaserRadii { start: Some(1e-4), ..of(3e-4) }, "largest_radius: must be what"),
        ] {
            let refused = radii.bubble(1e5).expect_err("no bubble").to_string();
            assert!(refused.contains(words), "{refused}");
        }
    }
}
