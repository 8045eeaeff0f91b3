"""A projector of line integrals and its backprojector (protocol 2), as in tomography:

    volver adjoint python3 examples/kernels/projector.py

The projector sums the extinctions of a ray's segments times their lengths, y = A x; the backprojector gives each of them
its part of a number y, x = Aᵀ y. With --sampling ends extinctions stand where segments meet, and both use trapezoids.
--weights lengths has the inner product Σ dᵢ xᵢ zᵢ, in which Aᵀ y is y wherever a value stands.

--fault builds in a mistake of the kind that is made, to see it found: factor, sign, nearest (interpolated in front,
and not behind), even (every segment as long as the first), weights (the other inner product), clamp (values below 0 count
as 0).
"""

import argparse

import volver_kernel

FAULTS = ["factor", "sign", "nearest", "even", "weights", "clamp"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sampling", choices=["middle", "ends"], default="middle")
    parser.add_argument("--weights", choices=["plain", "lengths"], default="plain")
    parser.add_argument("--fault", choices=FAULTS)
    options = parser.parse_args()
    at = "middles" if options.sampling == "middle" else "edges"

    def render(task):
        edges = task["data"]["edges"]["lambda"]
        segments = [back - front for front, back in zip(edges, edges[1:])]
        values = task["data"][at]["extinction"]
        lengths = parts(segments, options.sampling)
        if options.fault == "clamp":
            values = [max(x, 0.0) for x in values]
        result = {"optical_depth": sum(x * d for x, d in zip(values, lengths))}
        if "cotangents" in task:
            (y,) = task["cotangents"]
            back = backprojected(y, segments, lengths, options)
            result["gradient"] = {"extinction": back}
        return result

    declaration = {"name": "projector", "form": "segments", "format": "f64", "answers": ["optical_depth"]}
    declaration.update(gradient=at, adjoint=options.weights, sampling=options.sampling, order=2)
    volver_kernel.serve(declaration, render)


def parts(segments, sampling):
    """The length that each value stands for: its segment, or half of both beside it."""
    if sampling == "middle":
        return list(segments)
    return [(before + behind) / 2 for before, behind in zip([0.0, *segments], [*segments, 0.0])]


def backprojected(y, segments, lengths, options):
    """Aᵀ y in the inner product declared."""
    own = lengths
    if options.fault == "nearest":
        own = [*segments, 0.0] if options.sampling == "ends" else [0.0, *segments[1:]]
    elif options.fault == "even":
        own = parts([segments[0]] * len(segments), options.sampling)
    back = [y * d for d in own]
    if (options.weights == "lengths") != (options.fault == "weights"):
        back = [x / d for x, d in zip(back, lengths)]
    times = {"factor": 1.07, "sign": -1.0}.get(options.fault, 1.0)
    return [times * x for x in back]


if __name__ == "__main__":
    main()
