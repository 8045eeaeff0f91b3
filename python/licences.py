#!/usr/bin/env python3
"""Writes licenses/ from the sources of all that the program links: what a wheel, or any other binary, carries.

    python/licences.py            # writes
    python/licences.py --check    # exit code 1 where a crate of Cargo.lock is missing there
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "licenses"
WHOLE = FOLDER / "THIRD-PARTY.txt"
TARGETS = ["x86_64-unknown-linux-gnu", "aarch64-unknown-linux-gnu"]
TEXT = re.compile(r"(?i)^(licen[sc]e|copying|unlicense|notice|copyright)[^/]*$")
RULE = "=" * 100


def crates():
    """What is linked, without what builds and tests it: name and version."""
    found = set()
    for target in TARGETS:
        tree = ["cargo", "tree", "--locked", "-e", "normal", "--prefix", "none", "--format", "{p}", "--target", target]
        lines = subprocess.run(tree, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
        found |= {tuple(line.split()[:2]) for line in lines}
    return sorted((name, version[1:]) for name, version in found if name != "volver")


def texts(folder):
    """Texts of a crate, those of C sources inside it too."""
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        # What is built for documentation and tests is not linked.
        if path.is_file() and TEXT.match(path.name) and not {"doc", "doc-c", "tests", "test", "contrib"} & set(inside.parts):
            if path.suffix in ("", ".md", ".txt", ".rst") or path.suffix.upper() == path.suffix or path.suffix[1:2].isupper():
                yield inside, path.read_text(encoding="utf-8", errors="replace").strip()


def write():
    metadata = ["cargo", "metadata", "--locked", "--format-version", "1"]
    metadata = json.loads(subprocess.run(metadata, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    packages = {(package["name"], package["version"]): package for package in metadata["packages"]}
    FOLDER.mkdir(exist_ok=True)
    holders, listed = {}, []
    for key in crates():
        package = packages[key]
        folder = Path(package["manifest_path"]).parent
        name = " ".join(key)
        listed.append(f"{name}: {package['license']} ({package['repository'] or package['homepage'] or 'no address'})")
        if key[0] == "gmp-mpfr-sys":
            libraries(folder)
        count = 0
        for inside, text in texts(folder):
            if key[0] == "gmp-mpfr-sys" and len(inside.parts) > 1:
                continue
            holders.setdefault(text, []).append(f"{name}: {inside}")
            count += 1
        if not count:
            # There is none in the package, and each of these may be had under MIT's.
            assert "MIT" in package["license"], name
            holders.setdefault(mit(package["authors"]), []).append(f"{name}: as it states")
    listed.append("Rust's standard library: MIT OR Apache-2.0 (https://github.com/rust-lang/rust)")
    parts = ["The program volver links the crates below. Their licences follow, each text once.", "\n".join(listed)]
    parts += [f"{RULE}\n" + "\n".join(names) + f"\n{RULE}\n\n{text}" for text, names in holders.items()]
    WHOLE.write_text("\n\n".join(parts) + "\n", encoding="utf-8")


def mit(authors):
    """MIT's licence, which volver's own has the words of."""
    _, _, permission = (ROOT / "LICENSE-MIT").read_text(encoding="utf-8").partition("\n\nPermission")
    return f"MIT License\n\nCopyright (c) {', '.join(authors)}\n\nPermission{permission}".strip()


def libraries(folder):
    """GMP and MPFR, which are linked statically. MPC is not linked."""
    for source in sorted(folder.glob("*-c")):
        name = source.name.removesuffix("-c")
        if name.startswith("mpc"):
            continue
        for text in ["COPYING", "COPYING.LESSER", "COPYING.LESSERv3", "COPYINGv2", "COPYINGv3"]:
            if (source / text).exists():
                (FOLDER / f"{name}.{text}").write_text((source / text).read_text(encoding="utf-8"), encoding="utf-8")


def main():
    if sys.argv[1:] != ["--check"]:
        write()
        return
    text = WHOLE.read_text(encoding="utf-8")
    missing = [" ".join(key) for key in crates() if f"\n{' '.join(key)}: " not in text]
    if missing:
        sys.exit(f"licenses/THIRD-PARTY.txt has no {', '.join(missing)} (allowed: what python/licences.py writes)")


if __name__ == "__main__":
    main()
