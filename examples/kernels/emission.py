"""Activity along a ray and what is attenuated of it, as projectors of emission tomography (SPECT, PET) have it:

    volver verify python3 examples/kernels/emission.py

The source is j per length, and not C = j/mu per depth, so that rays that emit and do not absorb are rays like others:
volver asks them too. A segment adds j d (1 - exp(-mu d)) / (mu d), which is j d where mu is 0. With --by-division the
formula is j / mu (1 - exp(-mu d)), which has no value there.
"""

import argparse
import math

import volver_kernel


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--by-division", action="store_true")
    options = parser.parse_args()

    def render(task):
        edges, middles = task["data"]["edges"]["lambda"], task["data"]["middles"]
        lengths = [back - front for front, back in zip(edges, edges[1:])]
        return [project(lengths, middles["extinction"], row, options.by_division) for row in middles["emission"]]

    declaration = {"name": "emission", "form": "segments", "source": "length", "method": "front-to-back/middle/expm1"}
    volver_kernel.serve(declaration, render)


def project(lengths, attenuation, activity, by_division):
    radiance, depth = 0.0, 0.0
    for d, mu, j in zip(lengths, attenuation, activity):
        if by_division:
            seen = j / mu * -math.expm1(-mu * d)
        else:
            seen = j * d * (-math.expm1(-mu * d) / (mu * d) if mu * d > 0 else 1.0)
        radiance += math.exp(-depth) * seen
        depth += mu * d
    return radiance


if __name__ == "__main__":
    main()
