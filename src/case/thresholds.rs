//! The thresholds of adaptation where a case does not give them: from the error that adaptation may add.
//!
//! One rule for all cases, whatever is in them. A threshold ε of a wave adds an error of about 100 ε to it, measured on pulses of 12 to
//! 20 cells per width; a threshold ε of an interface or a shock, which is on the finest level anyway, adds one of at most 30 ε to the peaks,
//! loads and times of a collapse. See docs/theory/choosing-epsilon.md.

use super::read_adaptation::{Asked, DEFAULT_ERROR};
use super::reader::Given;
use super::{FluidCase, LoadCase, SolidCase, scales};

/// The same for waves of [`WAVE_CELLS`] cells per width: below the scheme's own error of such waves.
const WAVE_ERROR: f64 = 1e-4;
/// Cells per width of the waves for which [`WAVE_ERROR`] is meant. It falls with the square of the cells' width, as the scheme's own.
const WAVE_CELLS: f64 = 20.0;
/// Bounds of the error of waves that follows their cells per width.
const WAVE_ERRORS: [f64; 2] = [1e-7, 1e-3];
/// What a threshold of waves adds to them, in units of itself.
const ERROR_OF_WAVES: f64 = 100.0;
/// What a threshold of interfaces and shocks adds to a collapse, in units of itself.
const ERROR_OF_INTERFACES: f64 = 100.0 / 3.0;
/// Weaker waves than this share of the reference value count as of this share: what is stronger around them is no wave.
const WEAKEST_WAVE: f64 = 1e-2;

/// A wave that the case prescribes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wave {
    /// Largest stress or pressure, Pa.
    amplitude: f64,
    /// Width of its pulse, or radius of its load, m.
    width: f64,
}

/// The waves that the sides and the load prescribe; an inflow's history has no width.
fn prescribed(fluid: Option<&FluidCase>, solid: Option<&SolidCase>, load: Option<&LoadCase>) -> Vec<Wave> {
    let in_fluid = fluid.into_iter().flat_map(|fluid| &fluid.initial.pulses);
    let in_fluid = in_fluid.map(|pulse| Wave { amplitude: pulse.amplitude.abs(), width: pulse.width });
    let in_solid = solid.into_iter().flat_map(|solid| {
        let wave = |pulse: &solid::PotentialPulse| Wave {
            amplitude: scales::pulse_stress(pulse, &solid.material).abs(),
            width: pulse.width,
        };
        solid.pulses.iter().map(wave)
    });
    let pressing = load.and_then(|load| Some(Wave { amplitude: load.largest(), width: load.width()? }));
    in_fluid.chain(in_solid).chain(pressing).filter(|wave| wave.amplitude > 0.0).collect()
}

/// The threshold of waves, relative to a reference value: ε = E A/(100 p_ref) with the waves' amplitudes A, the least of all.
///
/// E is the error asked for; where none is, 10⁻⁴ (20 h/a)² for a prescribed wave of width a, so that refinement keeps the scheme's
/// order (Harten 1995; Cohen, Kaber, Müller & Postel 2003 choose ε likewise by the order and the finest level), and 10⁻² where
/// no wave is prescribed. Of two digits.
///
/// - `reference`: p_ref or σ_ref, Pa; `cell`: h, width of the finest cells, m. returns: in (0, 1). errors: none.
fn of_waves(error: Option<f64>, waves: &[Wave], reference: f64, cell: f64) -> f64 {
    let [least, most] = WAVE_ERRORS;
    let own_error = |wave: &Wave| (WAVE_ERROR * (WAVE_CELLS * cell / wave.width).powi(2)).clamp(least, most);
    let share = |wave: &Wave| (wave.amplitude / reference).clamp(WEAKEST_WAVE, 1.0);
    let of = |wave: &Wave| error.unwrap_or_else(|| own_error(wave)) * share(wave) / ERROR_OF_WAVES;
    let whole = error.unwrap_or(DEFAULT_ERROR) / ERROR_OF_WAVES;
    two_digits(waves.iter().map(of).reduce(f64::min).unwrap_or(whole))
}

/// The threshold of interfaces and shocks.
fn of_interfaces(error: Option<f64>) -> f64 {
    two_digits(error.unwrap_or(DEFAULT_ERROR) / ERROR_OF_INTERFACES)
}

fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// Sets the thresholds of both sides.
pub(super) fn settle(
    fluid: Option<(&mut FluidCase, &Asked)>,
    solid: Option<(&mut SolidCase, &Asked)>,
    load: Option<&LoadCase>,
) {
    let waves = prescribed(
        fluid.as_ref().map(|(fluid, _)| &**fluid),
        solid.as_ref().map(|(solid, _)| &**solid),
        load,
    );
    let value = |given: &Option<Given<f64>>| given.as_ref().map(|given| given.value);
    let widest = |size: [f64; 2]| size[0].max(size[1]);
    if let Some((fluid, asked)) = fluid {
        let (error, epsilon) = (value(&asked.error), value(&asked.epsilon));
        let cell = widest(fluid.grid.cell_size());
        let by_rule = || of_waves(error, &waves, fluid.scale_pressure, cell);
        fluid.wave_epsilon = value(&asked.epsilon_waves).or(epsilon).unwrap_or_else(by_rule);
        if let Some(adaptation) = &mut fluid.grid.adaptation {
            adaptation.epsilon = epsilon.unwrap_or_else(|| of_interfaces(error));
        }
    }
    if let Some((solid, asked)) = solid {
        let cell = widest(solid.grid.cell_size());
        let by_rule = || of_waves(value(&asked.error), &waves, solid.scale_stress, cell);
        if let Some(adaptation) = &mut solid.grid.adaptation {
            adaptation.epsilon = value(&asked.epsilon).unwrap_or_else(by_rule);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PULSE: Wave = Wave { amplitude: 1e4, width: 3e-4 };

    #[test]
    fn the_threshold_of_prescribed_waves_falls_with_the_square_of_the_cells_width() {
        let of = |cells: f64| of_waves(None, &[PULSE], 1e4, PULSE.width / cells);
        assert_eq!([10.0, 20.0, 19.999_999_9, 40.0, 80.0].map(of), [4e-6, 1e-6, 1e-6, 2.5e-7, 6.2e-8]);
        assert_eq!([1e-3, 1e9].map(of), [1e-5, 1e-9]);
    }

    #[test]
    fn waves_are_kept_by_their_own_amplitude_beside_something_stronger() {
        let of = |reference| of_waves(None, &[PULSE], reference, PULSE.width / 20.0);
        assert_eq!([1e4, 1e5, 1e6, 1e9].map(of), [1e-6, 1e-7, 1e-8, 1e-8]);
        let weaker = Wave { amplitude: 1e3, ..PULSE };
        assert_eq!(of_waves(None, &[PULSE, weaker], 1e4, PULSE.width / 20.0), 1e-7);
    }

    #[test]
    fn the_error_that_is_asked_for_is_the_rule_where_it_is() {
        assert_eq!([None, Some(1e-3), Some(0.03)].map(of_interfaces), [3e-4, 3e-5, 9e-4]);
        assert_eq!([None, Some(1e-3)].map(|error| of_waves(error, &[], 5e7, 1e-4)), [1e-4, 1e-5]);
        assert_eq!(of_waves(Some(1e-3), &[PULSE], 1e5, 1e-4), 1e-6);
    }
}
