"""What the gallery shows: the name of each picture or film, its runs, how it is drawn."""

from collections.abc import Callable
from dataclasses import dataclass

from . import curves, films, sections
from .runs import STAND_OFFS, WALLS


@dataclass(frozen=True)
class Entry:
    draw: Callable
    """Of its run, or of several runs by what they differ in, to a figure; of a film to one figure after the other."""
    runs: dict[object, str]
    """Names of runs."""
    frame_milliseconds: int = 0
    """Of a film."""


def _one(draw, run, frame_milliseconds=0):
    return Entry(draw, {None: run}, frame_milliseconds)


ENTRIES = {
    "film-collapse": _one(films.collapse, "collapse", 90),
    "film-pit": _one(films.pit, "collapse", 110),
    "film-lithotripter": _one(films.lithotripter, "lithotripter", 100),
    "collapse": _one(sections.collapse, "collapse"),
    "grid": _one(sections.grid, "collapse"),
    "jet": _one(sections.jet, "jet"),
    "waves": _one(sections.waves, "pulse"),
    "pit": _one(sections.pit, "collapse"),
    "wall": _one(sections.wall, "collapse"),
    "cut": _one(sections.cut, "cut"),
    "two": _one(sections.two, "two"),
    "free": _one(curves.free, "free"),
    "stand-off": Entry(curves.stand_off, {distance: f"stand-off-{distance}" for distance in STAND_OFFS}),
    "walls": Entry(curves.walls, {wall: f"wall-{wall}" for wall in WALLS}),
    "convergence": _one(curves.convergence, "convergence"),
}
