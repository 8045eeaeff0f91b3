"""What can go wrong, each in one line: what, where, what is allowed."""

from __future__ import annotations


class VolverError(Exception):
    """There is no result, because of the usage, the input or the machine; the program's exit code 2."""


class MissingError(VolverError):
    """Something is not installed: the program, NumPy, a library of tables."""


class RenderError(VolverError):
    """The function raised, which is then the cause, or returned what is no answer."""


class TimedOut(VolverError):
    """The function took longer over one request than it may."""


class Refused(Exception):
    """To be raised by a function that does not take a ray: the ray has no answer, and the others go on."""
