"""Every link of a site resolves: links.py SITE.

Links within the site lead to a file, and behind # to something with that name; nothing is loaded from elsewhere; addresses
of elsewhere are https, with a host, and are not asked. Then links are broken on purpose, and each has to be found.
Exit code 1: a link is dead.
"""

import html.parser
import pathlib
import sys
import urllib.parse

# What a page loads, and by which attribute; all else is for readers to follow.
LOADS = {("img", "src"), ("script", "src"), ("link", "href"), ("source", "src"), ("iframe", "src")}
FOLLOWED = {("a", "href")}
# Said of a page, and not loaded.
NAMED = {"canonical", "next", "prev", "search", "index", "top"}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names |= {given[key] for key in ("id", "name") if given.get(key)}
        for key, value in attributes:
            if (tag, key) in FOLLOWED or (tag, key) in LOADS and given.get("rel") not in NAMED:
                self.links.append(((tag, key) in LOADS, value or "", self.getpos()[0]))


def dead(pages, files):
    """What is wrong, by the pages' texts and the names of all files of the site."""
    read = {name: Page(text) for name, text in pages.items()}
    wrong, count = [], 0
    for name, page in read.items():
        for loads, link, line in page.links:
            count += 1
            said = f"{name}:{line}: {link}"
            parts = urllib.parse.urlsplit(link)
            if parts.scheme == "data":
                continue
            if parts.scheme or parts.netloc:
                if loads:
                    wrong.append(f"{said}: loaded from elsewhere")
                elif parts.scheme != "mailto" and (parts.scheme != "https" or "." not in parts.netloc):
                    wrong.append(f"{said}: no address (allowed: https with a host)")
                continue
            path = urllib.parse.unquote(parts.path)
            goal = resolved(name, path) if path else name
            if goal not in files:
                wrong.append(f"{said}: there is no {goal}")
            elif parts.fragment and goal in read and urllib.parse.unquote(parts.fragment) not in read[goal].names:
                wrong.append(f"{said}: nothing in {goal} has that name")
    return wrong, count


def resolved(name, path):
    parts = []
    for part in [*pathlib.PurePosixPath(name).parent.parts, *path.split("/")]:
        if part == "..":
            if not parts:
                return "what is above the site"
            parts.pop()
        elif part not in ("", "."):
            parts.append(part)
    return "/".join(parts)


BREAKS = [
    ("a page that is not there", '<a href="nowhere.html">x</a>', "there is no nowhere.html"),
    ("an anchor that is not there", '<a href="index.html#nowhere-at-all">x</a>', "nothing in index.html"),
    ("an anchor of its own", '<a href="#nowhere-at-all">x</a>', "has that name"),
    ("a picture that is not there", '<img src="none.svg">', "there is no none.svg"),
    ("a script from elsewhere", '<script src="https://example.org/x.js"></script>', "loaded from elsewhere"),
    ("an address without a host", '<a href="https://example">x</a>', "no address"),
    ("a page above the site", '<a href="../README.md">x</a>', "above the site"),
]


def main():
    site = pathlib.Path(sys.argv[1])
    files = {str(path.relative_to(site)) for path in site.rglob("*") if path.is_file()}
    pages = {name: (site / name).read_text(encoding="utf-8") for name in sorted(files) if name.endswith(".html")}
    wrong, count = dead(pages, files)
    for what, added, words in BREAKS:
        found, _ = dead({"index.html": pages["index.html"] + added, "verdicts.html": pages["verdicts.html"]}, files)
        if not any(words in one for one in found):
            wrong.append(f"{what}: nobody notices")
    print(f"{count} links of {len(pages)} pages, {len(BREAKS)} broken ones found")
    for one in wrong:
        print(f"tests/site/links.py: {one}", file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
