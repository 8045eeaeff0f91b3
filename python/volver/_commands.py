"""The program's commands as functions."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from . import _program
from ._errors import VolverError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._declaration import Declaration
    from ._results import Fitted, Identification, Plan, References, Study, Taylor, Verification

    #: a function of this process; or what the program takes: a method, a library, a program with its arguments
    Render = Union[Callable[[Any], Any], str, Sequence[str]]
    Words = Union[str, Iterable[str], None]
    Path = Union[str, "os.PathLike[str]"]

#: seconds that a function may take over one request, unless told otherwise
TIMEOUT = 60.0


def verify(
    render: Render,
    *,
    cases: Words = None,
    order: float | None = None,
    form: str = "segments",
    batched: bool = False,
    xp: str = "numpy",
    dtype: Any = None,
    device: Any = None,
    ladder: str | Iterable[int] | None = None,
    expect: float | str | None = None,
    divide: bool = False,
    uneven: bool = False,
    spacing: str | None = None,
    axis: str = "step",
    replicas: int | None = None,
    identify: str = "auto",
    batch: int | None = None,
    accept: Words = None,
    timeout: float = TIMEOUT,
    out: Path | None = None,
    junit: Path | None = None,
    save: Path | None = None,
    log: Path | None = None,
    **declaration: Unpack[Declaration],
) -> Verification:
    """Puts a function to the test: orders on cases of known radiance, and what it computes.

    ``render(ray)`` is given :class:`volver.Segments` (or what ``form`` names) as arrays of ``xp`` and ``dtype``, and
    returns the radiance, of shape (k,) for k channels; or a dictionary of what ``answers=`` declares. With ``batched``
    it is given R rays of equal n at once. A verification that fails is a result.

    Raises :class:`RenderError`, :class:`TimedOut`, :class:`MissingError`, or :class:`VolverError` for wrong usage.
    """
    from ._results import Verification

    options = [*_cases(cases), "--identify", identify, "--axis", axis]
    options += _flag("--ladder", ladder if ladder is None or isinstance(ladder, str) else ",".join(map(str, ladder)))
    options += _flag("--expect", expect) + _flag("--spacing", spacing) + _flag("--replicas", replicas)
    options += _flag("--batch", batch) + [word for one in _words(accept) for word in ("--accept", one)]
    options += ["--divide"] * divide + ["--uneven"] * uneven
    options += _flag("--out", out) + _flag("--junit", junit) + _flag("--save", save) + _flag("--log", log)
    kernel = _kernel(render, order, form, batched, xp, dtype, device, declaration)
    return Verification.of(*_with_kernel("verify", options, kernel, timeout))


def identify(
    render: Render,
    *,
    against: str | None = None,
    budget: int = 1000,
    order: float | None = None,
    form: str = "segments",
    batched: bool = False,
    xp: str = "numpy",
    dtype: Any = None,
    device: Any = None,
    timeout: float = TIMEOUT,
    out: Path | None = None,
    log: Path | None = None,
    **declaration: Unpack[Declaration],
) -> Identification:
    """Reads off what a function computes: its rule, and how that deviates. As :func:`verify` else."""
    from ._results import Identification

    options = ["--budget", str(budget), *_flag("--against", against), *_flag("--out", out), *_flag("--log", log)]
    kernel = _kernel(render, order, form, batched, xp, dtype, device, declaration)
    return Identification.of(*_with_kernel("identify", options, kernel, timeout))


def check(
    baseline: Path,
    render: Render,
    *,
    order: float | None = None,
    form: str = "segments",
    batched: bool = False,
    xp: str = "numpy",
    dtype: Any = None,
    device: Any = None,
    timeout: float = TIMEOUT,
    **declaration: Unpack[Declaration],
) -> tuple[bool, str]:
    """Compares a function with what ``verify(…, save=…)`` kept of it: whether nothing is worse, and the report."""
    kernel = _kernel(render, order, form, batched, xp, dtype, device, declaration)
    ran = _ran("check", [os.fspath(baseline)], kernel, timeout)
    return ran.code == 0, ran.out


def fit(
    steps: Iterable[Any],
    errors: Iterable[Any] | None = None,
    *,
    values: Iterable[Any] | None = None,
    exact: Any = None,
    richardson: bool = False,
    expect: float | str | None = None,
    at_least: float | None = None,
    floor: Any = None,
) -> Fitted:
    """Fits an order to errors at steps, or to values with ``exact=`` the exact one or ``richardson=True``."""
    from ._results import Fitted

    given = errors if values is None else values
    if given is None or (errors is not None and values is not None):
        raise VolverError("fit: errors and values (allowed: one of them)")
    table = _table(["h", "error" if values is None else "value"], steps, given)
    options = _flag("--exact", exact) + ["--richardson"] * richardson + _flag("--expect", expect)
    options += _flag("--at-least", at_least) + _flag("--floor", floor)
    return Fitted.of(*_with_input("fit", options, table))


def gradient_test(
    function: Callable[[Any], Any],
    gradient: Any,
    at: Any,
    *,
    direction: Any = None,
    steps: Iterable[float] | None = None,
    floor: Any = None,
) -> Taylor:
    """Tells from Taylor remainders whether ``gradient`` is that of ``function``, which maps arrays to a number.

    ``gradient`` is a function of the place ``at``, or its value there. The remainders |f(x + hv) − f(x) − h g·v| go to the
    program, for the steps h given (unless: 2⁻¹ … 2⁻¹²) along ``direction`` v (unless: drawn, with a fixed seed).
    """
    from ._arrays import numpy
    from ._results import Taylor

    np = numpy()
    place = np.asarray(_here(at), dtype=np.float64)
    if direction is None:
        direction = np.random.default_rng(0).standard_normal(place.shape)
    along = np.asarray(_here(direction), dtype=np.float64)
    slopes = np.asarray(_here(gradient(at) if callable(gradient) else gradient), dtype=np.float64)
    for what, array in (("gradient", slopes), ("direction", along)):
        if array.shape != place.shape:
            raise VolverError(f"a {what} of shape {array.shape} (allowed: {place.shape}, that of the place)")

    def value(where: Any) -> float:
        found = np.asarray(_here(function(_alike(where, at))), dtype=np.float64)
        if found.size != 1:
            raise VolverError(f"a function of shape {found.shape} (allowed: a number)")
        return float(found.reshape(()))

    slope, start = float(np.vdot(slopes, along)), value(place)
    rows = []
    for h in [2.0**-i for i in range(1, 13)] if steps is None else steps:
        change = value(place + h * along) - start
        rows.append((h, abs(change - h * slope), abs(change)))
    table = _table(["h", "remainder", "change"], *zip(*rows))
    return Taylor.of(*_with_input("gradient-test", _flag("--floor", floor), table))


def reference(case: Path, *, digits: int = 50, integrate: bool = False, estimate: bool = False) -> References:
    """The radiance of a case, by its name or the path of its file, to so many digits."""
    from ._results import References

    options = ["--digits", str(digits)] + ["--integrate"] * integrate + ["--estimate"] * estimate
    return References.of(*_with_json("reference", [*options, "--", os.fspath(case)], dash=False))


def study(
    file: Path | None = None,
    *,
    cases: Words = None,
    methods: Words = None,
    formats: Words = None,
    levels: str | Iterable[int] | None = None,
    errors: str = "split",
    threads: int | None = None,
    out: Path | None = None,
    yes: bool = False,
) -> Study:
    """Runs methods of volver's own on cases, in formats, at levels, and splits their errors."""
    from ._results import Study

    options = ["--errors", errors] + [word for one in _words(cases) for word in ("--cases", one)]
    options += [word for one in _words(methods) for word in ("--methods", one)]
    options += [word for one in _words(formats) for word in ("--formats", one)]
    options += _flag("--levels", levels if levels is None or isinstance(levels, str) else ",".join(map(str, levels)))
    options += _flag("--threads", threads) + _flag("--out", out) + ["--yes"] * yes
    return Study.of(*_with_json("study", [*options, *([] if file is None else ["--", os.fspath(file)])]))


