#!/usr/bin/env bash
# pythonradex 2.0.2 (PyPI, radiative transfer of molecular lines): the static slab's escape probability jumps at an
# optical depth of 1e-5, and what a thin slab keeps (1 - beta) is up to 15 times too much above it, and 0 below.
#
# Expected: beta = (1/2 - E3(tau))/tau within 1e-4, as the other geometries, which use a series for small tau.
# Found: 0 is kept below tau = 1e-5; above it beta comes from a table whose angular integral has 200 equal steps in
#   mu, too few where tau/mu changes: 1 - beta is 15.5 times the right one at 1.01e-5, 5 times at 1e-4, 1.37 times at
#   1e-3, 1.03 times at 5e-3. beta itself is off by at most 2.1e-3, so the comparison with 1 has to be made.
# Seen (2026-12-01), 1 - beta over the right one: tau 9.9e-6 0, 1.01e-5 15.47, 1.01e-4 5.03, 1e-3 1.374, 0.1 1.0001
#
# Exits 0 while this is so, 1 once it changes.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
python3 -m venv "$tmp/venv"
"$tmp/venv/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: pythonradex==2.0.2 \
    numpy==2.4.6 scipy==1.17.1 numba==0.68.1
cd "$tmp"
HOME="$tmp" venv/bin/python - <<'PY'
import sys
import numpy as np
from scipy.special import expn
from pythonradex.escape_probability import StaticSlab

tau = np.array([9.9e-6, 1.01e-5, 1.01e-4, 1e-3, 0.1])
seen = np.array([0.0, 15.467, 5.026, 1.374, 1.0001])
beta = StaticSlab().beta(tau)
right = (0.5 - expn(3, tau)) / tau
ratio = (1 - beta) / (1 - right)
for row in zip(tau, beta, right, ratio):
    print("tau %.3g: beta %.7f, right %.7f, kept over right %.4f" % row)
same = np.allclose(ratio, seen, rtol=1e-3)
print("as described" if same else "changed")
sys.exit(not same)
PY
