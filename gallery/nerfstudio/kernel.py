"""nerfstudio's RaySamples.get_weights and RGBRenderer, in training."""

import sys
import types

import torch

# nerfstudio asks for the viewer wherever boxes are, and nothing here uses that.
sys.modules["viser"] = sys.modules["viser.transforms"] = types.ModuleType("viser")

from nerfstudio.cameras.rays import RayBundle
from nerfstudio.model_components.renderers import RGBRenderer
from volver_kernel import serve

renderer = RGBRenderer(background_color="random").train()
one = torch.ones(1, 1)
bundle = RayBundle(torch.zeros(1, 3), torch.tensor([[0.0, 0.0, 1.0]]), one, nears=0 * one, fars=one)


def render(task):
    edges, middles = task["data"]["edges"], task["data"]["middles"]
    places = torch.tensor(list(edges["lambda"]))[None, :, None]
    sigmas = torch.tensor(list(middles["extinction"]), requires_grad=True)
    rgbs = torch.tensor([list(values) for values in middles["emission"]], requires_grad=True)
    samples = bundle.get_ray_samples(bin_starts=places[:, :-1], bin_ends=places[:, 1:])
    weights = samples.get_weights(sigmas[None, :, None])
    radiance = renderer(rgbs.T[None], weights)[0]
    result = {"radiance": radiance.tolist()}
    if "cotangents" in task:
        (radiance * torch.tensor(task["cotangents"])).sum().backward()
        result["gradient"] = {"extinction": sigmas.grad.tolist(), "emission": rgbs.grad.tolist()}
    return result


declaration = {"name": "nerfstudio, in training", "form": "segments", "format": "f32"}
serve(declaration | {"method": "front-to-back/middle/subtraction"} | {"gradient": "middles"}, render)
