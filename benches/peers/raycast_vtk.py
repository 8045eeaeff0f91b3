"""VTK's fixed-point ray caster beside volver's renderer: raycast_vtk.py SAMPLES SIDE SIZE STEP POINTS

Reads a cube of SIDE^3 samples in binary32 and renders SIZE^2 pixels, orthographic along z, for every line of standard input;
answers the seconds of processor time that it took, all threads, and the mean red of the picture. POINTS is JSON:
[[s, opacity per unit, red, green, blue], ...]. No ray ends early where opacity stays low, and no space is empty.
"""

import ctypes
import json
import os
import re
import sys

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
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper


def main():
    path, side, size, step, points = sys.argv[1:]
    side, size, step, points = int(side), int(size), float(step), json.loads(points)
    data = vtkImageData()
    data.SetDimensions(side, side, side)
    data.GetPointData().SetScalars(numpy_to_vtk(numpy.fromfile(path, "<f4"), deep=True))
    opacity, colors = vtkPiecewiseFunction(), vtkColorTransferFunction()
    for s, alpha, *color in points:
        opacity.AddPoint(s, alpha)
        colors.AddRGBPoint(s, *color)
    look = vtkVolumeProperty()
    look.ShadeOff()
    look.SetInterpolationTypeToLinear()
    look.SetScalarOpacityUnitDistance(1.0)
    look.SetScalarOpacity(opacity)
    look.SetColor(colors)
    mapper = vtkFixedPointVolumeRayCastMapper()
    mapper.IntermixIntersectingGeometryOff()
    mapper.SetAutoAdjustSampleDistances(False)
    mapper.SetLockSampleDistanceToInputSpacing(False)
    mapper.SetImageSampleDistance(1.0)
    mapper.SetSampleDistance(step)
    mapper.SetInputData(data)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(look)
    # No time is too much: the mapper would take longer steps.
    volume.SetAllocatedRenderTime(1e30, None)
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.AddVolume(volume)
    window.SetOffScreenRendering(True)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    width = float(side - 1)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(width / 2)
    camera.SetFocalPoint(width / 2, width / 2, width / 2)
    camera.SetPosition(width / 2, width / 2, -width)
    camera.SetViewUp(0, -1, 0)
    camera.SetClippingRange(width - step / 2, 4 * width)
    nowhere = [0, 0, 0]
    for _ in sys.stdin:
        before = os.times()
        mapper.PerImageInitialization(renderer, volume, 0, nowhere, nowhere, [0] * 6)
        mapper.PerVolumeInitialization(renderer, volume)
        mapper.PerSubVolumeInitialization(renderer, volume, 0)
        mapper.RenderSubVolume()
        after = os.times()
        image = mapper.GetRayCastImage()
        across, rows = image.GetImageInUseSize()
        memory = image.GetImageMemorySize()
        address = int(re.match("_([0-9a-f]+)_p_", image.GetImage())[1], 16)
        pixels = ctypes.cast(address, ctypes.POINTER(ctypes.c_ushort))
        values = numpy.ctypeslib.as_array(pixels, (memory[1], memory[0], 4))[:rows, :across]
        spent = after.user + after.system - before.user - before.system
        print(spent, values[:, :, 0].sum() / 32767 / size**2, flush=True)


if __name__ == "__main__":
    main()
