"""The quadrature of NeRF (Mildenhall et al. 2020, equation 3; Max 1995) as a kernel for volver:

    volver verify python3 examples/kernels/nerf.py

It takes one sample a segment, at its front; with --sampling middle in its middle. --far-wall gives the last
sample the length 1e10, as many implementations do: the ray ends at an opaque wall.
"""

import argparse
import math

import volver_kernel


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sampling", choices=["front", "middle"], default="front")
    parser.add_argument("--far-wall", action="store_true")
    options = parser.parse_args()

    def render(task):
        edges = task["data"]["edges"]["lambda"]
        lengths = [back - front for front, back in zip(edges, edges[1:])]
        if options.far_wall:
            lengths[-1] = 1e10
        # The samples at the front are the edges but for the last, which has no length to go with.
        samples = task["data"]["edges" if options.sampling == "front" else "middles"]
        colors = list(zip(*samples["emission"]))
        return quadrature(lengths, samples["extinction"], colors)

    declaration = {"name": "nerf", "form": "segments", "format": "f64", "far_wall": options.far_wall}
    declaration["method"] = f"front-to-back/{options.sampling}/subtraction"
    volver_kernel.serve(declaration, render)


def quadrature(lengths, extinction, colors):
    """Σ T (1 − exp(−τ δ)) C of every channel, with T = Π (1 − α) over the samples before."""
    radiance = [0.0] * len(colors[0])
    transmittance = 1.0
    for delta, tau, color in zip(lengths, extinction, colors):
        alpha = 1.0 - math.exp(-tau * delta)
        weight = transmittance * alpha
        radiance = [total + weight * c for total, c in zip(radiance, color)]
        transmittance *= 1.0 - alpha
    return radiance


if __name__ == "__main__":
    main()
