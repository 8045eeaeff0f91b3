"""The table of `volver study --errors total` by hand: 20 pairs of nested rules on C = sin s^2, tau = s cos s^2 over 10 levels.

usage: study_total.py flint|mpmath|numpy shared|alone [DIGITS] [values] [groups]

shared: every node of the finest level and every exponential of an inner rule once; alone: each method and level by itself.
Prints nothing, or with `values` a line for each inner rule, outer rule and n with the error. python-flint's balls and mpmath's
numbers have DIGITS digits and 12 more. With `groups` (shared) the rules of higher order are those over groups of segments, which
look at boundaries alone.
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
# Rules over groups of segments: a denominator, and for every boundary of a group the weights of its values up to there.
GROUPS = {
    "simpson-pairs-parabola": (12, [[5, 8, -1], [4, 16, 4]]),
    "boole-fours": (720, [[251, 646, -264, 106, -19], [232, 992, 192, 32, -8], [243, 918, 648, 378, -27], [224, 1024, 384, 1024, 224]]),
}
# Places that a segment is divided by.
PARTS = 4
if "groups" in sys.argv:
    PARTS = 1
    INNER = {rule: ([place // 4 for place in places], weights) for rule, (places, weights) in INNER.items() if set(places) <= {0, 4}}

if library == "flint":
    from flint import arb as real, ctx

    ctx.dps = digits + 12
    sine_cosine = real.sin_cos
    exponential = real.exp
    shown = lambda x: x.mid().str(25, radius=False)
elif library == "mpmath":
    from mpmath import exp as exponential, mp, mpf as real, nstr
    from mpmath import cos, sin

    mp.dps = digits + 12
    sine_cosine = lambda x: (sin(x), cos(x))
    shown = lambda x: nstr(x, 25)

if library in ("flint", "mpmath"):

    def evaluate(places, n):
        values = []
        for j in places:
            s = real(j) / n
            sine, cosine = sine_cosine(s * s)
            values.append((sine, s * cosine))
        return [c for c, _ in values], [t for _, t in values]

    def depths(tau, rule, n):
        """tau at places of segments -> depth at boundaries."""
        depth, found = real(0), [real(0)]
        if rule in GROUPS:
            denominator, rows = GROUPS[rule]
            rows = [[real(weight) / denominator / n for weight in row] for row in rows]
            for j in range(0, n, len(rows)):
                front = found[-1]
                for row in rows:
                    found.append(front + sum((w * tau[j + k] for k, w in enumerate(row)), real(0)))
            return found
        places, weights = INNER[rule]
        weights = [real(p) / q / n for p, q in weights]
        for j in range(0, PARTS * n, PARTS):
            for place, weight in zip(places, weights):
                depth += tau[j + place] * weight
            found.append(depth)
        return found

    def attenuate(source, depth):
        return [c * exponential(-t) for c, t in zip(source, depth)]

    def times(c, t):
        return [a * b for a, b in zip(c, t)]

    def total(f):
        return sum(f, real(0))

    def number(p, q):
        return real(p) / q

    sine_of_one, _ = sine_cosine(real(1))
    EXACT = 2 - (sine_of_one + 2) * exponential(-sine_of_one / 2)
else:
    import numpy as np

    def evaluate(places, n):
        s = np.asarray(places) / n
        return np.sin(s * s), s * np.cos(s * s)

    def depths(tau, rule, n):
        if rule in GROUPS:
            denominator, rows = GROUPS[rule]
            size = len(rows)
            values = [tau[k : k + n - size + 1 : size] for k in range(size + 1)]
            parts = [sum((w / denominator / n) * value for w, value in zip(row, values)) for row in rows]
            fronts = np.concatenate(([0.0], np.cumsum(parts[-1])[:-1]))
            return np.concatenate(([0.0], np.stack([fronts + part for part in parts], axis=1).ravel()))
        places, weights = INNER[rule]
        segments = sum((p / q / n) * tau[place : place + PARTS * n - PARTS + 1 : PARTS] for place, (p, q) in zip(places, weights))
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
    finest = PARTS * LEVELS[-1]
    emission, extinction = evaluate(range(finest + 1), finest)
    for n in LEVELS:
        stride = finest // (PARTS * n)
        tau = extinction[::stride]
        source = times(emission[:: PARTS * stride], tau[::PARTS])
        for inner in [*INNER, *(GROUPS if PARTS == 1 else [])]:
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
