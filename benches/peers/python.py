#!/usr/bin/env python3
"""What volver from Python costs: a function of NumPy beside the same kernel in C as a library.

    python benches/peers/python.py [ROUNDS]      # in an environment with volver's wheel and NumPy; needs cc

Processor time, user and system, of whole processes and all their children, in turn; medians and quartiles. Both verify
the same cases with the same levels, and what they report is compared first. Then the cost of a ray: that of this package
alone, with a function that computes nothing.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FUNCTION = '''
import json, sys, time
import numpy as np, volver

def render(ray):
    depth = ray.middles.extinction * ray.lengths
    before = np.append(0, np.cumsum(depth[:-1]))
    return (np.exp(-before) * -np.expm1(-depth)) @ ray.middles.emission

def nothing(ray):
    return zeros[len(ray.channels)]

zeros = [np.zeros(k) for k in range(64)]
count = 0

def counted(ray):
    global count
    count += 1
    return nothing(ray)

if sys.argv[1] == "verify":
    found = volver.verify(render, name="marcher", order=2, cases="@first")
    print(json.dumps([[line.name, line.verdict, line.order] for line in found.lines]))
elif sys.argv[1] == "again":
    for _ in range(5):
        volver.verify(render, name="marcher", order=2, cases="@first")
elif sys.argv[1] == "import":
    pass
else:
    spent = []
    for replicas in 8, 88:
        count, before = 0, time.process_time()
        volver.verify(counted, stochastic=True, replicas=replicas, cases="@first", ladder="4..64", identify="off")
        spent.append((count, time.process_time() - before))
    # The difference: what a run costs besides its rays is in both.
    (few, less), (many, more) = spent
    print(json.dumps([many - few, more - less]))
'''


def cost(command):
    """Seconds of the processor of a process and its children, and what it prints."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    out = process.stdout.read()
    _, _, usage = os.wait4(process.pid, 0)
    return usage.ru_utime + usage.ru_stime, out


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    import volver._program

    program = volver._program.program()
    with tempfile.TemporaryDirectory() as folder:
        library, script, result = (str(Path(folder) / name) for name in ("marcher.so", "function.py", "result.json"))
        source = str(ROOT / "examples" / "cmake" / "marcher.c")
        subprocess.run(["cc", "-O2", "-shared", "-fPIC", f"-I{ROOT / 'include'}", source, "-o", library, "-lm"], check=True)
        Path(script).write_text(FUNCTION)
        inside = [program, "verify", "--cases", "@first", "--quiet", "--json", result, library]
        outside = [sys.executable, script, "verify"]
        cost(inside)
        with open(result) as file:
            lines = [[line["name"], line["verdict"], line["order"]] for line in json.load(file)["lines"]]
        same = json.loads(cost(outside)[1])
        verdicts = [line[:2] for line in lines] == [line[:2] for line in same]
        apart = max(abs(a[2] - b[2]) for a, b in zip(lines, same) if a[2] is not None and b[2] is not None)
        print(f"{len(lines)} channels, verdicts {'the same' if verdicts else 'NOT the same'}, orders at most {apart:.1e} apart")
        seconds = {"C library": [], "NumPy": [], "import": [], "again": []}
        for _ in range(rounds):
            seconds["C library"].append(cost(inside)[0])
            seconds["NumPy"].append(cost(outside)[0])
            seconds["import"].append(cost([sys.executable, script, "import"])[0])
            # What one more takes in the same process, of five.
            five = cost([sys.executable, script, "again"])[0]
            seconds["again"].append((five - seconds["NumPy"][-1]) / 4)
        for what, all_ in seconds.items():
            low, middle, high = statistics.quantiles(all_, n=4)
            print(f"{what:10} {middle:.3f} s ({low:.3f} to {high:.3f})")
        ratios = sorted(b / a for a, b in zip(seconds["C library"], seconds["NumPy"]))
        print(f"ratio {statistics.median(ratios):.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f})")
        less = sorted((b - c) / a for a, b, c in zip(seconds["C library"], seconds["NumPy"], seconds["import"]))
        print(f"without the start of Python and the imports {statistics.median(less):.3f}")
        again = sorted(b / a for a, b in zip(seconds["C library"], seconds["again"]))
        print(f"once more in the same process {statistics.median(again):.3f} ({again[0]:.3f} to {again[-1]:.3f})")
        each = []
        for _ in range(rounds):
            count, spent = json.loads(cost([sys.executable, script, "ray"])[1])
            each.append(1e6 * spent / count)
        print(f"a ray {statistics.median(each):.2f} µs ({min(each):.2f} to {max(each):.2f}), {count} rays")
        starts = []
        for _ in range(max(rounds, 15)):
            code = "import time; t = time.perf_counter(); import volver; print(time.perf_counter() - t)"
            starts.append(1e3 * float(cost([sys.executable, "-c", code])[1]))
        print(f"import volver {statistics.median(starts):.1f} ms ({min(starts):.1f} to {max(starts):.1f})")


if __name__ == "__main__":
    main()
