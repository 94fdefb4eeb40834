"""One self-contained page on a run."""

from __future__ import annotations

import base64
import html
import io
import os
from collections.abc import Callable, Iterable
from pathlib import Path

from matplotlib.figure import Figure

from . import plot
from ._convergence import Convergence, study_of
from ._damage import damage
from ._health import Rows, health
from .plot.plastic import FIELD
from .plot.section import Run, default_time
from .plot.style import rounded, si
from .plot.surface import DISPLACEMENT
from .result import Result, open_run

STYLE = """
body { font: 16px/1.5 Georgia, serif; color: #1a1a1a; max-width: 56rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: 0; } h2 { font-size: 1.15rem; margin-top: 2.2rem; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: .6rem 0; } td, th { padding: .15rem 1.2rem .15rem 0; text-align: left; }
td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; } th { font-weight: normal; color: #666; }
figure { margin: 1.4rem 0; } figcaption { color: #666; font-style: italic; }
img { max-width: 100%; max-height: 42rem; display: block; } .quiet { color: #666; } .bad { color: #a33b00; }
pre { background: #f6f6f4; padding: .8rem; overflow-x: auto; font-size: .8rem; }
"""

def report(run: Run, out: str | os.PathLike[str] | None = None) -> Path:
    """Writes an HTML page on a run, with everything in it: what was run, key numbers, pictures, damage, coupling, timings.

    - `out`: the page; else `report.html` in the run directory. Returns its path.
    """
    result = open_run(run)
    path = result.directory / "report.html" if out is None else Path(out)
    path.write_text(page(result), encoding="utf-8")
    return path


def page(result: Result) -> str:
    """The page as text."""
    name = html.escape(str(result.histories.attrs.get("case_name", result.directory.name)))
    parts = [
        f"<h1>{name}</h1>", _state(result),
        "<h2>Key numbers</h2>", _table(_key_numbers(result)), _resolution(result),
        "<h2>Pictures</h2>", *_pictures(result),
        "<h2>Damage</h2>", _table(damage(result)),
        "<h2>Health</h2>", _table(health(result)),
        "<h2>Time spent</h2>", _table(_timings(result)),
        "<h2>The case, all defaults filled in</h2>",
        f"<pre>{html.escape((result.directory / 'case.toml').read_text())}</pre>",
    ]
    return (f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{name}</title>'
            f'<link rel="icon" href="data:,"><style>{STYLE}</style></head><body>{"".join(parts)}</body></html>\n')


def _table(rows: Rows) -> str:
    body = "".join(f'<tr><th>{html.escape(what)}</th><td class="n">{html.escape(value)}</td>'
                   f'<td class="quiet">{html.escape(note)}</td></tr>' for what, value, note in rows)
    return f"<table>{body}</table>" if body else '<p class="quiet">Nothing to tell.</p>'


def _state(result: Result) -> str:
    summary, attributes = result.summary, result.histories.attrs
    if summary.get("completed"):
        state = "Completed"
    else:
        state = f'<span class="bad">Not completed: {html.escape(str(summary.get("error", "it was stopped")))}</span>'
    revision = html.escape(f"{attributes.get('program', 'cav')}, revision {attributes.get('git_revision', 'unknown')}")
    warnings = "".join(f'<p class="bad">{html.escape(warning)}</p>' for warning in summary.get("warnings", []))
    return (f'<p>{state}: {si(summary.get("t_end"), "s")}, {summary.get("steps", 0)} steps. '
            f'<span class="quiet">{revision}.</span></p>{warnings}')


def _key_numbers(result: Result) -> Rows:
    window = result.summary.get("wall_pressure_mean_time")
    over = "" if window is None else f" over {rounded(float(window), 's')}"
    labels = {
        "wall_pressure_peak": "wall pressure on the axis, largest", "wall_pressure_peak_interface": "p* on the axis, largest",
        "wall_pressure_peak_anywhere": "wall pressure, largest anywhere",
        "wall_pressure_mean_peak": f"wall pressure on the axis, largest mean{over}",
        "wall_impulse": "impulse on the wall at the axis, largest", "von_mises_peak": "von Mises stress, largest",
        "yielded_volume_peak": "yielded volume, largest", "min_equivalent_radius": "smallest equivalent radius",
        "jet_velocity_peak": "fastest liquid on the axis",
    }
    table, study = result.key_numbers, study_of(result)
    for name, value, unit, time in zip(table.index, table["value"], table["unit"], table["time"]):
        shown = str(unit).replace("m3", "m³")
        when = "" if time is None or time != time else f"at {si(float(time), 's')}"
        around, says = ("", "") if study is None else _uncertainty(*study, str(name), float(value), shown)
        yield labels[str(name)], si(float(value), shown) + around, "; ".join(filter(None, [when, says]))
    if study is not None:
        yield "grid convergence", f"grid {study[1]} of 0 to {len(study[0].grids) - 1}", "± GCI, from convergence.json"


