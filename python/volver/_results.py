"""Results: the program's JSON as dataclasses, with its words."""

from __future__ import annotations

from . import _schemas
from ._shown import Shown


class Verification(Shown, _schemas.Verification):
    """A function put to the test: what :func:`volver.verify` found; rows are channels."""

    _rows = "lines"


class Identification(Shown, _schemas.Identification):
    """What a function computes, read off by :func:`volver.identify`; rows are deviations."""

    _rows = "deviations"


class Fitted(Shown, _schemas.Fitted):
    """An order fitted by :func:`volver.fit`; rows are levels."""

    _rows = "samples"


class Taylor(Shown, _schemas.Taylor):
    """What Taylor remainders say of a gradient, by :func:`volver.gradient_test`; rows are levels."""

    _rows = "samples"


class References(Shown, _schemas.References):
    """Radiances to many digits, by :func:`volver.reference`; rows are channels."""

    _rows = "references"


class Study(Shown, _schemas.Study):
    """Errors of methods, by :func:`volver.study`; rows are cases × methods × formats."""

    _rows = "rows"


class Plan(Shown, _schemas.Plan):
    """The least model of a scene, by :func:`volver.plan`; rows are stretches of the ray."""

    _rows = "steps"
