//! The `[solid]` table.

use std::path::PathBuf;

use coupler::Scheme;
use mesh::{Geometry, Limiter, Side};
use solid::{Boundary, InitialStress, Material, MaterialError, PotentialPulse, Weight};
use toml::de::DeValue;

use super::error::suggest;
use super::read_grid::{GridPlace, grid};
use super::read_plasticity::plasticity;
use super::reader::{Faults, Given, LARGEST, SMALLEST, Table, describe};
use super::shared::{Context, boundaries};
use super::{GridCase, SolidCase, scales};

/// - `acting`: what acts on the solid from outside.
pub(super) fn solid(
    mut table: Table<'_>,
    context: Context,
    acting: scales::Acting<'_>,
    faults: &mut Faults,
) -> Option<(SolidCase, GridPlace)> {
    let placed = grid(&mut table, context, Side::ZMax, faults);
    let material = material(&mut table, faults);
    let initial_stress = table.name("initial_stress", &InitialStress::NAMES, faults);
    let initial = table.string("initial", faults);
    let boundary = sides(&mut table, context, faults);
    let gravity = table.number("gravity", faults).filter(|given| given.value != 0.0);
    let limiter = table.name("limiter", &Limiter::NAMES, faults);
    let given = table.table("plasticity", faults);
    let is_plastic = given.is_some();
    let plasticity = given.and_then(|given| plasticity(given, material.as_ref(), faults));
    let pulses: Vec<Option<PotentialPulse>> =
        table.tables("pulse", faults).into_iter().map(|table| pulse(table, context, faults)).collect();
    let scale_stress = table.positive("scale_stress", faults);
    table.finish(faults);
    if is_plastic && plasticity.is_none() {
        return None;
    }
    let (grid, place) = placed?;
    let material = material?;
    let weight = match gravity {
        Some(given) => Some(weight(&given, &grid, &material, faults)?),
        None => None,
    };
    let pulses: Vec<PotentialPulse> = pulses.into_iter().collect::<Option<_>>()?;
    let case = SolidCase {
        grid,
        scale_stress: scale_stress.unwrap_or_else(|| scales::stress(acting, &pulses, &material)),
        material,
        plasticity,
        weight,
        initial_stress,
        initial: initial.map(|given| PathBuf::from(given.value)),
        boundary,
        limiter,
        pulses,
    };
    Some((case, place))
}

/// Its own weight; the stress that the case says is that on the surface.
fn weight(given: &Given<f64>, grid: &GridCase, material: &Material, faults: &mut Faults) -> Option<Weight> {
    /// The largest strain that it may mean.
    const SMALL_STRAIN: f64 = 0.01;
    let [low, high] = grid.z;
    let strain = (given.value * (high - low)).abs() / (material.c1() * material.c1());
    if strain > SMALL_STRAIN {
        let (g, c1) = (given.value, material.c1());
        let message = format!(
            "{g:?} m/s2 means a stress of {strain:?} of the modulus at solid.z = {low:?} m, with c1 = {c1:?} m/s (solid.material)"
        );
        let most = SMALL_STRAIN * c1 * c1 / (high - low);
        faults.of(
            given,
            message,
            format!("strains are small: at most {SMALL_STRAIN}; give less than {most:?} m/s2"),
        );
        return None;
    }
    Some(Weight { acceleration: given.value, level: high })
}

/// `material = "name"`, or a table with density and one pair of moduli or speeds.
fn material(table: &mut Table<'_>, faults: &mut Faults) -> Option<Material> {
    if !table.has("material") {
        let help = "give `material = \"structural-steel\"` or another name of `cav materials`, \
                    or a table [solid.material]";
        table.missing("material", help, faults);
    }
    let given = table.raw("material")?;
    match given.value {
        DeValue::String(name) => {
            let found = Material::by_name(name);
            if found.is_none() {
                let library = Material::library();
                let help = suggest(name, library.iter().map(Material::name));
                let help = format!("{help}; or a table [solid.material]");
                faults.of(&given, format!("unknown material `{name}`"), help);
            }
            found
        }
        DeValue::Table(_) => {
            let table = table.table("material", faults)?;
            custom(table, faults)
        }
        other => {
            let message = format!("must be a material's name or a table, got {}", describe(other));
            faults.of(&given, message, "give a name in quotes; `cav materials` lists them");
            None
        }
    }
}

