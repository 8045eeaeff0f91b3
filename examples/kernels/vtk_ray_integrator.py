#!/usr/bin/env python3
"""VTK's ray integrators for unstructured grids, vtkUnstructuredGrid{Homogeneous,Linear}RayIntegrator.

    pip install vtk && volver verify -- python3 examples/kernels/vtk_ray_integrator.py --integrator linear

Made for VTK 9.7.2 from PyPI; no screen and no OpenGL are needed. The integrators are called as VTK's mappers
call them, with the lengths of the segments and the values at their near and far ends. Values are dependent
components (red, green, blue, extinction per unit of length), which VTK passes through as they are: with no
transfer function, table or clamp in between. Emission may exceed 1. Colors are accumulated in binary32, opacity
too; the rest is binary64.

Homogeneous takes a segment's near values for all of it. `--samples near` gives it those, as VTK's own mapper
does: order 1. `--samples middle` gives it the values in the middle instead: order 2. Both are front-to-back
compositing with alpha = 1 - exp(-tau d). Linear takes C and tau to be linear in between (Moreland and Angel,
"A fast high accuracy volume renderer for unstructured data", 2004), with erf and Dawson's integral fitted in
binary32: order 2 down to their noise.
"""

import argparse

import vtkmodules.vtkCommonCore as core
import vtkmodules.vtkRenderingCore as rendering
import vtkmodules.vtkRenderingVolume as volume
from volver_kernel import serve

INTEGRATORS = {
    "homogeneous": volume.vtkUnstructuredGridHomogeneousRayIntegrator,
    "linear": volume.vtkUnstructuredGridLinearRayIntegrator,
}


def values(samples, channels, places):
    """A VTK array of (red, green, blue, extinction) at those places; colors that nobody asked for are 0."""
    array = core.vtkDoubleArray()
    array.SetNumberOfComponents(4)
    colors = [samples["emission"][channel] for channel in channels]
    for place in places:
        color = [float(color[place]) for color in colors] + [0.0] * (3 - len(colors))
        array.InsertNextTuple4(*color, float(samples["extinction"][place]))
    return array


def kernel(integrator, middle):
    """The function that renders a task."""
    prop = rendering.vtkVolumeProperty()
    prop.IndependentComponentsOff()
    owner = rendering.vtkVolume()
    owner.SetProperty(prop)

    def render(task):
        edges, middles = task["data"]["edges"], task["data"]["middles"]
        n = len(middles["lambda"])
        lengths = core.vtkDoubleArray()
        for front, back in zip(edges["lambda"], edges["lambda"][1:]):
            lengths.InsertNextValue(back - front)
        channels = range(len(task["channels"]))
        radiance = []
        # Three channels at a time, as colors.
        for start in range(0, len(channels), 3):
            some = channels[start : start + 3]
            if middle:
                near = far = values(middles, some, range(n))
            else:
                near, far = values(edges, some, range(n)), values(edges, some, range(1, n + 1))
            integrator.Initialize(owner, near)
            color = [0.0, 0.0, 0.0, 0.0]
            integrator.Integrate(lengths, near, far, color)
            radiance += color[: len(some)]
        return {"radiance": radiance, "opacity": color[3]}

    return render


def main():
    parser = argparse.ArgumentParser(description="Answers volver with VTK's ray integrators.")
    parser.add_argument("--integrator", choices=INTEGRATORS, default="homogeneous")
    parser.add_argument("--samples", choices=["near", "middle"], default="near", help="of homogeneous segments")
    options = parser.parse_args()
    linear = options.integrator == "linear"
    middle = options.samples == "middle" and not linear
    declaration = {"form": "segments", "format": "f32"}
    if linear:
        declaration |= {"name": "VTK linear ray integrator", "order": 2, "sampling": "ends"}
    else:
        position = "middle" if middle else "front"
        declaration |= {
            "name": f"VTK homogeneous ray integrator, {options.samples} samples",
            "method": f"front-to-back/{position}/subtraction",
            "order": 2 if middle else 1,
            "sampling": position,
        }
    serve(declaration, kernel(INTEGRATORS[options.integrator](), middle))


if __name__ == "__main__":
    main()
