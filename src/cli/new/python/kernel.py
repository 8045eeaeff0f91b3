"""A kernel for volver: the light of one ray through a volume.

    python3 test_kernel.py                  its own test, without volver
    volver verify python3 kernel.py         its order, and what it computes
    volver ask sine-squared -n 4            what it is asked
    volver verify --log talk.log python3 kernel.py

Put your renderer's loop in place of composite(). If it is another rule, say so below: "order": 1 in place of
"method" claims no more than an order. docs/protocol.md of volver lists what a kernel may declare.
"""

import math

import volver_kernel


def composite(lengths, extinction, emission):
    """Front to back over one sample a segment: the radiance of one channel, and what is left of light behind it."""
    radiance, transmittance = 0.0, 1.0
    for length, tau, color in zip(lengths, extinction, emission):
        passes = math.exp(-tau * length)
        radiance += transmittance * (1.0 - passes) * color
        transmittance *= passes
    return radiance, transmittance


def render(task):
    """The radiance of every channel of a task."""
    ends = task["data"]["edges"]["lambda"]
    lengths = [back - front for front, back in zip(ends, ends[1:])]
    middles = task["data"]["middles"]
    return [composite(lengths, middles["extinction"], emission)[0] for emission in middles["emission"]]


if __name__ == "__main__":
    volver_kernel.serve(
        {"name": "my kernel", "form": "segments", "method": "front-to-back/middle/subtraction", "format": "f64"},
        render,
    )
