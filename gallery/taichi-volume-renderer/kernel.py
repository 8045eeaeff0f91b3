"""taichi-volume-renderer's Scene, without lights: a picture of two by two pixels along a column of voxels, one a segment."""

import numpy
import taichi
from taichi_volume_renderer import Scene
from volver_kernel import serve

# A power of two, so that steps of one voxel add up exactly; what is behind the ray stays empty.
VOXELS = 8192
taichi.init(arch=taichi.cpu, cpu_max_num_threads=1, log_level=taichi.ERROR)
density = taichi.field(taichi.f32, shape=(VOXELS, 1, 1))
colour = taichi.Vector.field(3, taichi.f32, shape=(VOXELS, 1, 1))
lights = [taichi.Vector.field(3, taichi.f32, shape=(1,)) for _ in range(2)]
scene = Scene(density, colour, *lights, lighting=False, background=[0.0, 0.0, 0.0], smoke_density_factor=VOXELS)
# The camera looks along −x, from the middle of the last voxel.
scene.camera_distance = 0.5 - 0.5 / VOXELS
pixels = taichi.Vector.field(3, taichi.f32, shape=(2, 2))


def render(task):
    middles, n = task["data"]["middles"], task["segments"]
    if n > VOXELS:
        raise ValueError(f"{n} segments (allowed: {VOXELS})")
    voxels, colours = numpy.zeros((VOXELS, 1, 1)), numpy.zeros((VOXELS, 1, 1, 3))
    voxels[VOXELS - n :, 0, 0] = (numpy.asarray(middles["extinction"]) * numpy.diff(task["data"]["edges"]["lambda"]))[::-1]
    density.from_numpy(voxels.astype(numpy.float32))
    emission, radiance = numpy.asarray(middles["emission"]), []
    for first in range(0, len(emission), 3):
        some = emission[first : first + 3]
        colours[VOXELS - n :, 0, 0, : len(some)] = some.T[::-1]
        colour.from_numpy(colours.astype(numpy.float32))
        scene.render(pixels)
        radiance += pixels.to_numpy()[1, 1, : len(some)].tolist()
    return radiance


# The guess: compositing of voxels' middles.
serve({"name": "taichi", "form": "segments", "format": "f32", "method": "front-to-back/middle/subtraction"}, render)
