"""Asks a kernel by the program, and gives back what was found."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile

import findings
import machine

ROOT = pathlib.Path(__file__).resolve().parents[1]


def asked(volver, python, row):
    """What volver finds of the row's kernel, as expected.json has it."""
    kernel = [python, f"gallery/{row.name}/kernel.py"]
    # Options of identify are for a run of its own; without them verify reads the rule off on the way.
    how = "off" if row.identify else "full"
    verified = _document([volver, "verify", "--quiet", "--identify", how, *row.verify], kernel, row.timeout)
    identified = verified.get("identification")
    if row.identify:
        identified = _document([volver, "identify", "--quiet", *row.identify], kernel, row.timeout)
    gradient = None
    if row.gradients:
        gradient = _document([volver, "gradient", "--quiet", *row.gradient], kernel, row.timeout)
    packages = {package: machine.debian_version(package) for package in row.apt}
    return findings.found(packages, verified, identified, gradient)


def _document(command, kernel, seconds):
    """The JSON document of that command, which may end with exit code 0 or 1."""
    with tempfile.TemporaryDirectory(prefix="volver-gallery-") as folder:
        file = pathlib.Path(folder) / "found.json"
        code, said = _ended([*command, "--json", file, *kernel], folder, seconds)
        # A kernel that cannot start may leave a document that says nothing.
        if code not in (0, 1) or not file.exists():
            lines = [line for line in said.splitlines() if line.strip()] or [f"exit code {code}"]
            raise machine.Missing(f"volver {command[1]}: {' / '.join(line.strip() for line in lines[-3:])}")
        return json.loads(file.read_text(encoding="utf-8"))


def _ended(command, folder, seconds):
    """Its exit code and what it said on standard error."""
    # These alone: packages may have modules of the names of other kernels there.
    for name in ["volver_kernel.py", "vtk_volume.py"]:
        os.symlink(ROOT / "examples" / "kernels" / name, os.path.join(folder, name))
    paths = [folder, os.environ.get("PYTHONPATH", "")]
    # One thread, no display and no GPU: so that it is the same everywhere.
    surroundings = os.environ | {
        "PYTHONPATH": os.pathsep.join(path for path in paths if path),
        "PYTHONDONTWRITEBYTECODE": "1",
        "OMP_NUM_THREADS": "1",
        "CUDA_VISIBLE_DEVICES": "",
        "JAX_PLATFORMS": "cpu",
        "LC_ALL": "C.UTF-8",
        "NO_COLOR": "1",
        "TMPDIR": folder,
    }
    surroundings.pop("DISPLAY", None)
    words = [str(word) for word in command]
    process = subprocess.Popen(
        words, cwd=ROOT, env=surroundings, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip
    try:
        _, said = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        # volver ends its kernel when it is interrupted.
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
        raise machine.Missing(f"volver {command[1]} took more than {seconds} s") from None
    return process.returncode, said
