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
declared, of shape (rays,): arrays of binary64, of NumPy or of array.array, or lists. Gradients are asked ray by ray all
the same: where it is given a task, it has "cotangents".
"""

import array
import json
import math
import os
import sys
import traceback


# Keys of a greeting that the first version of the protocol has not.
SECOND = {
    "answers", "background", "batch", "channels", "emission", "exp_ulp", "expected_depth", "expm1_ulp", "gradient",
    "noise", "output", "pow_ulp", "source", "subnormals",
}  # fmt: skip


def serve(declaration, render):
    """Greets with the declaration, and renders task after task until volver closes the pipe."""
    if os.environ.get("VOLVER_PROTOCOL") != "1":
        sys.exit(f"started by volver alone: volver verify python3 {sys.argv[0]}")
    requests = os.fdopen(int(os.environ["VOLVER_REQUESTS"]), "rb")
    answers = os.fdopen(int(os.environ["VOLVER_ANSWERS"]), "wb")

    def answer(message, blocks=()):
        answers.write(json.dumps(message).encode() + b"\n")
        answers.writelines(blocks)
        answers.flush()

    requests.readline()  # volver's greeting, which has nothing that a kernel needs
    # From some hundred numbers on files are much faster than text.
    protocol = 2 if SECOND & declaration.keys() else 1
    answer({"type": "hello", "protocol": protocol, "arrays": "npy", **declaration})
    for line in requests:
        if line.startswith(b'{"type":"frame"'):
            frame = json.loads(line)
            header, blocks = _framed(render, frame, memoryview(requests.read(frame["bytes"])))
            answer(header, blocks)
            continue
        request = json.loads(line, object_hook=_loaded)
        if b'nan"' in line or b'inf"' in line:
            request = _floats(request)
        results = [_result(render, task) for task in request["tasks"]]
        answer({"type": "answer" if protocol == 2 else "radiance", "id": request["id"], "results": results})


def _framed(render, frame, data):
    """The line that answers many rays, and the blocks behind it."""
    at = 0
    for block in frame.pop("blocks"):
        size = 8 * math.prod(block["shape"])
        frame[block["name"]] = _opened(block, data[at : at + size])
        at += size
    answer = {"type": "frame", "id": frame["id"]}
    try:
        result = dict(render(frame))
        errors = result.pop("errors", [])
        blocks = [_block(name, values) for name, values in result.items()]
    except Exception as error:
        traceback.print_exc()
        return {**answer, "error": f"{type(error).__name__}: {error}"}, []
    answer["bytes"] = sum(len(data) for _, data in blocks)
    return {**answer, "errors": errors, "blocks": [block for block, _ in blocks]}, [data for _, data in blocks]


def _opened(block, data):
    """The numbers of a block, in its shape."""
    letter = {"<f8": "d", "<i8": "q", "<u8": "Q"}[block["type"]]
    if sys.byteorder == "big":
        values = array.array(letter, bytes(data))
        values.byteswap()
        data = memoryview(values).cast("B")
    return data.cast(letter, block["shape"])


def _block(name, values):
    """The block that holds them: what it is, and its bytes."""
    letter = "q" if name == "segments" else "d"
    if isinstance(values, list):
        rows = values if isinstance(values[0], (list, tuple)) else [[value] for value in values]
        shape = [len(values), len(rows[0])] if rows is values else [len(values)]
        data = array.array(letter, [value for row in rows for value in row])
    else:
        view = memoryview(values)
        if view.itemsize != 8 or (view.format[-1] == "d") != (letter == "d"):
            wanted = "int64" if letter == "q" else "float64"
            raise TypeError(f"'{name}' of numbers '{view.format}' (allowed: '{letter}', NumPy's {wanted})")
        shape = list(view.shape)
        data = array.array(letter, view.tobytes())
    if sys.byteorder == "big":
        data.byteswap()
    return {"name": name, "type": "<i8" if letter == "q" else "<f8", "shape": shape}, data.tobytes()


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
