#!/usr/bin/env python3
"""VTK's vtkGPUVolumeRayCastMapper, a ray caster in OpenGL's shading language.

    pip install vtk && volver verify -- python3 examples/kernels/vtk_gpu.py

Made for VTK 9.7.2 from PyPI. It needs OpenGL by EGL, but no screen and no graphics card: Mesa's software does,
`apt-get install libegl1 libgl1-mesa-dri` on Debian. The image is rendered into a buffer of binary32 numbers; on a
screen it would be rounded to multiples of 1/255.

What VTK does, as of its source and as measured:

- Samples lie at the far ends of the steps: without jitter the first one lies a whole step behind the front. So it
  has order 1. The last one lies on the back of the volume, and rounding decides whether it counts.
- Opacity is corrected for the step, alpha = 1 - (1 - alpha0)^(d/unit), only where alpha0 is above 1e-4. In a
  fainter medium every sample has alpha0, however short the step: the radiance grows like 1/d.
- A ray ends when less than 1/255 of the light behind it would come through.
- The transfer functions are textures of 1024 entries, or more where theirs are closer together, and are read up
  to half an entry aside: an error in proportion to the width of an entry that no step makes smaller, 4e-4 of the
  radiance in a smooth medium with 1024.
- The field is a texture of at most as many points a side as the driver has it, 2048 in Mesa's software. Longer
  rays are sampled anew with `--points`.

`--unit` is the unit distance of opacities. Where tau times unit is above about 10, alpha0 is 1 but for a few bits
of binary32, and the medium opaque.
"""

import argparse

import numpy
import vtkmodules.vtkRenderingOpenGL2 as opengl
from volver_kernel import serve
from vtk_volume import PIXEL, SIZE, Scene
from vtkmodules.vtkRenderingVolume import vtkGPUVolumeRayCastMapper

FLOAT = 10  # VTK_FLOAT


def binary32():
    """What renders volumes into a buffer of binary32 numbers."""
    passes = opengl.vtkRenderPassCollection()
    passes.AddItem(opengl.vtkLightsPass())
    passes.AddItem(opengl.vtkVolumetricPass())
    sequence = opengl.vtkSequencePass()
    sequence.SetPasses(passes)
    camera = opengl.vtkCameraPass()
    camera.SetDelegatePass(sequence)
    buffer = opengl.vtkFramebufferPass()
    buffer.SetDelegatePass(camera)
    buffer.SetColorFormat(opengl.vtkTextureObject.Float32)
    return buffer


def pixel(scene, buffer):
    """The red, green, blue and opacity of the ray."""
    if not scene.renderer.GetPass():
        # A mapper that has rendered into the window itself never before renders nothing into a buffer.
        scene.window.Render()
        scene.renderer.SetPass(buffer)
    scene.window.Render()
    pixels = buffer.GetColorTexture().Download()
    image = bytearray(SIZE * SIZE * 4 * 4)
    if not pixels.Download2D(FLOAT, image, [SIZE, SIZE], 4, [0, 0]):
        raise RuntimeError("OpenGL does not return its image")
    return numpy.frombuffer(image, numpy.float32).reshape(SIZE, SIZE, 4)[PIXEL, PIXEL]


def sampled(task, points):
    """The task with no more than that many field values."""
    field = task["data"]["field"]
    if len(field) <= points:
        return task
    places = numpy.linspace(0, len(field) - 1, points)
    fewer = numpy.interp(places, numpy.arange(len(field)), field)
    return task | {"data": task["data"] | {"field": fewer}}


def main():
    parser = argparse.ArgumentParser(description="Answers volver with VTK's ray caster in OpenGL.")
    parser.add_argument("--unit", type=float, default=1.0, help="distance that opacities are for")
    parser.add_argument("--points", type=int, default=2048, help="of the field, at most")
    options = parser.parse_args()
    mapper = vtkGPUVolumeRayCastMapper()
    mapper.UseJitteringOff()
    scene = Scene(mapper, options.unit)
    scene.window.SetMultiSamples(0)
    buffer = binary32()

    def render(task):
        task = sampled(task, options.points)
        scene.prepare(task, near=-task["length"])
        return scene.radiance(task, lambda: pixel(scene, buffer))

    declaration = {
        "name": "VTK OpenGL ray caster",
        "form": "volume",
        "order": 1,
        "format": "f32",
        "sampling": "back",
        # The last sample counts for a whole step, wherever the ray ends.
        "step": "divides",
    }
    serve(declaration, render)


if __name__ == "__main__":
    main()
