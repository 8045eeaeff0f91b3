"""Verifies approximations of the volume rendering integral, from Python.

    import numpy as np, volver

    def render(ray):
        depth = ray.middles.extinction * ray.lengths
        before = np.append(0, np.cumsum(depth[:-1]))
        return (np.exp(-before) * -np.expm1(-depth)) @ ray.middles.emission

    print(volver.verify(render, order=2))

The work is done by the program ``volver`` that was installed with this package; the function stays in this process, and
is handed rays as arrays. docs/python.md says what it is given and what it may return.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._assertion import assert_order
from ._commands import fit, gradient_test, identify, plan, reference, study, verify
from ._errors import MissingError, Refused, RenderError, TimedOut, VolverError
from ._version import VERSION as __version__  # noqa: F401

if TYPE_CHECKING:
    from ._rays import Formula, Samples, Segments, Volume
    from ._results import Fitted, Identification, Plan, References, Study, Taylor, Verification

__all__ = [
    "Fitted",
    "Formula",
    "Identification",
    "MissingError",
    "Plan",
    "References",
    "Refused",
    "RenderError",
    "Samples",
    "Segments",
    "Study",
    "Taylor",
    "TimedOut",
    "Verification",
    "Volume",
    "VolverError",
    "assert_order",
    "fit",
    "gradient_test",
    "identify",
    "plan",
    "reference",
    "study",
    "verify",
]


def __getattr__(name: str) -> Any:
    # Classes of results cost more than an import may: they are made when they are asked for.
    if name in __all__:
        from . import _rays, _results

        return getattr(_results, name, None) or getattr(_rays, name)
    raise AttributeError(f"module 'volver' has no attribute '{name}'")
