"""jax-nerf's rendering.render_volume_density, on a picture of two rows that are the same; the second is looked at."""

import jax
import jax.numpy as jnp
import numpy
from nerf.rendering import render_volume_density
from volver_kernel import serve


@jax.jit
def colour(field, depths):
    return render_volume_density(field, depths)[0]


def render(task):
    edges, n = task["data"]["edges"], task["segments"]
    depths = jnp.asarray(numpy.asarray(edges["lambda"])[:n], jnp.float32)[None, None].repeat(2, 0)
    emission = numpy.asarray(edges["emission"])
    radiance = []
    # Three channels at a time, as colours.
    for first in range(0, len(emission), 3):
        some = emission[first : first + 3, :n]
        black = numpy.zeros((3 - len(some), n))
        field = numpy.concatenate([some, black, numpy.asarray(edges["extinction"])[None, :n]]).T
        radiance += colour(jnp.asarray(field, jnp.float32)[None, None].repeat(2, 0), depths)[1, 0, : len(some)].tolist()
    return radiance


declaration = {"name": "jax-nerf", "form": "segments", "format": "f32", "far_wall": True, "exp_ulp": 1.1}
serve(declaration | {"method": "front-to-back/front/subtraction"}, render)
