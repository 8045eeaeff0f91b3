"""What the checks of volumes and pictures share: volver's example `convert`, and the table of what was compared."""

import json
import pathlib
import subprocess
import sys


class Converter:
    """Runs `convert`, and keeps what was compared."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = pathlib.Path(folder)
        self.rows = []

    def path(self, name):
        return str(self.folder / name)

    def run(self, what, name, to=None):
        """What `convert` prints of a file, which it writes to another as well."""
        command = [self.program, what, self.path(name)] + ([self.path(to)] if to else [])
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        if done.returncode:
            raise ValueError(done.stderr.strip())
        return json.loads(done.stdout)

    def refused(self, what, name, word):
        """A file that is not taken, with a word of the message."""
        try:
            self.run(what, name)
        except ValueError as error:
            message = str(error).removeprefix(self.path(name) + ": ")
            self.row(name, "refused", word in message, message if word not in message else word)
        else:
            self.row(name, "refused", False, "it was read")

    def row(self, name, what, right, remark=""):
        self.rows.append((name, what, right, remark))

    def end(self, title):
        print(title)
        for name, what, right, remark in self.rows:
            print(f"  {name:<34} {what:<38} {'same' if right and what != 'refused' else 'yes' if right else 'NO'} {remark}".rstrip())
        wrong = sum(not right for _, _, right, _ in self.rows)
        print(f"  {len(self.rows)} compared, {wrong} wrong")
        sys.exit(1 if wrong or not self.rows else 0)
