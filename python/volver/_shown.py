"""What every result can do: be printed, be shown in a notebook, become a frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, TypeVar

from ._errors import MissingError, VolverError

R = TypeVar("R", bound="Shown")

#: colours that are read on light and dark pages alike
GOOD, BAD = "#2e7d32", "#c62828"


class Shown:
    """A result with the program's own words."""

    #: the JSON that the program wrote
    data: Mapping[str, Any]
    #: the table and the sentences that the program printed
    text: str
    #: whether the program's exit code was 0
    passed: bool
    #: the list of JSON that is one row each in a frame, or none for a single row
    _rows = ""

    @classmethod
    def of(cls: type[R], data: Mapping[str, Any], text: str, passed: bool) -> R:
        """From the program's JSON and its words."""
        try:
            found: R = cls.read(data)  # type: ignore[attr-defined]
        except (KeyError, TypeError) as error:
            raise VolverError(
                f"the program's JSON is none of '{cls.__name__}': {error!r} (allowed: its own version)"
            ) from None
        found.data, found.text, found.passed = data, text, passed
        return found

    def __bool__(self) -> bool:
        raise TypeError("a result is neither true nor false (allowed: .passed)")

    def __str__(self) -> str:
        return self.text.rstrip("\n")

    def table(self) -> list[dict[str, Any]]:
        """What is a number, a text or a truth of each row."""
        found: Sequence[Mapping[str, Any]] = self.data[self._rows] if self._rows else [self.data]
        names = dict.fromkeys(key for row in found for key, value in row.items() if _plain(value))
        return [{name: row.get(name) if _plain(row.get(name)) else None for name in names} for row in found]

    def to_pandas(self) -> Any:
        """Rows as a pandas.DataFrame."""
        try:
            import pandas
        except ImportError:
            raise MissingError("pandas is not installed (allowed: pip install pandas)") from None
        return pandas.DataFrame(self.table())

    def to_polars(self) -> Any:
        """Rows as a polars.DataFrame."""
        try:
            import polars
        except ImportError:
            raise MissingError("polars is not installed (allowed: pip install polars)") from None
        return polars.DataFrame(self.table(), infer_schema_length=None, strict=False)

    def _repr_html_(self) -> str:
        rows = self.table()
        names = [name for name in (rows[0] if rows else {}) if any(row[name] is not None for row in rows)]
        head = "".join(f"<th>{escape(name.replace('_', ' '))}</th>" for name in names)
        body = "".join(f"<tr>{''.join(_cell(row[name]) for name in names)}</tr>" for row in rows)
        colour, word = (GOOD, "passed") if self.passed else (BAD, "not passed")
        return (
            f'<div class="volver"><p><b style="color:{colour}">{word}</b></p>'
            f'<div style="max-height:30em;overflow:auto"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'
            f"<details><summary>Report</summary><pre>{escape(str(self))}</pre></details></div>"
        )


def _plain(value: Any) -> bool:
    return value is None or isinstance(value, (str, int, float))


def _cell(value: Any) -> str:
    if value is None:
        return "<td></td>"
    if isinstance(value, float):
        return f'<td style="text-align:right">{value:.6g}</td>'
    return f"<td>{escape(str(value))}</td>"
