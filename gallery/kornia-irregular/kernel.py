"""kornia's nerf.volume_renderer.IrregularRenderer, on one ray of points at the fronts of segments."""

import torch
from kornia.nerf.volume_renderer import IrregularRenderer
from volver_kernel import serve

renderer = IrregularRenderer()


def render(task):
    edges, n = task["data"]["edges"], task["segments"]
    sigmas = torch.tensor(list(edges["extinction"]), requires_grad=True)
    rgbs = torch.tensor([list(values) for values in edges["emission"]], requires_grad=True)
    points = torch.zeros(1, n, 3)
    points[0, :, 2] = torch.tensor(list(edges["lambda"]))[:n]
    radiance = renderer(rgbs.T[None, :n], sigmas[None, :n, None], points)[0]
    result = {"radiance": radiance.tolist()}
    if "cotangents" in task:
        (radiance * torch.tensor(task["cotangents"])).sum().backward()
        result["gradient"] = {"extinction": sigmas.grad.tolist(), "emission": rgbs.grad.tolist()}
    return result


# The guess: NeRF's quadrature, whose last sample stands for everything behind it.
declaration = {"name": "kornia irregular", "form": "segments", "format": "f32", "far_wall": True}
declaration |= {"method": "front-to-back/front/subtraction", "gradient": "edges"}
serve(declaration, render)
