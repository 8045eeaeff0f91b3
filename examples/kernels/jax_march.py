"""Compositing front to back in JAX, with the gradient by jax.grad (protocol 2; needs JAX):

    volver gradient python3 examples/kernels/jax_march.py

Samples stand in the middles of segments. It computes in binary64, which has to be switched on.
"""

import jax

jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp  # noqa: E402
import volver_kernel  # noqa: E402


def march(extinction, emission, lengths):
    """Σ T α C of every channel."""
    depth = extinction * lengths
    before = jnp.cumsum(depth) - depth
    weights = jnp.exp(-before) * -jnp.expm1(-depth)
    return emission @ weights


def loss(extinction, emission, lengths, cotangents):
    return cotangents @ march(extinction, emission, lengths)


radiance_of = jax.jit(march)
gradient_of = jax.jit(jax.grad(loss, argnums=(0, 1)))


def render(task):
    lengths = jnp.diff(jnp.asarray(task["data"]["edges"]["lambda"]))
    samples = task["data"]["middles"]
    extinction = jnp.asarray(samples["extinction"])
    emission = jnp.asarray([list(row) for row in samples["emission"]])
    result = {"radiance": radiance_of(extinction, emission, lengths).tolist()}
    if "cotangents" in task:
        by_tau, by_c = gradient_of(extinction, emission, lengths, jnp.asarray(task["cotangents"]))
        result["gradient"] = {"extinction": by_tau.tolist(), "emission": by_c.tolist()}
    return result


if __name__ == "__main__":
    volver_kernel.serve(
        {
            "name": "jax-march",
            "form": "segments",
            "format": "f64",
            "gradient": "middles",
            "method": "front-to-back/middle/expm1",
        },
        render,
    )
