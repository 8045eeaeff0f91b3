"""The source of the site: stage.py VOLVER STAGE writes what Sphinx reads into STAGE.

Pages of docs/ and docs/tutorials/ stay as they are, but for links that leave docs/: what they lead to becomes a page of the
site, repository/PATH, so that no link of the site needs a network. Pages of verdicts and faults are made by runs of the
program (pages.py). A link that leads nowhere ends it with exit code 1.
"""

import os
import pathlib
import re
import shutil
import sys

import pages

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
LINK = re.compile(r"(\]\()([^()\s]+)(\))")
LANGUAGES = {".c": "c", ".h": "c", ".py": "python", ".rs": "rust", ".toml": "toml", ".sh": "bash", ".json": "json", ".yml": "yaml"}
# The reference, in the order of a reader who comes to it from the tutorials.
REFERENCE = [
    "verify", "identify", "gallery", "verdicts", "gradient", "protocol", "commands", "report", "study", "tradeoff", "scenes", "images", "cases",
    "nonsmooth", "stress", "scale", "python", "trust", "benchmarks", "architecture", "contributing",
]  # fmt: skip
MOST = 30
TUTORIALS = ["function", "python", "cpp", "rust", "volume", "which-error", "how-many-bits", "gradients", "ci"]


class Stage:
    """What was written, and what is still to be: files of the repository that pages link to."""

    def __init__(self, folder):
        self.folder = folder
        self.linked = {}
        self.dead = []

    def write(self, page, text):
        path = self.folder / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def copied(self, source, page):
        """A page of Markdown, with its links made to hold where it is put."""
        text = source.read_text(encoding="utf-8")
        self.write(page, self.relinked(text, source, page))

    def relinked(self, text, source, page):
        def moved(match):
            return match[1] + self.target(match[2], source, page) + match[3]

        lines, fence = [], None
        for line in text.splitlines(keepends=True):
            opening = re.match(r"\s*(```+|~~~+)", line)
            if opening and (fence is None or opening[1].startswith(fence)):
                # No lexer draws diagrams: they stand as they are written.
                line = line.replace("```mermaid", "```text")
                fence = opening[1] if fence is None else None
            elif fence is None and not line.startswith("    "):
                # Spans of code hold no links, but the text of a link may be one.
                line = LINK.sub(moved, line)
            lines.append(line)
        return "".join(lines)

    def target(self, link, source, page):
        path, hash_mark, anchor = link.partition("#")
        if not path or re.match(r"[a-z]+:", path):
            return link
        file = pathlib.Path(os.path.normpath(source.parent / path))
        if not file.exists():
            self.dead.append(f"{source.relative_to(ROOT)}: {link}")
            return link
        if file.is_relative_to(DOCS) and not file.is_relative_to(DOCS / "site"):
            goal = file.relative_to(DOCS)
        else:
            goal = self.linked.setdefault(file, self.place(file))
        return os.path.relpath(goal, pathlib.Path(page).parent) + hash_mark + anchor

    @staticmethod
    def place(file):
        inside = pathlib.Path("repository") / file.relative_to(ROOT)
        if file.is_dir():
            return inside / "index.md"
        return inside if file.suffix == ".md" else inside.with_name(inside.name + ".md")

    def repository(self):
        """The pages of what is linked to, and of what these link to."""
        done = set()
        while todo := self.linked.keys() - done:
            for file in sorted(todo):
                done.add(file)
                self.of_file(file, self.linked[file])
        return sorted(str(page.with_suffix("")) for page in self.linked.values())

    def of_file(self, file, page):
        name = file.relative_to(ROOT)
        if file.is_dir():
            inside = [entry for entry in sorted(file.iterdir()) if not entry.name.startswith((".", "__")) and entry.name != "target"]
            # Of a long list the names will do.
            named = [f"- `{entry.name}`" for entry in inside]
            linked = [f"- [`{entry.name}`]({self.target(entry.name, file / 'index', page)})" for entry in inside]
            rows = linked if len(inside) <= MOST else named
            self.write(page, f"# `{name}/`\n\n" + "\n".join(rows) + "\n")
        elif file.suffix == ".md":
            self.copied(file, page)
        else:
            text = file.read_text(encoding="utf-8")
            language = LANGUAGES.get(file.suffix, "bash" if text.startswith("#!") else "text")
            fence = "`" * max([3] + [len(run) + 1 for run in re.findall("`+", text)])
            self.write(page, f"# `{name}`\n\n{fence}{language}\n{text.rstrip()}\n{fence}\n")


def toctree(caption, entries, depth=1):
    return f"```{{toctree}}\n:caption: {caption}\n:hidden:\n:maxdepth: {depth}\n\n" + "\n".join(entries) + "\n```\n\n"


def main():
    volver, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    stage = Stage(folder)
    for source in sorted([*DOCS.glob("*.md"), *(DOCS / "tutorials").glob("*.md")]):
        stage.copied(source, str(source.relative_to(DOCS)))
    for picture in [*DOCS.glob("*.svg"), *DOCS.glob("*.json")]:
        shutil.copy(picture, folder)
    listed = {path.stem for path in DOCS.glob("*.md")} - {"index"}
    if listed != set(REFERENCE):
        sys.exit(f"docs/site/stage.py: REFERENCE lacks, or has too many: {sorted(listed ^ set(REFERENCE))}")
    for kernel in pages.kernels():
        stage.linked[kernel] = stage.place(kernel)
    made = pages.write(volver, folder)
    pages.link_names(folder)
    linked = stage.repository()
    if stage.dead:
        sys.exit("docs/site/stage.py: these links lead nowhere:\n" + "\n".join(stage.dead))
    index = (folder / "index.md").read_text(encoding="utf-8")
    index += "\n" + toctree("Tutorials", [f"tutorials/{name}" for name in TUTORIALS])
    index += toctree("Look it up", ["verdicts/index", "faults/index"])
    index += toctree("Reference", REFERENCE)
    index += toctree("Repository", ["repository/README", "repository/index"])
    files = [str(pathlib.Path(page).relative_to("repository")) for page in linked if page != "repository/README"]
    stage.write("repository/index.md", "# Files\n\nFiles of the repository that pages lead to, as they were when the site was made.\n\n"
                "```{toctree}\n:maxdepth: 1\n\n" + "\n".join(files) + "\n```\n")  # fmt: skip
    (folder / "index.md").write_text(index, encoding="utf-8")
    print(f"{made['verdict']} pages of verdicts, {made['fault']} of faults, {len(linked)} of files that pages link to")


if __name__ == "__main__":
    main()
