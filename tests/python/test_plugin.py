"""The plugin of pytest."""

from __future__ import annotations

import pytest
import volver
from marchers import CASES, front, middle


def test_an_order_is_asserted() -> None:
    found = volver.assert_order(middle, 2, cases=CASES)
    assert found is not None and found.passed


def test_a_failure_shows_table_and_formula() -> None:
    with pytest.raises(AssertionError) as raised:
        volver.assert_order(front, 2, cases=CASES)
    said = str(raised.value)
    assert said.startswith("order 2 is not confirmed\n") and "TooLow" in said and "What it computes\n" in said and "samples at the front" in said


TEST = """
import numpy as np
import volver

SAMPLES = "{samples}"

def render(ray):
    samples = getattr(ray, SAMPLES)
    depth = samples.extinction * ray.lengths
    before = np.append(0, np.cumsum(depth[:-1]))
    return (np.exp(-before) * -np.expm1(-depth)) @ samples.emission

def test_march(volver_baseline):
    volver.assert_order(render, 2, cases="sine-squared,thick", baseline=volver_baseline)
"""


def test_baselines_are_written_kept_and_compared(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_it=TEST.format(samples="middles"))
    missing = pytester.runpytest_subprocess()
    missing.assert_outcomes(failed=1)
    missing.stdout.fnmatch_lines(["*no baseline *volver-baselines/test_it.test_march.json (allowed: pytest --volver-update*"])
    pytester.runpytest_subprocess("--volver-update").assert_outcomes(passed=1)
    assert (pytester.path / "volver-baselines" / "test_it.test_march.json").exists()
    pytester.runpytest_subprocess().assert_outcomes(passed=1)
    pytester.makepyfile(test_it=TEST.format(samples="front"))
    worse = pytester.runpytest_subprocess()
    worse.assert_outcomes(failed=1)
    worse.stdout.fnmatch_lines(["*worse than *", "*moved: *"])