def plan(
    scene: Path,
    tolerance: float,
    *,
    formats: Words = None,
    cost: str = "evaluations",
    explain: bool = False,
    check: bool = True,
    out: Path | None = None,
) -> Plan:
    """The least model of a scene, a scene.toml, whose radiance is within the tolerance."""
    from ._results import Plan

    options = ["--tolerance", repr(float(tolerance)), "--cost", cost, *_flag("--out", out)]
    options += [word for one in _words(formats) for word in ("--format", one)]
    options += ["--explain"] * explain + ["--no-check"] * (not check)
    return Plan.of(*_with_json("plan", [*options, "--", os.fspath(scene)]))


def _kernel(
    render: Render,
    order: float | None,
    form: str,
    batched: bool,
    xp: str,
    dtype: Any,
    device: Any,
    declaration: Mapping[str, Any],
) -> Any:
    """A function as a kernel, or the words of one that the program knows."""
    if not callable(render):
        given = {"order": order, "dtype": dtype, "device": device, **declaration}
        named = next((key for key, value in given.items() if value is not None), "batched" if batched else None)
        if named:
            raise VolverError(f"{named}= with a kernel of its own words (allowed: with a function)")
        return [render] if isinstance(render, str) else list(render)
    from ._arrays import Arrays
    from ._kernel import Kernel

    declared = dict(declaration)
    name = declared.pop("name", None)
    return Kernel(
        render,
        form=form,
        name=name,
        batched=batched,
        arrays=Arrays(xp, dtype, device),
        declaration={"order": order, **declared},
    )


