"""I = integral of C tau exp(-t) for C = exp(-s^2), tau = 2 + sin(10 s^2) on [0, 1]: nested enclosures by python-flint.

usage: nested.py DIGITS; prints the CPU seconds and the radius."""

import sys
import time

from flint import acb, arb, ctx

digits = int(sys.argv[1])
ctx.dps = digits + 15
fine = arb(2) ** (-ctx.prec)
wanted = arb(10) ** (-digits)


def extinction(s):
    return 2 + (10 * s * s).sin()


def depth(x):
    # A wide ball is only asked for a bound: the range is enough.
    if x.rel_accuracy_bits() < ctx.prec // 2:
        return x * extinction(x * acb(arb(0.5, 0.5)))
    return acb.integral(lambda u, _: x * extinction(x * u), 0, 1, rel_tol=fine, abs_tol=fine)


def light(x, _):
    return (-x * x).exp() * extinction(x) * (-depth(x)).exp()


start = time.process_time()
found = acb.integral(light, 0, 1, rel_tol=wanted, abs_tol=wanted)
print(time.process_time() - start, float(found.real.rad()))
