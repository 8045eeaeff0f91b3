"""A kernel that takes many rays at once, in frames or as text: framed.py frames|json MODE FILE; its process numbers are
appended to FILE.

It reads the blocks by itself, with nothing but the document. Where it behaves it composites samples in the middles, and
answers the radiance alone; in the mode "parts" it answers pieces of what it was given.
"""

import json
import math
import os
import struct
import sys
import time

HOW, MODE, FILE = sys.argv[1:]
with open(FILE, "a") as file:
    file.write(f"{os.getpid()}\n")
requests = os.fdopen(3, "rb")
answers = os.fdopen(4, "wb")


def send(message, data=b""):
    answers.write(json.dumps(message).encode() + b"\n" + data)
    answers.flush()


def blocks_of(frame):
    """Name to rows of numbers."""
    data = requests.read(frame["bytes"])
    assert len(data) == frame["bytes"]
    found, at = {}, 0
    for block in frame["blocks"]:
        count = math.prod(block["shape"])
        letter = {"<f8": "d", "<i8": "q", "<u8": "Q"}[block["type"]]
        numbers = struct.unpack_from(f"<{count}{letter}", data, at)
        at += 8 * count
        last = block["shape"][-1]
        rows = [numbers[i : i + last] for i in range(0, count, last)]
        found[block["name"]] = rows if len(block["shape"]) == 2 else rows[0]
    assert at == len(data)
    return found


def rays_of_frame(frame):
    """As tasks of the protocol's other requests."""
    blocks, rays = blocks_of(frame), []
    offsets = blocks["offsets"]
    for ray in range(frame["rays"]):
        first, end = offsets[ray], offsets[ray + 1]

        def samples(name, first, end):
            emission = [row[first:end] for row in blocks[name + "_emission"]]
            return {
                "lambda": blocks[name + "_lambda"][first:end],
                "extinction": blocks[name + "_extinction"][first:end],
                "emission": emission,
            }

        rays.append(
            {
                "case": frame["cases"][blocks["case"][ray]],
                "channels": frame["channels"],
                "length": blocks["length"][ray],
                "step": blocks["step"][ray],
                "segments": end - first,
                "seed": blocks["seed"][ray],
                "background": blocks["background"][ray] if "background" in blocks else None,
                "data": {
                    "edges": samples("edges", first + ray, end + ray + 1),
                    "middles": samples("middles", first, end),
                },
            }
        )
    return rays


def lengths_of(ray):
    edges = ray["data"]["edges"]["lambda"]
    return [back - front for front, back in zip(edges, edges[1:])]


def composite(lengths, samples, through=1.0):
    radiance, depth = [0.0] * len(samples["emission"]), -math.log(through)
    for i, (length, extinction) in enumerate(zip(lengths, samples["extinction"])):
        weight = math.exp(-depth) * -math.expm1(-extinction * length)
        radiance = [total + weight * emission[i] for total, emission in zip(radiance, samples["emission"])]
        depth += extinction * length
    return radiance, math.exp(-depth)


def padded(values, count):
    return list(values) + [values[-1]] * (count - len(values))


def render(rays):
    """The radiances of all rays, each with what it takes over from the others in the modes that leak."""
    longest = max(ray["segments"] for ray in rays)
    first_lengths, through, found = lengths_of(rays[0]), 1.0, []
    for ray in rays:
        lengths, samples = lengths_of(ray), ray["data"]["middles"]
        if MODE == "step":
            lengths = [rays[0]["step"]] * len(lengths)
        elif MODE == "first-lengths":
            lengths = [first_lengths[0]] * len(lengths)
        elif MODE == "padding":
            lengths = padded(lengths, longest)
            emission = [padded(row, longest) for row in samples["emission"]]
            samples = {"extinction": padded(samples["extinction"], longest), "emission": emission}
        radiance, left = composite(lengths, samples, through)
        if MODE == "transmittance":
            through = left
        if MODE == "sum" and found:
            radiance = [own + 0.1 * other for own, other in zip(radiance, found[-1])]
        found.append(radiance)
    if MODE == "last-ray" and len(rays) > 1:
        found[-1] = [math.nextafter(value, 2.0) for value in found[-1]]
    return found


def block(name, rows, kind="<f8"):
    wide = isinstance(rows[0], (list, tuple))
    flat = [value for row in rows for value in row] if wide else list(rows)
    shape = [len(rows), len(rows[0])] if wide else [len(rows)]
    letter = {"<f8": "d", "<i8": "q", "<u8": "Q"}[kind]
    return {"name": name, "type": kind, "shape": shape}, struct.pack(f"<{len(flat)}{letter}", *flat)


def frame_of(request, *blocks, **more):
    data = b"".join(data for _, data in blocks)
    header = {"type": "frame", "id": request["id"], "bytes": len(data), "blocks": [head for head, _ in blocks]}
    return {**header, **more}, data