def _ran(command: str, options: Sequence[str], kernel: Any, timeout: float) -> _program.Ran:
    if isinstance(kernel, list):
        return _program.result(_program.run([command, *options, "--timeout", repr(timeout), "--", *kernel]))
    from ._session import run

    return _program.result(run([command, *options], kernel, float(timeout)))


def _with_kernel(command: str, options: Sequence[str], kernel: Any, timeout: float) -> tuple[Any, str, bool]:
    """The JSON, the text, and whether all is well."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "result.json")
        ran = _ran(command, [*options, "--json", path], kernel, timeout)
        with open(path, encoding="utf-8") as file:
            return json.load(file), ran.out, ran.code == 0


def _with_json(command: str, options: Sequence[str], dash: bool = True) -> tuple[Any, str, bool]:
    """The same of a command without a kernel, whose --json has a file, or prints in place of the text."""
    if not dash:
        return _printed([command, "--json", *options])
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "result.json")
        ran = _program.result(_program.run([command, "--json", path, *options]))
        with open(path, encoding="utf-8") as file:
            return json.load(file), ran.out, ran.code == 0


def _with_input(command: str, options: Sequence[str], table: str) -> tuple[Any, str, bool]:
    return _printed([command, "--json", *options, "--", "-"], table)


def _printed(arguments: list[str], stdin: str | None = None) -> tuple[Any, str, bool]:
    """Twice, for the JSON and for the text: these commands take milliseconds."""
    ran = _program.result(_program.run(arguments, stdin))
    shown = _program.result(_program.run([word for word in arguments if word != "--json"], stdin))
    return json.loads(ran.out), shown.out, ran.code == 0


def _table(names: Sequence[str], *columns: Iterable[Any]) -> str:
    lists = [[_text(value) for value in _here(column)] for column in columns]
    if len({len(one) for one in lists}) > 1:
        raise VolverError(f"{' and '.join(map(str, map(len, lists)))} numbers (allowed: as many of each)")
    return "\n".join([",".join(names), *(",".join(row) for row in zip(*lists))]) + "\n"


def _text(value: Any) -> str:
    """All digits of a number; text as it is."""
    return value if isinstance(value, str) else repr(float(value))


def _here(value: Any) -> Any:
    """On the CPU, without a graph."""
    return value.detach().cpu().numpy() if hasattr(value, "detach") else value


def _alike(values: Any, like: Any) -> Any:
    """An array of the library that the place is of."""
    if hasattr(like, "detach"):
        import torch  # type: ignore[import-not-found, unused-ignore]

        return torch.from_numpy(values).to(dtype=like.dtype, device=like.device)
    if type(like).__module__.partition(".")[0] in ("jax", "jaxlib"):
        import jax.numpy as jnp  # type: ignore[import-not-found, unused-ignore]

        return jnp.asarray(values, dtype=like.dtype)
    return values


def _words(value: Words) -> list[str]:
    if value is None:
        return []
    return [value] if isinstance(value, str) else [os.fspath(one) for one in value]


def _cases(value: Words) -> list[str]:
    return [word for one in _words(value) for word in ("--cases", one)]


def _flag(option: str, value: Any) -> list[str]:
    """One word, so that a value may begin with a dash."""
    return [] if value is None else [f"{option}={os.fspath(value) if isinstance(value, os.PathLike) else value}"]
