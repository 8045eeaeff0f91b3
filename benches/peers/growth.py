"""How the processor time and the memory of `volver study --errors total` grow: with n, bits, cases and threads; as one picture.

usage: growth.py VOLVER [ROUNDS] [SVG]

What is varied is doubled, all else stays; processes run in turn, ROUNDS times [5]; times are medians of user and system time, what
the smallest process (a study of one method at n = 4) takes taken off; memory is the largest resident set (ru_maxrss). Powers are
fitted by least squares of logarithms over the last four points. Threads: time that passes,
too, which other work on the machine lengthens. Prints all figures; writes the picture where SVG is given, which takes matplotlib.
"""
import json
import math
import os
import statistics
import subprocess
import sys
import time

program = sys.argv[1]
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
picture = sys.argv[3] if len(sys.argv) > 3 else None
METHOD = "trapezoid/trapezoid"


def study(levels="4", bits="f64", cases="sine-squared", threads=1, methods=METHOD):
    return [program, "study", "--cases", cases, "--methods", methods, "--formats", bits, "--levels", levels, "--errors", "total", "--threads", str(threads)]


def measured(command):
    """Processor time, time that passes, MiB."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    # 1 is a case on which a method does not show its order.
    if (code := os.waitstatus_to_exitcode(status)) not in (0, 1):
        sys.exit(f"{' '.join(command)} ended with {code}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - start, usage.ru_maxrss / 1024


def names(count):
    """The first cases of the catalogue, by name."""
    text = subprocess.run([program, "cases", "--json", "-"], capture_output=True, text=True, check=True).stdout
    return ",".join(case["name"] for case in json.loads(text)["cases"][:count])


METHODS = "riemann-left/trapezoid,trapezoid/trapezoid,simpson/simpson,boole/boole,front-to-back/middle/expm1"
series = {
    "n, f64": [(n, study(levels=str(n))) for n in (1 << k for k in range(18, 25))],
    "n, mpfr:341": [(n, study(levels=str(n), bits="mpfr:341")) for n in (1 << k for k in range(10, 17))],
    "bits, n = 1024": [(bits, study(levels="1024", bits=f"mpfr:{bits}")) for bits in (128 << k for k in range(8))],
    "cases, five methods in mpfr:113, n to 1024": [(count, study(levels="4..1024", bits="mpfr:113", cases=names(count), methods=METHODS)) for count in (2, 4, 8, 16, 32)],
    "threads, 8 cases in mpfr:341, n to 4096": [(threads, study(levels="4..4096", bits="mpfr:341", cases=names(8), threads=threads, methods=METHODS)) for threads in (1, 2, 4)],
}
taken = {name: {x: [] for x, _ in points} for name, points in series.items()}
start = []
for _ in range(rounds):
    start.append(measured(study()))
    for name, points in series.items():
        for x, command in points:
            taken[name][x].append(measured(command))


def median(runs, which):
    return statistics.median(run[which] for run in runs)


START = median(start, 0)
print(f"start: {1e3 * START:.1f} ms, {median(start, 2):.0f} MiB")


def power(points):
    logs = [(math.log(x), math.log(y)) for x, y in points]
    if len(logs) < 2:
        return None
    mx, my = (statistics.mean(side) for side in zip(*logs))
    return sum((x - mx) * (y - my) for x, y in logs) / sum((x - mx) ** 2 for x, _ in logs)


found = {}
for name, points in taken.items():
    cpu = [(x, median(runs, 0) - START) for x, runs in points.items()]
    passing = [(x, median(runs, 1)) for x, runs in points.items()]
    peak = [(x, median(runs, 2)) for x, runs in points.items()]
    of_cpu = power([(x, y) for x, y in cpu if y > 0][-4:])
    found[name] = cpu, passing, peak, of_cpu
    fitted = "not fitted" if of_cpu is None else f"processor time as x^{of_cpu:.2f}"
    print(f"{name}: {fitted}")
    for (x, y), (_, wall), (_, mib) in zip(cpu, passing, peak):
        print(f"  {x}: {1e3 * y:.1f} ms, {1e3 * wall:.1f} ms pass, {mib:.0f} MiB")

if picture:
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "volver", "font.size": 9, "font.family": "sans-serif"})
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 4, figsize=(12, 3.2), constrained_layout=True)
    panels = [["n, f64", "n, mpfr:341"], ["bits, n = 1024"], ["cases, five methods in mpfr:113, n to 1024"], ["threads, 8 cases in mpfr:341, n to 4096"]]
    for axis, panel in zip(axes, panels):
        for name in panel:
            cpu, passing, _, of_cpu = found[name]
            label = name.split(", ", 1)[1]
            if panel[0].startswith("threads"):
                axis.plot(*zip(*passing), "s-", label="time that passes")
                axis.plot(*zip(*cpu), "o--", label="processor time, all threads")
            else:
                shown = f"{label}: power {of_cpu:.2f}" if of_cpu is not None else label
                axis.plot(*zip(*[(x, y) for x, y in cpu if y > 0]), "o-", label=shown)
        axis.set_xscale("log", base=2)
        if panel[0].startswith("threads"):
            axis.set_ylim(bottom=0)
        else:
            axis.set_yscale("log")
        axis.set_xlabel(panel[0].split(",")[0])
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7, loc="lower right" if panel[0].startswith("threads") else "upper left")
    axes[0].set_ylabel("s")
    figure.savefig(picture, metadata={"Date": None})
