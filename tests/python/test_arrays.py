"""Arrays of PyTorch and JAX, frames of Polars; each where it is installed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import volver
from marchers import CASES, middle


def march(torch: Any) -> Any:
    def render(ray: Any) -> Any:
        depth = ray.middles.extinction * ray.lengths
        before = torch.cumsum(depth, 0) - depth
        weights = torch.exp(-before) * -torch.expm1(-depth)
        return weights @ ray.middles.emission

    return render


@pytest.mark.parametrize("dtype, name", [(None, "f64"), ("float32", "f32")])
def test_tensors_of_torch(dtype: Any, name: str) -> None:
    torch = pytest.importorskip("torch")
    seen = set()

    def render(ray: Any) -> Any:
        seen.add((type(ray.lengths), ray.middles.emission.dtype))
        found = march(torch)(ray)
        return found.requires_grad_()

    found = volver.verify(render, order=2, cases=CASES, xp="torch", dtype=dtype, identify="off")
    assert found.passed and found.kernel.format == name
    assert seen == {(torch.Tensor, torch.float64 if dtype is None else torch.float32)}


def test_tensors_that_are_no_answer() -> None:
    torch = pytest.importorskip("torch")
    with pytest.raises(volver.RenderError, match="radiance of torch.float32 .*dtype='float32'|radiance of float32"):
        volver.verify(lambda ray: march(torch)(ray).float(), cases="sine-squared", xp="torch")
    with pytest.raises(volver.RenderError, match="on the device 'meta'"):
        volver.verify(lambda ray: march(torch)(ray).to("meta"), cases="sine-squared", xp="torch")
    found = volver.verify(march(torch), order=2, cases="thick", xp="torch", dtype=torch.bfloat16, identify="off")
    assert found.kernel.format == "bf16"
    with pytest.raises((volver.RenderError, RuntimeError, AssertionError)):
        volver.verify(march(torch), cases="thick", xp="torch", device="cuda:99")


def test_arrays_of_jax() -> None:
    pytest.importorskip("jax")
    import jax.numpy as jnp

    def render(ray: Any) -> Any:
        depth = ray.middles.extinction * ray.lengths
        before = jnp.concatenate([jnp.zeros_like(depth[:1]), jnp.cumsum(depth[:-1])])
        return (jnp.exp(-before) * -jnp.expm1(-depth)) @ ray.middles.emission

    # JAX makes binary32 of all numbers unless it is told otherwise, and that is what is declared.
    found = volver.verify(render, order=2, cases="thick", xp="jax", ladder="8..256", identify="off")
    assert found.kernel.format == "f32" and found.counts.failed == 0 and found.counts.contradicted == 0
    with pytest.raises(volver.VolverError, match="jax_enable_x64"):
        volver.verify(render, xp="jax", dtype="float64")


def test_frames_of_polars() -> None:
    polars = pytest.importorskip("polars")
    frame = volver.verify(middle, order=2, cases=CASES, identify="off").to_polars()
    assert isinstance(frame, polars.DataFrame) and frame["verdict"].to_list().count("Confirmed") == 5
    study = volver.study(cases="sine-squared", methods="trapezoid/trapezoid", formats="f64", levels="8..128")
    assert study.to_polars()["format"].to_list() == ["f64"]


def test_a_gradient_of_torch() -> None:
    torch = pytest.importorskip("torch")
    place = torch.tensor(np.array([0.3, 0.7]), requires_grad=True)

    def value(x: Any) -> Any:
        return torch.sum(torch.exp(-x))

    value(place).backward()
    assert volver.gradient_test(value, place.grad, place).passed
