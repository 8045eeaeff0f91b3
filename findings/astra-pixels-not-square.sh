#!/usr/bin/env bash
# astra-toolbox 2.5.0 (PyPI), CPU projectors of parallel beams on pixels that are not square: wide ones are refused,
# high ones are taken without a word, and "line" and "linear" then give line integrals wrong by the pixels' ratio.
#
# Expected: create_vol_geom takes four window bounds, so pixels of any shape are projected right, or all but square
#   ones are refused.
# Found, with pixels dx wide and dy high, everywhere 1: dx > dy raises "Pixel height must equal pixel width" in all
#   three projectors; dx < dy doesn't. There "strip" is right, "line" and "linear" give dx/dy times the length for rays
#   within 45 degrees of the y axis and dy/dx times for the others, so a sinogram jumps by the ratio's square at 45
#   degrees. With square pixels, of any size, all three are right.
# So: resample to square pixels before ASTRA's CPU line integrals serve as reference; the mass of a view shows it.
# Seen (2026-12-01), window 16 wide and 32 high (dx = 0.5, dy = 1), length of the middle ray at 0, 0.2, 1.3 rad, 90 deg:
#   right 32.000 32.651 16.605 16.000; strip the same;
#   line and linear 16.000 16.325 33.210 32.000
#
# Uses no GPU, the package needs NVIDIA's runtime libraries to be imported nevertheless (200 MB to fetch).
# Exits 0 while this is so, 1 once it changes.
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
python3 -m venv "$tmp/venv"
"$tmp/venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: astra-toolbox==2.5.0 \
    numpy==2.4.6 scipy==1.17.1 nvidia-cuda-runtime-cu12==12.9.79 nvidia-cufft-cu12==11.4.1.4 nvidia-nvjitlink-cu12==12.9.86
cd "$tmp"
HOME="$tmp" venv/bin/python - <<'PY'
import sys
import numpy as np
import astra

n, channel = 32, 0.25
angles = np.array([0.0, 0.2, 1.3, np.pi / 2])
image = np.ones((n, n), np.float32)


def middle(kind, half_x, half_y):
    """Mean of the two middle rays; None where the projector refuses the pixels."""
    volume = astra.create_vol_geom(n, n, -half_x, half_x, -half_y, half_y)
    beam = astra.create_proj_geom("parallel", channel, 192, angles)
    try:
        projector = astra.create_projector(kind, beam, volume)
    except Exception as error:
        print("   ", str(error).split(". ")[-1])
        return None
    _, sino = astra.create_sino(image, projector)
    return sino[:, 95:97].mean(axis=1)


same = True
for half_x, half_y in ((8, 8), (8, 16), (16, 8)):
    with np.errstate(divide="ignore"):
        right = np.minimum(2 * half_x / np.abs(np.sin(angles)), 2 * half_y / np.abs(np.cos(angles)))
    ratio = half_x / half_y
    law = np.where(angles < np.pi / 4, ratio, 1 / ratio)
    print(f"pixels {half_x / 16} x {half_y / 16}; right:", np.round(right, 3))
    for kind in ("strip", "line", "linear"):
        seen = middle(kind, half_x, half_y)
        print("   ", kind, "refused" if seen is None else np.round(seen, 3))
        same &= (seen is None) == (ratio > 1)
        if seen is not None:
            same &= np.allclose(seen, right if kind == "strip" else right * law, rtol=5e-3)
print("as described" if same else "changed")
sys.exit(not same)
PY
