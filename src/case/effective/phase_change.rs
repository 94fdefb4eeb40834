//! `[fluid.terms.phase_change]` and `.cavitation`, written out.

use fluid::{EvaporationLaw, PhaseChange};

use super::Lines;

pub(super) fn write(text: &mut Lines, change: PhaseChange) {
    text.head("[fluid.terms.phase_change]");
    match change.law {
        EvaporationLaw::HertzKnudsen { accommodation } => {
            text.key("law", "\"hertz-knudsen\"");
            text.number("accommodation", accommodation);
        }
        EvaporationLaw::Equilibrium => text.key("law", "\"ptg\""),
    }
    text.number("vapour_fraction", change.vapour_fraction);
    if let Some(threshold) = change.cavitation {
        text.head("[fluid.terms.cavitation]");
        text.number("threshold", threshold);
    }
}
