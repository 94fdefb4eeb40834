//! Small cases in which everything happens that a checkpoint has to hold.

use crate::fixture::{THIN_GAS, bubble, grid, probe, sensor, steel, water};

/// Lines of a side that adapts.
fn lines(z: [f64; 2], more: &str) -> String {
    grid(z, 0.05, [4, 4]) + "levels = 4\nadapt_every = 3\n" + more
}

const LIMITER: &str = "limiter = \"minmod\"\n";

/// A bubble over steel, adaptive on three levels, up to 64 × 64 cells a side.
pub fn coupled() -> String {
    let text = [
        "[time]\nend = 4e-5\nsnapshot_every = 1.3e-6\n",
        &water(&lines([0.01, 0.06], LIMITER), 5e7),
        &bubble([0.03, 0.0], 0.01, THIN_GAS),
        &steel(&lines([-0.04, 0.01], LIMITER)),
        &probe("wall", [0.01, 0.0], "fluid"),
        &probe("steel", [0.01, 0.004], "solid"),
        &sensor("disc", 0.004, 1e-6),
    ];
    text.concat()
}

/// A second bubble above the first.
pub fn second_bubble() -> String {
    bubble([0.048, 0.0], 0.006, THIN_GAS)
}

/// The fluid above a rigid wall, from the text of a coupled case.
pub fn fluid_alone() -> String {
    let text = coupled();
    let head = text.split("[solid]").next().unwrap();
    format!("{head}[coupling]\nscheme = \"rigid\"\n")
}

/// A bubble above a rigid wall that grows and whose gas is cut, on a grid that follows it: three levels are there at different times.
pub fn growing() -> String {
    let text = [
        "[time]\nend = 1.3e-4\nsnapshot_every = 1e-5\n",
        &water(&lines([0.0, 0.05], LIMITER), 5e7),
        "[fluid.bubble]\ncentre = [0.025, 0.0]\nradius = 4e-3\nequilibrium_radius = 8e-3\ncells_per_radius = 4\n\
         reset = { equilibrium_radius = 4e-3 }\n",
        "[coupling]\nscheme = \"rigid\"\n",
    ];
    text.concat()
}

/// A spherical wave in an elastic solid, adaptive.
pub fn solid() -> String {
    let text = [
        "[time]\nend = 6e-6\nsnapshot_every = 1.3e-6\n",
        &steel(&lines([0.0, 0.05], "")),
        "[coupling]\nscheme = \"none\"\n",
        "[[solid.pulse]]\ncentre = [0.02, 0.0]\nwidth = 0.004\namplitude = 1e-9\n",
        &probe("steel", [0.03, 0.004], "solid"),
    ];
    text.concat()
}

/// A load on a solid's surface, adaptive.
pub fn loaded() -> String {
    let text = [
        "[time]\nend = 6e-6\nsnapshot_every = 1.3e-6\n",
        &steel(&lines([-0.05, 0.0], "")),
        "[coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = 1e6\nradius = 0.006\n",
        "history = [[0.0, 0.0], [1e-6, 1.0], [2e-6, 0.3]]\n",
        &probe("steel", [0.0, 0.004], "solid"),
    ];
    text.concat()
}
