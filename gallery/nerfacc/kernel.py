"""nerfacc's render_weight_from_density and accumulate_along_rays, on one ray of intervals."""

import torch
from nerfacc.volrend import accumulate_along_rays, render_weight_from_density
from volver_kernel import serve


def render(task):
    edges, middles = task["data"]["edges"], task["data"]["middles"]
    places = torch.tensor(list(edges["lambda"]))[None]
    sigmas = torch.tensor(list(middles["extinction"]), requires_grad=True)
    rgbs = torch.tensor([list(values) for values in middles["emission"]], requires_grad=True)
    weights, _, _ = render_weight_from_density(places[:, :-1], places[:, 1:], sigmas[None])
    radiance = accumulate_along_rays(weights, rgbs.T[None])[0]
    opacity = accumulate_along_rays(weights)[0, 0]
    result = {"radiance": radiance.tolist(), "opacity": opacity.item()}
    if "cotangents" in task:
        (radiance * torch.tensor(task["cotangents"])).sum().backward()
        result["gradient"] = {"extinction": sigmas.grad.tolist(), "emission": rgbs.grad.tolist()}
    return result


serve(
    {
        "name": "nerfacc",
        "form": "segments",
        "format": "f32",
        "method": "front-to-back/middle/subtraction",
        "answers": ["radiance", "opacity"],
        "gradient": "middles",
    },
    render,
)
