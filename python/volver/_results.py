"""Results: the program's JSON as dataclasses, with its words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from . import _schemas
from ._errors import VolverError
from ._shown import Shown


def _read(kind: Any, data: Mapping[str, Any], text: str, passed: bool) -> Any:
    try:
        found = kind.read(data)
    except (KeyError, TypeError) as error:
        raise VolverError(f"the program's JSON is none of '{kind.__name__}': {error!r} (allowed: its own version)") from None
    found._with(data, text, passed)
    return found


class Verification(Shown, _schemas.Verification):
    """A function put to the test: what :func:`volver.verify` found; rows are channels."""

    _rows = "lines"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> Verification:
        """From JSON and text."""
        found: Verification = _read(cls, data, text, passed)
        return found


class Identification(Shown, _schemas.Identification):
    """What a function computes, read off by :func:`volver.identify`; rows are deviations."""

    _rows = "deviations"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> Identification:
        """From JSON and text."""
        found: Identification = _read(cls, data, text, passed)
        return found


class Fitted(Shown, _schemas.Fitted):
    """An order fitted by :func:`volver.fit`; rows are levels."""

    _rows = "samples"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> Fitted:
        """From JSON and text."""
        found: Fitted = _read(cls, data, text, passed)
        return found


class Taylor(Shown, _schemas.Taylor):
    """What Taylor remainders say of a gradient, by :func:`volver.gradient_test`; rows are levels."""

    _rows = "samples"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> Taylor:
        """From JSON and text."""
        found: Taylor = _read(cls, data, text, passed)
        return found


class References(Shown, _schemas.References):
    """Radiances to many digits, by :func:`volver.reference`; rows are channels."""

    _rows = "references"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> References:
        """From JSON and text."""
        found: References = _read(cls, data, text, passed)
        return found


class Study(Shown, _schemas.Study):
    """Errors of methods, by :func:`volver.study`; rows are cases × methods × formats."""

    _rows = "rows"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> Study:
        """From JSON and text."""
        found: Study = _read(cls, data, text, passed)
        return found


class Plan(Shown, _schemas.Plan):
    """The least model of a scene, by :func:`volver.plan`; rows are stretches of the ray."""

    _rows = "steps"

    @classmethod
    def of(cls, data: Mapping[str, Any], text: str, passed: bool) -> Plan:
        """From JSON and text."""
        found: Plan = _read(cls, data, text, passed)
        return found
