#!/usr/bin/env bash
# SimpleITK 2.5.7: Shrink, which takes every f-th sample, and the coordinates it gives them.
# Expected: the samples taken are fixed by the factor (the middle of each block), an odd factor's are true middles, and
#   the origin is where the first of them lay; one more sample at the far end changes nothing in front.
# Does: the origin is set so that old and new image have one centre, and the samples are those nearest after rounding: so
#   which ones are taken depends on the size, and for half or a third of all sizes values and coordinates are half a voxel
#   apart, for odd factors too. BinShrink has 0 throughout.
# Seen: ramp f(x) = x, factor 3, sizes 9 to 14: first sample 1 2 2 1 2 2, value less coordinate 0 0.5 0 0 0.5 0;
#   factor 2: first sample 1 throughout, 0 at odd sizes, 0.5 at even sizes.
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check SimpleITK==2.5.7 numpy==2.4.6
cat >see.py <<'P'
import sys
import numpy as np
import SimpleITK


def shrunk(filter, size, factor):
    ramp = SimpleITK.GetImageFromArray(np.repeat(np.arange(size, dtype="f8")[None], size, axis=0))
    out = filter(ramp, [factor, factor])
    row = SimpleITK.GetArrayFromImage(out)[0]
    error = row - (out.GetOrigin()[0] + out.GetSpacing()[0] * np.arange(len(row)))
    assert np.ptp(error) == 0
    return float(row[0]), float(error[0])


seen = {}
for factor in (2, 3):
    rows = [shrunk(SimpleITK.Shrink, size, factor) for size in range(9, 15)]
    bins = [shrunk(SimpleITK.BinShrink, size, factor)[1] for size in range(9, 15)]
    print("factor", factor, "sizes 9 to 14: first sample", [r[0] for r in rows], "value less coordinate",
          [r[1] for r in rows], "BinShrink", bins)
    seen[factor] = ([r[0] for r in rows], [r[1] for r in rows], bins)
zeros = [0.0] * 6
sys.exit(seen != {
    2: ([1.0] * 6, [0.0, 0.5] * 3, zeros),
    3: ([1.0, 2.0, 2.0, 1.0, 2.0, 2.0], [0.0, 0.5, 0.0, 0.0, 0.5, 0.0], zeros),
})
P
v/bin/python see.py
