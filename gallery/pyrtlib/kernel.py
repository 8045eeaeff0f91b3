"""pyrtlib's layer depths and downwelling integral, RTEquation.exponential_integration and RTEquation.planck, without background."""

import numpy as np
from pyrtlib.rt_equation import RTEquation
from volver_kernel import serve

RTEquation._from_sat = False
FREQUENCY = 1.0
# Emission is a temperature's modified Planck function 1/(e^(h nu/kT) - 1); this is h nu/k.
HVK = RTEquation.planck(np.float64(FREQUENCY), np.full(2, 300.0), np.zeros(2))[4]


def temperature(emission):
    """The temperature that shines so; of what does not shine one too low for the exponential."""
    with np.errstate(divide="ignore"):
        return HVK / np.minimum(np.log1p(1.0 / emission), 1e6)


def render(task):
    edges = task["data"]["edges"]
    tau, levels = np.asarray(edges["extinction"]), np.asarray(edges["lambda"])
    lengths = np.concatenate([[0.0], np.diff(levels)])
    # Upwards from the antenna; zeros count as the mean of both ends.
    _, depths = RTEquation.exponential_integration(True, tau, lengths, 1, len(tau), 1.0)
    found = []
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        for emission in edges["emission"]:
            _, atmosphere, *_ = RTEquation.planck(np.float64(FREQUENCY), temperature(np.asarray(emission)), depths)
            found.append(float(atmosphere[-1]))
    return found


serve({"name": "pyrtlib", "form": "segments", "format": "f64", "emission": "positive", "method": "layers/linear"}, render)
