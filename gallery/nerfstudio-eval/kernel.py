"""nerfstudio's RaySamples.get_weights and RGBRenderer, in evaluation."""

import sys
import types

import torch

# nerfstudio asks for the viewer wherever boxes are, and nothing here uses that.
sys.modules["viser"] = sys.modules["viser.transforms"] = types.ModuleType("viser")

from nerfstudio.cameras.rays import RayBundle
from nerfstudio.model_components.renderers import RGBRenderer
from volver_kernel import serve

renderer = RGBRenderer(background_color="random").eval()
one = torch.ones(1, 1)
bundle = RayBundle(torch.zeros(1, 3), torch.tensor([[0.0, 0.0, 1.0]]), one, nears=0 * one, fars=one)


def render(task):
    edges, middles = task["data"]["edges"], task["data"]["middles"]
    places = torch.tensor(list(edges["lambda"]))[None, :, None]
    sigmas = torch.tensor(list(middles["extinction"]))
    rgbs = torch.tensor([list(values) for values in middles["emission"]])
    samples = bundle.get_ray_samples(bin_starts=places[:, :-1], bin_ends=places[:, 1:])
    weights = samples.get_weights(sigmas[None, :, None])
    radiance = renderer(rgbs.T[None], weights)[0]
    return {"radiance": radiance.tolist()}


declaration = {"name": "nerfstudio, in evaluation", "form": "segments", "format": "f32"}
serve(declaration | {"method": "front-to-back/middle/subtraction"}, render)
