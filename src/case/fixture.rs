//! A small case that tests of this module change.

use super::Case;

/// [`small`] with two levels, at 500 bar.
pub fn of_two_levels(sets: &[&str]) -> Case {
    small(2, 5e7, sets)
}

/// [`small`] with four, at 10 bar.
pub fn of_four_levels(sets: &[&str]) -> Case {
    small(4, 1e6, sets)
}

/// A bubble of 2 mm in liquid of a pressure beside a rigid wall, its coarsest cells halved so often.
fn small(levels: usize, pressure: f64, sets: &[&str]) -> Case {
    let text = format!(
        "[time]\nend = 1e-6\n[coupling]\nscheme = \"rigid\"\n[fluid]\nz = [0, 0.01]\nr = [0, 0.01]\ncells = [16, 16]\n\
         levels = {levels}\n[fluid.liquid]\ngamma = 7.15\npi = 3e8\n[fluid.ambient]\ndensity = 1000\npressure = {pressure:e}\n\
         [[fluid.region]]\nshape = \"sphere\"\ncentre = [0.004, 0]\nradius = 0.002\nphase = \"gas\"\ndensity = 1.2\n\
         pressure = 1e5\n"
    );
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::from_toml(&text, "small", &sets).unwrap_or_else(|errors| panic!("{errors}"))
}
