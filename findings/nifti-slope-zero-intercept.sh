#!/usr/bin/env bash
# SimpleITK 2.5.7 and nibabel 5.4.2: a NIfTI-1 file with scl_slope 0 or NaN and an intercept.
# Expected: the format says that samples are scaled if scl_slope is not 0; so with slope 0 the intercept is without effect.
# Does: nibabel leaves the samples as they are. SimpleITK takes the slope for 1 and adds the intercept.
# Seen: a stored 59, intercept 100: slope 0 -> nibabel 59, SimpleITK 159; slope NaN -> 59 and 159; slope 1 -> 159 and 159.
# So a volume's densities differ by a constant between two readers that both call the file good.
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check SimpleITK==2.5.7 nibabel==5.4.2 numpy==2.4.6
cat >see.py <<'P'
import struct
import sys
import nibabel
import numpy as np
import SimpleITK

volume = np.full((4, 5, 6), 59, "i2")
seen = []
for slope in (0.0, float("nan"), 1.0):
    nibabel.save(nibabel.Nifti1Image(volume, np.diag([2.0, 3.0, 4.0, 1.0])), "a.nii")
    data = bytearray(open("a.nii", "rb").read())
    data[112:120] = struct.pack("<ff", slope, 100.0)  # scl_slope, scl_inter
    open("a.nii", "wb").write(data)
    image = nibabel.load("a.nii")
    raw = struct.unpack("<ff", open("a.nii", "rb").read()[112:120])
    values = (float(image.get_fdata()[1, 2, 3]), float(SimpleITK.ReadImage("a.nii")[1, 2, 3]))
    print("slope, intercept", raw, "nibabel, SimpleITK", values)
    seen.append(values)
sys.exit(seen != [(59.0, 159.0), (59.0, 159.0), (159.0, 159.0)])
P
v/bin/python see.py
