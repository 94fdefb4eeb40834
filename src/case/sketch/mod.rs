//! A picture of a case at its start, as letters for a terminal or as a PNG: what is where, before anything runs.

mod letters;
mod pixels;
mod scene;

use std::path::Path;

use super::Case;
use scene::Scene;

/// The picture as lines of text.
pub fn letters(case: &Case) -> Option<String> {
    Scene::of(case).map(|scene| letters::draw(&scene))
}

/// The picture as a PNG file.
///
/// # Errors
/// The file cannot be written.
pub fn png(case: &Case, path: &Path) -> std::io::Result<()> {
    let scene = Scene::of(case).ok_or_else(|| std::io::Error::other("the case has no media"))?;
    pixels::write(&scene, path)
}

/// The first case of all, as tests draw it.
#[cfg(test)]
fn collapse() -> Case {
    let text = super::new::Collapse::default().text().expect("a case");
    Case::from_toml(&text, "collapse", &[]).expect("a case")
}
