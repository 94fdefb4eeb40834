"""Pictures as files that are small enough for a repository."""

import io

import numpy as np
from matplotlib.colors import to_rgb
from PIL import Image
from pycav.plot.style import BLUE, GREEN, GREY, INK, ORANGE, PINK, WHITE

DPI = 140
MOST_BYTES = 160 << 10  # of a picture in all colours


def palette(figure):
    """256 colours that serve a figure: those of its maps, the same under lines, and those of lines and text."""
    maps = {image.cmap.name: image.cmap for axes in figure.axes for image in axes.images}.values()
    lines = np.array([to_rgb(c) for c in (INK, GREY, ORANGE, BLUE, GREEN, PINK, WHITE)])
    ink, white = lines[0], lines[-1]
    paler = np.linspace(0.15, 0.85, 6)
    found = [lines, *(c + (white - c) * share for c in lines[:-1] for share in paler)]
    for colours in maps:
        full = colours(np.linspace(0, 1, 128 // len(maps)))[:, :3]
        found += [full, *(full[::4] + (ink - full[::4]) * share for share in (0.3, 0.6))]
    flat = (np.vstack([np.atleast_2d(c).reshape(-1, 3) for c in found])[:256] * 255).round().astype(np.uint8)
    image = Image.new("P", (1, 1))
    image.putpalette(flat.tobytes() + flat[-1].tobytes() * (256 - len(flat)))
    return image


def save(figure, path):
    """In all colours if that takes little room, else with a palette."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=DPI)
    image = Image.open(buffer).convert("RGB")
    image.save(path, optimize=True)
    if path.stat().st_size > MOST_BYTES:
        image.quantize(palette=palette(figure), dither=Image.Dither.NONE).save(path, optimize=True)
    print(f"{path}  {path.stat().st_size / 1024:.0f} KiB")
