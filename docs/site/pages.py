"""Pages of verdicts and of faults, each with what the program says and draws of a kernel that has it.

verdicts.toml and faults.toml say which kernel and why; the tables of docs/verdicts.md and docs/identify.md say which names
there are and what they mean. A kernel that is not found to be what its page says ends it with exit code 1.
"""

import concurrent.futures
import difflib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# Of what is printed only these parts, which begin so.
TOLD = ("  case ", "How it deviates", "Many rays in one request", "The smallest ray", "confirmed:", "not confirmed:")
KERNELS = ["march", "ends", "volume", "formula", "batched"]
OF_LAW = "segments between references"
PICTURES = {
    "weights": "What values along an even ray weigh, and how much of their light reaches the eye, beside the rule without faults",
    "opacity": "Opacity of a segment over its depth, beside 1 − exp(−τd)",
}


class Wrong(Exception):
    """A page that would not say the truth."""


def table(page, heading):
    """The rows of the first table below a heading: names in the order in which they stand, and what is said of them."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8").split(f"\n{heading}\n", 1)[1]
    rows = []
    for line in text.splitlines():
        if line.startswith("| ") or line.startswith("|-"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
        elif rows:
            break
    return [([name.strip(" `") for name in row[0].split(",")], row[1]) for row in rows[2:]]


def verdicts():
    return {name: meaning for names, meaning in table("verdicts.md", "## The verdicts") for name in names}


def faults():
    return {name: meaning for names, meaning in table("identify.md", "## Deviations") for name in names}


def kernels():
    """The kernels that faults are built into."""
    return [HERE / f"{name}.py" for name in KERNELS]


def built(entry):
    """The kernel with its changes, and without."""
    plain = (HERE / (entry.get("kernel", "march") + ".py")).read_text(encoding="utf-8")
    source = plain
    for before, after in entry.get("change", []):
        if source.count(before) != 1:
            raise Wrong(f"{entry['name']}: {before!r} stands in the kernel {source.count(before)} times (allowed: once)")
        source = source.replace(before, after)
    return plain, source


def source_of(entry):
    """The page of the kernel without the change, from that of a verdict or a fault."""
    return f"../repository/docs/site/{entry.get('kernel', 'march')}.py.md"


def difference(plain, source):
    lines = difflib.unified_diff(plain.splitlines(), source.splitlines(), lineterm="", n=1)
    return "\n".join(line for line in lines if not line.startswith(("---", "+++", "@@")))


def run(volver, folder, arguments):
    done = subprocess.run([volver, *arguments], cwd=folder, capture_output=True, text=True, timeout=300)
    if done.returncode not in (0, 1):
        raise Wrong(f"volver {shlex.join(arguments)}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def told(printed):
    """The parts of a report that a page shows."""
    parts = re.split(r"\n\s*\n", printed.strip("\n"))
    printed = "\n\n".join(part for part in parts if part.startswith(TOLD))
    return re.sub(r"\n\d+ files in out$", "", printed)


def fault(volver, folder, stage, entry, meaning):
    name = entry["name"]
    plain, source = built(entry)
    work = folder / name
    work.mkdir()
    shutil.copy(ROOT / "examples/kernels/volver_kernel.py", work)
    (work / "mine.py").write_text(source, encoding="utf-8")
    cases = entry.get("cases", "sine-squared")
    arguments = ["verify", "--identify", "full", "--cases", cases, "python3", "mine.py"]
    printed = run(volver, work, [*arguments[:1], "--json", "found.json", "--out", "out", *arguments[1:]])
    if entry.get("by") == "identify":
        arguments = ["identify", "python3", "mine.py"]
        printed = run(volver, work, [*arguments[:1], "--json", "found.json", *arguments[1:]])
    found = json.loads((work / "found.json").read_text(encoding="utf-8"))
    found = found.get("identification", found)
    deviations = [one["name"] for one in found["deviations"]]
    if name not in deviations:
        raise Wrong(f"{name}: its kernel is found to have {deviations} (needed: {name})")
    errors = cases.split(",")[0]
    pictures = [(next((work / "out").glob(f"{errors}*.svg")), f"Errors of {errors} against n")]
    # Where segments follow their law its picture shows nothing.
    is_of_law = any(one["probe"] == OF_LAW for one in found["deviations"])
    pictures += [(work / "out" / f"{one}.svg", what) for one, what in PICTURES.items() if one != "opacity" or is_of_law]
    shown = drawn(stage / "faults", name, pictures)
    others = [f"[`{one}`]({one}.md)" for one in deviations if one != name]
    beside = f" Found beside it: {', '.join(others)}." if others else ""
    page = f"""# {entry['title']}

`{name}`: {meaning}.

{entry['from']}

## Built into a kernel

[A ray marcher]({source_of(entry)}) with it is `mine.py`:

```diff
{difference(plain, source)}
```

## What volver says

    volver {shlex.join(arguments)}

```text
{told(printed)}
```
{beside}
{shown}
## What to do

{entry['cure']}

