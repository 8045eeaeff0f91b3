"""Failures of a JUnit file as annotations of GitHub: one line each on standard output."""

import sys
import xml.etree.ElementTree as ElementTree


def escaped(text, more=()):
    """As workflow commands want it."""
    for letter in ("%", "\r", "\n", *more):
        text = text.replace(letter, f"%{ord(letter):02X}")
    return text


def main():
    for case in ElementTree.parse(sys.argv[1]).getroot().iter("testcase"):
        for kind in ("failure", "error"):
            for found in case.findall(kind):
                title = escaped(f"volver: {case.get('name')}", (":", ","))
                text = (found.get("message") or "") + "\n" + (found.text or "")
                print(f"::error title={title}::{escaped(text.strip())}")


if __name__ == "__main__":
    main()
