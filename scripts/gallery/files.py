"""Files of the gallery: pictures and films as WebP."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

WIDTH = 1100
"""Of a picture, pixels."""


def pixels(figure, width):
    """A figure as an image of so many pixels across."""
    figure.set_dpi(width / figure.get_figwidth())
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return Image.fromarray(np.ascontiguousarray(np.asarray(canvas.buffer_rgba())[..., :3]))


def save(figure, path, width=WIDTH):
    pixels(figure, width).save(path, quality=86, method=6)


def save_film(frames, path, width, milliseconds=90, quality=70, hold=1400):
    """An animation that stands still at its end; `frames` are figures of one size.

    Every image is whole: differences leave traces of earlier ones in faint waves.
    """
    images = [pixels(figure, width) for figure in frames]
    durations = [milliseconds] * (len(images) - 1) + [hold]
    images[0].save(path, save_all=True, append_images=images[1:], duration=durations, loop=0, quality=quality, method=6,
                   kmin=0, kmax=1)
