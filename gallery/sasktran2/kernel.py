"""SASKTRAN2's emission source, seen straight down through a plane-parallel atmosphere without scattering; with its derivatives."""

import numpy as np
import sasktran2 as sk
from volver_kernel import serve

config = sk.Config()
config.emission_source = sk.EmissionSource.Standard
config.single_scatter_source = sk.SingleScatterSource.NoSource
config.multiple_scatter_source = sk.MultipleScatterSource.NoSource


def render(task):
    edges = task["data"]["edges"]
    # Altitudes ascend, the eye is on top.
    altitude = task["length"] - np.asarray(edges["lambda"])[::-1]
    linear, plane = sk.InterpolationMethod.LinearInterpolation, sk.GeometryType.PlaneParallel
    geometry = sk.Geometry1D(1.0, 0.0, 6371000.0, altitude, linear, plane)
    view = sk.ViewingGeometry()
    view.add_ray(sk.GroundViewingSolar(1.0, 0.0, 1.0, 2 * task["length"]))
    channels, derivatives = len(task["channels"]), "cotangents" in task
    wavelengths = 500.0 + np.arange(channels)
    atmosphere = sk.Atmosphere(geometry, config, wavelengths_nm=wavelengths, calculate_derivatives=derivatives)
    atmosphere.storage.total_extinction[:] = np.asarray(edges["extinction"])[::-1, None]
    atmosphere.storage.ssa[:] = 0.0
    atmosphere.storage.emission_source[:] = np.asarray(edges["emission"])[:, ::-1].T
    found = sk.Engine(config, geometry, view).calculate_radiance(atmosphere)
    result = {"radiance": found["radiance"].values[:, 0, 0].tolist()}
    if derivatives:
        row = lambda name: found[name].transpose("wavelength", "altitude", "los", "stokes").values[:, ::-1, 0, 0]
        cotangents = np.asarray(task["cotangents"])[:, None]
        by_tau, by_emission = row("wf_extinction"), row("wf_emission")
        slopes = {"extinction": (cotangents * by_tau).sum(axis=0).tolist()}
        result["gradient"] = slopes | {"emission": (cotangents * by_emission).tolist()}
    return result


declared = {"method": "layers/linear", "gradient": "edges"}
serve({"name": "SASKTRAN2", "form": "segments", "format": "f64", **declared}, render)
