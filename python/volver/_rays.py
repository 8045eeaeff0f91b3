"""What a function is given: a ray cut into segments, many such rays, a volume, or code."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

Convert = Callable[[Any], Any]


class Samples:
    """Values at places along rays; with many rays each array has one axis more, in front."""

    __slots__ = ("distance", "emission", "extinction")

    #: λ from the eye, of shape (n,), in the case's unit of length L
    distance: Any
    #: τ there, of shape (n,), in 1/L
    extinction: Any
    #: C there, of shape (n, k) for k channels, in units of the radiance
    emission: Any

    def __init__(self, distance: Any, extinction: Any, emission: Any) -> None:
        self.distance = distance
        self.extinction = extinction
        self.emission = emission

    def __getitem__(self, which: Any) -> Samples:
        return Samples(self.distance[..., which], self.extinction[..., which], self.emission[..., which, :])


class Segments:
    """A ray cut into n segments; with ``batched=True`` R rays of equal n, each array with the axis (R,) in front."""

    __slots__ = ("_lengths", "background", "case", "channels", "edges", "length", "middles", "seed", "step")

    #: the case's name; with many rays a list of names
    case: Any
    #: the names of the k channels
    channels: Sequence[str]
    #: D, the length of the ray, in L
    length: Any
    #: d, the step asked for, in L
    step: Any
    #: for functions that draw random numbers: the same seed, the same answer
    seed: Any
    #: of functions that take one, of shape (k,): the radiance that enters at the far end; else None
    background: Any
    #: at the n + 1 ends of segments, near to far
    edges: Samples
    #: in the n middles
    middles: Samples

    def __init__(
        self,
        case: Any,
        channels: Sequence[str],
        length: Any,
        step: Any,
        seed: Any,
        background: Any,
        edges: Samples,
        middles: Samples,
    ) -> None:
        self.case = case
        self.channels = channels
        self.length = length
        self.step = step
        self.seed = seed
        self.background = background
        self.edges = edges
        self.middles = middles
        self._lengths: Any = None

    @property
    def count(self) -> int:
        """n."""
        return int(self.middles.distance.shape[-1])

    @property
    def lengths(self) -> Any:
        """δ, the lengths of the segments, of shape (n,), in L."""
        if self._lengths is None:
            distance = self.edges.distance
            self._lengths = distance[..., 1:] - distance[..., :-1]
        return self._lengths

    @property
    def front(self) -> Samples:
        """At the ends that are nearer to the eye, n of them."""
        return self.edges[:-1]

    @property
    def back(self) -> Samples:
        """At the ends that are farther from the eye."""
        return self.edges[1:]


@dataclass(frozen=True)
class Volume:
    """A ray through a grid, with lookup tables: for renderers that want both."""

    case: str
    channels: Sequence[str]
    length: float
    step: float
    segments: int
    seed: int
    background: Any
    #: field values s at evenly spaced places from 0 to D, linear between them
    field: Any
    #: the field values of the first and of the last entry of the table
    first: float
    last: float
    #: τ by entry, evenly spaced
    extinction: Any
    #: C by entry, of shape (entries, k)
    emission: Any


@dataclass(frozen=True)
class Formula:
    """Python that defines LENGTH, field(lambda), extinction(s) and emission_CHANNEL(s)."""

    case: str
    channels: Sequence[str]
    length: float
    step: float
    segments: int
    seed: int
    background: Any
    code: str


def volume_of(task: dict[str, Any], convert: Convert) -> Volume:
    """The volume of a task."""
    import numpy as np

    data, table = task["data"], task["data"]["table"]
    return Volume(
        **_common(task, convert),
        field=convert(_array(data["field"])),
        first=_number(table["first"]),
        last=_number(table["last"]),
        extinction=convert(_array(table["extinction"])),
        emission=convert(np.stack([_array(row) for row in table["emission"]], axis=-1)),
    )


def formula_of(task: dict[str, Any], convert: Convert) -> Formula:
    """The code of a task."""
    return Formula(**_common(task, convert), code=task["data"]["code"])


def _common(task: dict[str, Any], convert: Convert) -> dict[str, Any]:
    background = task.get("background")
    return {
        "case": task["case"],
        "channels": task["channels"],
        "length": _number(task["length"]),
        "step": _number(task["step"]),
        "segments": task["segments"],
        "seed": task["seed"],
        "background": None if background is None else convert(_array(background)),
    }


def _number(value: Any) -> float:
    """JSON has no NaN and no infinities: they come as text."""
    return float(value)


def _array(values: list[Any]) -> Any:
    import numpy as np

    return np.array([float(value) for value in values], dtype=np.float64)
