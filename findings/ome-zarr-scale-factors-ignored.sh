#!/usr/bin/env bash
# ome-zarr 0.18.0 (zarr 3.1.6): of a list of whole scale factors only its length counts.
# Expected: write_image(a, scale_factors=[3]) makes one level coarser by 3, [4, 16] levels coarser by 4 and 16.
# Does: [3], [4] and [8] all make one level coarser by 2; [4, 16] makes 2 and 4. No warning. The same factors given as
#   dictionaries ({"y": 4, "x": 4}) are kept.
# Seen: asked [3] -> 2.0; [4] -> 2.0; [8] -> 2.0; [4, 16] -> 2.0 4.0; [{y: 4, x: 4}] -> 4.0
# So a pyramid meant for one jump by 4 has voxels of half the size one computes with. The coordinates that are written
#   belong to the data; only the wish is lost.
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
from ome_zarr.writer import write_image

volume = np.zeros((48, 48), "f4")
asked = [[3], [4], [8], [4, 16], [{"y": 4, "x": 4}]]
seen = []
for number, factors in enumerate(asked):
    name = str(factors)
    path = f"{number}.zarr"
    write_image(volume, path, axes="yx", scale_factors=factors)
    attributes = dict(zarr.open_group(path, mode="r").attrs)
    levels = attributes.get("ome", attributes)["multiscales"][0]["datasets"][1:]
    scales = [level["coordinateTransformations"][0]["scale"][-1] for level in levels]
    print("asked", name, "written", scales)
    seen.append(scales)
sys.exit(seen != [[2.0], [2.0], [2.0], [2.0, 4.0], [4.0]])
P
v/bin/python -W ignore see.py
