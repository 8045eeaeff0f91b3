"""ASTRA's CPU projector "linear" (Joseph): the middle ray of a parallel beam at 0.1 rad through pixels that are even across."""

import math

import astra
import numpy as np
from volver_kernel import serve

ANGLE = 0.1


def render(task):
    tau, d = np.asarray(task["data"]["middles"]["extinction"]), task["length"] / task["segments"]
    # Pixels have to be square. The ray is longer than they are high, so that a row holds d of it.
    rows, pixel = len(tau), d * math.cos(ANGLE)
    columns = 2 * math.ceil(rows * math.tan(ANGLE) / 2) + 8
    half_x, half_y = columns * pixel / 2, rows * pixel / 2
    volume = astra.create_vol_geom(rows, columns, -half_x, half_x, -half_y, half_y)
    beam = astra.create_proj_geom("parallel", pixel, 1, np.array([ANGLE]))
    projector = astra.create_projector("linear", beam, volume)
    image = np.repeat(tau.astype(np.float32)[:, None], columns, axis=1)
    try:
        number, sinogram = astra.create_sino(image, projector)
        astra.data2d.delete(number)
        result = {"optical_depth": float(sinogram[0, 0])}
        if "cotangents" in task:
            measured = np.array([[task["cotangents"][0]]], np.float32)
            number, back = astra.create_backprojection(measured, projector)
            astra.data2d.delete(number)
            result["gradient"] = {"extinction": back.sum(axis=1, dtype=float).tolist()}
        return result
    finally:
        astra.projector.delete(projector)


declared = {"answers": ["optical_depth"], "gradient": "middles", "adjoint": "plain", "sampling": "middle", "order": 2}
serve({"name": "ASTRA linear", "form": "segments", "format": "f32", "step": "divides", **declared}, render)
