"""POV-Ray's media, method 2 with an interval a segment: a picture of one pixel of a box with a density file a coefficient."""

import pathlib
import struct
import subprocess
import tempfile

from volver_kernel import serve

SCENE = """#version 3.7; global_settings {{ assumed_gamma 1.0 }}
camera {{ orthographic location <0.5, 0.5, -1> direction z right 0.001*x up 0.001*y }}
box {{ <0, 0, 0>, <1, 1, {length!r}> hollow pigment {{ rgbt 1 }} interior {{ {media} }} }}
"""
MEDIUM = """media {{ method 2 intervals {n} samples 1, 1 jitter 0 {name} {largest!r}
  density {{ density_file df3 "{name}.df3" interpolate 0 scale <1, 1, {length!r}> }} }} """


def medium(folder, name, values, length):
    """A medium of that name whose density file has one voxel a value, of 32 bits."""
    largest, n = max(values) or 1.0, len(values)
    voxels = [round(value / largest * 0xFFFFFFFF) for value in values]
    folder.joinpath(f"{name}.df3").write_bytes(struct.pack(f">3H{n}I", 1, 1, n, *voxels))
    return MEDIUM.format(n=n, name=name, largest=largest, length=length)


def render(task):
    middles, length = task["data"]["middles"], float(task["length"])
    emission = [c * tau for c, tau in zip(middles["emission"][0], middles["extinction"])]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        media = medium(folder, "absorption", middles["extinction"], length) + medium(folder, "emission", emission, length)
        folder.joinpath("ray.pov").write_text(SCENE.format(length=length, media=media))
        command = ["povray", "+Iray.pov", "+Oray.exr", "+FE", "+W1", "+H1", "-D", "-A", "+WT1", "File_Gamma=1.0"]
        subprocess.run(command, cwd=name, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        # Blue, green and red of the pixel stand at the end, as halves.
        return [struct.unpack("<3e", folder.joinpath("ray.exr").read_bytes()[-6:])[2]]


# The guess: compositing of middles.
declaration = {"name": "POV-Ray media", "form": "segments", "format": "f64", "output": "f16", "channels": 1}
declaration |= {"step": "divides", "emission": "positive", "method": "front-to-back/middle/subtraction"}
serve(declaration, render)
