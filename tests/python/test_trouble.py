"""Whatever a function does, one clear line comes of it and no process is left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import volver
from marchers import middle

CASE = "sine-squared"


def verify(render: Any, **options: Any) -> volver.Verification:
    options = {"order": 2, "cases": CASE, "identify": "off", **options}
    return volver.verify(render, **options)


def test_a_function_that_raises_is_heard_once_with_its_task() -> None:
    calls = []

    def raises(ray: Any) -> Any:
        calls.append(ray)
        raise ZeroDivisionError("no \n light")

    with pytest.raises(volver.RenderError, match=r"raises raised ZeroDivisionError: no light on 'sine-squared', \d+ segments") as raised:
        verify(raises)
    assert isinstance(raised.value.__cause__, ZeroDivisionError) and len(calls) == 1


class OnGpu:
    """As a tensor of a GPU looks."""

    class device:  # noqa: N801
        type = "cuda"

        def __str__(self) -> str:
            return "cuda:0"

    device = device()  # type: ignore[assignment, misc]
    dtype = "float64"
    shape = (1,)

    def detach(self) -> Any:
        raise AssertionError("it is not to be copied")


@pytest.mark.parametrize(
    "answer, words",
    [
        (lambda ray: np.zeros(3), r"radiance of shape \(3,\) on 'sine-squared', .* \(allowed: \(1,\) or \(\)\)"),
        (lambda ray: np.zeros(ray.count), r"radiance of shape \(\d+,\)"),
        (lambda ray: np.zeros(1, np.float32), r"radiance of float32 on .*allowed: float64, .*dtype='float32' in the call"),
        (lambda ray: np.zeros(1, np.complex128), r"radiance of complex128 on .*allowed: float64, as the rays have\)"),
        (lambda ray: np.zeros(1, int), r"radiance of int64 on "),
        (lambda ray: None, r"an answer of None on .*allowed: radiance"),
        (lambda ray: "dark", r"radiance of "),
        (lambda ray: object(), r"radiance of object on .*allowed: arrays of numbers"),
        (lambda ray: {"radiance": 0.0, "opacity": 0.0}, r"an answer of radiance, opacity on .*allowed: radiance, as declared"),
        (lambda ray: {}, r"an answer of  on "),
        (lambda ray: OnGpu(), r"radiance on the device 'cuda:0' on .*allowed: on the CPU, as radiance.cpu\(\)"),
    ],
)
def test_what_is_no_answer_is_named(answer: Any, words: str) -> None:
    with pytest.raises(volver.RenderError, match=words) as raised:
        verify(answer)
    assert "\n" not in str(raised.value)


def test_nan_is_an_answer() -> None:
    found = verify(lambda ray: middle(ray) * np.nan)
    assert not found.passed and found.lines[0].verdict == "NotFinite"


def test_a_function_that_hangs_in_the_background_is_interrupted() -> None:
    """Jobs that a shell starts with & ignore SIGINT."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    start = time.monotonic()
    try:
        with pytest.raises(volver.TimedOut):
            verify(lambda ray: time.sleep(600), timeout=0.5)
    finally:
        signal.signal(signal.SIGINT, before)
    assert time.monotonic() - start < 60 and signal.getsignal(signal.SIGURG) is signal.SIG_DFL


def test_a_function_that_hangs_is_interrupted() -> None:
    start = time.monotonic()
    with pytest.raises(volver.TimedOut, match=r"no answer in 0.5 s \(allowed: up to timeout=0.5\)"):
        verify(lambda ray: time.sleep(600), timeout=0.5)

    def busy(ray: Any) -> Any:
        while True:
            pass

    with pytest.raises(volver.TimedOut):
        verify(busy, timeout=0.5)

    def stubborn(ray: Any) -> Any:
        while True:
            try:
                time.sleep(600)
            except KeyboardInterrupt:
                return 0.0

    with pytest.raises(volver.TimedOut):
        verify(stubborn, timeout=0.5)
    assert time.monotonic() - start < 30


def test_a_function_that_hangs_in_another_thread_is_interrupted_too() -> None:
    said: list[BaseException] = []

    def run() -> None:
        def busy(ray: Any) -> Any:
            while True:
                pass

        try:
            verify(busy, timeout=0.5)
        except BaseException as error:  # noqa: BLE001
            said.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join(30)
    assert not thread.is_alive() and isinstance(said[0], volver.TimedOut)


def test_prints_do_no_harm(capfd: pytest.CaptureFixture[str]) -> None:
    def prints(ray: Any) -> Any:
        print("x" * 10_000)
        os.write(1, b"y" * 10_000)
        return middle(ray)

    assert verify(prints).passed
    assert capfd.readouterr().out.count("x") > 10_000


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_function_that_forks_is_asked_on() -> None:
    def forks(ray: Any) -> Any:
        child = os.fork()
        if child:
            os.waitpid(child, 0)
        # The child returns as well.
        return middle(ray)

    assert verify(forks).passed
    assert verify(lambda ray: subprocess.run(["true"], check=True) and middle(ray)).passed


