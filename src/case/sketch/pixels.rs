//! The picture in pixels.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

use font8x8::UnicodeFonts;

use super::super::format::si;
use super::scene::{Content, Scene};

/// Pixels of the longer side of the domain.
const LONGER: f64 = 800.0;
/// Pixels around it.
const MARGIN: Margin = Margin { left: 140, right: 40, above: 60, below: 80 };
/// Pixels of a dot of the letters, 8 by 8 dots each.
const DOT: usize = 2;
/// Half of a probe's cross.
const CROSS: i64 = 7;

struct Margin {
    left: usize,
    right: usize,
    above: usize,
    below: usize,
}

type Colour = [u8; 3];
const PAPER: Colour = [255, 255, 255];
const INK: Colour = [30, 30, 30];
const WALL: Colour = [160, 40, 0];
const LEGEND: [(Content, &str); 3] =
    [(Content::Liquid, "liquid"), (Content::Gas, "gas"), (Content::Solid, "solid")];

const fn colour(content: Content) -> Colour {
    match content {
        Content::Outside => PAPER,
        Content::Liquid => [198, 222, 241],
        Content::Gas => [255, 247, 214],
        Content::Solid => [176, 176, 180],
    }
}

/// Rows of pixels.
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Picture {
    fn of(width: usize, height: usize) -> Self {
        Self { width, height, pixels: PAPER.repeat(width * height) }
    }

    /// Points outside the picture are left out.
    fn put(&mut self, x: i64, y: i64, colour: Colour) {
        let within = |at: i64, most: usize| usize::try_from(at).ok().filter(|at| *at < most);
        if let Some((x, y)) = within(x, self.width).zip(within(y, self.height)) {
            let at = 3 * (y * self.width + x);
            self.pixels[at..at + 3].copy_from_slice(&colour);
        }
    }

    fn bar(&mut self, [x, y]: [i64; 2], [wide, tall]: [i64; 2], colour: Colour) {
        for j in 0..tall {
            for i in 0..wide {
                self.put(x + i, y + j, colour);
            }
        }
    }

    fn write(&mut self, text: &str, [x, y]: [i64; 2]) {
        let dot = DOT as i64;
        for (number, letter) in text.chars().enumerate() {
            let of = |font: Option<[u8; 8]>| font;
            let glyph = of(font8x8::BASIC_FONTS.get(letter))
                .or_else(|| font8x8::LATIN_FONTS.get(letter))
                .unwrap_or_default();
            for (j, bits) in glyph.iter().enumerate() {
                for i in (0..8).filter(|i| bits >> i & 1 == 1) {
                    let at = [x + dot * (8 * number as i64 + i), y + dot * j as i64];
                    self.bar(at, [dot; 2], INK);
                }
            }
        }
    }
}

fn text_width(text: &str) -> i64 {
    (8 * DOT * text.chars().count()) as i64
}

/// Where points of the scene are in the picture.
struct Place<'a> {
    scene: &'a Scene<'a>,
    /// Pixels a metre.
    scale: f64,
}

impl Place<'_> {
    fn x(&self, r: f64) -> i64 {
        MARGIN.left as i64 + ((r - self.scene.r[0]) * self.scale).round() as i64
    }

    fn y(&self, z: f64) -> i64 {
        MARGIN.above as i64 + ((self.scene.z[1] - z) * self.scale).round() as i64
    }
}

/// Draws a scene into a file.
pub(super) fn write(scene: &Scene<'_>, path: &Path) -> io::Result<()> {
    let picture = draw(scene);
    let [width, height] =
        [picture.width, picture.height].map(|pixels| u32::try_from(pixels).unwrap_or(u32::MAX));
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.pixels)?;
    Ok(writer.finish()?)
}

fn draw(scene: &Scene<'_>) -> Picture {
    let [tall, wide] = [scene.z, scene.r].map(|[low, high]| high - low);
    let scale = LONGER / tall.max(wide);
    let [tall, wide] = [tall, wide].map(|length| (length * scale).round().max(1.0) as usize);
    let mut picture = Picture::of(MARGIN.left + wide + MARGIN.right, MARGIN.above + tall + MARGIN.below);
    let place = Place { scene, scale };
    for j in 0..tall {
        for i in 0..wide {
            let point = [scene.z[1] - (j as f64 + 0.5) / scale, scene.r[0] + (i as f64 + 0.5) / scale];
            picture.put((MARGIN.left + i) as i64, (MARGIN.above + j) as i64, colour(scene.content(point)));
        }
    }
    grids(&mut picture, &place);
    marks(&mut picture, &place);
    words(&mut picture, &place);
    picture
}

