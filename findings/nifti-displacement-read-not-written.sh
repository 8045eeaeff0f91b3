#!/usr/bin/env bash
# SimpleITK 2.5.7, nibabel 5.4.2: a displacement field in NIfTI (intent code 1006) read and written again.
# Expected: reading and writing gives the file's numbers back, in whichever handedness they are held in between.
# Does: the reader turns the vectors (x and y change sign), as it turns the positions. The same image cannot be written
#   as NIfTI: the writer finds the intent 1006 in the metadata, wants to turn them back and refuses, because
#   SimpleITK's vectors are not of the type it turns. With the metadata erased the file is written with intent 1007 and
#   the turned numbers; read again they stay turned. Intent 1007 is left alone in both directions.
# Seen: written by nibabel (1, 2, 3), 1006: read as (-1, -2, 3); written again: refused; without metadata: 1007 with
#   (-1, -2, 3) in the file. 1007: read as (1, 2, 3), written again as (1, 2, 3).
# Date: 2026-12-01
set -euo pipefail
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
cd "$dir"
python3 -m venv v
v/bin/pip install -q --disable-pip-version-check SimpleITK==2.5.7 nibabel==5.4.2 numpy==2.4.6
cat >see.py <<'P'
import sys
import nibabel
import numpy as np
import SimpleITK

field = np.zeros((4, 5, 6, 1, 3), "f4")
field[...] = (1, 2, 3)


def stored(path):
    image = nibabel.load(path)
    return int(image.header["intent_code"]), tuple(image.get_fdata()[0, 0, 0, 0].tolist())


seen = []
for intent in (1006, 1007):
    image = nibabel.Nifti1Image(field, np.diag([2.0, 3.0, 4.0, 1.0]))
    image.header["intent_code"] = intent
    nibabel.save(image, "a.nii")
    read = SimpleITK.ReadImage("a.nii")
    row = [intent, read[0, 0, 0]]
    try:
        SimpleITK.WriteImage(read, "b.nii")
        row.append(stored("b.nii"))
    except RuntimeError as error:
        row.append("refused")
        print(str(error).strip().splitlines()[-1].split(": ", 1)[-1])
    for key in read.GetMetaDataKeys():
        read.EraseMetaData(key)
    SimpleITK.WriteImage(read, "c.nii")
    row.append(stored("c.nii"))
    print("intent", row[0], "read", row[1], "written", row[2], "written without metadata", row[3])
    seen.append(row)
sys.exit(seen != [
    [1006, (-1.0, -2.0, 3.0), "refused", (1007, (-1.0, -2.0, 3.0))],
    [1007, (1.0, 2.0, 3.0), (1007, (1.0, 2.0, 3.0)), (1007, (1.0, 2.0, 3.0))],
])
P
v/bin/python see.py
