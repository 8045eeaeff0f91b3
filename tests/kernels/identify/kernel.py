"""A kernel of the protocol that marches through the middles of segments; its argument is its fault."""
import json
import math
import random
import sys
import time

fault = sys.argv[1]
requests, answers = open(3), open(4, "w")


def radiance(task):
    edges, middles = task["data"]["edges"], task["data"]["middles"]
    through, sums = 1.0, [0.0] * len(task["channels"])
    for i in range(task["segments"]):
        depth = middles["extinction"][i] * (edges["lambda"][i + 1] - edges["lambda"][i])
        if fault == "smoothed" and i:
            depth = (depth + middles["extinction"][i - 1] * task["step"]) / 2
        opacity = -math.expm1(-depth)
        for channel, emission in enumerate(middles["emission"]):
            sums[channel] += through * opacity * emission[i]
        through *= 1 - opacity
        if fault == "early-end" and through < 0.0039:
            break
    n, channels = task["segments"], len(task["channels"])
    if fault == "nan":
        sums = [math.nan] * channels
    if fault == "garbage":
        sums = [random.random() for _ in range(channels)]
    if (fault == "only-eight" and n != 8) or (fault == "three-channels" and channels != 3) or (fault == "no-single" and n == 1):
        return {"error": "not that one"}
    if fault == "dies" and n > 40:
        sys.exit(3)
    if fault == "hangs":
        time.sleep(60)
    return {"radiance": sums}


for line in requests:
    request = json.loads(line)
    if request["type"] == "hello":
        answer = {"type": "hello", "protocol": 1, "name": fault, "form": "segments"}
    else:
        results = [{"error": "no"} if fault == "refuses" else radiance(task) for task in request["tasks"]]
        answer = {"type": "radiance", "id": request["id"], "results": results}
    print(json.dumps(answer), file=answers, flush=True)