/// Edges of the blocks, darker than what is below them.
fn grids(picture: &mut Picture, place: &Place<'_>) {
    for [low, high] in place.scene.blocks() {
        let ([left, right], [top, bottom]) =
            ([place.x(low[1]), place.x(high[1])], [place.y(high[0]), place.y(low[0])]);
        let faint = |content: Content| colour(content).map(|part| part - part / 6);
        let content = place.scene.content([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])]);
        picture.bar([left, top], [right - left, 1], faint(content));
        picture.bar([left, bottom], [right - left, 1], faint(content));
        picture.bar([left, top], [1, bottom - top], faint(content));
        picture.bar([right, top], [1, bottom - top], faint(content));
    }
}

/// The wall, the discs on it, the probes.
fn marks(picture: &mut Picture, place: &Place<'_>) {
    let scene = place.scene;
    if let Some(wall) = scene.wall() {
        let [left, right] = scene.r.map(|r| place.x(r));
        picture.bar([left, place.y(wall) - 1], [right - left, 2], INK);
        for disc in scene.discs() {
            let [from, to] = disc.map(|r| place.x(r));
            picture.bar([from, place.y(wall) - 3], [to - from, 6], WALL);
        }
    }
    for [z, r] in scene.probes() {
        let (x, y) = (place.x(r), place.y(z));
        picture.bar([x - CROSS, y - 1], [2 * CROSS, 2], WALL);
        picture.bar([x - 1, y - CROSS], [2, 2 * CROSS], WALL);
    }
}

/// Title, ranges, legend.
fn words(picture: &mut Picture, place: &Place<'_>) {
    let scene = place.scene;
    picture.write(&scene.title(), [MARGIN.left as i64, 20]);
    for z in scene.z.into_iter().chain(scene.wall()) {
        let text = si(z, "m");
        picture.write(&text, [MARGIN.left as i64 - 12 - text_width(&text), place.y(z) - 8]);
    }
    let bottom = place.y(scene.z[0]) + 12;
    let [low, high] = scene.r.map(|r| si(r, "m"));
    picture.write(&low, [place.x(scene.r[0]), bottom]);
    picture.write(&high, [place.x(scene.r[1]) - text_width(&high), bottom]);
    let mut x = MARGIN.left as i64;
    for (content, name) in LEGEND {
        picture.bar([x, bottom + 32], [20, 20], INK);
        picture.bar([x + 1, bottom + 33], [18, 18], colour(content));
        picture.write(name, [x + 28, bottom + 34]);
        x += 28 + text_width(name) + 32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_shows_the_bubble_where_it_is() {
        let case = super::super::collapse();
        let scene = Scene::of(&case).expect("media");
        let picture = draw(&scene);
        let tall = scene.z[1] - scene.z[0];
        let place = Place { scene: &scene, scale: LONGER / tall.max(scene.r[1] - scene.r[0]) };
        let at = |z: f64, r: f64| {
            let at = 3 * (place.y(z) as usize * picture.width + place.x(r) as usize);
            [picture.pixels[at], picture.pixels[at + 1], picture.pixels[at + 2]]
        };
        assert_eq!(at(1.5e-3, -0.5e-3), colour(Content::Gas));
        assert_eq!(at(1.5e-3, -1.1e-3), colour(Content::Liquid));
        assert_eq!(at(-1e-3, -1.13e-3), colour(Content::Solid));
        assert_eq!(at(0.0, 0.2e-3), WALL, "the disc");
        assert_eq!(at(0.0, -3e-3), INK, "the wall");
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("case.png");
        write(&scene, &path).expect("a file");
        let decoder = png::Decoder::new(std::io::BufReader::new(File::open(&path).expect("a file")));
        let reader = decoder.read_info().expect("a PNG");
        assert_eq!(
            [reader.info().width as usize, reader.info().height as usize],
            [picture.width, picture.height]
        );
    }
}
