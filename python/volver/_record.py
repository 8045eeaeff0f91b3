"""What all objects of the program's JSON are."""

from __future__ import annotations


class Record:
    """Shown and compared by what it has; once for all classes, each of which would take longer to make."""

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in vars(self).items())})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and vars(self) == vars(other)

    __hash__ = None  # type: ignore[assignment]
