//! What the wall is made of, as it is asked for.

use solid::Material;
use solid::plasticity::MaterialHardening;

use super::super::error::suggest;
use super::grid::Blocks;

/// Short names for materials of the library.
const SHORT: [(&str, &str); 6] = [
    ("steel", "structural-steel"),
    ("stainless", "stainless-316l"),
    ("duplex", "duplex-2205"),
    ("bronze", "nickel-aluminium-bronze"),
    ("acrylic", "pmma"),
    ("carbide", "tungsten-carbide"),
];
/// A wall that does not move.
const RIGID: &str = "rigid";

/// What is on the other side of the liquid.
#[derive(Clone, Debug, PartialEq)]
pub enum Wall {
    /// A wall that does not move.
    Rigid,
    /// A material of the library.
    Solid(Box<Material>),
}

/// Blocks of a solid whose cells have the width of the fluid's second finest, and what there is to say of them.
pub(super) fn twice_as_wide(fluid: &Blocks) -> (Blocks, &'static str) {
    let blocks = fluid.coarser(1);
    // Blocks as wide as the domain have no coarser ones.
    let about =
        if blocks == *fluid { "cells as wide as the fluid's" } else { "cells twice as wide as the fluid's" };
    (blocks, about)
}

impl Wall {
    /// By the name of a material of the library, a short one (`steel`), or `rigid`.
    ///
    /// # Errors
    /// There is none of that name: the message has the nearest ones.
    pub fn named(name: &str) -> Result<Self, String> {
        if name == RIGID {
            return Ok(Self::Rigid);
        }
        let full = SHORT.iter().find(|(short, _)| *short == name).map_or(name, |(_, full)| full);
        Material::by_name(full).map(|material| Self::Solid(Box::new(material))).ok_or_else(|| {
            let library = Material::library();
            let names = library.iter().map(Material::name).chain(SHORT.iter().map(|(short, _)| *short));
            format!("there is no material `{name}`; {}", suggest(name, names.chain([RIGID])))
        })
    }

    /// Its name in the library, or `rigid`.
    pub fn name(&self) -> &str {
        match self {
            Self::Rigid => RIGID,
            Self::Solid(material) => material.name(),
        }
    }

    /// What a case says of the wall below z = 0: that it is rigid, or `[solid]` and how it yields.
    ///
    /// - `finest`: what there is to say of its cells; `deep`, `across`: how far the solid reaches, m; `more`: keys between `[solid]` and its plasticity; `elastic`: whether it has none.
    pub(super) fn keys(
        &self,
        (blocks, finest): (&Blocks, &str),
        [deep, across]: [f64; 2],
        more: &str,
        elastic: bool,
    ) -> String {
        let Self::Solid(material) = self else {
            return "\n[coupling]\nscheme = \"rigid\"                # a wall that does not move\n"
                .to_owned();
        };
        format!(
            "\n[solid]                         # below it\n{grid}material = \"{name}\"\n\
             initial_stress = \"hydrostatic\"  # in balance with the liquid at the start\n{more}{law}",
            grid = blocks.keys(deep, 0.0, across, finest),
            name = material.name(),
            law = if elastic { String::new() } else { plasticity(material) },
        )
    }
}

/// The `[solid.plasticity]` that a material's constants allow, with a comment; empty where it has no yield strength.
pub(super) fn plasticity(material: &Material) -> String {
    if MaterialHardening::of(material.name()).is_some() {
        return "\n[solid.plasticity]\nlaw = \"johnson-cook\"            # hardening, rate and heat: the library's constants\n".to_owned();
    }
    match material.yield_strength() {
        Some(_) => "\n[solid.plasticity]\nlaw = \"perfect\"                 # the library has a yield strength, and no hardening\n".to_owned(),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_have_names_of_the_library_and_short_ones() {
        for material in Material::library() {
            let wall = Wall::named(material.name()).expect("a material of the library");
            assert_eq!(wall.name(), material.name());
        }
        for (short, full) in SHORT {
            assert!(Wall::named(short).is_ok_and(|wall| wall.name() == full), "{short}");
        }
        assert_eq!(Wall::named("rigid"), Ok(Wall::Rigid));
        let refused = Wall::named("stel").expect_err("no such material");
        assert!(refused.contains("`stel`") && refused.contains("steel"), "{refused}");
    }
}
