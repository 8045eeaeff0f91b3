"""A kernel that misbehaves as it is told: kernel.py MODE FILE; its process numbers are appended to FILE.

Where it behaves, the radiance of every channel is the number of segments.
"""

import json
import os
import signal
import subprocess
import sys
import time

MODE, FILE = sys.argv[1:]
with open(FILE, "a") as file:
    file.write(f"{os.getpid()}\n")
with open(FILE) as file:
    STARTS = len(file.readlines())
NOISE = 10 << 20

requests = os.fdopen(3, "rb")
answers = os.fdopen(4, "wb")


def send(text):
    answers.write(text.encode())
    answers.flush()


def greet(**more):
    hello = {"type": "hello", "protocol": 1, "name": MODE, "form": "segments", **more}
    send(json.dumps({key: value for key, value in hello.items() if value is not None}) + "\n")


def answer(request, **more):
    results = [result(task) for task in request["tasks"]]
    send(json.dumps({"type": "radiance", "id": request["id"], "results": results, **more}) + "\n")


def result(task):
    return {"radiance": [task["segments"]] * len(task["channels"])}


def hang():
    time.sleep(1000)


def descendant():
    """A process of the same group that holds all pipes open and does not listen."""
    code = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); time.sleep(1000)"
    subprocess.Popen([sys.executable, "-S", "-c", code], pass_fds=(3, 4))


def told(word):
    """What it was told at its end goes to a file of its own."""
    with open(FILE + ".told", "a") as file:
        file.write(word + "\n")


def terminated(number, frame):
    told("terminated")
    os._exit(0)


if MODE == "told":
    signal.signal(signal.SIGTERM, terminated)
if MODE == "exits":
    for line in ["first", "second", "", "no module named torch", "giving up"]:
        print(line, file=sys.stderr)
    sys.exit(3)
if MODE == "dies":
    os.kill(os.getpid(), signal.SIGKILL)
if MODE == "never-greets":
    descendant()
    hang()
if MODE == "noisy-start":
    send("x" * NOISE)
if MODE == "greets-on-stdout":
    print("hello, I am a kernel")
    hang()
if MODE == "slow-start":
    time.sleep(2)
if MODE == "very-slow-start":
    time.sleep(30)
if MODE == "half-greeting":
    send('{"type":"hello"')
    sys.exit(0)

requests.readline()
# What is to be so when volver goes on comes before the greeting.
if MODE == "closes-requests":
    requests.close()
if MODE == "does-not-end":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
if MODE == "leaves-descendant":
    descendant()
if MODE == "unknown-key":
    greet(metod="nerf")
elif MODE == "version-3":
    greet(protocol=3, dialect="other")
elif MODE == "no-name":
    greet(name=None)
elif MODE == "function":
    greet(form="function")
elif MODE == "changes" and STARTS > 1:
    greet(format="f32", order=2)
elif MODE == "volume":
    greet(form="volume")
elif MODE == "formula":
    greet(form="formula", language="python")
elif MODE == "hexadecimal":
    greet(numbers="hexadecimal")
elif MODE == "npy":
    greet(arrays="npy")
elif MODE == "wide":
    greet(format="mpfr:200")
else:
    greet()

if MODE == "does-not-read":
    hang()
if MODE == "closes-requests":
    hang()
if MODE == "closes-answers":
    requests.readline()
    answers.close()
    hang()

