"""PythonicDISORT without scattering, a layer a segment with a constant source, seen along its one upward stream."""

import numpy as np
from PythonicDISORT.pydisort import pydisort
from volver_kernel import serve

# The node of two streams, at which the intensity needs no interpolation.
MU = 0.5


def intensity(depths, source):
    n = len(depths)
    phase = np.zeros((n, 2))
    phase[:, 0] = 1.0
    # It divides by the larger of the first and the last layer's source, and is NaN where both are 0.
    source = np.where(source == 0.0, 1e-100, source)
    # Depths are vertical: along the stream they are 1/MU as large. No beam, nothing enters.
    bottoms = np.cumsum(MU * depths)
    *_, u0 = pydisort(bottoms, np.zeros(n), 2, phase, 0, 0, 0, s_poly_coeffs=source[:, None])[:4]
    return float(u0(0.0)[0])


def render(task):
    edges, middles = task["data"]["edges"], task["data"]["middles"]
    depths = np.asarray(middles["extinction"]) * np.diff(edges["lambda"])
    return [intensity(depths, np.asarray(emission)) for emission in middles["emission"]]


declared = {"method": "front-to-back/middle/expm1", "emission": "positive"}
serve({"name": "PythonicDISORT", "form": "segments", "format": "f64", **declared}, render)
