"""The table of `volver study --errors total` by hand: 20 pairs of nested rules on C = sin s^2, tau = s cos s^2 over 10 levels.

usage: study_total.py flint|numpy shared|alone [DIGITS] [values]

shared: every node of the finest level and every exponential of an inner rule once; alone: each method and level by itself.
Prints nothing, or with `values` a line for each inner rule, outer rule and n with the error. python-flint's balls stand for
numbers of DIGITS digits and 12 more.
"""
import sys

library, how = sys.argv[1:3]
digits = int(sys.argv[3]) if len(sys.argv) > 3 and sys.argv[3].isdigit() else 100
LEVELS = [4 << k for k in range(10)]
# A rule on a segment: places in quarters of it, weights as fractions.
INNER = {
    "riemann-left": ([0], [(1, 1)]),
    "riemann-right": ([4], [(1, 1)]),
    "trapezoid": ([0, 4], [(1, 2), (1, 2)]),
    "simpson": ([0, 2, 4], [(1, 6), (4, 6), (1, 6)]),
    "boole": ([0, 1, 2, 3, 4], [(7, 90), (32, 90), (12, 90), (32, 90), (7, 90)]),
}

if library == "flint":
    from flint import arb, ctx

    ctx.dps = digits + 12

    def evaluate(places, n):
        values = []
        for j in places:
            s = arb(j) / n
            sine, cosine = (s * s).sin_cos()
            values.append((sine, s * cosine))
        return [c for c, _ in values], [t for _, t in values]

    def depths(tau, rule, n):
        """tau at quarters of segments -> depth at boundaries."""
        places, weights = INNER[rule]
        weights = [arb(p) / q / n for p, q in weights]
        depth, found = arb(0), [arb(0)]
        for j in range(0, 4 * n, 4):
            for place, weight in zip(places, weights):
                depth += tau[j + place] * weight
            found.append(depth)
        return found

    def attenuate(source, depth):
        return [c * (-t).exp() for c, t in zip(source, depth)]

    def times(c, t):
        return [a * b for a, b in zip(c, t)]

    def total(f):
        return sum(f, arb(0))

    def number(p, q):
        return arb(p) / q

    one = arb(1)
    EXACT = 2 - (one.sin() + 2) * (-one.sin() / 2).exp()
    shown = lambda x: x.mid().str(25, radius=False)
else:
    import numpy as np

    def evaluate(places, n):
        s = np.asarray(places) / n
        return np.sin(s * s), s * np.cos(s * s)

    def depths(tau, rule, n):
        places, weights = INNER[rule]
        segments = sum((p / q / n) * tau[place : place + 4 * n - 3 : 4] for place, (p, q) in zip(places, weights))
        return np.concatenate(([0.0], np.cumsum(segments)))

    def attenuate(source, depth):
        return source * np.exp(-depth)

    def times(c, t):
        return c * t

    def total(f):
        return np.sum(f)

    def number(p, q):
        return p / q

    EXACT = 2 - (np.sin(1.0) + 2) * np.exp(-np.sin(1.0) / 2)
    shown = lambda x: f"{x:.17e}"

OUTER = {
    "riemann-left": lambda f, n: total(f[:-1]) / n,
    "trapezoid": lambda f, n: ((f[0] + f[-1]) / 2 + total(f[1:-1])) / n,
    "simpson": lambda f, n: (f[0] + 4 * total(f[1:-1:2]) + 2 * total(f[2:-1:2]) + f[-1]) / (3 * n),
    "boole": lambda f, n: 2 * (7 * (f[0] + f[-1]) + 32 * total(f[1::2]) + 12 * total(f[2::4]) + 14 * total(f[4:-1:4])) / (45 * n),
}


def shared():
    table = {}
    finest = 4 * LEVELS[-1]
    emission, extinction = evaluate(range(finest + 1), finest)
    for n in LEVELS:
        stride = finest // (4 * n)
        tau = extinction[::stride]
        source = times(emission[:: 4 * stride], tau[::4])
        for inner in INNER:
            f = attenuate(source, depths(tau, inner, n))
            for outer, rule in OUTER.items():
                table[inner, outer, n] = rule(f, n) - EXACT
    return table


def alone():
    table = {}
    for inner, (places, _) in INNER.items():
        for outer, rule in OUTER.items():
            for n in LEVELS:
                looked_at = sorted({4 * j + place for j in range(n) for place in [0, *places, 4]})
                emission, extinction = evaluate(looked_at, 4 * n)
                tau = dict(zip(looked_at, extinction))
                ends = [emission[i] * extinction[i] for i, j in enumerate(looked_at) if j % 4 == 0]
                f = attenuate(ends, depths(tau, inner, n))
                table[inner, outer, n] = rule(f, n) - EXACT
    return table


table = {"shared": shared, "alone": alone}[how]()
if "values" in sys.argv:
    for (inner, outer, n), error in table.items():
        print(f"{inner}/{outer}", n, shown(error))
