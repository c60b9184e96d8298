# SPDX-License-Identifier: GPL-2.0-or-later
"""Run by ParaView's pvbatch: opens the .pvd files of a folder as doc/visualise.md says, and writes what ParaView sees
of them into an .npz file, and pictures.

    pvbatch paraview_look.py FOLDER TIME
"""
from pathlib import Path
import sys

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkMassProperties

SIZE = (400, 300)
HALF_HEIGHT = 6.0  # of what the pictures show, around the middle (8, 6) of x and y


def opened(path, time):
    reader = simple.PVDReader(FileName=str(path))
    reader.UpdatePipeline(time=time)
    return reader


def points(source):
    data = servermanager.Fetch(source).GetPoints()
    return vtk_to_numpy(data.GetData()).astype(float) if data else np.empty((0, 3))


def arrays(of):
    return {of.GetArrayName(k): vtk_to_numpy(of.GetArray(k)) for k in range(of.GetNumberOfArrays())}


def glyphs(reader, time):
    """As on the page: the filter Tensor Glyph, a sphere, scale factor 1."""
    made = simple.TensorGlyph(Input=reader, GlyphType="Sphere")
    made.ScaleFactor = 1.0
    made.GlyphType.ThetaResolution = made.GlyphType.PhiResolution = 64
    made.UpdatePipeline(time=time)
    return made


def as_glyphs(shown):
    """As on the page: the representation 3D Glyphs, oriented by quaternions."""
    shown.SetRepresentationType("3D Glyphs")
    shown.GlyphType = "Sphere"
    shown.GlyphType.ThetaResolution = shown.GlyphType.PhiResolution = 64
    shown.Orient, shown.OrientationMode, shown.SelectOrientationVectors = 1, "Quaternion", "quaternion"
    shown.Scaling, shown.ScaleMode, shown.SelectScaleArray, shown.ScaleFactor = 1, "Vector Components", "semi_axes", 2.0


def draw(path, source, time, represent=lambda shown: None):
    """Along z without perspective, plain blue on white."""
    view = simple.CreateView("RenderView")
    view.ViewSize = SIZE
    view.UseColorPaletteForBackground = 0
    view.Background = (1.0, 1.0, 1.0)
    view.OrientationAxesVisibility = 0
    view.ViewTime = time
    shown = simple.Show(source, view)
    represent(shown)
    shown.ColorArrayName = (None, "")
    shown.AmbientColor = shown.DiffuseColor = (0.0, 0.0, 1.0)
    shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
    simple.Render(view)  # the first picture chooses a camera
    view.CameraParallelProjection = 1
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = (8.0, 6.0, 90.0), (8.0, 6.0, 0.0), (0.0, 1.0, 0.0)
    view.CameraParallelScale = HALF_HEIGHT
    simple.SaveScreenshot(str(path), view, ImageResolution=SIZE)
    simple.Delete(view)


def look(folder, time):
    seen = {}
    for path in folder.glob("*.pvd"):
        reader = opened(path, time)
        data = servermanager.Fetch(reader)
        kind = path.stem
        seen[f"{kind} times"] = np.array(reader.TimestepValues)
        seen[f"{kind} points"] = points(reader)
        seen[f"{kind} cells"] = data.GetNumberOfCells()
        for where, of in (("point", data.GetPointData()), ("cell", data.GetCellData())):
            seen |= {f"{kind} {where} {name}": values for name, values in arrays(of).items()}
        if kind == "grains":
            made = glyphs(reader, time)
            seen["glyphs points"] = points(made)
            draw(folder / "glyphs.png", made, time)
            draw(folder / "representation.png", reader, time, as_glyphs)
        if kind == "surfaces":
            properties = vtkMassProperties()
            properties.SetInputData(data)
            properties.Update()
            seen["surfaces volume"] = properties.GetVolume()
            draw(folder / "surfaces.png", reader, time)
        if kind == "contacts":
            tubes = simple.Tube(Input=reader, Scalars=["POINTS", "fn"], VaryRadius="By Scalar")
            tubes.Radius, tubes.RadiusFactor = 0.02, 4.0
            tubes.UpdatePipeline(time=time)
            seen["tubes points"] = points(tubes)
            draw(folder / "contacts.png", tubes, time)
    np.savez(folder / "seen.npz", **seen)


look(Path(sys.argv[1]), float(sys.argv[2]))
