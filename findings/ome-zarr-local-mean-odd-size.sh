#!/usr/bin/env bash
# ome-zarr 0.18.0 (zarr 3.1.6): with method LOCAL_MEAN and a size that the factors do not divide the coarse levels' data and
#   their written coordinates part by up to one coarse voxel.
# Expected: means of blocks of 2, 4, 8 ... voxels carry scale 2, 4, 8 ... and a translation of half a block less half a
#   voxel, whatever the size; what is left over at the end is dropped or padded.
# Does: the data are such means, but the scale is old size / new size (1023 voxels, fifth level of 31: 33, not 32), as if
#   the image had been stretched. The method RESIZE does stretch it, and there the same coordinates are right.
# Seen: a ramp f(x) = x of 1023 voxels, value less written coordinate at the last sample of levels 1 to 5, in fine voxels:
#   LOCAL_MEAN -1.00 -2.99 -6.97 -14.88 -30.50; in the middle -0.5 -1.5 -3.5 -7.5 -15.5.
#   The size 1024: 0 everywhere. RESIZE, 1023, in the middle: 0.
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check ome-zarr==0.18.0 zarr==3.1.6
cat >see.py <<'P'
import sys
import numpy as np
import zarr
from ome_zarr.scale import Methods
from ome_zarr.writer import write_image


def errors(size, method):
    ramp = np.repeat(np.arange(size, dtype="f4")[None], 32, axis=0)
    path = f"{size}-{method.value}.zarr"
    write_image(ramp, path, axes="yx", scale_factors=[2, 4, 8, 16, 32], method=method)
    group = zarr.open_group(path, mode="r")
    attributes = dict(group.attrs)
    middle, last = [], []
    for level in attributes.get("ome", attributes)["multiscales"][0]["datasets"][1:]:
        scale, translation = level["coordinateTransformations"]
        row = group[level["path"]][0]
        error = row - (scale["scale"][-1] * np.arange(len(row)) + translation["translation"][-1])
        middle.append(round(float(error[len(error) // 2]), 2))
        last.append(round(float(error[-1]), 2))
    print(method.value, size, "middle", middle, "last", last)
    return middle, last


odd = errors(1023, Methods.LOCAL_MEAN)
even = errors(1024, Methods.LOCAL_MEAN)
resized = errors(1023, Methods.RESIZE)
ok = np.allclose(odd[0], [-0.5, -1.5, -3.5, -7.5, -15.5], atol=0.02)
ok = ok and np.allclose(odd[1], [-1.0, -2.99, -6.97, -14.88, -30.5], atol=0.02)
ok = ok and not np.any(even) and np.allclose(resized[0], 0, atol=0.02)
sys.exit(not ok)
P
v/bin/python -W ignore see.py
