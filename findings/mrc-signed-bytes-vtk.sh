#!/usr/bin/env bash
# VTK 9.7.2, SimpleITK 2.5.7, mrcfile 1.5.4: MRC volumes of mode 0 (bytes) and mode 12 (half floats).
# Expected: mode 0 is signed in MRC2014, so all three read -5 where -5 was written; mode 12 is read or refused.
# Does: VTK's reader takes mode 0 for unsigned bytes: -5 is 251. SimpleITK reads it signed. Of mode 12 VTK logs
#   "Unknown data type" and then hands out a volume of the right size and spacing in double precision that holds none of
#   the data (zeros, when seen); SimpleITK refuses it.
# Seen: mode 0: mrcfile -5, SimpleITK -5 (8-bit signed), VTK 251 (unsigned char).
#   mode 12: mrcfile -5.0, SimpleITK refused, VTK 0.0 (double).
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check vtk==9.7.2 SimpleITK==2.5.7 mrcfile==1.5.4 numpy==2.4.6
cat >see.py <<'P'
import sys
import mrcfile
import numpy as np
import SimpleITK
from vtkmodules.vtkIOImage import vtkMRCReader

seen = []
for kind in ("i1", "f2"):
    volume = np.zeros((3, 4, 5), kind)
    volume[0, 0, 1] = -5
    with mrcfile.new("a.mrc", overwrite=True) as file:
        file.set_data(volume)
        file.voxel_size = (1.5, 2, 3)
    assert mrcfile.validate("a.mrc")
    with mrcfile.open("a.mrc") as file:
        ours = float(file.data[0, 0, 1])
    try:
        image = SimpleITK.ReadImage("a.mrc")
        itk = (float(image[1, 0, 0]), image.GetPixelIDTypeAsString())
    except RuntimeError:
        itk = "refused"
    reader = vtkMRCReader()
    reader.SetFileName("a.mrc")
    reader.Update()
    out = reader.GetOutput()
    vtk = (out.GetScalarComponentAsDouble(1, 0, 0, 0), out.GetScalarTypeAsString(), out.GetDimensions())
    print(kind, "mrcfile", ours, "SimpleITK", itk, "VTK", vtk)
    if vtk[1] == "double" and vtk[0] != ours:
        vtk = ("not the data", vtk[1], vtk[2])
    seen.append((ours, itk, vtk))
sys.exit(seen != [
    (-5.0, (-5.0, "8-bit signed integer"), (251.0, "unsigned char", (5, 4, 3))),
    (-5.0, "refused", ("not the data", "double", (5, 4, 3))),
])
P
v/bin/python see.py
