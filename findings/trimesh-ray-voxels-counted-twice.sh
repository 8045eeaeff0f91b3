#!/usr/bin/env bash
# trimesh 5.2.0 (rtree 1.4.1): mesh.voxelized(pitch, method="ray") counts a voxel once for every ray that hits it.
# Expected: filled_count is the number of filled voxels, points has each once, volume = filled_count * pitch^3 is at most
#   the volume of the grid's box, and fill() can only add.
# Does: four rays go through each cell by default, and each of their hits is kept; filled_count, volume and points
#   have them all. The dense array has them once. fill() goes by way of the dense array, so "filled" has fewer.
#   Walls along z are left open: only what rays along z hit is there.
# Seen: box 2 x 2 x 2, pitch 0.5: grid 5 x 5 x 5 = 125 voxels, filled_count 128, volume 16.0 (box of the grid: 15.625),
#   dense 50, after fill() 50. Pitch 0.1: 3200 against 882. method="subdivide": 98 and 98, after fill() 125.
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check trimesh==5.2.0 numpy==2.4.6 scipy==1.17.1 rtree==1.4.1 networkx==3.6.1
cat >see.py <<'P'
import sys
import numpy as np
import trimesh

box = trimesh.creation.box((2, 2, 2))
seen = []
for pitch, method in ((0.5, "ray"), (0.1, "ray"), (0.5, "subdivide")):
    grid = box.voxelized(pitch, method=method)
    cells = int(np.prod(grid.shape))
    row = [cells, int(grid.filled_count), int(grid.encoding.dense.sum()), int(grid.copy().fill().filled_count)]
    print(method, "pitch", pitch, "cells, filled_count, dense, after fill():", row,
          "volume", round(float(grid.volume), 4), "box of the grid", round(cells * pitch**3, 4))
    seen.append(row)
sys.exit(seen != [[125, 128, 50, 50], [9261, 3200, 882, 882], [125, 98, 98, 125]])
P
v/bin/python -W ignore see.py
