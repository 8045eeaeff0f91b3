"""Compositing front to back with its gradient, in reverse mode by hand (protocol 2):

    volver gradient python3 examples/kernels/gradient.py

The radiance is I = Σ T α C with α = 1 − exp(−τ δ) and T = Π (1 − α) over the samples before. The gradient of Σ aₖ Iₖ is
aₖ T α by C, and by τ δ (T′ Σ aₖ C − Σ aₖ R), where T′ is what passes the sample too and R what comes from behind it.
Samples stand in the middles of segments; with --sampling front at their fronts, with --sampling jittered anywhere in them,
by the task's seed, between values at both ends: then derivatives scatter, and are compared in the mean. --far-wall gives
the last one the length 1e10, --background takes what is behind the ray. --rectifier has no slope where τ is 0, as behind
max(τ, 0): legal, and said.

--fault builds in a mistake of the kind that is made, to see it found: transmittance, factor, sign, own-light, detached,
channels, length, nan.
"""

import argparse
import math
import random

import volver_kernel

FAULTS = ["transmittance", "factor", "sign", "own-light", "detached", "channels", "length", "nan"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sampling", choices=["front", "middle", "jittered"], default="middle")
    parser.add_argument("--fault", choices=FAULTS)
    parser.add_argument("--rectifier", action="store_true")
    ends = parser.add_mutually_exclusive_group()
    ends.add_argument("--far-wall", action="store_true")
    ends.add_argument("--background", action="store_true")
    options = parser.parse_args()
    at = "middles" if options.sampling == "middle" else "edges"

    def render(task):
        edges = task["data"]["edges"]["lambda"]
        lengths = [back - front for front, back in zip(edges, edges[1:])]
        if options.far_wall:
            lengths[-1] = 1e10
        samples = task["data"][at]
        places = None
        if options.sampling == "jittered":
            places = [chance() for chance in [random.Random(task["seed"]).random] * len(lengths)]
            samples = between(samples, places)
        background = task.get("background") or [0.0] * len(task["channels"])
        result = {"radiance": radiance(lengths, samples, background)}
        if "cotangents" in task:
            found = gradient(lengths, samples, background, task["cotangents"], options.fault)
            if options.rectifier:
                pairs = zip(found["extinction"], samples["extinction"])
                found["extinction"] = [slope if tau > 0.0 else 0.0 for slope, tau in pairs]
            result["gradient"] = found if places is None else to_ends(found, places)
        return result

    declaration = {"name": "gradient", "form": "segments", "format": "f64", "gradient": at}
    declaration.update(far_wall=options.far_wall, background=options.background)
    if options.sampling == "jittered":
        declaration.update(stochastic=True, sampling="jittered")
    else:
        declaration["method"] = f"front-to-back/{options.sampling}/expm1"
    volver_kernel.serve(declaration, render)


def between(ends, places):
    """Values at places of segments, from 0 to 1, linear between their ends."""
    row = lambda values: [(1 - u) * a + u * b for u, a, b in zip(places, values, values[1:])]
    return {"extinction": row(ends["extinction"]), "emission": [row(values) for values in ends["emission"]]}


def to_ends(found, places):
    """The derivatives by the ends that values were interpolated from."""

    def row(values):
        ends = [0.0] * (len(values) + 1)
        for i, (u, value) in enumerate(zip(places, values)):
            ends[i] += (1 - u) * value
            ends[i + 1] += u * value
        return ends

    return {"extinction": row(found["extinction"]), "emission": [row(values) for values in found["emission"]]}


def weights(lengths, samples):
    """T and α of every sample, and T behind the last."""
    transmittance, found = 1.0, []
    for length, tau in zip(lengths, samples["extinction"]):
        found.append((transmittance, -math.expm1(-tau * length)))
        transmittance *= math.exp(-tau * length)
    return found, transmittance


def radiance(lengths, samples, background):
    of, last = weights(lengths, samples)
    in_front = [sum(t * alpha * c for (t, alpha), c in zip(of, row)) for row in samples["emission"]]
    return [r + last * b for r, b in zip(in_front, background)]


def gradient(lengths, samples, background, cotangents, fault=None):
    """From the last sample to the first: what comes from behind each is known when it is met."""
    by_tau = [0.0] * len(lengths)
    by_c = [[0.0] * len(lengths) for _ in cotangents]
    if fault == "channels":
        cotangents = [cotangents[0]] * len(cotangents)
    of, last = weights(lengths, samples)
    behind = last * sum(a * b for a, b in zip(cotangents, background))
    for i in reversed(range(len(lengths))):
        t, alpha = of[i]
        light = sum(a * row[i] for a, row in zip(cotangents, samples["emission"]))
        for row, a in zip(by_c, cotangents):
            row[i] = a * t * alpha
        passes = t * (1.0 - alpha)
        if fault == "transmittance":
            passes = 1.0 - alpha
        if fault == "own-light":
            behind += t * alpha * light
        by_tau[i] = lengths[i] * (passes * light - behind)
        if fault != "own-light":
            behind += t * alpha * light
    if fault == "factor":
        by_tau = [1.03 * x for x in by_tau]
    elif fault == "sign":
        by_tau = [-x for x in by_tau]
    elif fault == "detached":
        by_tau = [0.0] * len(by_tau)
    elif fault == "length":
        by_tau = [x / length for x, length in zip(by_tau, lengths)]
    elif fault == "nan":
        by_tau[-1] = math.nan
    return {"extinction": by_tau, "emission": by_c}


if __name__ == "__main__":
    main()
