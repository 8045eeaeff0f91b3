"""A kernel that computes nothing: clock.py json|npy|frames. Its radiance is the processor time that it has taken so far,
in seconds."""

import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples" / "kernels"))
import volver_kernel

if sys.argv[1] == "frames":
    DECLARATION = {"batch": 4096}
else:
    DECLARATION = {"arrays": sys.argv[1]}


def render(asked):
    now = time.process_time()
    if "rays" in asked:
        return {"radiance": [[now]] * asked["rays"]}
    return [now]


volver_kernel.serve({"name": "clock", "form": "segments", **DECLARATION}, render)
