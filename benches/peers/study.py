"""`volver study` beside the tables of study_total.py: values first, then processor time and peak memory.

usage: study.py VOLVER [ROUNDS] [PYTHON] [split|total] [groups]

Errors are split or total [split]; with `groups` rules of higher order are those over groups of segments.

VOLVER is the program, or several of them with commas between, compared with each other too; PYTHON has python-flint,
mpmath and numpy.
Processes run in turn, ROUNDS times [15]; times are user and system together, medians and quartiles, what starting takes (`volver
--version`, the import of the library) taken off. Of numpy it is the time inside its process, from columns to the table. Memory is the largest resident set of the whole
process (ru_maxrss), start included.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
programs = sys.argv[1].split(",")
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 15
python = sys.argv[3] if len(sys.argv) > 3 else sys.executable
peer = os.path.join(here, "study_total.py")
errors = sys.argv[4] if len(sys.argv) > 4 else "split"
groups = sys.argv[5:]
INNER = ["riemann-left", "riemann-right", "trapezoid", *(["simpson-pairs-parabola", "boole-fours"] if groups else ["simpson", "boole"])]
OUTER = ["riemann-left", "trapezoid", "simpson", "boole"]
METHODS = [f"{inner}/{outer}" for inner in INNER for outer in OUTER]
IN_PROCESS = """
import sys, time
sys.argv = ["study_total.py", "numpy", "shared", *MORE]
exec(open(PEER).read())
taken = []
for _ in range(21):
    start = time.process_time()
    shared()
    taken.append(time.process_time() - start)
print(sorted(taken)[10])
""".replace("PEER", repr(peer)).replace("MORE", repr(groups))


def study(program, bits, *more):
    return [program, "study", "--cases", "sine-squared", "--methods", ",".join(METHODS), "--formats", bits, "--levels", "4..2048", "--errors", errors, "--threads", "1", *more]


def seconds(command):
    """User and system time of a process, and its peak memory in MiB."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{command[0]} ended with {status}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def values(program, bits, part):
    with tempfile.TemporaryDirectory() as out:
        subprocess.run(study(program, bits, "--out", os.path.join(out, "study")), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        with open(os.path.join(out, "study", "study.jsonl")) as journal:
            unit = [json.loads(line) for line in journal][1]
    return {(row["method"], level["n"]): float(level[part]) for row in unit["rows"] for level in row["levels"]}


def compare(program):
    """The largest difference of any error: at 100 digits relative to it, in binary64 as it is."""
    precise = "discretization" if errors == "split" else "total"
    for library, bits, part, relative in [("flint", "mpfr:341", precise, True), ("mpmath", "mpfr:341", precise, True), ("numpy", "f64", "total", False)]:
        ours = values(program, bits, part)
        lines = subprocess.run([python, peer, library, "shared", "values", *groups], capture_output=True, text=True, check=True).stdout
        worst = 0.0
        for line in lines.splitlines():
            method, n, error = line.split()
            error = float(error)
            off = abs(ours[method, int(n)] - error)
            worst = max(worst, off / abs(error) if relative else off)
        print(f"{program}, {bits}: {part} and {library}'s errors differ by {worst:.1e} at most ({len(ours)} of them)")


commands = {
    "start of python-flint": [python, "-c", "import flint"],
    "python-flint, shared": [python, peer, "flint", "shared", *groups],
    "start of mpmath": [python, "-c", "import mpmath"],
    "mpmath, shared": [python, peer, "mpmath", "shared", *groups],
    "start of numpy": [python, "-c", "import numpy"],
    "numpy, the whole process": [python, peer, "numpy", "shared", *groups],
}
for program in programs:
    compare(program)
    commands[f"start of {program}"] = [program, "--version"]
    commands[f"{program}, mpfr:341"] = study(program, "mpfr:341")
    commands[f"{program}, f64"] = study(program, "f64")
times = {name: [] for name in [*commands, "numpy, shared"]}
memory = {name: [] for name in commands}
for _ in range(rounds):
    for name, command in commands.items():
        taken, peak = seconds(command)
        times[name].append(taken)
        memory[name].append(peak)
    inside = subprocess.run([python, "-c", IN_PROCESS], capture_output=True, text=True, check=True).stdout
    times["numpy, shared"].append(float(inside))


def row(name, start, peer_seconds):
    off = statistics.median(times[start]) if start else 0.0
    low, middle, high = (1e3 * (t - off) for t in statistics.quantiles(times[name], n=4, method="inclusive"))
    ratio = f", {middle / peer_seconds:.2f} of its peer" if peer_seconds else ""
    peak = f", {statistics.median(memory[name]):.0f} MiB" if name in memory else ""
    print(f"{name}: {middle:.1f} ms ({low:.1f} to {high:.1f}){ratio}{peak}")
    return middle


flint = row("python-flint, shared", "start of python-flint", None)
row("mpmath, shared", "start of mpmath", flint)
numpy = row("numpy, shared", None, None)
row("numpy, the whole process", "start of numpy", numpy)
for program in programs:
    row(f"{program}, mpfr:341", f"start of {program}", flint)
    row(f"{program}, f64", f"start of {program}", numpy)