Where it is meant and stays, `--accept {name}` lets the deviation pass, though no order that is too low; [`volver check`](../verify.md#baselines-in-ci) sees that it does not get worse. All names: [what a kernel computes](../identify.md#deviations).
"""
    (stage / "faults" / f"{name}.md").write_text(page, encoding="utf-8")


def verdict(volver, folder, stage, entry, meaning):
    name = entry["name"]
    plain, source = built(entry)
    meaning = entry.get("meaning", meaning)
    work = folder / name
    work.mkdir()
    shutil.copy(ROOT / "examples/kernels/volver_kernel.py", work)
    (work / "mine.py").write_text(source, encoding="utf-8")
    arguments = shlex.split(entry["run"])
    printed = run(volver, work, ["verify", "--json", "found.json", "--out", "out", *arguments])
    lines = json.loads((work / "found.json").read_text(encoding="utf-8"))["lines"]
    picture = work / "out" / f"{entry.get('case', 'sine-squared' if 'sine-squared' in entry['run'] else arguments[1].replace('/', '-'))}.svg"
    case = entry.get("of", picture.stem)
    seen = {line["name"].replace("/", "-"): line["verdict"] for line in lines}
    if seen.get(case) != name:
        raise Wrong(f"{name}: the verdicts of its run are {seen} (needed: {name} of {case})")
    shown = drawn(stage / "verdicts", name.lower(), [(picture, f"Errors of {picture.stem} against n")])
    kernel = ""
    if "mine.py" in entry["run"]:
        what = f"\n\n```diff\n{difference(plain, source)}\n```" if entry.get("change") else ", as it is."
        kernel = f"`mine.py` is [a ray marcher]({source_of(entry)}){', changed so:' if entry.get('change') else ''}{what}\n\n"
    page = f"""# {name}

{meaning[0].upper() + meaning[1:]}.

{shown}
## A run that has it

{kernel}    volver verify {entry['run']}

```text
{told(printed)}
```

## What to do

{entry['do']}

How verdicts come about: [orders and verdicts](../verdicts.md).
"""
    (stage / "verdicts" / f"{name.lower()}.md").write_text(page, encoding="utf-8")


def drawn(folder, name, pictures):
    """Pictures that are there, copied, in Markdown."""
    shown = ""
    for path, what in pictures:
        if path.exists():
            copy = f"{name}-{path.name}"
            shutil.copy(path, folder / copy)
            shown += f"![{what}]({copy})\n\n"
    if not shown:
        raise Wrong(f"{name}: no picture")
    return shown


def index(folder, title, words, entries):
    rows = "\n".join(f"| [{label}]({page}.md) | {meaning} |" for label, page, meaning in entries)
    names = "\n".join(page for _, page, _ in entries)
    text = f"# {title}\n\n{words}\n\n| | |\n|---|---|\n{rows}\n\n```{{toctree}}\n:hidden:\n\n{names}\n```\n"
    (folder / "index.md").write_text(text, encoding="utf-8")


def same(kind, have, want):
    if set(have) != set(want):
        raise Wrong(f"docs/site/{kind}: without a page {sorted(set(want) - set(have))}, unknown {sorted(set(have) - set(want))}")


def write(volver, stage):
    """All pages; how many."""
    asked = tomllib.loads((HERE / "faults.toml").read_text(encoding="utf-8"))
    kinds, without = asked["fault"], asked["without"]
    given = tomllib.loads((HERE / "verdicts.toml").read_text(encoding="utf-8"))["verdict"]
    meanings, names = verdicts(), faults()
    (stage / "verdicts").mkdir(parents=True)
    (stage / "faults").mkdir()
    try:
        same("verdicts.toml", [entry["name"] for entry in given], meanings)
        same("faults.toml", [entry["name"] for entry in kinds] + list(without), names)
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            folder = pathlib.Path(folder)
            for sub in ("fault", "verdict"):
                (folder / sub).mkdir()
            runs = [pool.submit(fault, volver, folder / "fault", stage, entry, names[entry["name"]]) for entry in kinds]
            runs += [pool.submit(verdict, volver, folder / "verdict", stage, entry, meanings[entry["name"]]) for entry in given]
            wrong = [str(error) for error in (one.exception() for one in runs) if error]
        if wrong:
            raise Wrong("\n".join(wrong))
    except Wrong as error:
        sys.exit(f"docs/site/pages.py: {error}")
    index(stage / "verdicts", "A page a verdict", "What each verdict means, a run that has it, and what to do.",
          [(entry["name"], entry["name"].lower(), entry.get("meaning", meanings[entry["name"]])) for entry in given])  # fmt: skip
    kinds = sorted(kinds, key=lambda entry: list(names).index(entry["name"]))
    words = "Each is built into a kernel of a few lines, which `volver` is then asked about: what it says and draws is below. The names are those of [what a kernel computes](../identify.md#deviations)."
    index(stage / "faults", "A page a kind of fault", words, [(f"`{entry['name']}`", entry["name"], entry["title"]) for entry in kinds])
    return {"fault": len(kinds), "verdict": len(given)}


def link_names(stage):
    """In the tables of the reference every name leads to its page."""
    for page, folder, names in [("verdicts.md", "verdicts", verdicts()), ("identify.md", "faults", faults())]:
        path = stage / page
        lines = path.read_text(encoding="utf-8").splitlines()
        for i, line in enumerate(lines):
            cells = line.split("|")
            if len(cells) > 2 and all(name.strip(" `") in names for name in cells[1].split(",")):
                linked = []
                for name in cells[1].split(","):
                    file = f"{folder}/{name.strip(' `').lower()}.md"
                    linked.append(f" [{name.strip()}]({file})" if (stage / file).exists() else f" {name.strip()}")
                cells[1] = ",".join(linked) + " "
                lines[i] = "|".join(cells)
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
