"""A kernel that computes nothing: nothing.py json|npy. What is left is the way there and back."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples" / "kernels"))
import volver_kernel

DECLARATION = {"name": "nothing", "form": "segments", "arrays": sys.argv[1]}
volver_kernel.serve(DECLARATION, lambda task: [0.0] * len(task["channels"]))
