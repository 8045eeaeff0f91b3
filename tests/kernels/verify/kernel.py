"""A renderer that composites front to back, and is wrong or misbehaves as it is told.

    kernel.py [--declare JSON] [--sampling front|middle] [--drop-last] [--unsteady] [--claim JSON]
              [--trouble WHAT [--at N] [--case NAME] [--sign FILE]]

--marker TEXT is for tests to find its process by; FILE is made when it misbehaves.
"""

import argparse
import json
import math
import os
import signal
import sys
import time

NOISE = 10 << 20

parser = argparse.ArgumentParser()
parser.add_argument("--marker")
parser.add_argument("--declare", type=json.loads, default={"method": "front-to-back/middle/subtraction"})
parser.add_argument("--sampling", choices=["front", "middle"], default="middle")
parser.add_argument("--drop-last", action="store_true")
parser.add_argument("--unsteady", action="store_true")
parser.add_argument("--claim", type=json.loads, default={})
parser.add_argument("--trouble", default="none")
parser.add_argument("--at", type=int)
parser.add_argument("--case")
parser.add_argument("--sign")
options = parser.parse_args()
trouble = options.trouble
TYPE = "answer" if options.declare.get("protocol") == 2 else "radiance"

requests = os.fdopen(3, "rb")
answers = os.fdopen(4, "wb")


def send(text):
    answers.write(text.encode())
    answers.flush()


def hang():
    time.sleep(1000)


def say_on_standard_error():
    print("loading scene\nfirst sign\nout of memory", file=sys.stderr, flush=True)


def radiance(task):
    edges = task["data"]["edges"]
    lengths = [back - front for front, back in zip(edges["lambda"], edges["lambda"][1:])]
    samples = edges if options.sampling == "front" else task["data"]["middles"]
    count = len(lengths) - options.drop_last
    found = []
    for emission in samples["emission"]:
        total, transmittance = 0.0, 1.0
        for i in range(count):
            alpha = 1.0 - math.exp(-samples["extinction"][i] * lengths[i])
            total += transmittance * alpha * emission[i]
            transmittance *= 1.0 - alpha
        if options.unsteady:
            total *= 1.0 + 1e-3 * int.from_bytes(os.urandom(2), "little") / 65536
        found.append(total)
    return found


def is_cue(task):
    """Whether this is the task to misbehave on."""
    return options.at in (None, task["segments"]) and options.case in (None, task["case"])


def answer(request, shift=0):
    results = [{"radiance": radiance(task), **(options.claim if is_cue(task) else {})} for task in request["tasks"]]
    if trouble == "nan" and any(is_cue(task) for task in request["tasks"]):
        results = [{"radiance": ["nan" for _ in task["channels"]]} for task in request["tasks"]]
    send(json.dumps({"type": TYPE, "id": request["id"] + shift, "results": results}) + "\n")


def misbehave(request):
    if options.sign:
        open(options.sign, "w").close()
    if trouble == "hangs":
        say_on_standard_error()
        hang()
    elif trouble == "garbage":
        send("Traceback (most recent call last):\n")
    elif trouble == "half-line":
        send('{"type":"radiance","id":')
        sys.exit(0)
    elif trouble == "wrong-id":
        answer(request, shift=1)
    elif trouble == "twice":
        answer(request)
        answer(request)
    elif trouble == "noise":
        send("x" * NOISE)
    elif trouble == "noise-stderr":
        print("x" * NOISE, file=sys.stderr, flush=True)
        say_on_standard_error()
        sys.exit(5)
    elif trouble == "dies":
        say_on_standard_error()
        os.kill(os.getpid(), signal.SIGSEGV)
    elif trouble == "escapes":
        print("\x1b[31mred \x1b]0;title\x07 ]]> <b>&amp; | *x*", file=sys.stderr, flush=True)
        sys.exit(7)
    elif trouble == "refuses":
        results = [{"error": "not \x1b[31m\n\u2028this one"} for task in request["tasks"]]
        send(json.dumps({"type": "radiance", "id": request["id"], "results": results}) + "\n")
    elif trouble == "prints":
        print('{"type":"radiance","id":1,"results":[]}\n' * 1000, flush=True)
        answer(request)
    else:
        answer(request)


if trouble == "start-exits":
    say_on_standard_error()
    sys.exit(3)
if trouble == "start-hangs":
    hang()
requests.readline()
if trouble == "start-garbage":
    send("hello!\n")
    hang()
if trouble == "closes-requests":
    requests.close()
hello = {"type": "hello", "protocol": 1, "name": "fixture", "form": "segments", **options.declare}
send(json.dumps(hello) + "\n")
if trouble == "closes-requests":
    hang()
if trouble == "closes-answers":
    requests.readline()
    answers.close()
    hang()

for line in requests:
    request = json.loads(line)
    if any(is_cue(task) for task in request["tasks"]):
        misbehave(request)
    else:
        answer(request)
