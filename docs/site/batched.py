"""A ray marcher that is given many rays at once: middle samples, front to back, ray by ray."""

import math

import volver_kernel


def render(frame):
    offsets, ends = frame["offsets"], frame["edges_lambda"]
    counts = [offsets[ray + 1] - offsets[ray] for ray in range(frame["rays"])]
    radiances = []
    for ray, n in enumerate(counts):
        radiance, transmittance = [0.0] * len(frame["channels"]), 1.0
        for i in range(n):
            sample = offsets[ray] + i
            d = ends[sample + ray + 1] - ends[sample + ray]
            opacity = -math.expm1(-frame["middles_extinction"][sample] * d)
            for k in range(len(radiance)):
                radiance[k] += transmittance * opacity * frame["middles_emission"][k, sample]
            transmittance *= 1.0 - opacity
        radiances.append(radiance)
    return {"radiance": radiances}


volver_kernel.serve({"name": "batched", "form": "segments", "sampling": "middle", "order": 2, "batch": 64}, render)
