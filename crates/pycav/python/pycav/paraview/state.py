# mypy: ignore-errors
"""A run of pycav in ParaView: schlieren above, von Mises stress below, time.

    paraview --script=FILE            or File, Load State...
    pvpython FILE --picture OUT.png [--time SECONDS] [--size WIDTH HEIGHT]

x of the files is z of the run, y is r; stresses in Pa, lengths in m.
"""

import argparse
import json
import os
import sys

from paraview.simple import (
    AnnotateTimeFilter, CellDatatoPointData, Contour, CreateRenderView, GetAnimationScene, GetColorTransferFunction,
    GetScalarBar, GetTimeKeeper, OpenDataFile, Reflect, Render, ResetCamera, SaveScreenshot, SetActiveView, Show,
)

RUN = json.loads("{}")
HERE = os.path.dirname(os.path.abspath(globals().get("__file__", "."))) if "__file__" in globals() else os.getcwd()
TITLES = {"schlieren": "gradient of density / (kg/m4)", "von_mises": "von Mises stress / Pa"}
INK = [0.1, 0.1, 0.1]
SIZE = [1160, 1000]


def opened(name):
    """A file of the run."""
    path = os.path.join(HERE, name)
    try:
        return OpenDataFile(path)
    except RuntimeError as error:
        raise SystemExit(f"{path}: this ParaView does not read it. ParaView 5.12 or newer does; for an older one write the script "
                         "with pycav.paraview_state(run, vtu=True)") from error


def whole(source):
    """Both sides of the axis."""
    if not RUN["mirrored"]:
        return source
    mirrored = Reflect(Input=source)
    mirrored.Plane = "Y Min"
    return mirrored


def coloured(source, view, field, low, high, preset, logarithmic):
    """A section in the colours of one field, with a bar."""
    shown = Show(source, view)
    shown.SetRepresentationType("Surface")
    # Colours as they stand on the bar: no light on them.
    shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
    table = GetColorTransferFunction(field)
    table.ApplyPreset(preset, True)
    if field == "schlieren":
        table.InvertTransferFunction()
    table.RescaleTransferFunction(low, high)
    table.AutomaticRescaleRangeMode = "Never"
    if logarithmic:
        table.MapControlPointsToLogSpace()
        table.UseLogScale = 1
    shown.ColorArrayName = ["CELLS", field]
    shown.LookupTable = table
    shown.SetScalarBarVisibility(view, True)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = TITLES[field], ""
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize = bar.LabelFontSize = 12
    bar.WindowLocation, bar.Position = "Any Location", [0.89, 0.56 if field == "schlieren" else 0.08]
    bar.ScalarBarLength = 0.35


def draw():
    """The picture of the run in a view of its own."""
    view = CreateRenderView()
    SetActiveView(view)
    view.ViewSize = SIZE
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    sources = {medium: opened(name) for medium, name in RUN["files"].items()}
    GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    if "fluid" in sources and "schlieren" in RUN:
        fluid = whole(sources["fluid"])
        coloured(fluid, view, "schlieren", *RUN["schlieren"], "Grayscale", True)
        outline = Contour(Input=CellDatatoPointData(Input=fluid))
        outline.ContourBy, outline.Isosurfaces = ["POINTS", "gas_fraction"], [0.5]
        line = Show(outline, view)
        line.ColorArrayName = ["POINTS", ""]
        line.DiffuseColor = line.AmbientColor = [0.0, 0.447, 0.698]
        line.LineWidth = 2.0
    if "solid" in sources and "von_mises" in RUN:
        coloured(whole(sources["solid"]), view, "von_mises", 0.0, RUN["von_mises"], "Inferno (matplotlib)", False)
    clock = AnnotateTimeFilter(Input=next(iter(sources.values())))
    clock.Scale = RUN["clock"]["scale"]
    digits, unit = f".{RUN['clock']['decimals']}f", RUN["clock"]["unit"]
    if hasattr(clock, "Format") and "%" in str(clock.Format):
        clock.Format = f"t = %{digits} {unit}"
    else:
        clock.Format = f"t = {{time:{digits}}} {unit}"
    label = Show(clock, view)
    label.Color, label.FontSize = INK, 16
    # z upwards, r to the right: seen from below the plane of the section.
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, -1], [0, 0, 0], [1, 0, 0]
    view.CameraParallelProjection = 1
    return view


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--picture")
    parser.add_argument("--time", type=float, default=RUN["time"], help="s")
    parser.add_argument("--size", type=int, nargs=2, default=SIZE)
    options, _ = parser.parse_known_args(sys.argv[1:])
    view = draw()
    # By itself ParaView would take the next snapshot after that time, however near the one before it is.
    snapshots = GetTimeKeeper().TimestepValues
    snapshots = list(snapshots) if hasattr(snapshots, "__len__") else [snapshots]
    time = min(snapshots, key=lambda snapshot: abs(snapshot - options.time), default=options.time)
    GetAnimationScene().AnimationTime = time
    view.ViewTime = time
    GetTimeKeeper().Time = time
    Render(view)
    ResetCamera(view)
    # The section to the left, the bars to the right of it.
    view.CameraParallelScale *= 0.76
    for place in (view.CameraPosition, view.CameraFocalPoint):
        place[1] += 0.13 * view.CameraParallelScale
    Render(view)
    if options.picture:
        SaveScreenshot(options.picture, view, ImageResolution=options.size)


main()
