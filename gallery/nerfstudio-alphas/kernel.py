"""nerfstudio's RaySamples.get_weights_and_transmittance_from_alphas, with opacities of the middles of segments."""

import sys
import types

import torch

# nerfstudio asks for the viewer wherever boxes are, and nothing here uses that.
sys.modules["viser"] = sys.modules["viser.transforms"] = types.ModuleType("viser")

from nerfstudio.cameras.rays import RaySamples
from volver_kernel import serve


def render(task):
    edges, middles = task["data"]["edges"], task["data"]["middles"]
    lengths = torch.diff(torch.tensor(list(edges["lambda"])))
    sigmas = torch.tensor(list(middles["extinction"]), requires_grad=True)
    rgbs = torch.tensor([list(values) for values in middles["emission"]], requires_grad=True)
    alphas = -torch.expm1(-sigmas * lengths)[None, :, None]
    weights = RaySamples.get_weights_and_transmittance_from_alphas(alphas, weights_only=True)
    radiance = (weights * rgbs.T[None]).sum(dim=-2)[0]
    result = {"radiance": radiance.tolist()}
    if "cotangents" in task:
        (radiance * torch.tensor(task["cotangents"])).sum().backward()
        result["gradient"] = {"extinction": sigmas.grad.tolist(), "emission": rgbs.grad.tolist()}
    return result


declaration = {"name": "nerfstudio, from alphas", "form": "segments", "format": "f32", "gradient": "middles"}
serve(declaration | {"method": "front-to-back/middle/expm1"}, render)
