"""The steps of action.yml, as a runner runs them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import volver._program

ROOT = Path(__file__).resolve().parents[2]
KERNEL = """\
import sys
sys.path.insert(0, "{kernels}")
import math
import volver_kernel

def render(task):
    edges, middles = task["data"]["edges"]["lambda"], task["data"]["{samples}"]
    radiance, depth = [0.0 for _ in task["channels"]], 0.0
    for i in range(task["segments"]):
        step = middles["extinction"][i] * (edges[i + 1] - edges[i])
        weight = math.exp(-depth) * -math.expm1(-step)
        radiance = [r + weight * c[i] for r, c in zip(radiance, middles["emission"])]
        depth += step
    return radiance

volver_kernel.serve({{"name": "mine", "form": "segments", "order": 2}}, render)
"""


def run(step: str, folder: Path, **environment: str) -> tuple[str, dict[str, str]]:
    """What a step prints, and its outputs."""
    output = folder / "output"
    output.write_text("")
    path = os.path.dirname(volver._program.program()) + os.pathsep + os.environ["PATH"]
    files = {"GITHUB_OUTPUT": str(output), "GITHUB_STEP_SUMMARY": str(folder / "summary"), "RUNNER_TEMP": str(folder)}
    ran = subprocess.run(
        [str(ROOT / "python" / "action"), step],
        env={**os.environ, "PATH": path, **files, **environment},
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return ran.stdout, dict(line.split("=", 1) for line in output.read_text().splitlines())


def kernel(folder: Path, samples: str) -> str:
    path = folder / "kernel.py"
    path.write_text(KERNEL.format(kernels=ROOT / "examples" / "kernels", samples=samples))
    return f"{sys.executable} kernel.py"


def test_a_kernel_is_verified_reported_and_annotated(tmp_path: Path) -> None:
    cases = {"CASES": "sine-squared,thick", "ARGUMENTS": "--ladder 8..256"}
    _, outputs = run("verify", tmp_path, KERNEL=kernel(tmp_path, "middles"), **cases)
    assert outputs["code"] == "0" and outputs["conclusion"] == "confirmed"
    printed, _ = run("annotate", tmp_path, REPORT=outputs["report"])
    assert "::error" not in printed and "sine-squared" in (tmp_path / "summary").read_text()
    assert (Path(outputs["report"]) / "index.html").exists()

    _, outputs = run("verify", tmp_path, KERNEL=kernel(tmp_path, "edges"), **cases)
    assert outputs["code"] == "1" and outputs["conclusion"] == "not confirmed"
    printed, _ = run("annotate", tmp_path, REPORT=outputs["report"])
    assert "::error title=volver%3A sine-squared::" in printed

    # A baseline lets what is known pass.
    program = volver._program.program()
    words = ["--cases", "sine-squared,thick", "--ladder", "8..256", "--save", "base.json", "--quiet"]
    subprocess.run([program, "verify", *words, sys.executable, "kernel.py"], cwd=tmp_path, capture_output=True)
    _, outputs = run("verify", tmp_path, KERNEL=f"{sys.executable} kernel.py", BASELINE="base.json", **cases)
    assert outputs["code"] == "0" and outputs["conclusion"] == "not confirmed"


def test_a_kernel_that_cannot_run_is_no_success(tmp_path: Path) -> None:
    _, outputs = run("verify", tmp_path, KERNEL="no-such-program")
    assert outputs["code"] == "2" and outputs["conclusion"] == "could not run" and "report" not in outputs
