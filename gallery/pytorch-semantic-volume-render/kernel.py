"""pytorch-semantic-volume-render's process_density, on one ray of points at the fronts of segments."""

import sys
import types

import torch
from volver_kernel import serve

# It asks for torch_scatter as it starts, and for nothing of it here.
sys.modules["torch_scatter"] = types.ModuleType("torch_scatter")

from pt_svr.render import process_density


def render(task):
    edges, n = task["data"]["edges"], task["segments"]
    # Batch, cameras, rays, points, one.
    places = torch.tensor(list(edges["lambda"])[:n]).reshape(1, 1, 1, n, 1)
    density = torch.tensor(list(edges["extinction"])[:n]).reshape(1, 1, 1, n, 1)
    mask, _, masked = process_density(density, places)
    weights = torch.zeros_like(density)
    weights[mask] = masked
    rgbs = torch.tensor([list(values)[:n] for values in edges["emission"]])
    return (weights.flatten() * rgbs).sum(dim=-1).tolist()


# The guess: NeRF's quadrature, whose last sample stands for everything behind it.
declaration = {"name": "pt_svr", "form": "segments", "format": "f32", "far_wall": True}
serve(declaration | {"method": "front-to-back/front/subtraction"}, render)
