"""kornia's nerf.volume_renderer.RegularRenderer, on a batch of rays of middles, each with its own step."""

import numpy
import torch
from kornia.nerf.volume_renderer import RegularRenderer
from volver_kernel import serve

renderer = RegularRenderer()


def render(frame):
    counts = numpy.diff(frame["offsets"])
    rays, longest, channels = len(counts), max(2, counts.max()), len(frame["channels"])
    sigmas, rgbs = numpy.zeros((rays, longest, 1)), numpy.zeros((rays, longest, channels))
    # Shorter rays are empty behind their end; their points go on as far apart.
    points = numpy.zeros((rays, longest, 3))
    points[:, :, 2] = (numpy.arange(longest) + 0.5) * numpy.asarray(frame["step"])[:, None]
    emission = numpy.asarray(frame["middles_emission"])
    for ray, (start, count) in enumerate(zip(frame["offsets"], counts)):
        sigmas[ray, :count, 0] = frame["middles_extinction"][start : start + count]
        rgbs[ray, :count] = emission[:, start : start + count].T
    # Three channels at a time, as colours.
    radiance = numpy.zeros((rays, channels))
    for first in range(0, channels, 3):
        some = numpy.zeros((rays, longest, 3))
        width = min(3, channels - first)
        some[:, :, :width] = rgbs[:, :, first : first + width]
        answer = renderer(*(torch.tensor(each, dtype=torch.float32) for each in (some, sigmas, points)))
        radiance[:, first : first + width] = answer.numpy()[:, :width]
    return {"radiance": radiance}


declaration = {"name": "kornia regular", "form": "segments", "format": "f32", "step": "divides", "batch": 64}
serve(declaration | {"method": "front-to-back/middle/subtraction"}, render)
