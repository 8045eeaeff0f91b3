"""VTK's vtkFixedPointVolumeRayCastMapper, asked for its own image of 15 bits; the first sample lies half a step inside."""

import ctypes
import re

import numpy
from volver_kernel import serve
from vtk_volume import PIXEL, Scene
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper

ONE = 32767
mapper = vtkFixedPointVolumeRayCastMapper()
mapper.SetNumberOfThreads(1)
mapper.IntermixIntersectingGeometryOff()
scene = Scene(mapper, unit=1.0)
# No time is too much: or the mapper takes longer steps.
scene.volume.SetAllocatedRenderTime(1e30, None)


def pixel():
    mapper.PerImageInitialization(scene.renderer, scene.volume, 0, [0] * 3, [0] * 3, [0] * 6)
    mapper.PerVolumeInitialization(scene.renderer, scene.volume)
    mapper.PerSubVolumeInitialization(scene.renderer, scene.volume, 0)
    mapper.RenderSubVolume()
    image = mapper.GetRayCastImage()
    width, height = image.GetImageMemorySize()
    left, bottom = image.GetImageOrigin()
    # Python is told the address alone: "_000055fca790c8c0_p_void".
    address = int(re.match("_([0-9a-f]+)_p_", image.GetImage())[1], 16)
    pixels = ctypes.cast(address, ctypes.POINTER(ctypes.c_ushort))
    return numpy.ctypeslib.as_array(pixels, (height, width, 4))[PIXEL - bottom, PIXEL - left] / ONE


def render(task):
    scene.prepare(task, near=-0.5 * task["step"])
    return scene.radiance(task, pixel)


# The guess: compositing of middles with opacities corrected for the step, in 15 bits of the brightest colour.
declaration = {"name": "VTK fixed point", "form": "volume", "format": "fixed:15", "quantum": 1 / ONE, "step": "divides"}
declaration |= {"order": 2, "sampling": "middle", "emission": "positive", "channels": 1}
serve(declaration | {"answers": ["radiance", "opacity"]}, render)
