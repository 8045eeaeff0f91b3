"""Rows of the gallery: what is known of a package before it is run, and what was found when it was."""

import json
import pathlib
import re
import tomllib
from dataclasses import dataclass, field

KINDS = ["visualization", "learning", "medicine", "radiative transfer"]
TEXTS = ["package", "version", "kind", "what", "guess", "know", "source", "reading", "unidentified"]


class Refused(Exception):
    """A row that is none: which, what is wrong, what is allowed."""


@dataclass
class Row:
    """One folder; keys are those of row.toml, and say more in docs/contributing.md."""

    folder: pathlib.Path
    package: str
    version: str
    kind: str
    what: str
    guess: str = ""
    know: str = ""
    source: str = ""
    reading: str = ""
    unidentified: str = ""
    gradients: bool = False
    why_not: str = ""
    no_deps: bool = False
    timeout: int = 1800
    verify: list = field(default_factory=list)
    identify: list = field(default_factory=list)
    gradient: list = field(default_factory=list)
    apt: list = field(default_factory=list)

    @property
    def name(self):
        return self.folder.name

    def expected(self):
        """What was found before, or None."""
        path = self.folder / "expected.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def keep(self, text):
        (self.folder / "expected.json").write_text(text, encoding="utf-8")


def all_rows(folder):
    """Every row, by kind and name."""
    found = [read(path) for path in sorted(folder.glob("*/row.toml"))]
    return sorted(found, key=lambda row: (KINDS.index(row.kind), row.name.lower()))


def chosen(every, names):
    """Those of these names, or all of them."""
    known = {row.name for row in every}
    if unknown := [name for name in names if name not in known]:
        raise Refused(f"no row {unknown[0]!r} (allowed: {', '.join(sorted(known))})")
    return [row for row in every if not names or row.name in names]


def read(path):
    """The row of that file."""
    where = f"gallery/{path.parent.name}/row.toml"
    try:
        keys = tomllib.loads(path.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise Refused(f"{where}: {error}") from None
    allowed = Row.__dataclass_fields__.keys() - {"folder"}
    if unknown := sorted(keys.keys() - allowed):
        raise Refused(f"{where}: unknown key {unknown[0]!r} (allowed: {', '.join(sorted(allowed))})")
    needed = TEXTS[:4] if "why_not" in keys else TEXTS
    if missing := [key for key in needed if key not in keys]:
        raise Refused(f"{where}: {missing[0]!r} is missing (allowed: a text)")
    for key in [*TEXTS, "why_not"]:
        if not isinstance(keys.get(key, ""), str):
            raise Refused(f"{where}: {key} is no text")
    if keys["kind"] not in KINDS:
        raise Refused(f"{where}: kind {keys['kind']!r} (allowed: {', '.join(KINDS)})")
    return Row(folder=path.parent, **keys)


def complete(every):
    """Refuses rows that lack a file, that pin nothing, or that say nothing of what is not identified."""
    driven = [row for row in every if not row.why_not]
    for row in driven:
        for name in ["kernel.py", "requirements.txt", "expected.json"]:
            if not (row.folder / name).exists():
                raise Refused(f"gallery/{row.name}: there is no {name} (allowed: with why_not alone)")
        for line in (row.folder / "requirements.txt").read_text(encoding="utf-8").splitlines():
            if not re.match(r"\s*(#|--|$)|[^=<>~!]+==[^=*]+$", line):
                raise Refused(f"gallery/{row.name}/requirements.txt: {line!r} (allowed: NAME==VERSION)")
        if empty := [key for key in TEXTS if key != "unidentified" and not getattr(row, key).strip()]:
            raise Refused(f"gallery/{row.name}/row.toml: {empty[0]} is empty (allowed: words)")
        if row.expected().get("rule") is None and not row.unidentified.strip():
            raise Refused(f"gallery/{row.name}: no rule, and row.toml does not say what is not identified")
