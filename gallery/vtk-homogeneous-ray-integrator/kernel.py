"""VTK's vtkUnstructuredGridHomogeneousRayIntegrator, given the values at both ends of segments, as its mapper gives them."""

from volver_kernel import serve
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkRenderingCore import vtkVolume, vtkVolumeProperty
from vtkmodules.vtkRenderingVolume import vtkUnstructuredGridHomogeneousRayIntegrator

volume, prop = vtkVolume(), vtkVolumeProperty()
prop.IndependentComponentsOff()
volume.SetProperty(prop)
integrator = vtkUnstructuredGridHomogeneousRayIntegrator()


def values(edges, channels, places):
    """Red, green, blue and extinction per unit of length at these places."""
    array = vtkDoubleArray()
    array.SetNumberOfComponents(4)
    for place in places:
        color = [edges["emission"][channel][place] for channel in channels]
        array.InsertNextTuple4(*color, *[0.0] * (3 - len(color)), edges["extinction"][place])
    return array


def render(task):
    edges, n = task["data"]["edges"], task["segments"]
    lengths = vtkDoubleArray()
    for front, back in zip(edges["lambda"], edges["lambda"][1:]):
        lengths.InsertNextValue(back - front)
    radiance, channels = [], list(range(len(task["channels"])))
    for some in [channels[start : start + 3] for start in range(0, len(channels), 3)]:
        near, far, color = values(edges, some, range(n)), values(edges, some, range(1, n + 1)), [0.0] * 4
        integrator.Initialize(volume, near)
        integrator.Integrate(lengths, near, far, color)
        radiance += color[: len(some)]
    return {"radiance": radiance, "opacity": color[3]}


# The guess: "homogeneous" takes a segment's mean.
serve({"name": "VTK homogeneous", "form": "segments", "format": "f32", "method": "layers/mean"}, render)
