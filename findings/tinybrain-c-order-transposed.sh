#!/usr/bin/env bash
# tinybrain 1.7.0: downsample_segmentation by 2 x 2 x 2 of an array in NumPy's usual (C) order.
# Expected: the same labels as from a Fortran-ordered copy: the readme says that other orders take a slower way, and
#   downsample_with_averaging and the factor (2, 2, 1) do give the same.
# Does: with (2, 2, 2) the memory of a C-ordered array is read as if it were in Fortran order. The shape is right, only
#   labels that exist come out, nothing is said, and nearly all are in the wrong place.
# Seen: blocks of 2 x 2 x 2 equal labels, 4 x 5 x 6 of them: labels in the right place: (2, 2, 2) C 2 of 120, F 120 of 120;
#   (2, 2, 1) C and F all; averaging (2, 2, 2) C and F all. A ramp along the first axis comes out along the last.
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check tinybrain==1.7.0 numpy==2.4.6
cat >see.py <<'P'
import sys
import numpy as np
import tinybrain

labels = np.random.default_rng(0).integers(1, 1000, (4, 5, 6)).astype("u4")
fine = labels.repeat(2, 0).repeat(2, 1).repeat(2, 2)
seen = {}
for order in "CF":
    volume = np.asarray(fine, order=order)
    cube = tinybrain.downsample_segmentation(volume, (2, 2, 2))[0]
    flat = tinybrain.downsample_segmentation(volume, (2, 2, 1))[0]
    mean = tinybrain.downsample_with_averaging(volume.astype("f4"), (2, 2, 2))[0]
    assert cube.shape == labels.shape and np.isin(cube, labels).all()
    seen[order] = [int((cube == labels).sum()), bool((flat == labels.repeat(2, 2)).all()), bool((mean == labels).all())]
    print(order, "order: right by (2, 2, 2)", seen[order][0], "of", labels.size,
          "; by (2, 2, 1):", seen[order][1], "; averaged:", seen[order][2])
ramp = np.ones((8, 8, 8), "u4") * np.arange(8, dtype="u4")[:, None, None] // 2 + 1
turned = tinybrain.downsample_segmentation(ramp, (2, 2, 2))[0]
print("ramp 1 2 3 4 along the first axis: first axis", turned[:, 0, 0], "last axis", turned[0, 0])
ok = seen["C"][0] < 10 and seen["C"][1:] == [True, True] and seen["F"] == [labels.size, True, True]
ok = ok and turned[:, 0, 0].tolist() == [1] * 4 and turned[0, 0].tolist() == [1, 2, 3, 4]
sys.exit(not ok)
P
v/bin/python see.py
