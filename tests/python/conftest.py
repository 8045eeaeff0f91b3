"""Nothing that a test starts may be left when it ends."""

import os
import subprocess
import time
from collections.abc import Iterator

import pytest

pytest_plugins = ["pytester"]


def children() -> list[str]:
    listed = subprocess.run(["ps", "-o", "pid=,comm=", "--ppid", str(os.getpid())], capture_output=True, text=True)
    return [line for line in listed.stdout.splitlines() if "volver" in line]


@pytest.fixture(autouse=True)
def no_process_is_left() -> Iterator[None]:
    yield
    deadline = time.monotonic() + 5
    while children() and time.monotonic() < deadline:
        time.sleep(0.05)
    assert children() == []
