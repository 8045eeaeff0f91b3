"""Runs the code of tutorials as their readers would: check.py VOLVER PAGE...

Fenced blocks with a word behind their language do something, in a temporary folder a page, in the order of the page:

    sh run [exit=N] [in=source]   is run by bash, `volver` being on the PATH and $VOLVER_SOURCE the repository; exit code 0
                                  or N; in=source: there, and not in the folder
    sh shown                      is not run: what needs a network, or the reader's own machine
    LANGUAGE file=PATH            is written to PATH
    LANGUAGE same=PATH            stands in that file of the repository, which is tested elsewhere
    text output                   is what the last run printed: line by line and in order, with … for what is left out.
                                  Numbers are those printed, rounded to the digits shown

Then pages are broken on purpose, and each break has to be found. Exit code 1: a page does not say what happens.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The first build of the library takes minutes.
PATIENCE = 1800
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")


class Wrong(Exception):
    """What a page says is not what happens."""


class Block:
    def __init__(self, line, info, text):
        self.line = line
        self.language, *self.words = info.split() or [""]
        self.text = text

    def option(self, name):
        return next((word.split("=", 1)[1] for word in self.words if word.startswith(name + "=")), None)


def blocks(text):
    """Fenced blocks, with the line that each begins at."""
    found, fence = [], None
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r"(`{3,})(.*)", line)
        if fence is None and mark:
            fence, begin, info, inside = mark[1], number, mark[2].strip(), []
        elif fence is not None and line.strip() == fence:
            found.append(Block(begin, info, "".join(row + "\n" for row in inside)))
            fence = None
        elif fence is not None:
            inside.append(line)
    if fence is not None:
        raise Wrong(f"{begin}: a block without an end")
    return found


def digits_after(number):
    """The power of ten of the last digit shown."""
    mantissa, _, power = number.partition("e")
    return int(power or 0) - len(mantissa.partition(".")[2])


def is_said(token, real):
    """Whether a word of a page is a word that was printed, its numbers to the digits shown."""
    if token == real:
        return True
    shown, have = NUMBER.findall(token), NUMBER.findall(real)
    if not shown or len(shown) != len(have) or NUMBER.sub("#", token) != NUMBER.sub("#", real):
        return False
    # An integer is a count: none is nearly another.
    return all(a == b or (("." in a or "e" in a) and round(abs(float(a) - float(b)) / 10.0 ** digits_after(a), 9) <= 0.5) for a, b in zip(shown, have))


def is_line(said, real):
    """Whether a line of a page is a line that was printed; … stands for any words, or for the rest of one."""
    said, real = said.split(), real.split()
    if not said:
        return not real
    if said[0] == "…":
        return any(is_line_of(said[1:], real[i:]) for i in range(len(real) + 1))
    return is_line_of(said, real)


def is_line_of(said, real):
    if not said:
        return not real
    if said[0] == "…":
        return any(is_line_of(said[1:], real[i:]) for i in range(len(real) + 1))
    return bool(real) and is_said(said[0], real[0]) and is_line_of(said[1:], real[1:])


def compare(block, printed):
    """Every line of the block is one of what was printed, in that order, the next one unless … stands between."""
    lines, at, loose = printed.splitlines(), 0, True
    for number, said in enumerate(block.text.splitlines(), block.line + 1):
        if not said.strip():
            continue
        if said.strip() == "…":
            loose = True
            continue
        rest = [i for i in range(at, len(lines)) if lines[i].strip()]
        found = next((i for i in (rest if loose else rest[:1]) if is_line(said, lines[i])), None)
        if found is None:
            raise Wrong(f"{number}: not printed: {said.strip()!r}; what was:\n{printed}")
        at, loose = found + 1, False


def without_indent(text):
    return "\n".join(line.strip() for line in text.splitlines() if line.strip())


class Page:
    def __init__(self, volver, text, folder):
        self.text = text
        self.folder = folder
        self.environment = {**os.environ, "VOLVER_SOURCE": str(ROOT), "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}
        tools = folder / ".bin"
        tools.mkdir()
        (tools / "volver").symlink_to(volver)
        self.environment["PATH"] = f"{tools}{os.pathsep}{self.environment['PATH']}"
        self.printed = None
        self.did = {"runs": 0, "outputs": 0, "files": 0}

    def check(self):
        for block in blocks(self.text):
            if block.words and block.words[0] == "run":
                self.run(block)
            elif block.words == ["output"]:
                if self.printed is None:
                    raise Wrong(f"{block.line}: an output, and nothing was run")
                compare(block, self.printed)
                self.did["outputs"] += 1
            elif path := block.option("file"):
                file = self.folder / path
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(block.text, encoding="utf-8")
                self.did["files"] += 1
            elif path := block.option("same"):
                if without_indent(block.text) not in without_indent((ROOT / path).read_text(encoding="utf-8")):
                    raise Wrong(f"{block.line}: this does not stand in {path}")
                self.did["files"] += 1
            elif block.words != ["shown"]:
                raise Wrong(f"{block.line}: {block.language!r} {block.words} (allowed: run, shown, output, file=PATH, same=PATH)")
        return self.did

    def run(self, block):
        where = ROOT if block.option("in") == "source" else self.folder
        # Standard error belongs to what a reader sees.
        script = "set -euo pipefail\n" + block.text
        environment = dict(self.environment)
        if where == self.folder:
            # A reader's crate has a target folder of its own.
            environment.pop("CARGO_TARGET_DIR", None)
        done = subprocess.run(
            ["bash", "-c", script], cwd=where, env=environment, timeout=PATIENCE,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        wanted = int(block.option("exit") or 0)
        if done.returncode != wanted:
            raise Wrong(f"{block.line}: exit code {done.returncode} (allowed: {wanted}):\n{done.stdout}")
        self.printed = done.stdout
        self.did["runs"] += 1


def checked(volver, text):
    with tempfile.TemporaryDirectory() as folder:
        return Page(volver, text, pathlib.Path(folder)).check()


# A page that is right, what is done to it, and a word of what has to be said.
RIGHT = """
```python file=march.py
import math
print("order", math.pi)
raise SystemExit(1)
```

