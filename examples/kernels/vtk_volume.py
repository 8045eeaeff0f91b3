"""A task of the form `volume` as VTK sees it, for vtk_fixed_point.py and vtk_gpu.py.

The ray is the z axis from 0 to D. The field stands on a grid of 3 by 3 by m + 1 points, the same for all x and y,
and the camera looks along z without perspective. VTK's transfer functions take opacity per unit distance,
alpha0 = 1 - exp(-tau unit), and color from 0 to 1: emission is divided by its maximum, and radiance multiplied
by it. Between the entries of the tables VTK takes alpha0 to be linear, where volver takes tau to be.
"""

import os

# No screen: or VTK looks for one first, and warns.
os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import numpy
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401 (what draws for the classes below)
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkVolumeProperty,
)

# Pixels of the square image; the ray is that right above the middle.
SIZE = 4
PIXEL = SIZE // 2


class Scene:
    """A window with one volume in it, in front of `mapper`."""

    def __init__(self, mapper, unit):
        self.mapper, self.unit = mapper, unit
        mapper.SetAutoAdjustSampleDistances(False)
        mapper.SetLockSampleDistanceToInputSpacing(False)
        mapper.SetImageSampleDistance(1.0)
        self.property = vtkVolumeProperty()
        self.property.ShadeOff()
        self.property.SetInterpolationTypeToLinear()
        self.property.SetScalarOpacityUnitDistance(unit)
        self.volume = vtkVolume()
        self.volume.SetMapper(mapper)
        self.volume.SetProperty(self.property)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.renderer.SetBackground(0, 0, 0)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetSize(SIZE, SIZE)
        self.window.AddRenderer(self.renderer)

    def prepare(self, task, near):
        """Sets the ray up, seen from a plane at z = `near`."""
        length, data = task["length"], task["data"]
        field = numpy.asarray(data["field"], float)
        image = vtkImageData()
        image.SetDimensions(3, 3, len(field))
        image.SetOrigin(-length, -length, 0)
        image.SetSpacing(length, length, length / (len(field) - 1))
        image.GetPointData().SetScalars(numpy_to_vtk(numpy.repeat(field, 9), deep=True))
        self.mapper.SetInputData(image)
        self.mapper.SetSampleDistance(task["step"])
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetParallelScale(length / 2)
        camera.SetFocalPoint(0, 0, length)
        camera.SetPosition(0, 0, near - length)
        camera.SetViewUp(0, 1, 0)
        camera.SetClippingRange(length, 4 * length)

    def radiance(self, task, pixel):
        """The radiance of every channel; `pixel` returns the numbers from 0 to 1 of one ray."""
        table = task["data"]["table"]
        extinction = numpy.asarray(table["extinction"], float)
        emission = numpy.asarray(table["emission"], float)
        if not (numpy.isfinite(extinction).all() and numpy.isfinite(emission).all()):
            return {"error": "infinite extinction or emission (allowed: finite)"}
        if emission.min() < 0 or extinction.min() < 0:
            return {"error": "negative extinction or emission (allowed: 0 or above, as opacities and colors are)"}
        peak = float(emission.max()) or 1.0
        places = numpy.linspace(table["first"], table["last"], len(extinction))
        opacity = vtkPiecewiseFunction()
        for s, alpha0 in zip(places, -numpy.expm1(-extinction * self.unit)):
            opacity.AddPoint(s, alpha0)
        self.property.SetScalarOpacity(opacity)
        radiance = []
        # Three channels at a time, as colors.
        for start in range(0, len(emission), 3):
            some = emission[start : start + 3] / peak
            black = numpy.zeros((3 - len(some), len(places)))
            colors = vtkColorTransferFunction()
            for s, *color in zip(places, *some, *black):
                colors.AddRGBPoint(s, *color)
            self.property.SetColor(colors)
            *color, alpha = pixel()
            radiance += [float(c) * peak for c in color[: len(some)]]
        return {"radiance": radiance, "opacity": float(alpha)}
