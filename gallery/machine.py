"""What a package needs on this machine: an environment of Python, packages of Debian."""

import hashlib
import os
import pathlib
import shutil
import subprocess
import sys

INSTALLING = 1200
# Debian's packages of Python are for this one.
DEBIANS = "/usr/bin/python3"


class Missing(Exception):
    """What cannot be had or run, in one line."""


def environment(root, row):
    """The path of a Python that has the package; it is made where it is not there."""
    for package in row.apt:
        _debian(package)
    requirements = (row.folder / "requirements.txt").read_text(encoding="utf-8")
    of_debian = any(package.startswith("python3-") for package in row.apt)
    python = DEBIANS if of_debian else "python3"
    version = _ran([python, "-c", "import sys; print(sys.version_info[:3])"], 60)
    # Rows with the same requirements share one.
    key = hashlib.sha256(f"{requirements}{version}{of_debian}{row.no_deps}".encode()).hexdigest()[:16]
    folder = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", root / "target")) / "gallery" / key
    inside = folder / "bin" / "python"
    if not (folder / "complete").exists():
        shutil.rmtree(folder, ignore_errors=True)
        folder.parent.mkdir(parents=True, exist_ok=True)
        _ran([python, "-m", "venv", *["--system-site-packages"] * of_debian, folder], 120)
        install = [inside, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-input"]
        # requirements.txt then has all that is needed, and what its packages ask for beyond is left out.
        install += ["--no-deps"] * row.no_deps
        _ran([*install, "-r", row.folder / "requirements.txt"], INSTALLING)
        (folder / "complete").write_text(requirements, encoding="utf-8")
    return str(inside)


def debian_version(package):
    """The version that is installed, or None."""
    query = ["dpkg-query", "--show", "--showformat=${db:Status-Status} ${Version}", package]
    try:
        said = subprocess.run(query, capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired):
        return None
    status, _, version = said.stdout.partition(" ")
    return version if status == "installed" else None


def _debian(package):
    if debian_version(package) is not None:
        return
    if shutil.which("apt-get") is None:
        raise Missing(f"Debian's package {package} is not there (allowed: where apt-get is)")
    print(f"installing Debian's {package}", file=sys.stderr, flush=True)
    sudo = [] if os.geteuid() == 0 else ["sudo"]
    quiet = ["-y", "-qq", "--no-install-recommends"]
    try:
        _ran([*sudo, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", *quiet, package], INSTALLING)
    except Missing:
        # Lists of packages may be old, or not there at all.
        _ran([*sudo, "apt-get", "update", "-qq"], 300)
        _ran([*sudo, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", *quiet, package], INSTALLING)


def _ran(command, seconds):
    """What it printed; where it fails the last line of what it said is the reason."""
    words = [str(word) for word in command]
    try:
        said = subprocess.run(words, capture_output=True, text=True, timeout=seconds, stdin=subprocess.DEVNULL)
    except FileNotFoundError:
        raise Missing(f"there is no {words[0]}") from None
    except subprocess.TimeoutExpired:
        raise Missing(f"{pathlib.Path(words[0]).name} took more than {seconds} s: {' '.join(words[1:5])}") from None
    if said.returncode:
        lines = [line for line in (said.stderr or said.stdout).splitlines() if line.strip()]
        errors = [line for line in lines if "ERROR" in line] or lines or [f"exit code {said.returncode}"]
        raise Missing(f"{pathlib.Path(words[0]).name}: {errors[-1].strip()}")
    return said.stdout.strip()
