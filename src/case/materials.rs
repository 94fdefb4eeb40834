//! What `cav materials` prints, and laws in words.

use std::fmt::Write as _;

use fluid::{Heat, NamedFluid};
use solid::plasticity::{Hardening, JohnsonCook, MaterialHardening, RateFactor, ThermalSoftening};
use solid::{Material, MaterialHeat};

/// The materials known by name.
pub fn materials_table() -> String {
    let mut text = format!(
        "{:<25}{:>9}{:>7}{:>7}{:>9}{:>9}{:>9}{:>10}{:>10}  source\n{:<25}{:>9}{:>7}{:>7}{:>9}{:>9}{:>9}{:>10}{:>10}\n",
        "name",
        "density",
        "c1",
        "c2",
        "young",
        "poisson",
        "yield",
        "conduct.",
        "c",
        "",
        "kg/m3",
        "m/s",
        "m/s",
        "GPa",
        "1",
        "MPa",
        "W/(m K)",
        "J/(kg K)"
    );
    for material in Material::library() {
        let strength = material.yield_strength().map_or("-".to_owned(), |y| format!("{:.0}", y / 1e6));
        let heat = |of: fn(&MaterialHeat) -> f64| {
            material.heat().as_ref().map_or("-".to_owned(), |heat| of(heat).to_string())
        };
        let _ = writeln!(
            text,
            "{:<25}{:>9.0}{:>7.0}{:>7.0}{:>9.4}{:>9.4}{:>9}{:>10}{:>10}  {}",
            material.name(),
            material.density(),
            material.c1(),
            material.c2(),
            material.young() / 1e9,
            material.poisson(),
            strength,
            heat(|heat| heat.conductivity),
            heat(|heat| heat.capacity),
            material.source()
        );
    }
    hardening_table(&mut text);
    fluids_table(&mut text);
    text
}

/// A line of a table: a name, numbers under each other, and where they are from.
fn row(text: &mut String, [first, others]: [usize; 2], cells: &[String], source: &str) {
    for (place, cell) in cells.iter().enumerate() {
        let _ = if place == 0 { write!(text, "{cell:<first$}") } else { write!(text, "{cell:>others$}") };
    }
    let _ = writeln!(text, "  {source}");
}

/// The constants of `[fluid.liquid]` and `[fluid.gas]` by `fluid = "name"`, and those of terms.
fn fluids_table(text: &mut String) {
    let row = |text: &mut String, cells: [String; 9], source: &str| row(text, [19, 10], &cells, source);
    let _ = writeln!(
        text,
        "\np = (gamma - 1)(e - q)/(1/rho - b) - gamma pi, `fluid = \"name\"` in [fluid.liquid], [fluid.gas]:"
    );
    let heads = ["name", "gamma", "pi", "b", "c_v", "q", "q'", "viscosity", "conduct."];
    row(text, heads.map(str::to_owned), "source");
    let units = ["", "1", "MPa", "m3/kg", "J/(kg K)", "kJ/kg", "J/(kg K)", "Pa s", "W/(m K)"];
    row(text, units.map(str::to_owned), "");
    for NamedFluid { name, law, viscosity, conductivity, source } in NamedFluid::library() {
        let heat =
            |of: fn(&Heat) -> f64| law.heat.as_ref().map_or("-".to_owned(), |heat| of(heat).to_string());
        let cells = [
            (*name).to_owned(),
            law.gamma.to_string(),
            (law.pi / 1e6).to_string(),
            if law.covolume > 0.0 { format!("{:e}", law.covolume) } else { "0".to_owned() },
            heat(|heat| heat.capacity),
            heat(|heat| heat.energy / 1e3),
            heat(|heat| heat.entropy),
            format!("{viscosity:.2e}"),
            conductivity.to_string(),
        ];
        row(text, cells, source);
    }
}

