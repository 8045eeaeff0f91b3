"""VTK's vtkGPUVolumeRayCastMapper, in Mesa's software, rendered into a buffer of binary32 numbers."""

import numpy
import vtkmodules.vtkRenderingOpenGL2 as opengl
from volver_kernel import serve
from vtk_volume import PIXEL, SIZE, Scene
from vtkmodules.vtkRenderingVolume import vtkGPUVolumeRayCastMapper

FLOAT = 10  # VTK_FLOAT
mapper = vtkGPUVolumeRayCastMapper()
mapper.UseJitteringOff()
scene = Scene(mapper, unit=1.0)
scene.window.SetMultiSamples(0)
passes, sequence = opengl.vtkRenderPassCollection(), opengl.vtkSequencePass()
camera, buffer = opengl.vtkCameraPass(), opengl.vtkFramebufferPass()
passes.AddItem(opengl.vtkLightsPass())
passes.AddItem(opengl.vtkVolumetricPass())
sequence.SetPasses(passes)
camera.SetDelegatePass(sequence)
buffer.SetDelegatePass(camera)
buffer.SetColorFormat(opengl.vtkTextureObject.Float32)


def pixel():
    if not scene.renderer.GetPass():
        # A mapper that has never rendered into the window itself renders nothing into a buffer.
        scene.window.Render()
        scene.renderer.SetPass(buffer)
    scene.window.Render()
    image = bytearray(SIZE * SIZE * 4 * 4)
    if not buffer.GetColorTexture().Download().Download2D(FLOAT, image, [SIZE, SIZE], 4, [0, 0]):
        raise RuntimeError("OpenGL does not return its image")
    return numpy.frombuffer(image, numpy.float32).reshape(SIZE, SIZE, 4)[PIXEL, PIXEL]


def render(task):
    if len(task["data"]["field"]) > 2048:
        raise ValueError("longer than a texture of OpenGL")
    scene.prepare(task, near=-task["length"])
    return scene.radiance(task, pixel)


# The guess: compositing of front samples with opacities corrected for the step.
declaration = {"name": "VTK GPU", "form": "volume", "format": "f32", "step": "divides", "emission": "positive"}
serve(declaration | {"order": 1, "sampling": "front", "answers": ["radiance", "opacity"]}, render)
