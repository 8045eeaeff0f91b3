"""exojax's intensity-based emission without scattering, rtrun_emis_pureabs_ibased_intensity, straight down; gradients by JAX."""

import jax
import jax.numpy as jnp
import numpy as np
from exojax.rt.rtransfer import rtrun_emis_pureabs_ibased_intensity
from volver_kernel import serve

STRAIGHT = jnp.array([1.0])


def intensity(tau, emission, lengths):
    """Layers are rows, from the top; channels are wavenumbers."""
    depths = jnp.broadcast_to((tau * lengths)[:, None], emission.T.shape)
    return rtrun_emis_pureabs_ibased_intensity(depths, emission.T, STRAIGHT)[0]


@jax.jit
def slopes(tau, emission, lengths, cotangents):
    _, back = jax.vjp(lambda t, c: intensity(t, c, lengths), tau, emission)
    return back(cotangents)


def render(task):
    single = lambda values: jnp.asarray(np.asarray(values, np.float32))
    edges, middles = np.asarray(task["data"]["edges"]["lambda"]), task["data"]["middles"]
    given = single(middles["extinction"]), single([list(row) for row in middles["emission"]]), single(np.diff(edges))
    result = {"radiance": np.asarray(intensity(*given), float).tolist()}
    if "cotangents" in task:
        by_tau, by_emission = slopes(*given, single(task["cotangents"]))
        result["gradient"] = {
            "extinction": np.asarray(by_tau, float).tolist(),
            "emission": np.asarray(by_emission, float).tolist(),
        }
    return result


declared = {"method": "front-to-back/middle/expm1", "gradient": "middles", "exp_ulp": 1.1}
serve({"name": "exojax ibased", "form": "segments", "format": "f32", **declared}, render)
