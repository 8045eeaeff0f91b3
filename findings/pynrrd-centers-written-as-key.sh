#!/usr/bin/env bash
# pynrrd 1.1.3, SimpleITK 2.5.7: `centers`, NRRD's own name for the centring of axes (`centerings` is its other name).
# Expected: nrrd.write of {"centers": ["node"] * 3} writes the field, or refuses it.
# Does: it knows `centerings` alone, and writes `centers:=['node', 'node', 'node']`, a key of the user, which says nothing to any
#   reader. ITK then takes the centring for missing and adds half a spacing to `axis mins`.
# Seen: axis mins 0, spacing 2: origin (1, 1, 1) with "centers", (0, 0, 0) with "centerings"; ITK itself reads a header with
#   `centers: node node node` as (0, 0, 0).
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check pynrrd==1.1.3 SimpleITK==2.5.7 numpy==2.4.6
cat >see.py <<'P'
import nrrd
import numpy as np
import SimpleITK

origins = {}
for key in ("centers", "centerings"):
    header = {"spacings": np.full(3, 2.0), "axis mins": np.zeros(3), "encoding": "raw", key: ["node"] * 3}
    nrrd.write(f"{key}.nrrd", np.zeros((12, 5, 3), "f4"), header)
    with open(f"{key}.nrrd", "rb") as file:
        line = next(line for line in file if line.startswith(b"center"))
    origins[key] = SimpleITK.ReadImage(f"{key}.nrrd").GetOrigin()
    print(key, line.decode().strip(), origins[key])
with open("hand.nrrd", "w") as file:
    file.write(
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n"
        "spacings: 2 2 2\naxis mins: 0 0 0\ncenters: node node node\n\nab"
    )
origins["by hand"] = SimpleITK.ReadImage("hand.nrrd").GetOrigin()
print("by hand", origins["by hand"])
assert origins == {"centers": (1, 1, 1), "centerings": (0, 0, 0), "by hand": (0, 0, 0)}
P
v/bin/python see.py
