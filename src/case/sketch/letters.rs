//! The picture in letters.

use std::fmt::Write as _;

use super::super::format::si;
use super::scene::{Content, Scene};

/// The most columns and rows of a picture, and how much taller than wide a letter is.
const COLUMNS: f64 = 60.0;
const ROWS: f64 = 24.0;
const TALLER: f64 = 2.0;
/// Columns for what is said of z.
const MARGIN: usize = 10;

/// Lines of text, z upwards.
pub(super) fn draw(scene: &Scene<'_>) -> String {
    let (height, width) = (scene.z[1] - scene.z[0], scene.r[1] - scene.r[0]);
    // Metres of a row, the same both ways.
    let row = (height / ROWS).max(TALLER * width / COLUMNS);
    let (rows, columns) = ((height / row).round().max(1.0), (TALLER * width / row).round().max(1.0));
    let (row, column) = (height / rows, width / columns);
    let mut lines: Vec<Vec<char>> = Vec::new();
    for i in 0..rows as usize {
        let z = scene.z[1] - (i as f64 + 0.5) * row;
        let letter = |j: usize| letter(scene.content([z, scene.r[0] + (j as f64 + 0.5) * column]));
        lines.push((0..columns as usize).map(letter).collect());
    }
    for [z, r] in scene.probes() {
        let i = (((scene.z[1] - z) / row) as usize).min(lines.len() - 1);
        let j = (((r - scene.r[0]) / column) as usize).min(lines[i].len() - 1);
        lines[i][j] = '+';
    }
    let wall = scene.wall().map(|wall| (((scene.z[1] - wall) / row).round() as usize, wall));
    let edge = "-".repeat(columns as usize);
    let mut text = format!("{:>MARGIN$} +{edge}+\n", si(scene.z[1], "m"));
    for (i, line) in lines.iter().enumerate() {
        if let Some((_, z)) = wall.filter(|(at, _)| *at == i && i > 0) {
            let _ = writeln!(text, "{:>MARGIN$} +{}+ wall", si(z, "m"), "=".repeat(columns as usize));
        }
        let _ = writeln!(text, "{:>MARGIN$} |{}|", "", line.iter().collect::<String>());
    }
    let below = wall.is_some_and(|(at, _)| at == lines.len());
    let last = if below { "=".repeat(columns as usize) } else { edge };
    let _ = writeln!(text, "{:>MARGIN$} +{last}+{}", si(scene.z[0], "m"), if below { " wall" } else { "" });
    let [low, high] = scene.r.map(|r| si(r, "m"));
    let between = (columns as usize + 2).saturating_sub(low.chars().count() + high.chars().count());
    let _ = writeln!(text, "{:MARGIN$} {low}{}{high}   . liquid, o gas, # solid", "", " ".repeat(between));
    text
}

fn letter(content: Content) -> char {
    match content {
        Content::Outside => ' ',
        Content::Liquid => '.',
        Content::Gas => 'o',
        Content::Solid => '#',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bubble_is_round_and_above_the_wall() {
        let case = super::super::collapse();
        let drawn = draw(&Scene::of(&case).expect("media"));
        let lines: Vec<&str> = drawn.lines().collect();
        let wall = lines.iter().position(|line| line.ends_with("wall")).expect("a wall");
        let gas: Vec<(usize, usize)> = lines[..lines.len() - 1]
            .iter()
            .enumerate()
            .map(|(i, line)| (i, line.matches('o').count()))
            .filter(|(_, letters)| *letters > 0)
            .collect();
        let widest = gas.iter().map(|(_, letters)| *letters).max().expect("gas");
        assert!(gas.iter().all(|(i, _)| *i < wall), "{drawn}");
        assert!(widest.abs_diff(2 * gas.len()) <= 2, "as wide as tall:\n{drawn}");
        assert!(
            lines[wall + 1..lines.len() - 2].iter().all(|line| line.contains('#') && !line.contains('.')),
            "{drawn}"
        );
        assert!(lines.len() <= ROWS as usize + 4, "{drawn}");
    }
}
