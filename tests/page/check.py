"""Reads pages in Chromium as their readers would: check.py CHROMIUM OUTPUT PAGE...

Every page, in light, dark and on a phone: no word on the console, no request, all plots there, tables that sort,
legends that switch. Then pages are broken on purpose, and each break has to be found: a check that cannot fail
checks nothing. Pictures and a PDF go to OUTPUT. Exit code 1: something is wrong.
"""

import pathlib
import sys

from devtools import Browser

HERE = pathlib.Path(__file__).resolve().parent
CHECKS = (HERE / "checks.js").read_text(encoding="utf-8")

# Window, theme of the system, phone.
LOOKS = {"light": (1280, 900, "light", False), "dark": (1280, 900, "dark", False), "phone": (390, 844, "light", True)}

# What is broken, how, and a word of what has to be said.
POLICY = 'http-equiv="Content-Security-Policy"'
BREAKS = [
    ("an exception", ("</body>", "<script>nothing.at.all()</script></body>"), "console: "),
    ("a word on the console", ("</body>", "<script>console.log('here')</script></body>"), "console: "),
    ("a picture from elsewhere", ("</body>", '<img src="https://example.org/a.png"></body>'), "console: "),
    ("no policy, and a request", (POLICY, 'name="x"', "</body>", '<img src="http://127.0.0.1:9/a.png"></body>'), "request: "),
    ("numbers sorted as text", ("Number(x) - Number(y)", "(x < y ? -1 : 1)"), "is not ascending"),
    ("tables that do not sort", ("body.append(...sorted)", "void sorted"), "is not "),
    ("plots without height", ("</style>", ".plot > svg { height: 0 !important }</style>"), "plot '"),
    ("invisible curves", ("</style>", ".series * { stroke: var(--ground) !important }</style>"), "of series"),
    ("a legend that switches nothing", ('.series[hidden] { display: none; }', ""), "does not hide"),
    ("no tips", ('tip.hidden = false', "void 0"), "no tip"),
    ("grey on white", ("--muted: #57606c", "--muted: #b0b0b0"), "contrast"),
    ("a page wider than the window", ("</style>", "h1 { width: 3000px }</style>"), "wide in a window"),
]


def wrong(browser, url, look, picture=None):
    """What is wrong with a page, and what there was to see."""
    browser.look(*look)
    browser.open(url)
    if picture:
        browser.photograph(picture)
    result = browser.run(CHECKS)
    found = result["wrong"]
    found += [f"console: {text}" for text in browser.said]
    found += [f"request: {asked}" for asked in browser.asked if asked != url and not asked.startswith("data:")]
    return found, result["told"]


def main():
    program, output, *pages = sys.argv[1:]
    output = pathlib.Path(output)
    output.mkdir(parents=True, exist_ok=True)
    failures = []
    seen = {}
    with Browser(program) as browser:
        for page in map(pathlib.Path, pages):
            name = f"{page.parent.name}-{page.stem}"
            url = page.resolve().as_uri()
            for look, settings in LOOKS.items():
                found, told = wrong(browser, url, settings, output / f"{name}-{look}.png")
                failures += [f"{name}, {look}: {words}" for words in found]
                seen = {key: seen.get(key, 0) + count for key, count in told.items()}
            browser.look(*LOOKS["light"])
            browser.open(url)
            browser.print(output / f"{name}.pdf")
            print(f"{name}: {told['plots']} plots, {told['tables']} tables", flush=True)
        # Columns in which text and numbers, or good and bad, would sort in different ways: without any, nothing was tested.
        failures += [f"the pages have no {key} to tell by" for key, count in seen.items() if count == 0]

        for what, changes, words in BREAKS:
            if not any(broken(browser, pathlib.Path(page), output, changes, words) for page in pages):
                failures.append(f"{what}: nobody notices")
        print(f"{len(BREAKS)} broken pages found", flush=True)
    for failure in failures:
        print(f"tests/page/check: {failure}", file=sys.stderr)
    sys.exit(1 if failures else 0)


def broken(browser, page, output, changes, words):
    """Whether a break of this page is found."""
    text = page.read_text(encoding="utf-8")
    for old, new in zip(changes[::2], changes[1::2]):
        if old not in text:
            raise SystemExit(f"tests/page/check: nothing to break: the page has no '{old}'")
        # The page's own elements come last.
        text = new.join(text.rsplit(old, 1)) if old == "</body>" else text.replace(old, new)
    file = output / "broken.html"
    file.write_text(text, encoding="utf-8")
    try:
        found, _ = wrong(browser, file.resolve().as_uri(), LOOKS["light"])
        return any(words in one for one in found)
    finally:
        file.unlink()


main()
