"""A ray marcher that is given the medium as source code and chooses its own places: middle samples, front to back."""

import math

import volver_kernel


def render(task):
    medium = {}
    exec(task["data"]["code"], medium)
    begin, end, step = 0.0, task["length"], task["step"]
    radiance, transmittance = [0.0] * len(task["channels"]), 1.0
    n = math.ceil((end - begin) / step - 1e-9)
    for i in range(n):
        at = begin + i * step
        d = min(step, end - at)
        s = medium["field"](at + d / 2)
        opacity = -math.expm1(-medium["extinction"](s) * d)
        for k, channel in enumerate(task["channels"]):
            radiance[k] += transmittance * opacity * medium["emission_" + channel](s)
        transmittance *= 1.0 - opacity
    return radiance


volver_kernel.serve({"name": "formula", "form": "formula", "language": "python", "sampling": "middle", "order": 2}, render)
