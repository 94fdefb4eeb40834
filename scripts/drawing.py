"""How the paper's kinds of pictures look: colours, scales, panels, bars, names, and the size of their files."""

import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, LogNorm, to_rgb
from matplotlib.ticker import NullFormatter
from PIL import Image

from run_directory import MICRO, MILLI
from snapshots import Raster

INK, GREY, BUBBLE, BLUE, GREEN, PINK = "#1a1a1a", "0.5", "#d55e00", "#0072b2", "#009e73", "#cc79a7"
DPI = 140
MOST_BYTES = 160 << 10  # of a picture in all colours
MOST = 1400  # pixels of a raster along a side


def part_of(name, low, high):
    """A colour map's part, so that lines drawn over it stay visible."""
    colours = plt.get_cmap(name)(np.linspace(low, high, 256))
    return LinearSegmentedColormap.from_list(f"{name} {low}-{high}", colours, 64)


def logarithmic(top, decades):
    """A scale of some decades below a value, which may be 0 before anything has happened."""
    top = max(top, 1e-12)
    return LogNorm(top / 10**decades, top, clip=True)


def mirrored(image, sign=1):
    return np.vstack([sign * image[::-1], image])


def show(axes, raster, image, sign=1, **style):
    """An image of a half section and its mirror image."""
    extent = [raster.low[0] * MILLI, raster.high[0] * MILLI, -raster.high[1] * MILLI, raster.high[1] * MILLI]
    return axes.imshow(mirrored(image, sign), origin="lower", extent=extent, **style)


def contour(axes, raster, image, level, **style):
    if np.nanmin(image) < level < np.nanmax(image):
        r = np.concatenate([-raster.r[::-1], raster.r]) * MILLI
        axes.contour(raster.z * MILLI, r, mirrored(image), [level], **style)


def bubble_outline(run, axes, time, box):
    """The line on which half is gas."""
    step = run.fluid.nearest(time)
    if "gas_fraction" in run.fluid.fields():
        mesh, gas = run.fluid.mesh(step), run.fluid.field("gas_fraction", step)
        raster = Raster(mesh, box, MOST // 2)
        contour(axes, raster, raster.paint(gas, mesh.gradient(gas)), 0.5, colors=BUBBLE, linewidths=0.9)


def canvas(run, window, panels=1, one_sided=False):
    """A figure with panels of equal scale side by side, room for bars below."""
    low, high, _, top = run.box(window)
    bottom = 0.0 if one_sided else -top
    tall = (top - bottom) / (high - low)
    width = 5.2 / panels if panels > 1 else 4.6
    left, gap, foot, head = 0.62, 0.25, 0.98, 0.34
    size = (left + panels * width + (panels - 1) * gap + 0.2, foot + tall * width + head)
    figure = plt.figure(figsize=size)
    all_axes = []
    for panel in range(panels):
        axes = figure.add_axes([(left + panel * (width + gap)) / size[0], foot / size[1],
                                width / size[0], tall * width / size[1]])
        axes.set(xlim=(low * MILLI, high * MILLI), ylim=(bottom * MILLI, top * MILLI), aspect="equal")
        axes.set_xlabel("$z$ / mm")
        axes.yaxis.set_major_formatter(lambda r, _: f"{abs(r):g}")  # both halves are the same
        axes.tick_params(labelleft=panel == 0)
        all_axes.append(axes)
    all_axes[0].set_ylabel("$r$ / mm", labelpad=2)
    return figure, all_axes


def bar(figure, axes, drawn, label, part=(0.0, 1.0), extend="neither", **more):
    """A slim bar below a part of a panel."""
    place = axes.get_position()
    inch = 1 / figure.get_figheight()
    x, width = place.x0 + part[0] * place.width, (part[1] - part[0]) * place.width
    into = figure.add_axes([x + 0.02 * width, 0.42 * inch, 0.96 * width, 0.09 * inch])
    colours = figure.colorbar(drawn, cax=into, orientation="horizontal", extend=extend, extendfrac=0.03, **more)
    low, high = drawn.norm.vmin, drawn.norm.vmax
    if isinstance(drawn.norm, LogNorm):
        colours.ax.xaxis.set_minor_formatter(NullFormatter())
        if high < 100 * low:  # too few powers of ten
            marks = [m * 10.0**k for k in range(int(np.floor(np.log10(low))), int(np.log10(high)) + 1) for m in (1, 3)]
            marks = [m for m in marks if low <= m <= high]
            colours.set_ticks(marks, labels=[f"{m:g}" for m in marks])
    colours.set_label(label, labelpad=1)
    colours.outline.set_linewidth(0.5)
    colours.ax.tick_params(width=0.5, length=2.5)
    return colours


def names(run, axes, time, what, box):
    """The media's names, the interface, the axis, a title."""
    wall = run.wall * MILLI
    axes.axhline(0, color=GREY, linewidth=0.5, dashes=(8, 3, 1.5, 3))
    axes.axvline(wall, color=INK, linewidth=1.1)
    frame = dict(boxstyle="square,pad=0.2", facecolor="white", edgecolor="none", alpha=0.85)
    style = dict(va="top", style="italic", color=INK, bbox=frame, transform=axes.get_xaxis_transform())
    # Between the points of the text and the frame of the panel.
    if box[0] < run.wall:
        axes.text(box[0] * MILLI + 0.015 * (box[1] - box[0]) * MILLI, 0.975, "solid", ha="left", **style)
    if box[1] > run.wall:
        axes.text(box[1] * MILLI - 0.015 * (box[1] - box[0]) * MILLI, 0.975, "fluid", ha="right", **style)
    axes.set_title(f"{what}, $t$ = {time * MICRO:.1f} µs", loc="left", fontsize=9, pad=4)


def style():
    plt.rcParams.update({
        "font.family": "serif", "font.serif": ["STIX Two Text", "STIXGeneral", "DejaVu Serif"],
        "mathtext.fontset": "stix", "font.size": 9, "axes.linewidth": 0.6, "axes.edgecolor": INK,
        "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.major.size": 3, "ytick.major.size": 3,
        "savefig.facecolor": "white",
    })


def palette(figure):
    """256 colours that serve a figure: those of its maps, the same under lines, and those of lines and text."""
    maps = {image.cmap.name: image.cmap for axes in figure.axes for image in axes.images}.values()
    lines = np.array([to_rgb(c) for c in (INK, GREY, BUBBLE, BLUE, GREEN, PINK, "white")])
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
    plt.close(figure)
    print(f"{path}  {path.stat().st_size / 1024:.0f} KiB")
