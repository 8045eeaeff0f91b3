"""Compositing that answers all that the protocol asks for: radiance, opacity, optical and expected depth:

    volver verify python3 examples/kernels/depths.py

Samples stand in the middles of segments. The expected depth is Σ w λ with the weights w of the radiance, as depth maps
of learned volumes are; with --by-opacity it is divided by the opacity Σ w. --only NAME, repeatable, leaves out the
others: a projector of tomography answers the optical depth alone. --background adds what is behind the ray.
"""

import argparse
import math

import volver_kernel

ANSWERS = ["radiance", "opacity", "optical_depth", "expected_depth"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--by-opacity", action="store_true")
    parser.add_argument("--background", action="store_true")
    parser.add_argument("--only", choices=ANSWERS, action="append")
    options = parser.parse_args()
    answers = options.only or ANSWERS

    def render(task):
        edges = task["data"]["edges"]["lambda"]
        lengths = [back - front for front, back in zip(edges, edges[1:])]
        found = composite(lengths, task["data"]["middles"])
        if options.by_opacity and found["opacity"] > 0:
            found["expected_depth"] /= found["opacity"]
        if options.background:
            through = math.exp(-found["optical_depth"])
            found["radiance"] = [r + through * b for r, b in zip(found["radiance"], task["background"])]
        return {name: found[name] for name in answers}

    declaration = {"name": "depths", "form": "segments", "method": "front-to-back/middle/expm1", "answers": answers}
    declaration["background"] = options.background
    if "expected_depth" in answers:
        declaration["expected_depth"] = "by-opacity" if options.by_opacity else "plain"
    volver_kernel.serve(declaration, render)


def composite(lengths, samples):
    """All four, front to back; w = T (1 − exp(−τ δ))."""
    radiance = [0.0] * len(samples["emission"])
    opacity, optical_depth, expected_depth = 0.0, 0.0, 0.0
    for i, (delta, tau, at) in enumerate(zip(lengths, samples["extinction"], samples["lambda"])):
        weight = math.exp(-optical_depth) * -math.expm1(-tau * delta)
        radiance = [total + weight * c[i] for total, c in zip(radiance, samples["emission"])]
        opacity += weight
        expected_depth += weight * at
        optical_depth += tau * delta
    return {
        "radiance": radiance,
        "opacity": opacity,
        "optical_depth": optical_depth,
        "expected_depth": expected_depth,
    }


if __name__ == "__main__":
    main()
