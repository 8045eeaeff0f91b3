"""A study in one process beside the same in shards: processor time, what shards cost besides, and how even they are.

usage: shards.py VOLVER [ROUNDS]

58 channels x 20 pairs x 6 formats x 10 levels, whole errors, by one process on two threads and by 8 shards of one thread, two at a
time; in turn, ROUNDS times [3], user and system time of all processes, medians. Then 64 shards: the slowest beside the mean, of the
seconds that their units took, cut by the model of costs alone and by what the 8 shards took. Joined results are compared first.
"""
import filecmp
import glob
import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

volver = os.path.abspath(sys.argv[1])
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
os.chdir(tempfile.mkdtemp())
INNER = ["riemann-left", "riemann-right", "trapezoid", "simpson", "boole"]
OUTER = ["riemann-left", "trapezoid", "simpson", "boole"]
methods = ",".join(f"{inner}/{outer}" for inner in INNER for outer in OUTER)
STUDY = ["study", "--cases", "@first", "--methods", methods, "--formats", "f32;f64;tf32;f16;mpfr:113;mpfr:341", "--levels", "4..2048", "--quiet"]


def processor(work):
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    start = used()
    work()
    return used() - start


def one():
    shutil.rmtree("one", ignore_errors=True)
    subprocess.run([volver, *STUDY, "--errors", ERRORS, "--threads", "2", "--out", "one"], check=False)


def lines(out, shards, *more):
    command = [volver, *STUDY, "--errors", ERRORS, "--out", out, "--on", "shell", "--shards", str(shards), *more]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def parallel(commands):
    subprocess.run(["xargs", "-P", "2", "-d", "\n", "-n", "1", "sh", "-c"], input="\n".join(commands), text=True, check=True)


def eight():
    shutil.rmtree("eight", ignore_errors=True)
    parallel(lines("eight", 8))


def merge(out):
    subprocess.run([volver, "merge", out, "--quiet"], check=False)


def took(out):
    found = {}
    for path in glob.glob(f"{out}/shards/*.jsonl"):
        with open(path) as file:
            for line in list(file)[1:]:
                line = json.loads(line)
                found[line["key"], line["unit"]["case"], line["unit"]["format"]] = line["took"]
    return found


def evenness(out, seconds):
    """The slowest shard in parts of the mean."""
    with open(f"{out}/shards.json") as file:
        division = json.load(file)
    header = division["work"]["header"]
    order = [(case[0], form) for case in header["cases"] for form in header["formats"]]
    by_name = {name: value for (_, *name), value in seconds.items() for name in [tuple(name)]}
    costs = [by_name[name] for name in order]
    begins = [0, *division["ends"][:-1]]
    sums = [sum(costs[begin:end]) for begin, end in zip(begins, division["ends"])]
    return max(sums) / statistics.mean(sums), len(sums)


for ERRORS in ["total", "split"]:
    one()
    eight()
    join = processor(lambda: merge("eight"))
    assert filecmp.cmp("one/study.jsonl", "eight/study.jsonl", shallow=False), "not what one process writes"
    times = [(processor(one), processor(eight)) for _ in range(rounds)]
    first, second = (statistics.median(column) for column in zip(*times))
    print(f"{ERRORS}: one process {first:.1f} s, 8 shards {second:.1f} s, {second / first:.3f}; joined in {join:.1f} s", flush=True)
    measured = took("eight")
    earlier = f"earlier-{ERRORS}"
    shutil.copytree("eight", earlier)
    eight()
    again = took("eight")
    for name, more in [("model", []), ("learned", ["--costs", earlier])]:
        lines(f"{name}-{ERRORS}", 64, *more)
        slowest, shards = evenness(f"{name}-{ERRORS}", again)
        print(f"{ERRORS}: {shards} shards by the {name} costs: the slowest {slowest:.3f} of the mean", flush=True)
