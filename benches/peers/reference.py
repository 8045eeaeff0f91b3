"""`volver reference` beside python-flint, and with its singularities seen beside a program of before: values first, then
processor time.

usage: reference.py VOLVER[,BEFORE] [ROUNDS] [PYTHON]

VOLVER is the program; PYTHON has python-flint. Processes run in turn, ROUNDS times [15], what takes more than a second in every
third round; times are user and system together, medians and quartiles, less the median of what is no integration: the same medium
to one digit, the import of the library; where singularities are `volver --version`, and there BEFORE is run too.
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
peer = os.path.join(here, "reference_flint.py")
FOG = ("2 + sin(10*s^2)", "exp(-s^2)")
# Taylor panels, those of 3, 4, 5, 6, 8 and 12 that took the least time when they were tried one after the other.
PANELS = {100: 3, 500: 6, 1000: 6}
SINGULAR = [("sqrt(s)", "exp(-s)"), ("sqrt(1 - s)", "exp(-s)"), ("sqrt(s*(1 - s))", "exp(-s)"), ("abs(sin(10*s))", "exp(-s)")]
KINKS = ("abs(sin(314*s))", "1")
folder = tempfile.mkdtemp()


def medium(number, formulas):
    path = os.path.join(folder, f"{number}.toml")
    with open(path, "w") as file:
        file.write(f'name = "a"\nlength = 1\nextinction = "{formulas[0]}"\nemission = "{formulas[1]}"\n')
    return path


def reference(program, path, digits, way):
    return [program, "reference", path, "--digits", str(digits), "--yes", *([] if way == "enclosure" else ["--estimate"])]


def seconds(command):
    """User and system time of a process, and whether it did what it was asked for."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return usage.ru_utime + usage.ru_stime, status == 0


def value(command):
    done = subprocess.run([*command, "--json"], capture_output=True, text=True)
    return json.loads(done.stdout)["references"][0] if done.returncode == 0 else None


def agree(a, b, digits):
    """Whether two decimal numbers are the same to so many digits, but for the last."""
    from decimal import Decimal, getcontext

    getcontext().prec = digits + 10
    return abs(Decimal(a) - Decimal(b)) <= Decimal(10) ** (1 - digits) * abs(Decimal(b))


def compare():
    for digits in (100, 500):
        found = subprocess.run([python, peer, "nested", str(digits)], capture_output=True, text=True, check=True).stdout
        nested = found.strip().strip("[").split(" ")[0]
        for way in ("enclosure", "estimate"):
            ours = value(reference(programs[0], fog, digits, way))["radiance"]
            print(f"fog, {digits} digits, {way} and flint's nested integrals agree: {agree(ours, nested, digits)}")


fog = medium("fog", FOG)
compare()
rows, commands = [], {"import": [python, "-c", "import flint"]}


def row(label, command, start, beside=None):
    commands[label] = command
    rows.append((label, start, beside))


for digits in (100, 500):
    row(f"flint nested, {digits}", [python, peer, "nested", str(digits)], "import")
for digits in (100, 500, 1000):
    row(f"flint Taylor, {digits}", [python, peer, "taylor", str(digits), str(PANELS[digits])], "import")
for program in programs[:1]:
    for way, all_digits in (("estimate", (100, 500, 1000)), ("enclosure", (100, 500))):
        commands[f"{program} fog {way} start"] = reference(program, fog, 1, way)
        for digits in all_digits:
            nested, taylor = f"flint nested, {digits}", f"flint Taylor, {digits}"
            beside = [nested] if digits < 1000 else []
            row(f"{program} fog {way}, {digits}", reference(program, fog, digits, way), f"{program} fog {way} start", [*beside, taylor])
for number, formulas in enumerate([*SINGULAR, KINKS]):
    path = medium(number, formulas)
    for way in ("estimate", "enclosure"):
        for program in programs:
            label = f"{program} {formulas[0]}, {formulas[1]}, {way}, 50"
            commands[f"{program} start"] = [program, "--version"]
            first = f"{programs[-1]} {formulas[0]}, {formulas[1]}, {way}, 50"
            row(label, reference(program, path, 50, way), f"{program} start", [first] if program != programs[-1] else [])
times = {label: [] for label in commands}
refused = set()
for turn in range(rounds):
    for label, command in commands.items():
        if turn % 3 and times[label][0] > 1:
            continue
        taken, is_good = seconds(command)
        times[label].append(taken)
        if not is_good:
            refused.add(label)
medians = {}
for label, start, _ in rows:
    off = statistics.median(times[start])
    medians[label] = [1e3 * (t - off) for t in statistics.quantiles(times[label], n=4, method="inclusive")]
for label, start, beside in rows:
    low, middle, high = medians[label]
    ratios = "".join(f", {middle / medians[other][1]:.4f} of {other}" for other in beside or [])
    whole = 1e3 * statistics.median(times[label])
    print(f"{label}: {middle:.1f} ms ({low:.1f} to {high:.1f}), {whole:.1f} with its start{ratios}{', refused' if label in refused else ''}")
