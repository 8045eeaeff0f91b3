"""Reads the site in Chromium as its readers would: check.py CHROMIUM SITE OUTPUT.

Every page of tutorials, verdicts, faults and the reference, in a wide window and on a phone: no word on the console, nothing
asked of a network, every picture there and of a size to be seen, no page wider than the window, a heading. Then pages are
broken on purpose, and each break has to be found. Pictures of some go to OUTPUT. Exit code 1: something is wrong.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "page"))
from devtools import Browser  # noqa: E402

# Window, theme of the system, phone.
LOOKS = {"wide": (1280, 900, "light", False), "dark": (1280, 900, "dark", False), "phone": (400, 860, "light", True)}
# Of these there are pictures to look at.
SEEN = ["index", "tutorials/python", "verdicts/toolow", "verdicts/index", "faults/last-sample", "faults/index", "verify", "protocol"]
LOOK = """(() => {
  const wrong = [];
  if (document.querySelectorAll('h1').length !== 1) wrong.push('no heading, or several');
  for (const img of document.querySelectorAll('article img')) {
    const box = img.getBoundingClientRect();
    if (!img.complete || !img.naturalWidth) wrong.push(`picture ${img.getAttribute('src')} is not there`);
    else if (box.width < 200 || box.height < 80) wrong.push(`picture ${img.getAttribute('src')} is ${box.width} by ${box.height}`);
    if (!img.alt) wrong.push(`picture ${img.getAttribute('src')} says nothing`);
  }
  const wide = document.scrollingElement.scrollWidth;
  if (wide > innerWidth + 1) wrong.push(`${wide} wide in a window of ${innerWidth}`);
  const article = document.querySelector('article');
  if (!article || article.innerText.length < 100) wrong.push('an empty page');
  return {wrong, pictures: document.querySelectorAll('article img').length};
})()"""
BREAKS = [
    ("a word on the console", ("</body>", "<script>console.log('here')</script></body>"), "console: "),
    ("an exception", ("</body>", "<script>nothing.at.all()</script></body>"), "console: "),
    ("a request", ("</article>", '<img alt="x" src="http://127.0.0.1:9/a.png"></article>'), "request: "),
    ("a picture that is not there", ("</article>", '<img alt="x" src="none.svg"></article>'), "is not there"),
    ("a picture too small to see", ("</head>", "<style>article img { width: 9px !important }</style></head>"), " by "),
    ("a page wider than the window", ("</head>", "<style>h1 { width: 3000px }</style></head>"), "wide in a window"),
    ("no heading", ("<h1", "<h2"), "no heading"),
]


def wrong(browser, url, look):
    browser.look(*look)
    browser.open(url, patience=0.0)
    # Pictures below the window are loaded when they are needed.
    browser.run("Promise.all([...document.images].map(i => { i.loading = 'eager'; return i.decode().catch(() => 0) })).then(() => 0)")
    told = browser.run(LOOK)
    found = told["wrong"] + [f"console: {text}" for text in browser.said]
    return found + [f"request: {one}" for one in browser.asked if not one.startswith(("file:", "data:"))], told["pictures"]


def main():
    program, site, output = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    output.mkdir(parents=True, exist_ok=True)
    names = [path.relative_to(site).with_suffix("") for path in sorted(site.rglob("*.html"))]
    names = [str(name) for name in names if name.parts[0] != "repository" or name.name == "README"]
    names = [name for name in names if name not in ("search", "genindex")]
    failures, pictures = [], 0
    with Browser(program) as browser:
        for name in names:
            url = (site / f"{name}.html").resolve().as_uri()
            for look, settings in LOOKS.items():
                if look == "dark" and name not in SEEN:
                    continue
                found, count = wrong(browser, url, settings)
                pictures += count
                failures += [f"{name}, {look}: {words}" for words in found]
                if name in SEEN:
                    browser.photograph(output / f"{name.replace('/', '-')}-{look}.png", most=3000)
        failures += [f"{name}: no such page" for name in SEEN if name not in names]
        page = site / "verdicts" / "toolow.html"
        broken = site / "verdicts" / "broken.html"
        for what, (before, after), words in BREAKS:
            broken.write_text(page.read_text(encoding="utf-8").replace(before, after), encoding="utf-8")
            try:
                found = wrong(browser, broken.resolve().as_uri(), LOOKS["wide"])[0]
            finally:
                broken.unlink()
            if not any(words in one for one in found):
                failures.append(f"{what}: nobody notices")
    print(f"{len(names)} pages read, {pictures} pictures seen, {len(BREAKS)} broken pages found")
    for failure in failures:
        print(f"tests/site/check: {failure}", file=sys.stderr)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
