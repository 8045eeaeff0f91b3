"""I = integral of C tau exp(-t) for C = exp(-s^2), tau = 2 + sin(10 s^2) on [0, 1] by python-flint.

usage: reference_flint.py nested DIGITS | taylor DIGITS PANELS

nested: an enclosure, acb.integral of the light with acb.integral of tau at each of its places. taylor: PANELS Taylor series of
tau, integrated, and of the light, with Cauchy's bound on a disc for what they leave out. Prints the value.
"""
import math
import sys

from flint import acb, arb, arb_series, ctx

kind, digits = sys.argv[1], int(sys.argv[2])


def tau(s):
    return 2 + (10 * s * s).sin()


def medium(s):
    return (-s * s).exp(), tau(s)


def nested():
    ctx.dps = digits + 15
    fine, wanted = arb(2) ** (-ctx.prec), arb(10) ** (-digits)

    def depth(x):
        # A wide ball is only asked for a bound: the range is enough.
        if x.rel_accuracy_bits() < ctx.prec // 2:
            return x * tau(x * acb(arb(0.5, 0.5)))
        return acb.integral(lambda u, _: x * tau(x * u), 0, 1, rel_tol=fine, abs_tol=fine)

    def light(x, _):
        emission, extinction = medium(x)
        return emission * extinction * (-depth(x)).exp()

    return acb.integral(light, 0, 1, rel_tol=wanted, abs_tol=wanted).real


def greatest(centre, radius, part):
    """|C| or |tau| on a disc, from 96 arcs of its circle."""
    most = 0.0
    for k in range(96):
        angle = acb(arb((k + 0.5) * 2 * math.pi / 96, math.pi / 96 + 1e-9))
        size = abs(medium(acb(centre) + radius * (acb(0, 1) * angle).exp())[part])
        most = max(most, float(size.mid()) + float(size.rad()))
    return most


def terms(centre, reach):
    """The fewest terms of a panel, and log2 of the bounds that they follow from."""
    found = None
    ctx.prec = 53
    for radius in [reach * m for m in (2, 3, 4, 6, 8, 12, 16)]:
        emission, extinction = greatest(centre, radius, 0), greatest(centre, radius, 1)
        if not (extinction < 1e200 and emission < 1e200 and 2 * radius * extinction < 20000):
            continue
        light = math.log2(extinction * emission) + 2 * radius * extinction / math.log(2)
        depth = math.log2(extinction * radius)
        count = math.ceil(((digits + 2) * math.log2(10) + max(light, depth) + 8) / math.log2(radius / reach))
        if found is None or count < found[0]:
            found = (count, radius, light, depth)
    if found is None:
        sys.exit("no bound on any disc: more panels are needed")
    return found


def at(series, u):
    value = arb(0)
    for coefficient in reversed(series.coeffs()):
        value = value * u + coefficient
    return value


def taylor(panels):
    light, transmittance = arb(0), arb(1)
    for panel in range(panels):
        reach = 0.5 / panels
        count, radius, log_light, log_depth = terms((2 * panel + 1) / (2 * panels), reach)
        ctx.dps, ctx.cap = digits + 20, count + 1

        def missed(log):
            return arb(0, 1) * arb(2) ** math.ceil(log - count * math.log2(radius / reach) + 1)

        x = arb_series([arb(2 * panel + 1) / (2 * panels), 1], count + 1)
        emission, extinction = medium(x)
        depth, edge = extinction.integral(), arb(1) / (2 * panels)
        before = -(at(depth, -edge) + missed(log_depth))
        found = (emission * extinction * (-depth).exp()).integral()
        light += transmittance * (-before).exp() * (at(found, edge) - at(found, -edge) + missed(log_light))
        transmittance *= (-(before + at(depth, edge) + missed(log_depth))).exp()
    return light


value = nested() if kind == "nested" else taylor(int(sys.argv[3]))
print(value.str(digits, radius=True))
