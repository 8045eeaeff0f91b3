"""A function as a kernel of volver's protocol, version 2 (docs/protocol.md)."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, BinaryIO

from ._arrays import Arrays, numpy
from ._errors import MissingError, Refused, RenderError, VolverError
from ._rays import Samples, Segments, formula_of, volume_of
from ._version import VERSION

if TYPE_CHECKING:
    from ._guard import Guard

#: rays in one frame at most
BATCH = 4096
FORMS = ("segments", "volume", "formula")
#: what an answer may have beside what is declared, by the letters of its axes: rays and channels
BESIDE = {"step": "r", "segments": "r", "standard_error": "rk"}
AXES = {"radiance": "rk", "opacity": "r", "optical_depth": "r", "expected_depth": "r", **BESIDE}


class Kernel:
    """A function, what it declares, and how it is given rays."""

    def __init__(
        self,
        render: Callable[[Any], Any],
        *,
        form: str,
        name: str | None,
        batched: bool,
        arrays: Arrays,
        declaration: dict[str, Any],
    ) -> None:
        if form not in FORMS:
            raise VolverError(f"form='{form}' (allowed: 'segments', 'volume', 'formula')")
        if batched and form != "segments":
            raise VolverError(f"batched=True with form='{form}' (allowed: with form='segments')")
        self.render = render
        self.form = form
        self.batched = batched
        self.arrays = arrays
        self.name = name or getattr(render, "__name__", None) or type(render).__name__
        self.name = "".join(letter if letter.isprintable() else " " for letter in self.name)[:100]
        self.answers: Sequence[str] = declaration.get("answers") or ("radiance",)
        if isinstance(self.answers, str):
            self.answers = (self.answers,)
        self.greeting: dict[str, Any] = {
            "type": "hello",
            "protocol": 2,
            "name": self.name,
            "form": form,
            "format": arrays.format,
            **{key: value for key, value in declaration.items() if value is not None},
            "answers": list(self.answers),
        }
        if form == "segments":
            self.greeting["batch"] = BATCH
        if form == "formula":
            self.greeting["language"] = "python"
        self.process = os.getpid()
        self.greeted = False

    def serve(self, requests: BinaryIO, answers: BinaryIO, guard: Guard) -> None:
        """Answers until no more is asked."""
        for line in requests:
            message = json.loads(line)
            kind = message["type"]
            head: dict[str, Any]
            blocks: list[bytes] = []
            if kind == "hello":
                if message["program"] != f"volver {VERSION}":
                    raise MissingError(f"the program is '{message['program']}' (allowed: 'volver {VERSION}', as the package)")
                self.greeted = True
                head = self.greeting
            elif kind == "frame":
                data = bytearray(message["bytes"])
                if _filled(requests, data) < len(data):
                    return
                head, blocks = self._framed(message, data, guard)
            else:
                head = self._answered(message, guard)
            text = json.dumps(head, separators=(",", ":")).encode() + b"\n"
            answers.write(b"".join([text, *blocks]) if blocks else text)
            answers.flush()

    def _call(self, ray: Any, where: Callable[[], str], guard: Guard) -> Any:
        """What the function says, as a dictionary."""
        try:
            result = guard.call(self.render, ray)
        except Refused:
            raise
        except Exception as error:
            said = " ".join(f"{type(error).__name__}: {error}".split()).rstrip(":")
            raise RenderError(f"{self.name} raised {said} {where()}") from error
        finally:
            # A copy of this process that came out of the function as well is nobody's.
            if os.getpid() != self.process:
                print(f"volver: {self.name} forked, and the child returned: it ends here", file=sys.stderr, flush=True)
                os._exit(70)
        if not isinstance(result, dict):
            result = {"radiance": result}
        wanted = self.answers
        missing = [name for name in wanted if name not in result]
        other = [name for name in result if name not in wanted and name not in BESIDE]
        if missing or other or result.get("radiance", 0) is None:
            got = ", ".join(map(str, result)) if result.get("radiance", 0) is not None else "None"
            raise RenderError(f"an answer of {got} {where()} (allowed: {', '.join(wanted)}, as declared in answers=)")
        return result

    def _framed(self, frame: dict[str, Any], data: bytearray, guard: Guard) -> tuple[dict[str, Any], list[bytes]]:
        np = numpy()
        at, arrays = 0, {}
        for block in frame["blocks"]:
            count = 1
            for size in block["shape"]:
                count *= size
            arrays[block["name"]] = np.frombuffer(data, block["type"], count, at).reshape(block["shape"])
            at += 8 * count
        rays, channels = frame["rays"], len(frame["channels"])
        out: dict[str, Any] = {}
        errors = []
        for group, ray in self._groups(frame, arrays):
            where = lambda ray=ray: _where(ray)  # noqa: E731
            try:
                result = self._call(ray, where, guard)
            except Refused as refused:
                errors += [{"ray": int(one), "error": str(refused) or "refused"} for one in group]
                continue
            for name, value in result.items():
                if name not in out:
                    axes = (rays, channels) if AXES[name] == "rk" else (rays,)
                    out[name] = np.zeros(axes, np.int64 if name == "segments" else np.float64)
                size = (len(group),) if self.batched else ()
                shapes = (*size, channels) if AXES[name] == "rk" else size
                allowed = (shapes, size) if AXES[name] == "rk" and channels == 1 else (shapes,)
                values = self.arrays.answer(name, value, allowed, where)
                out[name][group if self.batched else group[0]] = values
        head: dict[str, Any] = {"type": "frame", "id": frame["id"]}
        if len(errors) == rays and errors:
            return {**head, "error": errors[0]["error"]}, []
        for name in self.answers:
            out.setdefault(name, np.zeros((rays, channels) if AXES[name] == "rk" else (rays,)))
        blocks, bodies = [], []
        for name, values in out.items():
            kind = "<i8" if name == "segments" else "<f8"
            blocks.append({"name": name, "type": kind, "shape": list(values.shape)})
            bodies.append(values.astype(kind, copy=False).tobytes())
        head["bytes"] = sum(map(len, bodies))
        head["blocks"] = blocks
        if errors:
            head["errors"] = sorted(errors, key=lambda one: one["ray"])
        return head, bodies

    def _groups(self, frame: dict[str, Any], arrays: dict[str, Any]) -> Any:
        """Rays one by one, or those of equal n together, with their places in the frame."""
        convert, names, channels = self.arrays.convert, frame["cases"], frame["channels"]
        offsets = arrays["offsets"].tolist()
        cases, seeds = arrays["case"].tolist(), arrays["seed"].tolist()
        lengths, steps = arrays["length"], arrays["step"]
        background = arrays.get("background")
        if not self.batched:
            plain = self.arrays.library == "numpy" and self.arrays.dtype == "float64"
            lengths, steps = lengths.tolist(), steps.tolist()
            ends = [arrays[f"edges_{what}"] for what in ("lambda", "extinction", "emission")]
            middles = [arrays[f"middles_{what}"] for what in ("lambda", "extinction", "emission")]
            ends[2], middles[2] = ends[2].T, middles[2].T
            for r in range(frame["rays"]):
                first, last = offsets[r], offsets[r + 1]
                inner = slice(first, last)
                outer = slice(first + r, last + r + 1)
                if plain:
                    at_ends = Samples(ends[0][outer], ends[1][outer], ends[2][outer])
                    at_middles = Samples(middles[0][inner], middles[1][inner], middles[2][inner])
                else:
                    at_ends = Samples(*(convert(values[outer]) for values in ends))
                    at_middles = Samples(*(convert(values[inner]) for values in middles))
                behind = None if background is None else convert(background[r])
                ray = Segments(names[cases[r]], channels, lengths[r], steps[r], seeds[r], behind, at_ends, at_middles)
                yield [r], ray
            return
        np = numpy()
        counts = np.diff(arrays["offsets"])
        for n in np.unique(counts).tolist():
            group = np.flatnonzero(counts == n)
            first = arrays["offsets"][:-1][group]
            inner = first[:, None] + np.arange(n)
            outer = (first + group)[:, None] + np.arange(n + 1)
            at_ends, at_middles = (
                Samples(
                    convert(arrays[f"{what}_lambda"][which]),
                    convert(arrays[f"{what}_extinction"][which]),
                    convert(np.ascontiguousarray(np.moveaxis(arrays[f"{what}_emission"][:, which], 0, -1))),
                )
                for what, which in (("edges", outer), ("middles", inner))
            )
            behind = None if background is None else convert(background[group])
            yield (
                group,
                Segments(
                    [names[cases[r]] for r in group],
                    channels,
                    convert(lengths[group]),
                    convert(steps[group]),
                    [seeds[r] for r in group],
                    behind,
                    at_ends,
                    at_middles,
                ),
            )

    def _answered(self, request: dict[str, Any], guard: Guard) -> dict[str, Any]:
        """The answer to a request of text."""
        results = []
        for task in request["tasks"]:
            if "cotangents" in task:
                raise VolverError("a gradient is asked for (allowed: functions without one)")
            make = volume_of if self.form == "volume" else formula_of
            ray = make(task, self.arrays.convert)
            where = lambda ray=ray: _where(ray)  # noqa: E731
            try:
                result = self._call(ray, where, guard)
            except Refused as refused:
                results.append({"error": str(refused) or "refused"})
                continue
            channels, said = len(ray.channels), {}
            for name, value in result.items():
                shapes = ((channels,), ()) if channels == 1 else ((channels,),)
                values = self.arrays.answer(name, value, shapes if AXES[name] == "rk" else ((),), where)
                said[name] = _written(values.tolist())
            results.append(said)
        return {"type": "answer", "id": request["id"], "results": results}


def _written(value: Any) -> Any:
    """NaN and infinities as text, which JSON has no numbers for."""
    if isinstance(value, list):
        return [_written(one) for one in value]
    return value if isinstance(value, int) or value - value == 0 else str(value)


def _where(ray: Any) -> str:
    """Which task, in words."""
    if not isinstance(ray, Segments):
        return f"on '{ray.case}', {ray.segments} segments, seed {ray.seed}"
    if isinstance(ray.case, list):
        names = list(dict.fromkeys(ray.case))
        shown = ", ".join(f"'{name}'" for name in names[:3]) + (" …" if len(names) > 3 else "")
        return f"on {len(ray.case)} rays of {shown}, {ray.count} segments"
    return f"on '{ray.case}', {ray.count} segments, seed {ray.seed}"


def _filled(source: BinaryIO, data: bytearray) -> int:
    """Reads until it is full or there is no more; how much there was."""
    view, at = memoryview(data), 0
    while at < len(data):
        count = source.readinto(view[at:])  # type: ignore[attr-defined]
        if not count:
            break
        at += count
    return at
