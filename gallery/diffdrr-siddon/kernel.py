"""DiffDRR's Siddon projector through a row of voxels, and its backprojection by PyTorch's autograd."""

import numpy as np
import torch
from diffdrr.renderers import Siddon
from volver_kernel import serve

siddon = Siddon()


def render(task):
    n, d = task["segments"], task["length"] / task["segments"]
    row = torch.tensor(np.asarray(task["data"]["middles"]["extinction"]), dtype=torch.float32, requires_grad=True)
    volume = row[:, None, None].expand(n, 3, 3)
    # In units of voxels, whose centres are whole numbers: from one in front of the volume to one behind it.
    source, target = torch.tensor([[[-1.5, 1.0, 1.0]]]), torch.tensor([[[n + 0.5, 1.0, 1.0]]])
    distance = torch.full((1, 1, 1), (n + 2) * d)
    depth = siddon(volume, source, target, distance).sum()
    result = {"optical_depth": float(depth)}
    if "cotangents" in task:
        (back,) = torch.autograd.grad(depth * task["cotangents"][0], row)
        result["gradient"] = {"extinction": back.double().tolist()}
    return result


declared = {"answers": ["optical_depth"], "gradient": "middles", "adjoint": "plain", "sampling": "middle", "order": 2}
serve({"name": "DiffDRR Siddon", "form": "segments", "format": "f32", "step": "divides", **declared}, render)
