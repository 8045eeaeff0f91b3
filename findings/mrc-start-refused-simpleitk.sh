#!/usr/bin/env bash
# SimpleITK 2.5.7, mrcfile 1.5.4: an MRC volume whose first column's number is not below its number of columns.
# Expected: NXSTART is where the volume lies in a larger one; a crop of 5 columns that begins at column 7 is as good as
#   one that begins at column 2, and both are read.
# Does: SimpleITK refuses the file ("Unrecognized header") as soon as NXSTART >= NX; below that, negative ones
#   included, it reads the file and does not use the number: the origin stays 0.
# Seen: NX 5; NXSTART -6, 0, 4: read, origin 0 0 0; 5, 7: refused. mrcfile's validation passes all of them.
# Crops of maps, of which most begin further along than they are long, are so the ones that are refused.
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check SimpleITK==2.5.7 mrcfile==1.5.4 numpy==2.4.6
cat >see.py <<'P'
import sys
import mrcfile
import numpy as np
import SimpleITK

SimpleITK.ProcessObject.SetGlobalWarningDisplay(False)
seen = []
for start in (-6, 0, 4, 5, 7):
    with mrcfile.new("a.mrc", overwrite=True) as file:
        file.set_data(np.zeros((3, 4, 5), "f4"))
        file.voxel_size = 2
        file.nstart = (start, 0, 0)
    valid = mrcfile.validate("a.mrc", print_file=open("log", "w"))
    try:
        answer = SimpleITK.ReadImage("a.mrc").GetOrigin()
    except RuntimeError:
        answer = "refused"
    print("first column", start, "of 5; valid:", valid, "SimpleITK:", answer)
    seen.append((valid, answer))
zero = (True, (0.0, 0.0, 0.0))
sys.exit(seen != [zero, zero, zero, (True, "refused"), (True, "refused")])
P
v/bin/python see.py
