#!/usr/bin/env python3
"""Writes volver/_schemas.py, _declaration.py and _version.py from what the program prints.

    python/generate.py VOLVER            # writes
    python/generate.py VOLVER --check    # exit code 1 where what is there is stale
"""

import json
import keyword
import subprocess
import sys
import textwrap
from pathlib import Path

RESULTS = ["verify", "identify", "fit", "gradient-test", "reference", "study-results", "plan"]
NAMES = {"A plan of volver": "Plan"}
#: arguments of the functions, or what the package says of itself
OWN = {"type", "protocol", "form", "language", "order", "batch", "numbers", "arrays", "gradient", "adjoint"}
WIDTH = 118


def schema(volver, name):
    return json.loads(subprocess.run([volver, "schema", name], check=True, capture_output=True, text=True).stdout)


def wrapped(text, indent):
    text = " ".join(text.replace("\\", "\\\\").split())
    text = text.replace("[`", "`").replace("`]", "`")
    return textwrap.fill(f'"""{text}"""', WIDTH, initial_indent=indent, subsequent_indent=indent)


def attribute(key):
    name = key.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


class Classes:
    """Every object of the schemas as a dataclass that reads itself."""

    def __init__(self):
        self.written = {}

    def add(self, name, spec, definitions):
        """The class of that name; the same object twice is the same class."""
        text = self.text(name, spec, definitions)
        if self.written.setdefault(name, text) != text:
            sys.exit(f"two objects of the name {name}")

    def text(self, name, spec, definitions):
        needed = set(spec.get("required", []))
        lines = ["@dataclass(eq=False, repr=False)", f"class {name}(Record):", wrapped(spec.get("description", f"{name}."), "    "), ""]
        reads = []
        # Those that are always there come first, as dataclasses want it.
        properties = sorted(spec["properties"].items(), key=lambda item: item[0] not in needed)
        for key, value in properties:
            kind, read = self.kind(value, definitions)
            optional = key not in needed
            default = ""
            if optional:
                kind = kind if kind.endswith("| None") or kind == "Any" else f"{kind} | None"
                default = " = None"
            lines.append(f"    {attribute(key)}: {kind}{default}")
            if value is not True and "description" in value:
                lines.append(wrapped(value["description"], "    "))
            source = f'data["{key}"]'
            got = read(source)
            if optional and got == source:
                got = f'data.get("{key}")'
            elif optional:
                got = got.removeprefix(f"None if {source} is None else ")
                got = f'None if data.get("{key}") is None else {got}'
            reads.append(f"            {attribute(key)}={got},")
        lines += ["", "    @classmethod", f"    def read(cls, data: Mapping[str, Any]) -> {name}:"]
        lines += ['        """From JSON."""', "        return cls("] + reads + ["        )", ""]
        return "\n".join(lines)

    def kind(self, spec, definitions):
        """The type of a value, and what makes it of a piece of JSON."""
        plain = lambda source: source  # noqa: E731
        if spec is True or not spec:
            return "Any", plain
        if "$ref" in spec:
            name = spec["$ref"].rsplit("/", 1)[1]
            target = definitions[name]
            if "properties" in target and "oneOf" not in target and "anyOf" not in target:
                self.add(name, target, definitions)
                return name, lambda source: f"{name}.read({source})"
            return self.kind(target, definitions)
        options = spec.get("anyOf") or spec.get("oneOf")
        if options and "properties" not in spec:
            kept = [one for one in options if one.get("type") != "null"]
            null = len(kept) < len(options)
            if len(kept) == 1:
                kind, read = self.kind(kept[0], definitions)
                if not null or kind == "Any":
                    return kind, read
                return f"{kind} | None", lambda source: source if read("x") == "x" else f"None if {source} is None else {read(source)}"
            kinds = list(dict.fromkeys(self.kind(one, definitions)[0] for one in kept))
            objects = [kind for kind in kinds if kind not in ("str", "float", "int", "bool")]
            kind = "Any" if objects and len(kinds) > 1 else " | ".join(kinds)
            return (kind if not null or kind == "Any" else f"{kind} | None"), plain
        type_ = spec.get("type")
        if isinstance(type_, list):
            kinds = [self.kind({**spec, "type": one}, definitions) for one in type_ if one != "null"]
            kind = " | ".join(dict.fromkeys(one for one, _ in kinds))
            read = kinds[0][1]
            if "null" not in type_:
                return kind, read
            if read("x") == "x":
                return f"{kind} | None", read
            return f"{kind} | None", lambda source: f"None if {source} is None else {read(source)}"
        if type_ == "array":
            if "prefixItems" in spec:
                kinds = dict.fromkeys(self.kind(one, definitions)[0] for one in spec["prefixItems"])
                return f"list[{' | '.join(kinds)}]", plain
            kind, read = self.kind(spec.get("items", True), definitions)
            if read("x") == "x":
                return f"list[{kind}]", plain
            return f"list[{kind}]", lambda source: f"[{read('one')} for one in {source}]"
        if type_ == "object":
            inner = spec.get("additionalProperties")
            if isinstance(inner, dict) and "properties" not in spec:
                return f"dict[str, {self.kind(inner, definitions)[0]}]", plain
            return "dict[str, Any]", plain
        if "enum" in spec or "const" in spec:
            values = spec.get("enum", [spec.get("const")])
            kinds = dict.fromkeys("None" if value is None else type(value).__name__ for value in values)
            return " | ".join(kinds), plain
        return {"string": "str", "number": "float", "integer": "int", "boolean": "bool"}.get(type_, "Any"), plain


