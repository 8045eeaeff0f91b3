#!/usr/bin/env python3
"""VTK's vtkFixedPointVolumeRayCastMapper, which casts rays on the CPU in 15-bit arithmetic.

    pip install vtk && volver verify -- python3 examples/kernels/vtk_fixed_point.py

Made for VTK 9.7.2 from PyPI. No screen and no OpenGL are needed: the mapper is asked for its own image of 15 bits,
as VTK's multi-pass renderers ask it, and nothing is shown.

What VTK does, as of its source and as measured:

- Samples lie at whole steps from the camera's near plane, not from the volume. Users leave that plane to VTK, so
  that the first sample lies anywhere in the first step. Here it lies `--phase` steps behind the front of the
  volume: 0.5 is the middle, the best that can be had (order 2); anything else has order 1.
- Rays are shortened by 1/100 of a voxel and 1/1000 of their length at both ends, and samples there are left out:
  with the phase 0.5 the first and the last one from about 500 steps on.
- Opacity is corrected for the step, alpha = 1 - (1 - alpha0)^(d/unit), only where alpha0 is above 1e-4. In a
  fainter medium every sample has alpha0, however short the step: the radiance grows like 1/d.
- Products are rounded up to 15 bits, so that errors grow like 1/d in other media too.
- A ray ends when less than 255/32767 of the light behind it would come through, about 1/128.
- The transfer functions are looked up in tables of 32768 entries, without interpolation.

`--unit` is the unit distance of opacities. Where tau times unit is above about 10, alpha0 is 1 but for a few bits
of binary32, and the medium opaque.
"""

import argparse
import ctypes
import re

import numpy
from volver_kernel import serve
from vtk_volume import PIXEL, Scene
from vtkmodules.vtkRenderingVolume import vtkFixedPointVolumeRayCastMapper

ONE = 32767


def pixel(scene):
    """The red, green, blue and opacity of the ray, of the mapper's own image."""
    mapper = scene.mapper
    nowhere = [0, 0, 0]
    mapper.PerImageInitialization(scene.renderer, scene.volume, 0, nowhere, nowhere, [0] * 6)
    mapper.PerVolumeInitialization(scene.renderer, scene.volume)
    mapper.PerSubVolumeInitialization(scene.renderer, scene.volume, 0)
    mapper.RenderSubVolume()
    image = mapper.GetRayCastImage()
    width, height = image.GetImageMemorySize()
    left, bottom = image.GetImageOrigin()
    # Python is told the address alone: "_000055fca790c8c0_p_void".
    address = int(re.match("_([0-9a-f]+)_p_", image.GetImage())[1], 16)
    pixels = ctypes.cast(address, ctypes.POINTER(ctypes.c_ushort))
    values = numpy.ctypeslib.as_array(pixels, (height, width, 4))
    return values[PIXEL - bottom, PIXEL - left] / ONE


def main():
    parser = argparse.ArgumentParser(description="Answers volver with VTK's fixed-point ray caster.")
    parser.add_argument("--phase", type=float, default=0.5, help="of the first sample, in steps")
    parser.add_argument("--unit", type=float, default=1.0, help="distance that opacities are for")
    options = parser.parse_args()
    mapper = vtkFixedPointVolumeRayCastMapper()
    mapper.SetNumberOfThreads(1)
    mapper.IntermixIntersectingGeometryOff()
    scene = Scene(mapper, options.unit)
    # No time is too much: the mapper would take longer steps.
    scene.volume.SetAllocatedRenderTime(1e30, None)

    def render(task):
        scene.prepare(task, near=(options.phase - 1) * task["step"])
        return scene.radiance(task, lambda: pixel(scene))

    middle = options.phase == 0.5
    declaration = {
        "name": "VTK fixed-point ray caster",
        "form": "volume",
        "order": 2 if middle else 1,
        "format": "fixed:15",
        # The last sample counts for a whole step, wherever the ray ends.
        "step": "divides",
        # Of emission up to 1; in proportion to its maximum.
        "quantum": 1 / ONE,
    }
    serve(declaration | ({"sampling": "middle"} if middle else {}), render)


if __name__ == "__main__":
    main()
