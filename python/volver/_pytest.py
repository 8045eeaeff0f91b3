"""The plugin of pytest: baselines of functions, and --volver-update, which writes them anew."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from ._assertion import Baseline


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("volver")
    group.addoption("--volver-update", action="store_true", help="write the baselines of volver.assert_order anew")


@pytest.fixture
def volver_baseline(request: pytest.FixtureRequest) -> Baseline:
    """The baseline of this test, volver-baselines/MODULE.TEST.json beside its file."""
    from ._assertion import Baseline

    name = re.sub(r"[^A-Za-z0-9_.-]+", "-", request.node.name).strip("-")
    path = request.path.parent / "volver-baselines" / f"{request.path.stem}.{name}.json"
    return Baseline(path, update=bool(request.config.getoption("--volver-update")))