fn custom(mut table: Table<'_>, faults: &mut Faults) -> Option<Material> {
    const PAIRS: [[&str; 2]; 3] = [["c1", "c2"], ["young", "poisson"], ["lambda", "mu"]];
    let span = table.span.clone();
    let name = table.string("name", faults);
    let density = table.required("density", faults);
    let yield_strength = table.number("yield_strength", faults);
    let named: Vec<[&str; 2]> =
        PAIRS.into_iter().filter(|pair| pair.iter().any(|key| table.has(key))).collect();
    let numbers = [
        table.number("c1", faults),
        table.number("c2", faults),
        table.number("young", faults),
        table.number("poisson", faults),
        table.number("lambda", faults),
        table.number("mu", faults),
    ];
    let exactly = "give exactly one pair: c1 and c2, or young and poisson, or lambda and mu";
    let path = table.path.clone();
    let mut wrong = false;
    match named.as_slice() {
        [] => {
            faults.at(&path, &span, "neither speeds nor moduli are given", exactly);
            wrong = true;
        }
        [pair] => {
            for key in pair {
                if !table.has(key) {
                    table.missing(key, exactly, faults);
                    wrong = true;
                }
            }
        }
        several => {
            let list = several.iter().map(|pair| pair.join("/")).collect::<Vec<_>>().join(" and ");
            faults.at(&path, &span, format!("{list} are given together"), exactly);
            wrong = true;
        }
    }
    table.finish(faults);
    if wrong {
        return None;
    }
    let density = density?;
    let places: Vec<(String, std::ops::Range<usize>)> = numbers
        .iter()
        .flatten()
        .chain(&yield_strength)
        .map(|given| (given.path.clone(), given.span.clone()))
        .chain([(density.path.clone(), density.span.clone())])
        .collect();
    let density = density.value;
    let [c1, c2, young, poisson, lambda, mu] = numbers;
    let built = match (c1.zip(c2), young.zip(poisson), lambda.zip(mu)) {
        (Some((c1, c2)), None, None) => Material::from_speeds(density, c1.value, c2.value),
        (None, Some((young, poisson)), None) => Material::from_young(density, young.value, poisson.value),
        (None, None, Some((lambda, mu))) => Material::from_lame(density, lambda.value, mu.value),
        _ => return None,
    };
    let built = built.and_then(|material| match &yield_strength {
        Some(given) => material.with_yield_strength(given.value),
        None => Ok(material),
    });
    match built {
        // Speeds that follow from moduli are written out, and read again.
        Ok(material) if material.c1() > LARGEST || material.c2() < SMALLEST || density < SMALLEST => {
            let message = format!(
                "density {density:e} kg/m3, c1 = {:e} m/s and c2 = {:e} m/s are not all from {SMALLEST:e} to {LARGEST:e}",
                material.c1(),
                material.c2()
            );
            faults.at(&path, &span, message, "give speeds or moduli and a density that belong together");
            None
        }
        Ok(material) => {
            let name = name.map_or("custom", |given| given.value);
            let material = material.named(name, "the case file");
            Some(from_library(&material).unwrap_or(material))
        }
        Err(error) => {
            refuse(&path, &places, &error, faults);
            None
        }
    }
}

/// The library's entry, where name and numbers are its.
fn from_library(material: &Material) -> Option<Material> {
    let known = Material::by_name(material.name())?;
    (known.clone().named(known.name(), material.source()) == *material).then_some(known)
}

/// Reports what is wrong with a material's numbers, at the one that is meant.
fn refuse(
    path: &str,
    places: &[(String, std::ops::Range<usize>)],
    error: &MaterialError,
    faults: &mut Faults,
) {
    let (key, help) = match error {
        MaterialError::NotPositive { name, unit, .. } => (*name, format!("give a number > 0 in {unit}")),
        MaterialError::PoissonOutOfRange(_) => ("poisson", "0.25 to 0.35 for most metals".to_owned()),
        MaterialError::NegativeCompression { .. } => {
            ("c1", "c1 is the faster, dilatational wave; a solid resists compression".to_owned())
        }
        MaterialError::NegativeLambda { .. } => ("lambda", "a solid resists compression".to_owned()),
    };
    let path = format!("{path}.{key}");
    // The number that is at fault may be a derived one; then the first that was given stands for all.
    if let Some((path, span)) = places.iter().find(|(at, _)| *at == path).or(places.first()) {
        faults.at(path, span, error.to_string(), help);
    }
}

fn sides(table: &mut Table<'_>, context: Context, faults: &mut Faults) -> [Boundary; 4] {
    let covered = context.scheme.is_some_and(|scheme| scheme.is_coupled() || scheme == Scheme::Load);
    let z_max = if covered { Boundary::Interface } else { Boundary::Free };
    let r_min = match context.geometry {
        Geometry::Axisymmetric => Boundary::Axis,
        Geometry::Planar => Boundary::Symmetry,
    };
    let fixed = |side| match side {
        Side::ZMax if covered => {
            Some(("interface", "z_max of the solid is the interface; only scheme = \"none\" leaves it free"))
        }
        Side::RMin if context.geometry == Geometry::Axisymmetric => {
            Some(("axis", "r_min is the axis in axisymmetric geometry"))
        }
        _ => None,
    };
    let default = [Boundary::Absorbing, z_max, r_min, Boundary::Absorbing];
    let table = table.table("boundary", faults);
    boundaries(table, &Boundary::NAMES, fixed, default, Boundary::Periodic, faults)
}

fn pulse(mut table: Table<'_>, context: Context, faults: &mut Faults) -> Option<PotentialPulse> {
    let centre = table.required_pair("centre", faults);
    let width = table.required_positive("width", faults);
    let amplitude = table.required("amplitude", faults);
    table.finish(faults);
    if let Some(centre) = &centre
        && context.geometry == Geometry::Axisymmetric
        && centre.value[1] != 0.0
    {
        let message =
            format!("a spherical wave must be centred on the axis, got r = {:?} m", centre.value[1]);
        faults.of(centre, message, format!("write [{:?}, 0.0]", centre.value[0]));
    }
    Some(PotentialPulse { centre: centre?.value, width: width?, amplitude: amplitude?.value })
}
