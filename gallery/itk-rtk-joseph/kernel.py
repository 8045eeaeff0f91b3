"""RTK's attenuated Joseph projector of SPECT, along the long axis of a volume that is even across."""

import itk
import numpy as np
from itk import RTK as rtk
from volver_kernel import serve

Image = itk.Image[itk.F, 3]


def image(array, spacing, origin):
    """An image of float with indices z, y, x."""
    made = itk.image_from_array(np.ascontiguousarray(array, np.float32))
    made.SetSpacing(spacing)
    made.SetOrigin(origin)
    return made


def project(activity, attenuation, d):
    n = len(attenuation)
    across = lambda values: np.broadcast_to(values[:, None, None], (n, 3, 3))
    place = [[d] * 3, [-d, -d, -(n - 1) / 2 * d]]
    geometry = rtk.ThreeDCircularProjectionGeometry.New()
    # A source at infinity: parallel rays along z.
    geometry.AddProjection(2.0 * n * d, 0.0, 0.0)
    projector = rtk.JosephForwardAttenuatedProjectionImageFilter[Image, Image].New()
    projector.SetInput(0, image(np.zeros((1, 1, 1)), [d] * 3, [0.0] * 3))
    projector.SetInput(1, image(across(activity), *place))
    projector.SetInput(2, image(across(attenuation), *place))
    projector.SetGeometry(geometry)
    projector.Update()
    return float(itk.array_from_image(projector.GetOutput())[0, 0, 0])


def render(task):
    middles, d = task["data"]["middles"], task["length"] / task["segments"]
    attenuation = np.asarray(middles["extinction"])
    return [project(np.asarray(activity)[::-1], attenuation[::-1], d) for activity in middles["emission"]]


declared = {"source": "length", "method": "front-to-back/middle/expm1", "step": "divides"}
serve({"name": "RTK Joseph attenuated", "form": "segments", "format": "f32", **declared}, render)
