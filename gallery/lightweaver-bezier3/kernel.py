"""Lightweaver's formal solver piecewise_bezier3_1d up one vertical ray, with a background of opacity and emissivity of our own."""

import lightweaver as lw
import numpy as np
from lightweaver.LwCompiled import BackgroundProvider, ZeroRadiation
from lightweaver.rh_atoms import H_3_atom
from volver_kernel import serve

medium = {}


class Given(BackgroundProvider):
    """Opacity and emissivity as the task has them, in wavelengths far from any line."""

    def __init__(self, eqPops, radSet, wavelength):
        pass

    def compute_background(self, atmos, chi, eta, sca):
        emission = medium["emission"]
        chi[:], eta[:], sca[:] = medium["extinction"], 0.0, 0.0
        eta[-len(emission) :] = emission * medium["extinction"]


def render(task):
    edges = task["data"]["edges"]
    medium["extinction"], medium["emission"] = np.asarray(edges["extinction"]), np.asarray(edges["emission"])
    even = np.ones(len(edges["lambda"]))
    dark = {"lowerBc": ZeroRadiation(), "upperBc": ZeroRadiation(), "convertScales": False}
    gas = {"temperature": 6000 * even, "vlos": 0 * even, "vturb": 0 * even, "ne": 1e-3 * even, "nHTot": 1e-3 * even}
    height = -np.asarray(edges["lambda"])
    atmosphere = lw.Atmosphere.make_1d(lw.ScaleType.Geometric, depthScale=height, **gas, **dark)
    atmosphere.rays(1.0)
    # It wants one atom; its hydrogen is next to nothing.
    atoms = lw.RadiativeSet([H_3_atom()])
    atoms.set_detailed_static("H")
    spectrum = atoms.compute_wavelength_grid(extraWavelengths=1e7 * np.arange(1, len(task["channels"]) + 1))
    populations = atoms.compute_eq_pops(atmosphere)
    context = lw.Context(atmosphere, spectrum, populations, backgroundProvider=Given, formalSolver="piecewise_bezier3_1d")
    context.formal_sol_gamma_matrices()
    return np.asarray(context.spect.I).reshape(len(spectrum.wavelength), -1)[-len(task["channels"]) :, 0].tolist()


serve({"name": "Lightweaver bezier3", "form": "segments", "format": "f64", "method": "layers/bezier-cubic"}, render)