for line in requests:
    request = json.loads(line)
    task = request["tasks"][0]
    data = task["data"]
    if MODE == "never-answers":
        hang()
    elif MODE == "descendant":
        descendant()
        hang()
    elif MODE == "garbage":
        send("Traceback (most recent call last):\n")
    elif MODE == "garbage-once" and STARTS == 1:
        send("\x1b[2J\0\xff\n")
    elif MODE == "told":
        send("?\n")
    elif MODE == "half-words":
        # A word begun before the answer ends behind it.
        for word in ["half", None, " a word\nand half"]:
            if word is None:
                answer(request)
            else:
                print(word, end="", file=sys.stderr, flush=True)
            time.sleep(0.3)
    elif MODE == "not-an-answer":
        send('{"type":"radiance","id":1,"results":[{"radiance":["much"]}]}\n')
    elif MODE == "half-line":
        send('{"type":"radiance","id":')
        sys.exit(0)
    elif MODE == "wrong-id":
        answer(request, id=request["id"] + 1)
    elif MODE == "text-id":
        answer(request, id="7")
    elif MODE == "out-of-order" and STARTS == 1:
        # The answer of the request after this one first.
        answer(request, id=request["id"] + 1)
        answer(request)
    elif MODE == "twice":
        answer(request)
        answer(request)
    elif MODE == "nan":
        send(json.dumps({"type": "radiance", "id": request["id"], "results": [{"radiance": [float("nan")]}]}) + "\n")
    elif MODE == "nan-text":
        answer(request, results=[{"radiance": ["nan"], "opacity": "-inf"}])
    elif MODE == "noise-line":
        send("x" * NOISE)
        answer(request)
    elif MODE == "noise-lines":
        send("noise\n" * (NOISE // 6))
        answer(request)
    elif MODE == "noise-stdout":
        print("x" * NOISE)
        print("the end", flush=True)
        answer(request)
    elif MODE == "noise-stderr":
        print("x" * NOISE, file=sys.stderr)
        print("\x1b[31mthe end", file=sys.stderr, flush=True)
        send("?\n")
    elif MODE == "prints":
        # In one piece each: printed unbuffered, a text and its end come apart, and another line may come between.
        os.write(1, b'{"type":"radiance","id":1,"results":[]}\n')
        os.write(2, b"rendering\n")
        answer(request)
    elif MODE == "dies-at-7" and any(task["segments"] == 7 for task in request["tasks"]):
        os.kill(os.getpid(), signal.SIGSEGV)
    elif MODE == "too-few":
        answer(request, results=[])
    elif MODE == "too-many-channels":
        answer(request, results=[{"radiance": [1, 2]}])
    elif MODE == "standard-errors":
        answer(request, results=[{"radiance": [1], "standard_error": []}])
    elif MODE == "step-zero":
        answer(request, results=[{"radiance": [1], "step": 0}])
    elif MODE == "half-a-segment":
        answer(request, results=[{"radiance": [1], "segments": 0.5}])
    elif MODE == "refuses":
        answer(request, results=[{"error": "no such case"}])
    elif MODE == "neither":
        answer(request, results=[{}])
    elif MODE == "extra-key":
        answer(request, results=[{"radiance": [1], "stdev": [1]}])
    elif MODE == "all":
        answer(request, results=[{"radiance": ["0x1.8p-3"], "opacity": 0.5, "step": "0.25", "segments": 4, "standard_error": [1e-3]}])
    elif MODE == "wide":
        answer(request, results=[{"radiance": ["0." + "3" * 60]}])
    elif MODE == "hexadecimal":
        total = sum(float.fromhex(x) for x in data["edges"]["extinction"])
        answer(request, results=[{"radiance": [total, float.fromhex(task["step"]), float.fromhex(task["length"])][: len(task["channels"])]}])
    elif MODE == "npy":
        with open(data["middles"]["extinction"]["npy"], "rb") as file:
            content = file.read()
        print(os.path.dirname(data["middles"]["extinction"]["npy"]), flush=True)
        values = memoryview(content[-8 * task["segments"] :]).cast("d")
        assert content.startswith(b"\x93NUMPY") and b"'<f8'" in content, content
        answer(request, results=[{"radiance": [sum(values)]}])
    elif MODE == "volume":
        answer(request, results=[{"radiance": [len(data["field"]) + len(data["table"]["extinction"]) / 100]}])
    elif MODE == "formula":
        names = {}
        exec(data["code"], names)
        answer(request, results=[{"radiance": [names["extinction"](names["field"](0.25))]}])
    else:
        answer(request)
if MODE == "does-not-end":
    hang()
if MODE == "told":
    told("end of requests")
    hang()
