"""scikit-image's radon transform at 0 degrees, of an image whose middle column is the ray."""

import numpy as np
from skimage.transform import radon
from volver_kernel import serve


def render(task):
    tau, n = np.asarray(task["data"]["middles"]["extinction"]), task["segments"]
    # It works in pixels; the middle of an image of n columns is n // 2.
    image = np.zeros((n, n))
    image[:, n // 2] = tau
    sums = radon(image, theta=[0.0], circle=False)
    middle = sums.shape[0] // 2
    return {"optical_depth": float(sums[middle, 0]) * task["length"] / n}


declared = {"answers": ["optical_depth"], "sampling": "middle", "order": 2, "step": "divides"}
serve({"name": "scikit-image radon", "form": "segments", "format": "f64", **declared}, render)
