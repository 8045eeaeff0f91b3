"""The rows as the program has them: gallery.json, which it is compiled with."""

import json

TEXTS = ["package", "version", "kind", "what", "guess", "know", "source", "reading", "unidentified", "why_not"]


def written(rows):
    """The whole file, a row a line."""
    lines = [json.dumps(_row(row), ensure_ascii=False) for row in rows]
    return "[\n" + ",\n".join(lines) + "\n]\n"


def _row(row):
    found = row.expected() or {}
    return {
        "name": row.name,
        **{key: " ".join(getattr(row, key).split()) for key in TEXTS},
        "format": found.get("declares", {}).get("format", ""),
        "rule": found.get("rule") or [],
        "formula": found.get("formula"),
        "deviations": [one["name"] for one in found.get("deviations", [])],
    }