def answer(request, rays):
    if MODE == "dies-at-7" and any(ray["segments"] == 7 for ray in rays):
        os._exit(9)
    if MODE == "together-dies" and len(rays) > 1:
        os._exit(9)
    radiance = render(rays)
    if HOW == "json":
        send({"type": "answer", "id": request["id"], "results": [{"radiance": row} for row in radiance]})
        return
    count, own = len(rays), block("radiance", radiance)
    if MODE == "parts":
        edges = [ray["data"]["edges"] for ray in rays]
        first = [[ray["seed"], ray["length"], ray["step"]] for ray in rays]
        opacity = [samples["lambda"][-1] for samples in edges]
        depth = [samples["emission"][2][0] - samples["extinction"][-1] for samples in edges]
        expected = [ray["background"][1] + len(ray["case"]) for ray in rays]
        blocks = [block("expected_depth", expected), block("radiance", first), block("opacity", opacity)]
        send(*frame_of(request, *blocks, block("optical_depth", depth)))
    elif MODE == "used":
        segments = block("segments", [0, *range(2, count + 1)], "<i8")
        steps = block("step", [1.0] * (count - 1) + [math.inf])
        errors = block("standard_error", [[0.5] * len(row) for row in radiance])
        send(*frame_of(request, own, segments, steps, errors))
    elif MODE == "nan":
        send(*frame_of(request, block("radiance", [[math.nan] * len(row) for row in radiance])))
    elif MODE == "refuses":
        send({"type": "frame", "id": request["id"], "error": "no memory"})
    elif MODE == "refuses-many" and count > 1:
        send({"type": "frame", "id": request["id"], "error": "no memory"})
    elif MODE == "refuses-one":
        send(*frame_of(request, own, errors=[{"ray": count - 1, "error": "too thick"}]))
    elif MODE == "wrong-shape":
        send(*frame_of(request, block("radiance", [row[0] for row in radiance])))
    elif MODE == "wrong-type":
        send(*frame_of(request, block("radiance", [[1]] * count, "<i8")))
    elif MODE == "undeclared":
        send(*frame_of(request, own, block("opacity", [0.5] * count)))
    elif MODE == "missing":
        send(*frame_of(request, block("step", [0.5] * count)))
    elif MODE == "no-frame":
        send({"type": "answer", "id": request["id"], "results": [{"radiance": row} for row in radiance]})
    elif MODE == "wrong-id":
        send(*frame_of(request, own, id=request["id"] + 1))
    elif MODE == "too-much":
        send(*frame_of(request, own, bytes=8_000_000_000))
    elif MODE == "sizes":
        send(*frame_of(request, own, bytes=8 * count + 8))
    elif MODE == "huge":
        send(*frame_of(request, ({"name": "radiance", "type": "<f8", "shape": [2**62, 2**62]}, b"")))
    elif MODE == "negative":
        send(*frame_of(request, ({"name": "radiance", "type": "<f8", "shape": [-1, 1]}, b"")))
    elif MODE == "twice":
        send(*frame_of(request, own, own))
    elif MODE == "unknown-block":
        send(*frame_of(request, block("stdev", [0.5] * count)))
    elif MODE == "unknown-type":
        send(*frame_of(request, ({"name": "radiance", "type": "<f4", "shape": [count, 1]}, b"")))
    elif MODE == "error-beside":
        send(*frame_of(request, own, error="no memory"))
    elif MODE == "errors-outside":
        send(*frame_of(request, own, errors=[{"ray": count, "error": "too thick"}]))
    elif MODE == "errors-twice":
        send(*frame_of(request, own, errors=[{"ray": 0, "error": "a"}, {"ray": 0, "error": "b"}]))
    elif MODE in ("cut", "half"):
        header, data = frame_of(request, own)
        send(header, data[: len(data) // 2])
        if MODE == "cut":
            os._exit(0)
        time.sleep(1000)
    elif MODE == "slow":
        # What comes by itself is read by itself.
        header, data = frame_of(request, own)
        send(header)
        for byte in data:
            time.sleep(0.01)
            answers.write(bytes([byte]))
            answers.flush()
    elif MODE == "behind":
        send(*frame_of(request, own))
        answers.write(b"more")
        answers.flush()
    else:
        send(*frame_of(request, own))


requests.readline()
hello = {"type": "hello", "protocol": 2, "name": MODE, "form": "segments"}
if HOW == "frames":
    hello["batch"] = 3 if MODE == "three" else 4096
if MODE == "parts":
    hello.update(answers=["radiance", "opacity", "optical_depth", "expected_depth"], background=True)
send(hello)
for line in requests:
    request = json.loads(line)
    with open(FILE + ".asked", "a") as file:
        file.write(f"{request['type']} {request.get('rays') or len(request['tasks'])}\n")
    answer(request, rays_of_frame(request) if HOW == "frames" else request["tasks"])
