"""The program's other commands."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import volver


def test_an_order_is_fitted() -> None:
    steps = [0.4, 0.2, 0.1, 0.05, 0.025]
    found = volver.fit(steps, [0.5 * h**2 for h in steps], expect=2)
    assert found.passed and found.order == pytest.approx(2, abs=1e-6)
    assert not volver.fit(np.array(steps), np.array(steps), expect=2).passed
    values = volver.fit(steps, values=[1 + h for h in steps], exact=1, expect=1)
    assert values.passed and "Confirmed" in str(values)
    with pytest.raises(volver.VolverError, match="4 and 5 numbers|5 and 4 numbers"):
        volver.fit(steps, [1.0] * 4)
    with pytest.raises(volver.VolverError, match="allowed"):
        volver.fit([-h for h in steps], steps)


def test_a_gradient_is_told_from_a_wrong_one() -> None:
    place = np.array([0.3, 0.7])

    def right(x: Any) -> Any:
        return np.exp(-x)

    good = volver.gradient_test(lambda x: np.sum(-np.exp(-x)), right, place)
    assert good.passed and good.remainder == "second-order"
    bad = volver.gradient_test(lambda x: np.sum(-np.exp(-x)), lambda x: 1.1 * right(x), place)
    assert not bad.passed and bad.wrong_by is not None and abs(abs(bad.wrong_by) - 0.1) < 0.02


def test_a_reference_has_its_digits() -> None:
    found = volver.reference("homogeneous", digits=30)
    assert found.references[0].proved and len(found.references[0].radiance.replace(".", "")) >= 30
    with pytest.raises(volver.VolverError, match="no-such-case"):
        volver.reference("no-such-case")


def test_a_study_has_rows() -> None:
    found = volver.study(cases="sine-squared", methods=["trapezoid/trapezoid"], formats="f64", levels="8..128")
    assert found.rows[0].total.order == pytest.approx(2, abs=0.01)
    assert found.table()[0]["method"] == "trapezoid/trapezoid"


def test_a_scene_is_planned(tmp_path: Path) -> None:
    scene = Path(__file__).parents[2] / "examples" / "scenes" / "smoke.toml"
    found = volver.plan(scene, 1e-4)
    assert found.passed and found.tolerance == 1e-4 and found.steps
