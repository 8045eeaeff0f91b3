"""The program run beside this process, which is its kernel."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Sequence
from typing import IO

from ._errors import TimedOut
from ._guard import Ended, Guard
from ._kernel import Kernel
from ._program import Ran, end, environment, program


def run(arguments: Sequence[str], kernel: Kernel, timeout: float) -> Ran:
    """Runs the program on the kernel; whatever happens, it has ended then."""
    # Its greeting has its version: it need not be asked before.
    path = program(check=False)
    read_requests, write_requests = os.pipe()
    read_answers, write_answers = os.pipe()
    _widened(write_requests, write_answers)
    name = f"fd:{read_answers},{write_requests}"
    requests, answers = os.fdopen(read_requests, "rb", 1 << 16), os.fdopen(write_answers, "wb", 0)
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err, requests:
        try:
            process = subprocess.Popen(
                [path, *arguments, "--timeout", repr(timeout), "--", name],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
                pass_fds=(read_answers, write_requests),
                env=environment(),
                # Ctrl-C on the terminal is this process's, which ends the program.
                start_new_session=True,
            )
        except OSError:
            answers.close()
            program()
            raise
        finally:
            os.close(read_answers)
            os.close(write_requests)
        guard = Guard(process)
        try:
            try:
                kernel.serve(requests, Whole(answers), guard)  # type: ignore[arg-type]
            except (BrokenPipeError, Ended):
                # Its last words say why.
                pass
            answers.close()
            process.wait()
        except BaseException:
            end(process)
            raise
        finally:
            answers.close()
        ran = Ran(process.returncode, _text(out), _text(err))
    if not kernel.greeted:
        # It may be that it cannot run, or is another one.
        program()
    if guard.interrupted and ran.code == 2 and ": no answer in " in ran.err:
        raise TimedOut(f"{kernel.name}: no answer in {timeout:g} s (allowed: up to timeout={timeout:g})")
    if ran.code < 0:
        return Ran(2, "", f"the program was ended by signal {-ran.code}")
    return Ran(ran.code, ran.out, ran.err.replace(name, kernel.name))


class Whole:
    """Writes all of it, in as many parts as the pipe takes."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file

    def write(self, data: bytes) -> None:
        view = memoryview(data)
        while view:
            view = view[self._file.write(view) :]

    def flush(self) -> None:
        """Nothing is kept back."""


def _text(file: IO[bytes]) -> str:
    file.seek(0)
    return file.read().decode("utf-8", "replace")


def _widened(*pipes: int) -> None:
    """Fewer turns between the two processes, where the system has them."""
    try:
        import fcntl

        for pipe in pipes:
            fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, 1 << 20)  # type: ignore[attr-defined, unused-ignore]
    except (ImportError, AttributeError, OSError):
        pass