def results(volver):
    classes = Classes()
    for name in RESULTS:
        spec = schema(volver, name)
        title = NAMES.get(spec["title"], spec["title"])
        classes.add(title, spec, spec.get("$defs", {}))
    head = '''"""What the program writes as JSON; made from its schemas by python/generate.py."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ._record import Record

'''
    return head + "\n".join("\n" + text for text in classes.written.values())


def declaration(volver):
    spec = schema(volver, "protocol")["$defs"]["KernelHello"]
    definitions = schema(volver, "protocol")["$defs"]
    lines = [
        '"""What a function may say of itself; made from the schema of the protocol by python/generate.py."""',
        "",
        "from __future__ import annotations",
        "",
        "from typing import Any, TypedDict",
        "",
        "",
        "class Declaration(TypedDict, total=False):",
        wrapped("Keys of a greeting, as docs/protocol.md has them.", "    "),
        "",
    ]
    for key, value in spec["properties"].items():
        if key in OWN:
            continue
        kind = "Any" if key in ("segments", "quantum", "exp_ulp", "expm1_ulp", "pow_ulp") else Classes().kind(value, definitions)[0]
        kind = kind.replace(" | None", "")
        kind = kind.replace("list[str]", "tuple[str, ...] | list[str]")
        lines.append(f"    {attribute(key)}: {kind}{'' if kind == 'Any' else ' | None'}")
        if "description" in value:
            lines.append(wrapped(value["description"], "    "))
    return "\n".join(lines) + "\n"


def version(volver):
    printed = subprocess.run([volver, "--version"], check=True, capture_output=True, text=True).stdout
    return (
        '"""The version of the program and of this package; made by python/generate.py."""\n\n'
        f'VERSION = "{printed.split()[1]}"\n'
    )


def main():
    volver, *options = sys.argv[1:]
    folder = Path(__file__).parent / "volver"
    stale = []
    written = {
        "_schemas.py": results(volver),
        "_declaration.py": declaration(volver),
        "_version.py": version(volver),
    }
    for name, text in written.items():
        path = folder / name
        if options == ["--check"]:
            if path.read_text(encoding="utf-8") != text:
                stale.append(name)
        else:
            path.write_text(text, encoding="utf-8")
    if stale:
        sys.exit(f"stale: {', '.join(stale)} (allowed: what python/generate.py writes)")


if __name__ == "__main__":
    main()
