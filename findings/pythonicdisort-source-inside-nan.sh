#!/usr/bin/env bash
# PythonicDISORT 1.8 (PyPI, discrete ordinates): a thermal source that is in inner layers only gives NaN, without an error.
#
# Expected: layers that shine between layers that don't have an intensity, which without scattering is
#   sum S (1 - e^-dtau) e^-tau above.
# Found: pydisort divides all sources by the largest of the beam, what enters at both boundaries, the source at the top
#   of the first layer and the source at the bottom of the last one. Where these five are 0 that is 0/0, and every
#   intensity and flux is NaN. A source of 1e-100 in the outermost layers is enough for the right value.
# Seen (2026-12-01), three layers of vertical depth 0.5, no scattering, two streams (mu = 0.5), upward at the top:
#   S = 0 1 0: nan (right 0.232544); S = 1 1 0: 0.864665 (right); S = 1e-100 1 1e-100: 0.232544 (right)
#
# Exits 0 while this is so, 1 once it changes.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
python3 -m venv "$tmp/venv"
"$tmp/venv/bin/pip" install --quiet --disable-pip-version-check pythonicdisort==1.8 numpy==2.4.6 scipy==1.17.1
cd "$tmp"
HOME="$tmp" venv/bin/python -W ignore - <<'PY'
import sys
import numpy as np
from PythonicDISORT.pydisort import pydisort


def upward(source):
    phase = np.array([[1.0, 0.0]] * 3)
    found = pydisort(np.array([0.5, 1.0, 1.5]), np.zeros(3), 2, phase, 0, 0, 0, s_poly_coeffs=np.array([source]).T)
    return float(found[3](0.0)[0])


same = True
for source, finite in (([0.0, 1.0, 0.0], False), ([1.0, 1.0, 0.0], True), ([1e-100, 1.0, 1e-100], True)):
    right = sum(s * np.exp(-i) * (1 - np.exp(-1)) for i, s in enumerate(source))
    seen = upward(source)
    print("S =", *source, "intensity", seen, "right", round(right, 6))
    same &= np.isclose(seen, right, rtol=1e-9) if finite else np.isnan(seen)
print("as described" if same else "changed")
sys.exit(not same)
PY
