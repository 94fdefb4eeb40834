"""The page: what the template is filled with."""

from __future__ import annotations

import json
import re
from datetime import datetime, timezone
from importlib.resources import files
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from .._numbers import percent, si
from ..result import Result
from .curves import charts, packed, profile
from .damage import damage
from .frames import viewer
from .health import health
from .numbers import key_numbers, resolution
from .so_far import known

SCRIPTS = ("format.js", "axis.js", "picture.js", "viewer.js", "curve.js", "chart.js", "zoom.js", "csv.js", "start.js")
"""In their order: later ones use earlier ones."""


def page(result: Result) -> str:
    """The page as text."""
    assets = files(__package__) / "assets"
    pictures, over_time, over_radius = viewer(result), charts(result), profile(result)
    data = {"name": _name(result), "viewer": pictures, **packed([*over_time, *over_radius])}
    environment = Environment(loader=PackageLoader(__package__, "assets"), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    environment.filters["rich"] = _rich
    return environment.get_template("page.html").render(
        name=_name(result), state=_state(result), answer=_answer(result), warnings=result.summary.get("warnings", []),
        pictures=pictures, numbers=list(key_numbers(result)), resolution=resolution(result), charts=[*over_time, *over_radius],
        damage=list(damage(result)) if "solid" in result.media else [], health=list(health(result)),
        provenance=_provenance(result), times=_times(result), case=(result.directory / "case.toml").read_text(encoding="utf-8"),
        style=(assets / "style.css").read_text(encoding="utf-8"), scripts=[(assets / name).read_text(encoding="utf-8") for name in SCRIPTS],
        # Within a script element no text may look like the end of it.
        data=json.dumps(_plain(data), ensure_ascii=False, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"))


def _rich(text: str) -> Markup:
    """A text with its indices set lower: ε_d."""
    return Markup(re.sub(r"(?<=\w)_([a-z]+)", r"<sub>\1</sub>", str(escape(text))))


def _plain(value: Any) -> Any:
    """Numbers of numpy as Python's own; JSON has no others."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value.item() if hasattr(value, "item") else value


def _name(result: Result) -> str:
    return str(result.histories.attrs.get("case_name", result.directory.name))


def _answer(result: Result) -> list[str]:
    """The answer in words, as the program made it; runs of older programs have none."""
    found = result.summary.get("answer", [])
    return [found] if isinstance(found, str) else [str(sentence) for sentence in found]


def _state(result: Result) -> dict[str, Any]:
    summary, cells = known(result), result.cells_per_radius
    completed, end = bool(summary.get("completed")), result.parameters.get("time", {}).get("end")
    of = f" of {si(end, 's')}" if isinstance(end, (int, float)) and not completed else ""
    told = [f"{si(summary.get('t_end'), 's')}{of} in {summary.get('steps', 0):,} steps"]
    told += [] if cells is None else [f"{cells:.4g} cells per radius"]
    if completed or result.state == "running":
        return {"told": told, "good": completed, "says": "completed" if completed else "still running"}
    return {"told": told, "good": False, "says": f"Not completed: {summary.get('error') or 'it was stopped'}"}


def _provenance(result: Result) -> list[tuple[str, str]]:
    attributes = result.histories.attrs
    # Until the end the summary is that of the start.
    written = ["summary.json", *(f"{medium}.h5" for medium in result.media)]
    finished = datetime.fromtimestamp(max((result.directory / name).stat().st_mtime for name in written), timezone.utc)
    return [
        ("case", _name(result)), ("case hash", str(attributes.get("case_hash", "unknown"))),
        ("program", str(attributes.get("program", "cav"))), ("revision", str(attributes.get("git_revision", "unknown"))),
        ("results written", f"{finished:%Y-%m-%d %H:%M} UTC"), ("run directory", result.directory.resolve().name),
    ]


def _times(result: Result) -> list[tuple[str, str]]:
    """What the run cost."""
    summary = known(result)
    found = [("wall time", f"{summary['wall_seconds']:.3g} s")] if "wall_seconds" in summary else []
    for medium in ("fluid", "solid"):
        spent, updates = summary.get("coupling", {}).get(medium), summary.get("cell_updates", {}).get(medium)
        if spent and updates:
            seconds = spent["seconds_computing"]
            found.append((f"{medium}: computing", f"{seconds:.3g} s for {updates:,} cell updates, {1e9 * seconds / updates:.0f} ns each"))
    waited = summary.get("coupling", {}).get("exchange_wait_share")
    if waited is not None:
        found.append(("exchange between both sides", f"{percent(waited)} of the wall time"))
    return found
