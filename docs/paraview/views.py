"""Views of a run in ParaView, offscreen: pvbatch views.py RUN_FOLDER OUT_FOLDER [--step N].

Writes paraview_soil.png, the grains by their displacement beside the contacts by their normal force, and of a
saturated run paraview_water.png, the pore pressure above hydrostatic beside the porosity on its moving mesh.
`--step`: counted from 0; default: the last.
"""

import argparse
import pathlib

from paraview import simple

WIDTH, HEIGHT = 600, 640  # of one view [px]
INK = [0.15, 0.15, 0.15]

simple._DisableFirstRenderCameraReset()


def opened(file):
    # The default reader of older ParaViews stops at a bare name: the path is given in full.
    reader = simple.XDMFReader(FileNames=[str(file.resolve())])
    reader.UpdatePipelineInformation()
    return reader


def two_views(name):
    layout = simple.CreateLayout(name)
    layout.SplitHorizontal(0, 0.5)
    return layout, view_beside(layout, 1), view_beside(layout, 2)


def view_beside(layout, at):
    view = simple.CreateView("RenderView")
    view.ViewSize = [WIDTH, HEIGHT]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    layout.AssignView(at, view)
    return view


def coloured(source, view, array, title, representation, preset, span=None, component=None):
    display = simple.Show(source, view)
    display.SetRepresentationType(representation)
    kind = "CELLS" if array in source.CellData.keys() else "POINTS"
    simple.ColorBy(display, (kind, array, component) if component else (kind, array))
    table = simple.GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    if span:
        table.RescaleTransferFunction(*span)
    else:
        display.RescaleTransferFunctionToDataRange(False)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleColor = bar.LabelColor = INK
    bar.TitleFontSize, bar.LabelFontSize = 18, 16
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
    bar.ScalarBarLength, bar.ScalarBarThickness = 0.6, 14
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%-#.3g", "%-#.3g"
    display.SetScalarBarVisibility(view, True)
    return display


def framed(view, bounds, above=0.08, below=0.22):
    """Looks straight at the bounds, with room above for a title and below for the bar."""
    x, y = (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2
    height = (bounds[3] - bounds[2]) / (1 - above - below)
    width = (bounds[1] - bounds[0]) / 0.94 * HEIGHT / WIDTH
    scale = max(height, width)
    y -= (below - above) / 2 * scale
    view.CameraFocalPoint, view.CameraPosition = [x, y, 0], [x, y, 10]
    view.CameraViewUp, view.CameraParallelProjection, view.CameraParallelScale = [0, 1, 0], 1, scale / 2


def titled(view, words):
    text = simple.Show(simple.Text(Text=words), view, "TextSourceRepresentation")
    text.Color, text.FontSize, text.WindowLocation = INK, 16, "Upper Center"


def saved(layout, titles, time, bounds, file):
    """Each view at the time, on the bounds, under its title."""
    for view, words in titles.items():
        view.ViewTime = time
        framed(view, bounds)
        titled(view, words)
    simple.SaveScreenshot(str(file), layout, ImageResolution=[2 * WIDTH, HEIGHT], CompressionLevel="9")


def soil(run, out, step):
    layout, left, right = two_views("soil")
    grains, contacts = opened(run / "grains.xdmf"), opened(run / "contacts.xdmf")
    time = grains.TimestepValues[step]
    grains.UpdatePipeline(time), contacts.UpdatePipeline(time)
    bounds = grains.GetDataInformation().GetBounds()

    display = coloured(grains, left, "displacement", "displacement [m]", "Point Gaussian", "Viridis (matplotlib)",
                       (0, grains.PointData["displacement"].GetRange(-1)[1] / 2))
    display.ShaderPreset, display.Emissive = "Plain circle", 0
    display.ScaleByArray, display.SetScaleArray, display.UseScaleFunction = 1, ["POINTS", "radius"], 0
    display.GaussianRadius = 1.0

    # A line along the normal of each contact, in the colour of its normal force: force chains.
    force = simple.Calculator(Input=contacts, ResultArrayName="normal force", Function="force_X")
    force.UpdatePipeline(time)
    most = force.PointData["normal force"].GetRange()[1]
    lines = simple.Glyph(Input=force, GlyphType="Line", OrientationArray=["POINTS", "normal"],
                         ScaleArray=["POINTS", "No scale array"], GlyphMode="All Points")
    lines.ScaleFactor = 0.018 * (bounds[1] - bounds[0])
    lines.UpdatePipeline(time)
    display = coloured(lines, right, "normal force", "normal force [N/m]", "Surface", "Inferno (matplotlib)",
                       (0, most / 4))
    display.LineWidth = 2
    table = simple.GetColorTransferFunction("normal force")
    table.InvertTransferFunction()
    saved(layout, {left: f"grains after {time:.3g} s", right: "contacts"}, time, bounds, out / "paraview_soil.png")


def water(run, out, step):
    layout, left, right = two_views("water")
    flow = opened(run / "flow.xdmf")
    time = flow.TimestepValues[step]
    flow.UpdatePipeline(time)
    bounds = flow.GetDataInformation().GetBounds()
    # The file's pressure is without the hydrostatic one. Peaks at the tip's edges would leave all else without colour.
    most = max(abs(end) for end in flow.PointData["pressure"].GetRange()) / 2
    coloured(flow, left, "pressure", "pressure above hydrostatic [Pa]", "Surface", "Cool to Warm", (-most, most))
    display = coloured(flow, right, "porosity", "share of water [-]", "Surface With Edges", "Viridis (matplotlib)")
    display.EdgeColor = [0.75, 0.75, 0.75]
    # A source that is shown anew lets the range of the array that it had before grow.
    simple.GetColorTransferFunction("pressure").RescaleTransferFunction(-most, most)
    titles = {left: f"water after {time:.3g} s", right: "its mesh and what the grains leave of it"}
    saved(layout, titles, time, bounds, out / "paraview_water.png")


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("run", type=pathlib.Path)
    words.add_argument("out", type=pathlib.Path)
    words.add_argument("--step", type=int, default=-1)
    asked = words.parse_args()
    soil(asked.run, asked.out, asked.step)
    if (asked.run / "flow.xdmf").exists():
        water(asked.run, asked.out, asked.step)


main()
