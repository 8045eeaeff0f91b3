#!/usr/bin/env python3
"""VTK's mappers of volumes, on files: vtkFixedPointVolumeRayCastMapper or, with --gpu, vtkGPUVolumeRayCastMapper.

    pip install vtk && volver image wave --picture-format npy -- \\
      python3 examples/renderers/vtk_mapper.py {volume} {transfer} {camera} {width} {height} {step} {out}

Made for VTK 9.7.2 from PyPI. The CPU's needs no OpenGL, and answers with its own image of 15 bits; the GPU's needs EGL
(Mesa's software will do), and answers with a buffer of binary32 numbers. Opacities are those of a unit of length, and
colors are divided by the largest. Both mappers begin to sample at the camera's near plane or the front of the volume,
as docs/verify.md says of their rays.
"""

import argparse
import ctypes
import json
import os
import re

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import numpy
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401 (what draws for the classes below)
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkVolumeProperty,
)
from vtkmodules.vtkRenderingVolume import (
    vtkFixedPointVolumeRayCastMapper,
    vtkGPUVolumeRayCastMapper,
)

FLOAT = 10  # VTK_FLOAT


def transfer_functions(path, unit):
    """VTK's, sampled finely where opacities are no straight lines of the extinction; and the largest emission."""
    with open(path) as file:
        points = json.load(file)["points"]
    s = numpy.array([point["s"] for point in points])
    extinction = numpy.array([point["extinction"] for point in points])
    emission = numpy.array([point["emission"] for point in points])
    peak = float(emission.max()) or 1.0
    opacity, color = vtkPiecewiseFunction(), vtkColorTransferFunction()
    for place in numpy.linspace(s[0], s[-1], 1024):
        opacity.AddPoint(place, -numpy.expm1(-numpy.interp(place, s, extinction) * unit))
        color.AddRGBPoint(place, *[numpy.interp(place, s, emission[:, k]) / peak for k in range(3)])
    return opacity, color, peak


def fixed_point(mapper, renderer, volume, width, height):
    """The mapper's own image, of 15 bits."""
    nowhere = [0, 0, 0]
    mapper.PerImageInitialization(renderer, volume, 0, nowhere, nowhere, [0] * 6)
    mapper.PerVolumeInitialization(renderer, volume)
    mapper.PerSubVolumeInitialization(renderer, volume, 0)
    mapper.RenderSubVolume()
    image = mapper.GetRayCastImage()
    across, down = image.GetImageMemorySize()
    used = image.GetImageInUseSize()
    left, bottom = image.GetImageOrigin()
    address = int(re.match("_([0-9a-f]+)_p_", image.GetImage())[1], 16)
    pixels = ctypes.cast(address, ctypes.POINTER(ctypes.c_ushort))
    values = numpy.ctypeslib.as_array(pixels, (down, across, 4))[: used[1], : used[0]] / 32767
    whole = numpy.zeros((height, width, 4))
    whole[bottom : bottom + used[1], left : left + used[0]] = values
    return whole


def opengl(renderer, window, width, height):
    """A buffer of binary32 numbers."""
    import vtkmodules.vtkRenderingOpenGL2 as gl

    passes = gl.vtkRenderPassCollection()
    passes.AddItem(gl.vtkLightsPass())
    passes.AddItem(gl.vtkVolumetricPass())
    sequence = gl.vtkSequencePass()
    sequence.SetPasses(passes)
    camera = gl.vtkCameraPass()
    camera.SetDelegatePass(sequence)
    buffer = gl.vtkFramebufferPass()
    buffer.SetDelegatePass(camera)
    buffer.SetColorFormat(gl.vtkTextureObject.Float32)
    window.Render()
    renderer.SetPass(buffer)
    window.Render()
    image = bytearray(width * height * 4 * 4)
    pixels = buffer.GetColorTexture().Download()
    if not pixels.Download2D(FLOAT, image, [width, height], 4, [0, 0]):
        raise SystemExit("OpenGL does not return its image")
    return numpy.frombuffer(image, numpy.float32).reshape(height, width, 4)


def main():
    parser = argparse.ArgumentParser(description="A picture of a volume by one of VTK's mappers.")
    parser.add_argument("volume")
    parser.add_argument("transfer")
    parser.add_argument("camera")
    parser.add_argument("width", type=int)
    parser.add_argument("height", type=int)
    parser.add_argument("step", type=float)
    parser.add_argument("out")
    parser.add_argument("--gpu", action="store_true")
    parser.add_argument("--unit", type=float, default=0.1, help="distance that opacities are for")
    options = parser.parse_args()
    reader = vtkXMLImageDataReader()
    reader.SetFileName(options.volume)
    reader.Update()
    mapper = vtkGPUVolumeRayCastMapper() if options.gpu else vtkFixedPointVolumeRayCastMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetAutoAdjustSampleDistances(False)
    mapper.SetLockSampleDistanceToInputSpacing(False)
    mapper.SetImageSampleDistance(1.0)
    mapper.SetSampleDistance(options.step)
    opacity, color, peak = transfer_functions(options.transfer, options.unit)
    appearance = vtkVolumeProperty()
    appearance.ShadeOff()
    appearance.SetInterpolationTypeToLinear()
    appearance.SetScalarOpacityUnitDistance(options.unit)
    appearance.SetScalarOpacity(opacity)
    appearance.SetColor(color)
    volume = vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(appearance)
    volume.SetAllocatedRenderTime(1e30, None)
    renderer = vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddVolume(volume)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(options.width, options.height)
    window.AddRenderer(renderer)
    with open(options.camera) as file:
        given = json.load(file)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(given["position"])
    camera.SetFocalPoint(given["target"])
    camera.SetViewUp(given["up"])
    if "orthographic" in given:
        camera.ParallelProjectionOn()
        camera.SetParallelScale(given["orthographic"]["height"] / 2)
    else:
        camera.SetViewAngle(given["perspective"]["angle_degrees"])
    renderer.ResetCameraClippingRange()
    if options.gpu:
        mapper.UseJitteringOff()
        image = opengl(renderer, window, options.width, options.height)
    else:
        mapper.IntermixIntersectingGeometryOff()
        image = fixed_point(mapper, renderer, volume, options.width, options.height)
    # VTK's first row is the lowest.
    numpy.save(options.out, numpy.asarray(image[::-1, :, :3], float) * peak)


main()
