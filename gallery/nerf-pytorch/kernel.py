"""nerf-pytorch's NeRF.alpha_compositing_coefficients, on one ray of points at the fronts of segments."""

import torch
from nerf.model import NeRF
from volver_kernel import serve


def render(task):
    edges, n = task["data"]["edges"], task["segments"]
    sigmas = torch.tensor(list(edges["extinction"]), requires_grad=True)
    rgbs = torch.tensor([list(values) for values in edges["emission"]], requires_grad=True)
    points = torch.zeros(n, 3)
    points[:, 2] = torch.tensor(list(edges["lambda"]))[:n]
    weights = NeRF.alpha_compositing_coefficients(points, sigmas[:n, None])
    radiance = (weights * rgbs.T[:n]).sum(dim=-2)
    result = {"radiance": radiance.tolist()}
    if "cotangents" in task:
        (radiance * torch.tensor(task["cotangents"])).sum().backward()
        result["gradient"] = {"extinction": sigmas.grad.tolist(), "emission": rgbs.grad.tolist()}
    return result


# The guess: NeRF's quadrature, whose last sample stands for everything behind it.
declaration = {"name": "nerf-pytorch", "form": "segments", "format": "f32", "far_wall": True}
declaration |= {"method": "front-to-back/front/subtraction", "gradient": "edges"}
serve(declaration, render)
