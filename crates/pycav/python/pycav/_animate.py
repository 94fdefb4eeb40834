"""Animations of runs."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from . import plot
from .plot.section import Run
from .plot.waves import gradient
from .result import Result, open_run

Image8 = NDArray[np.uint8]


def animate(
    run: Run,
    path: str | os.PathLike[str],
    draw: Callable[..., Figure] | None = None,
    *,
    fps: float = 12.0,
    dpi: int = 110,
    **options: Any,
) -> Path:
    """An animation with a picture for every snapshot, as `.gif`, or as `.mp4` with imageio-ffmpeg from PyPI.

    - `draw`: a function of a run and a `time` that returns a figure; `pycav.plot.schlieren`, with the same scales in all
      pictures, if left out.
    - `options`: handed on to it, as `window`.
    """
    result, target = open_run(run), Path(path)
    if target.suffix not in (".gif", ".mp4"):
        raise ValueError(f"an animation is a .gif or a .mp4, not {target.name}")
    if draw is None:
        draw = plot.schlieren
        options.setdefault("strongest", _strongest(result))
    times = result.snapshots(result.media[0]).times
    # With one that all have, so that the picture does not jump.
    frames = (_pixels(draw(result, time=float(time), **options), dpi) for time in times)
    (_gif if target.suffix == ".gif" else _mp4)(target, frames, fps)
    return target


def _strongest(result: Result) -> dict[str, float]:
    """Ends of the scales of all pictures: what a picture of its own would take, the largest over time."""
    return {medium: max(float(np.percentile(gradient(result, medium, snapshot), 99.8))
                        for snapshot in result.snapshots(medium)) for medium in result.media}


def _pixels(figure: Figure, dpi: int) -> Image8:
    figure.set_dpi(dpi)
    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()
    pixels: Image8 = np.asarray(canvas.buffer_rgba())[..., :3]
    # Codecs want even numbers of pixels.
    return np.ascontiguousarray(pixels[: pixels.shape[0] // 2 * 2, : pixels.shape[1] // 2 * 2])


def _gif(path: Path, frames: Iterator[Image8], fps: float) -> None:
    images = [Image.fromarray(frame).quantize(128) for frame in frames]
    images[0].save(path, save_all=True, append_images=images[1:], duration=round(1000 / fps), loop=0, optimize=False)


def _mp4(path: Path, frames: Iterator[Image8], fps: float) -> None:
    try:
        import imageio_ffmpeg
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("an .mp4 needs imageio-ffmpeg: pip install 'pycav[animation]', or write a .gif") from error

    first = next(frames)
    size = (first.shape[1], first.shape[0])
    writer = imageio_ffmpeg.write_frames(str(path), size, fps=fps, quality=7, macro_block_size=2)
    writer.send(None)
    writer.send(first.tobytes())
    for frame in frames:
        writer.send(np.ascontiguousarray(frame).tobytes())
    writer.close()
