"""What a function may say of itself; made from the schema of the protocol by python/generate.py."""

from __future__ import annotations

from typing import Any, TypedDict


class Declaration(TypedDict, total=False):
    """Keys of a greeting, as docs/protocol.md has them."""

    answers: tuple[str, ...] | list[str] | None
    """What it answers of every ray, at least one; the radiance unless given. Of version 2."""
    background: bool | None
    """It takes a background, and is given one with every task. Of version 2."""
    channels: int | None
    """How many channels every task has to have; any unless given. Of version 2."""
    emission: str | None
    """`positive`: it takes no emission below 0. Any unless given. Of version 2."""
    exp_ulp: Any
    """By how many units in the last place e^x may be off, where that is more than rounding. Of version 2."""
    expected_depth: str | None
    """What its expected depth is divided by, where that is among the answers: by nothing unless given. Of version
    2."""
    expm1_ulp: Any
    """The same of e^x − 1. Of version 2."""
    far_wall: bool | None
    """It takes the last segment to be opaque: a wall of the last sample's emission stands at the end of the ray."""
    format: str | None
    """The format that it computes in, by volver's name: f32, f64, mpfr:128 …; f64 unless given."""
    method: str | None
    """The method of volver that it means to be, by its name, such as front-to-back/front/subtraction."""
    name: str | None
    """Its name, for reports."""
    noise: float | str | None
    """By so much its answers may be off by chance, in the units of the answer. Of version 2."""
    output: str | None
    """The format that its answers are rounded to at the end, where that is another one. Of version 2."""
    pow_ulp: Any
    """The same of powers b^d, x being d log₂ b. Of version 2."""
    quantum: Any
    """What its answers are multiples of, in the units of the radiance, where that is coarser than the format; in
    version 2 also as a part of the largest |C| of the ray."""
    sampling: str | None
    """Where it samples a segment, where the method does not say."""
    segments: Any
    """Which numbers of segments it works on; any unless given."""
    source: str | None
    """What its tasks have for emission: C, per `depth`, or C·τ, per `length`; with the form `segments`. C unless
    given. Of version 2."""
    step: str | None
    """`divides`: it works where the step divides the ray alone. Any step unless given."""
    stochastic: bool | None
    """Monte Carlo: the answer depends on the seed, and scatters."""
    subnormals: str | None
    """`lost`: numbers below the smallest normal one of the format may be 0. Kept unless given. Of version 2."""
