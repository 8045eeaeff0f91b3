"""The version of the program and of this package; made by python/generate.py."""

VERSION = "0.1.0"
