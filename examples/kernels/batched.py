"""Compositing of many rays at once with NumPy (protocol 2):

    volver verify --batch 512 python3 examples/kernels/batched.py

Rays of a frame have different numbers of segments: ray r has the segments offsets[r] to offsets[r + 1] - 1. All rays
march in lockstep, the i-th segment of every ray that has one at once, so that each has the same bits as alone. A running
sum over all segments of the frame, with what stood before each ray subtracted, would be faster and would not: how it
rounds depends on the rays before.

Samples stand in the middles of segments. --leak builds in a mistake of the kind that is made, to see it found:
transmittance (of the ray before), step (of the first ray), padding (shorter rays are filled up and the filling counts).
"""

import argparse

import numpy as np

import volver_kernel


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--batch", type=int, default=4096)
    parser.add_argument("--leak", choices=["transmittance", "step", "padding"])
    options = parser.parse_args()

    def render(frame):
        lengths = np.diff(frame["edges_lambda"])
        offsets = np.asarray(frame["offsets"])
        # Between two rays there is no segment.
        lengths = np.delete(lengths, offsets[1:-1] + np.arange(frame["rays"] - 1))
        if options.leak == "step":
            lengths[:] = frame["step"][0]
        depth = np.asarray(frame["middles_extinction"]) * lengths
        return composite(offsets, depth, np.asarray(frame["middles_emission"]), options.leak)

    declaration = {"name": "batched", "form": "segments", "batch": options.batch, "answers": ["radiance", "opacity"]}
    declaration["method"] = "front-to-back/middle/expm1"
    volver_kernel.serve(declaration, render)


def composite(offsets, depth, emission, leak=None):
    """Radiance and opacity of every ray, front to back; w = T (1 − exp(−τ δ))."""
    first, counts = offsets[:-1], np.diff(offsets)
    opacity = -np.expm1(-depth)
    radiance = np.zeros((len(counts), len(emission)))
    before = np.zeros(len(counts))
    for i in range(counts.max()):
        if leak == "padding":
            rays, at = np.arange(len(counts)), first + np.minimum(i, counts - 1)
        else:
            rays = np.flatnonzero(counts > i)
            at = first[rays] + i
        weight = np.exp(-before[rays]) * opacity[at]
        radiance[rays] += (weight * emission[:, at]).T
        before[rays] += depth[at]
    if leak == "transmittance":
        radiance[1:] *= np.exp(-before[:-1])[:, np.newaxis]
    return {"radiance": radiance, "opacity": -np.expm1(-before)}


if __name__ == "__main__":
    main()