```sh run exit=1
python3 march.py
```

```text output
order 3.1416
```

```sh run
volver fit --expect 2 - <<'END'
.4 8e-2
.2 2e-2
.1 5e-3
.05 1.25e-3
END
```

```text output
…
verdict Confirmed …
```
"""
BREAKS = [
    ("another digit", ("3.1416", "3.1417"), "not printed"),
    ("another word", ("order 3.1416", "orders 3.1416"), "not printed"),
    ("a line that is not printed", ("order 3.1416", "order 3.1416\nand more"), "not printed"),
    ("another exit code", ("sh run exit=1", "sh run"), "exit code 1"),
    ("code that does something else", ("math.pi", "math.e"), "not printed"),
    ("another verdict", ("verdict Confirmed", "verdict TooLow"), "not printed"),
    ("a file that is not written", ("python file=march.py", "python shown"), "exit code 2"),
    ("a block that nobody runs", ("sh run\n", "sh\n"), "allowed: run"),
    ("a command that fails", ("--expect 2", "--expect 3"), "exit code 1"),
]


def main():
    volver, *pages = sys.argv[1:]
    volver = pathlib.Path(volver).resolve()
    texts = {pathlib.Path(page).name: pathlib.Path(page).read_text(encoding="utf-8") for page in pages}
    failures = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {name: pool.submit(checked, volver, text) for name, text in texts.items()}
        for name, run in runs.items():
            try:
                did = run.result()
                print(f"{name}: {did['runs']} runs, {did['outputs']} outputs compared, {did['files']} files", flush=True)
                if not did["outputs"]:
                    failures.append(f"{name}: compares nothing")
            except (Wrong, subprocess.TimeoutExpired) as error:
                failures.append(f"{name}:{error}")
    checked(volver, RIGHT)
    for what, (before, after), words in BREAKS:
        broken = RIGHT.replace(before, after, 1)
        try:
            checked(volver, broken)
            failures.append(f"{what}: nobody notices")
        except Wrong as error:
            if broken == RIGHT or words not in str(error):
                failures.append(f"{what}: found is {error}")
    print(f"{len(BREAKS)} broken pages found", flush=True)
    for failure in failures:
        print(f"tests/tutorials/check: {failure}", file=sys.stderr)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
