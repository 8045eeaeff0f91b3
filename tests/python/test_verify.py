"""Functions are found to be what they are, as arrays of every kind."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import volver
from marchers import CASES, batched, front, middle


def test_a_function_has_its_order() -> None:
    found = volver.verify(middle, order=2, cases=CASES, identify="full")
    assert found.passed and found.conclusion == "confirmed"
    assert found.kernel.name == "middle" and found.kernel.format == "f64"
    orders = {line.name: line.order for line in found.lines}
    assert abs((orders["sine-squared"] or 0) - 2) < 0.01
    assert "confirmed: 5 confirmed" in str(found)
    assert found.identification is not None and found.identification.rule is not None
    assert "middle" in found.identification.rule.text
    wrong = volver.verify(front, order=2, cases=CASES)
    assert not wrong.passed and wrong.conclusion == "not confirmed"
    assert {line.verdict for line in wrong.lines if line.name == "sine-squared"} == {"TooLow"}
    assert volver.verify(front, order=1, cases=CASES).passed


def test_values_are_those_of_the_method_to_the_last_digits() -> None:
    found = volver.verify(middle, cases=CASES, method="front-to-back/middle/expm1")
    assert found.passed
    assert found.as_declared is not None and found.as_declared.agree == found.as_declared.of == 5


def test_many_rays_of_equal_n_have_the_answers_of_each() -> None:
    found = volver.verify(batched, order=2, cases=CASES, batched=True, batch=64)
    assert found.passed and found.batch is not None and found.batch.differ == 0

    def leaks(rays: Any) -> Any:
        rays.lengths[:] = rays.lengths[:1]
        return batched(rays)

    assert not volver.verify(leaks, order=2, cases="sine-squared", batched=True, batch=64).passed


def test_a_ray_is_what_is_documented() -> None:
    seen: list[volver.Segments] = []

    def looks(ray: volver.Segments) -> Any:
        seen.append(ray)
        return middle(ray)

    volver.verify(looks, order=2, cases="rgb-transfer", identify="off", ladder="8..64")
    ray = seen[0]
    n, k = ray.count, len(ray.channels)
    assert (ray.case, k) == ("rgb-transfer", 3)
    assert ray.edges.distance.shape == (n + 1,) and ray.edges.emission.shape == (n + 1, k)
    assert ray.middles.distance.shape == (n,) and ray.middles.emission.shape == (n, k)
    assert ray.lengths.shape == (n,) and ray.lengths.sum() == pytest.approx(ray.length, rel=1e-15)
    assert (ray.front.distance == ray.edges.distance[:-1]).all()
    assert (ray.back.extinction == ray.edges.extinction[1:]).all()
    assert ray.background is None and ray.edges.distance[0] == 0 and ray.edges.distance[-1] == ray.length
    # The same numbers as 'volver ask' prints.
    asked = subprocess.run(
        [volver._program.program(), "ask", "rgb-transfer", "-n", str(n)], capture_output=True, text=True, check=True
    )
    task = json.loads(asked.stdout.splitlines()[-1])["tasks"][0]
    if task["step"] == ray.step:
        assert task["data"]["middles"]["emission"] == ray.middles.emission.T.tolist()


@pytest.mark.parametrize("dtype, name", [("float32", "f32"), (np.float32, "f32"), ("float16", "f16")])
def test_numbers_of_fewer_bits_are_declared_as_such(dtype: Any, name: str) -> None:
    types = set()

    def looks(ray: Any) -> Any:
        types.add(ray.middles.emission.dtype)
        return middle(ray)

    found = volver.verify(looks, order=2, cases="sine-squared", dtype=dtype, identify="off")
    assert found.kernel.format == name and types == {np.dtype(dtype)}


def test_other_answers_than_the_radiance() -> None:
    def depths(ray: Any) -> Any:
        return {"radiance": middle(ray), "optical_depth": (ray.middles.extinction * ray.lengths).sum()}

    found = volver.verify(depths, order=2, cases=CASES, answers=("radiance", "optical_depth"))
    assert found.passed and found.answers and found.answers[0].quantity == "optical_depth"


def test_a_volume_and_a_formula() -> None:
    def sampled(ray: volver.Volume) -> Any:
        n = ray.segments
        places = (np.arange(n) + 0.5) * ray.length / n
        values = np.interp(places, np.linspace(0, ray.length, len(ray.field)), ray.field)
        entries = np.linspace(ray.first, ray.last, len(ray.extinction))
        depth = np.interp(values, entries, ray.extinction) * ray.length / n
        weights = np.exp(-np.append(0, np.cumsum(depth[:-1]))) * -np.expm1(-depth)
        return np.array([weights @ np.interp(values, entries, ray.emission[:, k]) for k in range(len(ray.channels))])

    found = volver.verify(sampled, form="volume", order=2, cases="sine-squared,rgb-transfer", step="divides", identify="full")
    assert found.counts.contradicted == 0 and found.counts.failed == 0
    assert found.identification is not None and found.identification.rule is not None
    assert "samples in the middle" in found.identification.rule.text

    def evaluated(ray: volver.Formula) -> Any:
        space: dict[str, Any] = {}
        exec(ray.code, space)
        n = ray.segments
        radiance, depth = np.zeros(len(ray.channels)), 0.0
        for i in range(n):
            s = space["field"]((i + 0.5) * ray.length / n)
            step = space["extinction"](s) * ray.length / n
            emission = np.array([space[f"emission_{channel}"](s) for channel in ray.channels])
            radiance += np.exp(-depth) * -np.expm1(-step) * emission
            depth += step
        return radiance

    assert volver.verify(evaluated, form="formula", order=2, cases="sine-squared", ladder="8..256", step="divides").passed


def test_refused_rays_have_no_answer_and_the_others_do() -> None:
    def picky(ray: Any) -> Any:
        if ray.case == "thick":
            raise volver.Refused("too thick for me")
        return middle(ray)

    found = volver.verify(picky, order=2, cases=CASES)
    failures = {line.name: line.failures for line in found.lines}
    assert "too thick for me" in failures["thick"][0].error and not failures["sine-squared"]


def test_what_a_function_computes_is_read_off() -> None:
    found = volver.identify(middle, order=2, budget=300)
    assert found.passed and found.rule is not None and found.rule.latex

    def short(ray: Any) -> Any:
        return middle(ray) * 0.5

    other = volver.identify(short, order=2, budget=300)
    assert not other.passed and other.deviations


def test_the_program_s_own_kernels_are_verified_too() -> None:
    assert volver.verify("method:front-to-back/middle/expm1", cases=CASES).passed


def test_files_are_written_where_they_are_asked_for(tmp_path: Path) -> None:
    volver.verify(middle, order=2, cases="sine-squared", out=tmp_path / "page", junit=tmp_path / "x.xml", log=tmp_path / "log")
    assert (tmp_path / "page" / "index.html").exists() and (tmp_path / "x.xml").exists()
    assert "the process that started this one" in (tmp_path / "log").read_text()


def test_frames_and_html() -> None:
    found = volver.verify(front, order=2, cases=CASES, name="<b>mine</b>")
    rows = found.table()
    assert [row["name"] for row in rows] == [line.name for line in found.lines]
    html = found._repr_html_()
    assert "TooLow" in html and "not passed" in html and "<b>mine</b>" not in html
    with pytest.raises(TypeError, match="passed"):
        bool(found)
    pytest.importorskip("pandas")
    assert list(found.to_pandas()["verdict"]) == [line.verdict for line in found.lines]