def _uncertainty(study: Convergence, grid: int, name: str, value: float, unit: str) -> tuple[str, str]:
    """What stands behind a number, and what is said of it: its uncertainty by the study, or why there is none."""
    found = study.record["numbers"].get(name)
    if found is None or found["values"][grid] != value:
        return "", ""
    own = found["uncertainties"][grid]
    how = found["convergence"].replace("-", " ")
    if own is None:
        return "", how
    order = how if found["order"] is None else f"order {found['order']:.2g}"
    return f" ± {rounded(own, unit)}", order


def _resolution(result: Result) -> str:
    cells = result.cells_per_radius
    counts = ", ".join(f"{medium}: {count.get('largest', 0):,} cells at most"
                       for medium, count in result.summary.get("cells", {}).items())
    per_radius = "" if cells is None else f"{cells:.4g} cells per radius; peaks depend on the resolution. "
    return f'<p class="quiet">{per_radius}{counts.capitalize()}.</p>'


def _pictures(result: Result) -> Iterable[str]:
    time = default_time(result)
    near, deep = _windows(result)
    drawings: list[tuple[str, Callable[[], Figure]]] = []
    data = result.histories
    if "interface/pressure" in data or "solid/von_mises_max" in data or result.radius is not None:
        drawings.append(("Histories", lambda: plot.histories(result)))
    drawings.append(("Numerical schlieren", lambda: plot.schlieren(result, time, near)))
    if len(result.media) == 2:
        drawings.append(("Normal velocity and normal stress", lambda: plot.interface_continuity(result, time, near)))
    strength = result.summary.get("yield_strength")
    if strength is not None:
        drawings.append(("Yield function", lambda: plot.yield_function(result, float(strength), time, deep)))
    drawings += _plastic(result, time, deep)
    if "interface/pressure" in result.histories:
        drawings.append(("Pressure on the wall over time", lambda: plot.space_time(result, "wall")))
    for name, draw in drawings:
        yield picture(draw(), name)


def _plastic(result: Result, time: float, window: plot.Window | None) -> list[tuple[str, Callable[[], Figure]]]:
    """What flowed and what stays, of a solid that yields."""
    if "solid" not in result.media or FIELD not in result.solid.fields:
        return []
    found: list[tuple[str, Callable[[], Figure]]] = [
        ("von Mises stress and plastic strain", lambda: plot.plastic_strain(result, time, window))]
    if DISPLACEMENT in result.histories:
        found.append(("The pit that stays", lambda: plot.pit(result)))
    return found


def _windows(result: Result) -> tuple[plot.Window | None, plot.Window | None]:
    """What is near the bubble and the wall, in both media and in the solid; all if there is no bubble."""
    radius = result.radius
    if radius is None:
        return None, None
    reach = {medium: result.snapshots(medium)[0].mesh for medium in result.media}
    low, high = (float(pick(mesh.low[0] if pick is min else mesh.high[0] for mesh in reach.values())) for pick in (min, max))
    far = min(float(mesh.high[1]) for mesh in reach.values())
    wall = float(reach["fluid"].low[0])
    across = min(4.5 * radius, far)
    near = (max(low, wall - 4.5 * radius), min(high, wall + 4.5 * radius), across)
    return near, (max(low, wall - 3.0 * radius), wall, min(3.0 * radius, far))


def picture(figure: Figure, name: str) -> str:
    """A figure as an image within the page."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=150)
    data = base64.b64encode(buffer.getvalue()).decode()
    label = html.escape(name)
    return f'<figure><figcaption>{label}</figcaption><img alt="{label}" src="data:image/png;base64,{data}"></figure>'


def _timings(result: Result) -> Rows:
    summary = result.summary
    yield "wall time", f"{summary.get('wall_seconds', float('nan')):.2f} s", ""
    for medium in ("fluid", "solid"):
        spent = summary.get("coupling", {}).get(medium)
        if spent:
            yield (f"{medium}: computing", f"{spent['seconds_computing']:.2f} s",
                   f"of that adapting {spent['seconds_adapting']:.2f} s; recording {spent['seconds_recording']:.2f} s")
        updates = summary.get("cell_updates", {}).get(medium)
        if updates and spent:
            yield f"{medium}: cell updates", f"{updates:,}", f"{1e9 * spent['seconds_computing'] / updates:.0f} ns each"
