"""Orders as assertions of tests."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ._errors import VolverError

if TYPE_CHECKING:
    from ._results import Verification


class Baseline:
    """A file that ``volver verify --save`` writes and ``volver check`` reads; written anew where it is to be."""

    def __init__(self, path: str | os.PathLike[str], update: bool = False) -> None:
        self.path = os.fspath(path)
        self.update = update


def assert_order(
    render: Callable[[Any], Any],
    order: float,
    *,
    cases: Any = None,
    baseline: Baseline | str | os.PathLike[str] | None = None,
    **options: Any,
) -> Verification | None:
    """Fails, with the table and the rule that was found, unless the function has that order on the cases.

    With a baseline the function is compared with that in place: known deviations pass, what is worse fails. ``options``
    are those of :func:`volver.verify`.
    """
    __tracebackhide__ = True
    from . import _commands

    if not isinstance(baseline, Baseline):
        baseline = None if baseline is None else Baseline(baseline)
    if baseline is not None and not baseline.update:
        if not os.path.exists(baseline.path):
            raise VolverError(f"no baseline {baseline.path} (allowed: pytest --volver-update, which writes it)")
        # What the baseline has is run again.
        given = {key: value for key, value in options.items() if key not in _OF_BASELINES}
        good, report = _commands.check(baseline.path, render, order=order, **given)
        if not good:
            raise AssertionError(f"worse than {baseline.path}\n{report.rstrip()}")
        return None
    save = None
    if baseline is not None:
        os.makedirs(os.path.dirname(baseline.path) or ".", exist_ok=True)
        save = baseline.path
    # A failure is to show the rule, which takes some hundred rays more.
    options.setdefault("identify", "full")
    found = _commands.verify(render, cases=cases, order=order, save=save, **options)
    if not found.passed and baseline is None:
        raise AssertionError(f"order {order:g} is {found.conclusion}\n{found}")
    return found


#: options of a verification that a baseline has itself
_OF_BASELINES = {
    "accept", "axis", "batch", "divide", "expect", "identify", "junit", "ladder", "log", "out", "replicas", "spacing",
    "uneven",
}  # fmt: skip
