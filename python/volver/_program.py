"""The program that was installed with this package, and no other version of it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from typing import NamedTuple

from ._errors import MissingError, VolverError
from ._version import VERSION

_found: dict[str, str] = {}


class Ran(NamedTuple):
    """How a run of the program ended."""

    code: int
    out: str
    err: str


def program(check: bool = True) -> str:
    """The path of the program: $VOLVER_PROGRAM, beside this interpreter, among the scripts, on the path."""
    asked = os.environ.get("VOLVER_PROGRAM", "")
    if asked in _found:
        return _found[asked]
    path = asked or _search()
    if check:
        _found[asked] = _checked(path)
    return path


def _search() -> str:
    beside = os.path.join(os.path.dirname(sys.executable), "volver")
    if os.access(beside, os.X_OK):
        return beside
    import shutil
    import sysconfig

    places = [sysconfig.get_path("scripts")]
    user = "posix_user" if os.name == "posix" else "nt_user"
    if user in sysconfig.get_scheme_names():
        places.append(sysconfig.get_path("scripts", user))
    for place in [*places, None]:
        found = shutil.which("volver", path=place)
        if found:
            return found
    raise MissingError(f"no program 'volver' in {places[0]} or on the path (allowed: pip install of volver's wheel)")


def _checked(path: str) -> str:
    wanted = f"volver {VERSION}"
    try:
        ran = subprocess.run([path, "--version"], capture_output=True, text=True, timeout=60, check=False)
    except (OSError, subprocess.SubprocessError) as error:
        raise MissingError(f"{path} does not run: {error} (allowed: the program of volver's wheel)") from None
    if ran.returncode != 0:
        last = (ran.stderr.strip().splitlines() or [f"exit code {ran.returncode}"])[-1]
        hint = "the program of a wheel made for this machine"
        if "GLIBC" in ran.stderr:
            hint = "a machine with that version of glibc or a later one, or a wheel built from source"
        raise MissingError(f"{path} does not run here: {last} (allowed: {hint})")
    if ran.stdout.strip() != wanted:
        raise MissingError(f"{path} is '{ran.stdout.strip()}' (allowed: '{wanted}', as the package)")
    return path


def run(arguments: Sequence[str], stdin: str | None = None) -> Ran:
    """Runs the program to its end; Ctrl-C ends it."""
    process = subprocess.Popen(
        [program(), *arguments],
        stdin=subprocess.DEVNULL if stdin is None else subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        env=environment(),
        start_new_session=True,
    )
    with process:
        try:
            out, err = process.communicate(stdin)
        except BaseException:
            end(process)
            raise
    return Ran(process.returncode, out, err)


def end(process: subprocess.Popen[bytes] | subprocess.Popen[str]) -> None:
    """Ends it, whatever it does."""
    process.terminate()
    try:
        process.wait(2)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def environment() -> dict[str, str]:
    """That of this process, without what is for a terminal."""
    return {**os.environ, "NO_COLOR": "1"}


def result(ran: Ran, name: str = "", kernel: str = "") -> Ran:
    """What ran, if it came to a result; `name` stands for `kernel` in what is said."""
    if ran.code in (0, 1) and not (ran.code == 1 and not ran.out):
        return ran
    lines = [line for line in ran.err.strip().splitlines() if line]
    said = lines[0].removeprefix("volver: ") if lines else f"the program ended with exit code {ran.code}"
    if kernel:
        said = said.replace(kernel, name)
    raise VolverError("\n".join([said, *lines[1:]]))