def script(tmp_path: Path, text: str, **environment: str) -> subprocess.Popen[str]:
    path = tmp_path / "script.py"
    path.write_text(textwrap.dedent(text))
    return subprocess.Popen(
        [sys.executable, str(path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **environment},
        cwd=Path(__file__).parent,
    )


def test_ctrl_c_leaves_no_process(tmp_path: Path) -> None:
    process = script(
        tmp_path,
        f"""
        import sys, time
        sys.path.insert(0, {str(Path(__file__).parent)!r})
        import volver
        def slow(ray):
            print("asked", flush=True)
            time.sleep(600)
        try:
            volver.verify(slow, order=2, cases="sine-squared")
        except KeyboardInterrupt:
            import subprocess, os
            print("interrupted", flush=True)
            print(subprocess.run(["ps", "-o", "comm=", "--ppid", str(os.getpid())], capture_output=True, text=True).stdout)
        """,
    )
    assert process.stdout is not None and process.stdout.readline() == "asked\n"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert out.startswith("interrupted") and "volver" not in out and err == ""


def test_a_killed_parent_leaves_no_program(tmp_path: Path) -> None:
    process = script(
        tmp_path,
        """
        import time, volver
        def slow(ray):
            print("asked", flush=True)
            time.sleep(600)
        volver.verify(slow, order=2, cases="sine-squared", name="killed-parent", log="/dev/null")
        """,
    )
    assert process.stdout is not None and process.stdout.readline() == "asked\n"
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)], capture_output=True, text=True)
    (program,) = listed.stdout.split()
    process.kill()
    process.wait()
    deadline = time.monotonic() + 20
    while os.path.exists(f"/proc/{program}") and time.monotonic() < deadline:
        with open(f"/proc/{program}/stat") as file:
            if file.read().rsplit(")", 1)[1].split()[0] == "Z":
                break
        time.sleep(0.05)
    else:
        assert not os.path.exists(f"/proc/{program}")


@pytest.mark.parametrize(
    "options, words",
    [
        ({"cases": "no-such-case"}, "no-such-case"),
        ({"form": "points"}, r"form='points' \(allowed: 'segments', 'volume', 'formula'\)"),
        ({"xp": "cupy"}, r"xp='cupy' \(allowed: "),
        ({"dtype": "int64"}, r"dtype='int64' \(allowed: "),
        ({"dtype": "bfloat16"}, r"dtype='bfloat16' with xp='numpy'"),
        ({"device": "cuda"}, r"device='cuda' with xp='numpy'"),
        ({"answers": ("light",)}, r"light"),
        ({"format": "f31"}, r"f31"),
        ({"batched": True, "form": "volume"}, r"batched=True with form='volume'"),
        ({"ladder": "8"}, r"--ladder"),
    ],
)
def test_wrong_usage_is_one_line(options: dict[str, Any], words: str) -> None:
    with pytest.raises(volver.VolverError, match=words) as raised:
        verify(middle, **options)
    assert "\n" not in str(raised.value) and "fd:" not in str(raised.value)


def fake(tmp_path: Path, text: str) -> str:
    tmp_path.mkdir(exist_ok=True)
    path = tmp_path / "volver"
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)
    return str(path)


def test_another_version_and_an_old_machine_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VOLVER_PROGRAM", fake(tmp_path, "echo volver 0.0.9\n"))
    with pytest.raises(volver.MissingError, match=r"is 'volver 0.0.9' \(allowed: 'volver "):
        verify(middle)
    said = "volver: /lib/x86_64-linux-gnu/libc.so.6: version \\`GLIBC_2.99' not found (required by volver)"
    monkeypatch.setenv("VOLVER_PROGRAM", fake(tmp_path / "old", f'echo "{said}" >&2; exit 1\n'))
    with pytest.raises(volver.MissingError, match=r"GLIBC_2.99' not found .*allowed: a machine with that version of glibc"):
        verify(middle)
    monkeypatch.setenv("VOLVER_PROGRAM", str(tmp_path / "none"))
    with pytest.raises(volver.MissingError, match="does not run"):
        verify(middle)


def test_without_numpy_it_is_said(tmp_path: Path) -> None:
    (tmp_path / "numpy.py").write_text("raise ImportError('hidden')")
    process = script(
        tmp_path,
        """
        import volver
        assert volver.fit([.4, .2, .1, .05], [8e-2, 2e-2, 5e-3, 1.25e-3], expect=2).passed
        try:
            volver.verify(lambda ray: 0.0)
        except volver.MissingError as error:
            print(error)
        """,
    )
    assert process.communicate(timeout=60) == ("NumPy is not installed (allowed: pip install numpy)\n", "")
