"""What a kernel in Python needs to talk to volver: docs/protocol.md, versions 1 and 2.

    import volver_kernel
    volver_kernel.serve({"name": "mine", "form": "segments"}, render)

render(task) is given a task of the protocol as a dictionary, and returns the radiances, one a channel, or a
dictionary with "radiance" and what else a result may hold; with "answers" in the declaration what these name. What it
raises becomes the task's error. It may print.
Arrays are array.array("d"), which numpy.asarray takes without a copy; with "arrays": "json" they are lists.
"""

import array
import json
import math
import os
import sys
import traceback


# Keys of a greeting that the first version of the protocol has not.
SECOND = {
    "answers", "background", "channels", "emission", "exp_ulp", "expected_depth", "expm1_ulp", "gradient", "noise",
    "output", "pow_ulp", "source", "subnormals",
}  # fmt: skip


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
    protocol = 2 if SECOND & declaration.keys() else 1
    answer({"type": "hello", "protocol": protocol, "arrays": "npy", **declaration})
    for line in requests:
        request = json.loads(line, object_hook=_loaded)
        if b'nan"' in line or b'inf"' in line:
            request = _floats(request)
        results = [_result(render, task) for task in request["tasks"]]
        answer({"type": "answer" if protocol == 2 else "radiance", "id": request["id"], "results": results})


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
