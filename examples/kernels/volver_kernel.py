"""What a kernel in Python needs to talk to volver: docs/protocol.md, versions 1 and 2.

    import volver_kernel
    volver_kernel.serve({"name": "mine", "form": "segments"}, render)

render(task) is given a task of the protocol as a dictionary, and returns the radiances, one a channel, or a
dictionary with "radiance" and what else a result may hold; with "answers" in the declaration what these name. What it
raises becomes the task's error. It may print.
Arrays are array.array("d"), which numpy.asarray takes without a copy; with "arrays": "json" they are lists.

With "batch": N in the declaration, render(frame) is given up to N rays at once: a dictionary of "rays", "channels",
"cases" and the blocks of the protocol ("offsets", "edges_extinction" …) as memoryviews of their shape, which
numpy.asarray takes without a copy. It returns a dictionary of "radiance", of shape (rays, channels), and what else is
declared, of shape (rays,): arrays of binary64, of NumPy or of array.array, or lists.
"""

import array
import json
import math
import os
import sys
import traceback


def serve(declaration, render):
    """Greets with the declaration, and renders task after task until volver closes the pipe."""
    if os.environ.get("VOLVER_PROTOCOL") != "1":
        sys.exit(f"started by volver alone: volver verify python3 {sys.argv[0]}")
    requests = os.fdopen(int(os.environ["VOLVER_REQUESTS"]), "rb")
    answers = os.fdopen(int(os.environ["VOLVER_ANSWERS"]), "wb")

    def answer(message):
        answers.write(json.dumps(message).encode() + b"\n")
        answers.flush()

    requests.readline()  # volver's greeting, which has nothing that a kernel needs
    # From some hundred numbers on files are much faster than text.
    protocol = 2 if declaration.keys() & {"answers", "gradient", "batch", "background"} else 1
    answer({"type": "hello", "protocol": protocol, "arrays": "npy", **declaration})
    for line in requests:
        if line.startswith(b'{"type":"frame"'):
            header, blocks = _framed(render, json.loads(line), requests)
            answers.write(json.dumps(header).encode() + b"\n")
            answers.writelines(blocks)
            answers.flush()
            continue
        request = json.loads(line, object_hook=_loaded)
        if b'nan"' in line or b'inf"' in line:
            request = _floats(request)
        results = [_result(render, task) for task in request["tasks"]]
        answer({"type": "answer" if protocol == 2 else "radiance", "id": request["id"], "results": results})


def _framed(render, frame, requests):
    """The line of the answer to many rays, and what stands behind it."""
    data = memoryview(requests.read(frame["bytes"]))
    for block in frame.pop("blocks"):
        own, data = data[: 8 * math.prod(block["shape"])], data[8 * math.prod(block["shape"]) :]
        kind = {"<f8": "d", "<i8": "q", "<u8": "Q"}[block["type"]]
        if sys.byteorder == "big":
            values = array.array(kind, bytes(own))
            values.byteswap()
            own = memoryview(values).cast("B")
        frame[block["name"]] = own.cast(kind, block["shape"]) if len(own) else own.cast(kind)
    answer = {"type": "frame", "id": frame["id"]}
    try:
        result = render(frame)
        named = {name: _block(name, values) for name, values in result.items() if name != "errors"}
    except Exception as error:
        traceback.print_exc()
        return {**answer, "error": f"{type(error).__name__}: {error}"}, []
    if "errors" in result:
        answer["errors"] = result["errors"]
    answer["blocks"] = [{"name": name, "type": kind, "shape": shape} for name, (kind, shape, _) in named.items()]
    answer["bytes"] = sum(len(block) for _, _, block in named.values())
    return answer, [block for _, _, block in named.values()]


def _block(name, values):
    """Its type, its shape and its bytes."""
    kind = "q" if name == "segments" else "d"
    if isinstance(values, list):
        rows = values if values and isinstance(values[0], list) else None
        flat = array.array(kind, sum(rows, []) if rows else values)
        shape = [len(values), len(rows[0])] if rows else [len(values)]
        view = memoryview(flat)
    else:
        view = memoryview(values)
        shape = list(view.shape)
        if view.format.lstrip("@=<") not in (kind, "l" if kind == "q" else kind):
            raise TypeError(f"'{name}' of numbers '{view.format}' (allowed: '{kind}', in NumPy .astype({'int' if kind == 'q' else 'float'}))")
    block = view.tobytes()
    if sys.byteorder == "big":
        swapped = array.array(kind, block)
        swapped.byteswap()
        block = swapped.tobytes()
    return ("<i8" if kind == "q" else "<f8"), shape, block


def _result(render, task):
    try:
        result = render(task)
    except Exception as error:
        traceback.print_exc()
        return {"error": f"{type(error).__name__}: {error}"}
    return _texts(result if isinstance(result, dict) else {"radiance": list(result)})


def _loaded(value):
    """The array itself in place of the file that holds it."""
    if "npy" not in value:
        return value
    with open(value["npy"], "rb") as file:
        content = file.read()
    values = array.array("d", content[10 + int.from_bytes(content[8:10], "little") :])
    if sys.byteorder == "big":
        values.byteswap()
    return values


def _texts(value):
    """NaN and infinities as text: JSON has no numbers for them."""
    if isinstance(value, dict):
        return {key: _texts(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_texts(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value


def _floats(value):
    """And as numbers again."""
    if isinstance(value, dict):
        return {key: _floats(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_floats(item) for item in value]
    return float(value) if isinstance(value, str) and value in ("nan", "inf", "-inf") else value