/// The constants of `[solid.plasticity] law = "johnson-cook"` for those that have some.
fn hardening_table(text: &mut String) {
    let row = |text: &mut String, cells: [String; 11], source: &str| row(text, [25, 9], &cells, source);
    let _ = writeln!(text, "\n(A + B eps^n)(1 + C ln(rate/rate0))(1 - T*^m), `law = \"johnson-cook\"`:");
    row(
        text,
        ["name", "A", "B", "n", "C", "rate0", "m", "melts", "T_r", "c_p", "chi"].map(str::to_owned),
        "source",
    );
    row(text, ["", "MPa", "MPa", "1", "1", "1/s", "1", "K", "K", "J/(kg K)", "1"].map(str::to_owned), "");
    for MaterialHardening { material, law, source, .. } in MaterialHardening::library() {
        let heat = |of: fn(&ThermalSoftening) -> f64| {
            law.softening.as_ref().map_or("-".to_owned(), |heat| of(heat).to_string())
        };
        let cells = [
            (*material).to_owned(),
            (law.yield_strength / 1e6).to_string(),
            (law.hardening_modulus / 1e6).to_string(),
            law.hardening_exponent.to_string(),
            law.rate.rate_coefficient.to_string(),
            law.rate.reference_rate.to_string(),
            heat(|heat| heat.softening_exponent),
            heat(|heat| heat.melting_temperature),
            heat(|heat| heat.reference_temperature),
            heat(|heat| heat.heat_capacity),
            heat(|heat| heat.taylor_quinney),
        ];
        row(text, cells, source);
    }
}

/// A hardening law with its constants, MPa.
pub(super) fn law_in_words(law: &Hardening) -> String {
    let mega = |stress: f64| stress / 1e6;
    match law {
        Hardening::Perfect(law) => format!("perfect: {} MPa", mega(law.yield_strength)),
        Hardening::Linear(law) => {
            format!("linear: {} MPa + {} MPa eps", mega(law.yield_strength), mega(law.hardening_modulus))
        }
        Hardening::JohnsonCook(JohnsonCook {
            yield_strength,
            hardening_modulus,
            hardening_exponent,
            rate,
            softening,
            ..
        }) => {
            let (a, b) = (mega(*yield_strength), mega(*hardening_modulus));
            let mut words = format!("johnson-cook: ({a} MPa + {b} MPa eps^{hardening_exponent})");
            if rate.acts() {
                words += &format!(" {}", rate_in_words(*rate));
            }
            if let Some(heat) = softening {
                let (low, high) = (heat.reference_temperature, heat.melting_temperature);
                let _ = write!(words, " (1 - T*^{}), T* from {low} to {high} K", heat.softening_exponent);
            }
            words
        }
        Hardening::Table(law) => {
            let mut words = format!(
                "table: {} points from {} MPa",
                law.points().count(),
                mega(law.points().next().map_or(0.0, |point| point[1]))
            );
            if law.rate().acts() {
                words += &format!(", {}", rate_in_words(law.rate()));
            }
            words
        }
    }
}

fn rate_in_words(RateFactor { rate_coefficient, reference_rate, .. }: RateFactor) -> String {
    format!("(1 + {rate_coefficient} ln(rate/({reference_rate} 1/s)))")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_of_the_library_is_there_with_its_constants() {
        let text = materials_table();
        let rows =
            |name: &str| text.lines().filter(|line| line.split_whitespace().next() == Some(name)).count();
        for material in Material::library() {
            let expected = 1 + usize::from(MaterialHardening::of(material.name()).is_some());
            assert_eq!(rows(material.name()), expected, "{}", material.name());
        }
        let copper: Vec<&str> = text
            .lines()
            .rfind(|line| line.starts_with("copper-ofhc"))
            .map(|line| line.split_whitespace().take(10).collect())
            .unwrap_or_default();
        assert_eq!(copper, ["copper-ofhc", "90", "292", "0.31", "0.025", "1", "1.09", "1356", "298", "383"]);
    }

    #[test]
    fn laws_are_told_with_their_constants() {
        let law = |name: &str| {
            MaterialHardening::of(name).map(|entry| law_in_words(&Hardening::JohnsonCook(entry.law)))
        };
        assert_eq!(
            law("copper-ofhc").as_deref(),
            Some(
                "johnson-cook: (90 MPa + 292 MPa eps^0.31) (1 + 0.025 ln(rate/(1 1/s))) (1 - T*^1.09), T* from 298 to 1356 K"
            )
        );
        assert!(law("duplex-2205").is_some_and(|words| !words.contains("T*")));
    }
}
