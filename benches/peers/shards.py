"""A study in one process beside the same in shards: processor time, what shards cost besides, and how even they are.

usage: shards.py VOLVER [ROUNDS [KIND]]

58 channels x 20 pairs x 6 formats x 10 levels, of each KIND of errors [total and split], by one process on two threads and by 8 shards of one thread, two at a
time; in turn, ROUNDS times [1], user and system time of all processes, medians. Then 64 shards, one at a time: the slowest beside the
mean, cut by the model of costs alone and by what the 8 shards took. Joined results are compared.
"""
import filecmp
import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

volver = os.path.abspath(sys.argv[1])
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 1
os.chdir(tempfile.mkdtemp())
INNER = ["riemann-left", "riemann-right", "trapezoid", "simpson", "boole"]
OUTER = ["riemann-left", "trapezoid", "simpson", "boole"]
methods = ",".join(f"{inner}/{outer}" for inner in INNER for outer in OUTER)
STUDY = ["study", "--cases", "@first", "--methods", methods, "--formats", "f32;f64;tf32;f16;mpfr:113;mpfr:341", "--quiet"]
# Ten each.
LEVELS = {"total": "32..16384", "split": "4..2048"}


def processor(work):
    def used():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime
    start = used()
    work()
    return used() - start


def one():
    shutil.rmtree("one", ignore_errors=True)
    subprocess.run([volver, *STUDY, "--errors", ERRORS, "--levels", LEVELS[ERRORS], "--threads", "2", "--out", "one"], check=False)


def lines(out, shards, *more):
    command = [volver, *STUDY, "--errors", ERRORS, "--levels", LEVELS[ERRORS], "--out", out, "--on", "shell", "--shards", str(shards), *more]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def parallel(commands):
    subprocess.run(["xargs", "-P", "2", "-d", "\n", "-n", "1", "sh", "-c"], input="\n".join(commands), text=True, check=True)


def eight():
    shutil.rmtree("eight", ignore_errors=True)
    parallel(lines("eight", 8))


def merge(out):
    subprocess.run([volver, "merge", out, "--quiet"], check=False)


for ERRORS in sys.argv[3:] or ["total", "split"]:
    times = [(processor(one), processor(eight))]
    join = processor(lambda: merge("eight"))
    assert filecmp.cmp("one/study.jsonl", "eight/study.jsonl", shallow=False), "not what one process writes"
    times += [(processor(one), processor(eight)) for _ in range(rounds - 1)]
    first, second = (statistics.median(column) for column in zip(*times))
    print(f"{ERRORS}: one process {first:.1f} s, 8 shards {second:.1f} s, {second / first:.3f}; joined in {join:.1f} s", flush=True)
    earlier = f"earlier-{ERRORS}"
    shutil.copytree("eight", earlier)
    for name, more in [("model", []), ("learned", ["--costs", earlier])]:
        out = f"{name}-{ERRORS}"
        # One at a time, and processor time: what waits for a processor is not slow.
        seconds = [processor(lambda: subprocess.run(["sh", "-c", line], check=True)) for line in lines(out, 64, *more)]
        merge(out)
        assert filecmp.cmp("one/study.jsonl", f"{out}/study.jsonl", shallow=False), "not what one process writes"
        with open(f"{out}/shards.json") as file:
            division = json.load(file)
        sums = [sum(division["costs"][begin:end]) for begin, end in zip([0, *division["ends"]], division["ends"])]
        uneven = [max(shards) / statistics.mean(shards) for shards in (sums, seconds)]
        print(
            f"{ERRORS}: 64 shards by the {name} costs: {sum(seconds):.1f} s in {len(division['costs'])} blocks, "
            f"the slowest {uneven[0]:.3f} of the mean as foreseen, {uneven[1]:.3f} as they took",
            flush=True,
        )
