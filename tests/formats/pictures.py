"""Pictures, cameras and transfer functions: pictures.py CONVERT FOLDER."""

import json
import pathlib
import struct
import sys

import cv2
import numpy as np
import OpenEXR
import vtk
from converter import Converter
from PIL import Image

vtk.vtkObject.GlobalWarningDisplayOff()
convert = Converter(*sys.argv[1:3])
path = convert.path
random = np.random.default_rng(25)
HEIGHT, WIDTH = 5, 7
COLOR = random.standard_normal((HEIGHT, WIDTH, 3)).astype(np.float32)
COLOR[1, 2, 0], COLOR[4, 6, 2] = np.inf, 1e-42
GREY = COLOR[..., 1].copy()


def read(name, values, channels, quantum=None, nan=0):
    """Whether volver reads a file as it was meant."""
    try:
        said = convert.run("image", name, "read.npy")
    except ValueError as error:
        convert.row(name, "values", False, str(error))
        return
    seen = np.load(path("read.npy"))
    convert.row(name, "values", seen.shape == values.shape and np.array_equal(seen, values.astype(float), equal_nan=True))
    size = [said["width"], said["height"], said["channels"], said["nan"]]
    convert.row(name, "size, channels, NaN", size == [WIDTH, HEIGHT, list(channels), nan], "" if size[2] == list(channels) else str(size))
    convert.row(name, f"quantum {quantum}", said["quantum"] == quantum)


def exr_written():
    """What volver writes, read by OpenEXR, OpenCV and Pillow."""
    np.save(path("color.npy"), COLOR.astype(float))
    np.save(path("grey.npy"), GREY.astype(float))
    np.save(path("alpha.npy"), np.dstack([COLOR, GREY]).astype(float))
    np.save(path("five.npy"), np.dstack([COLOR, GREY, GREY]).astype(float))
    for name, wanted in [
        ("color", {"R": COLOR[..., 0], "G": COLOR[..., 1], "B": COLOR[..., 2]}),
        ("grey", {"Y": GREY}),
        ("alpha", {"R": COLOR[..., 0], "G": COLOR[..., 1], "B": COLOR[..., 2], "A": GREY}),
        ("five", {"c0": COLOR[..., 0], "c1": COLOR[..., 1], "c2": COLOR[..., 2], "c3": GREY, "c4": GREY}),
    ]:
        convert.run("image", f"{name}.npy", f"volver-{name}.exr")
        with OpenEXR.File(path(f"volver-{name}.exr"), separate_channels=True) as file:
            seen = {key: channel.pixels for key, channel in file.channels().items()}
            scan_lines = file.header()["type"] == OpenEXR.scanlineimage
        right = seen.keys() == wanted.keys() and all(
            seen[key].dtype == np.float32 and np.array_equal(seen[key], wanted[key]) for key in wanted
        )
        convert.row(f"volver-{name}.exr, OpenEXR", "values by channel, scan lines", right and scan_lines)
        convert.run("image", f"volver-{name}.exr", "again.npy")
        again = np.load(path("again.npy"))
        convert.row(f"volver-{name}.exr", "back in .npy", np.array_equal(again, np.load(path(f"{name}.npy"))))
    convert.run("image", "color.npy", "volver-color.pfm")
    convert.run("image", "grey.npy", "volver-grey.pfm")
    seen = cv2.imread(path("volver-color.pfm"), cv2.IMREAD_UNCHANGED)
    # Blue first; scaled by 1.
    convert.row("volver-color.pfm, OpenCV", "values", np.array_equal(seen[..., ::-1], COLOR))
    seen = cv2.imread(path("volver-grey.pfm"), cv2.IMREAD_UNCHANGED)
    convert.row("volver-grey.pfm, OpenCV", "values", np.array_equal(seen, GREY))
    with Image.open(path("volver-grey.pfm")) as image:
        convert.row("volver-grey.pfm, Pillow", "values", np.array_equal(np.asarray(image), GREY))


def exr_read():
    """What OpenEXR writes."""

    def write(name, channels, **header):
        attributes = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage} | header
        with OpenEXR.File(attributes, channels) as file:
            file.write(path(name))

    broken = COLOR.copy()
    broken[0, 0] = np.nan
    for label in ["NO", "RLE", "ZIPS", "ZIP", "PIZ"]:
        write(f"exr-{label}.exr", {"RGB": COLOR}, compression=getattr(OpenEXR, f"{label}_COMPRESSION"))
        read(f"exr-{label}.exr", COLOR, "rgb")
    half = random.standard_normal((HEIGHT, WIDTH, 3)).astype(np.float16)
    write("exr-half.exr", {"RGB": half})
    read("exr-half.exr", half, "rgb")
    write("exr-nan.exr", {"RGB": broken})
    read("exr-nan.exr", broken, "rgb", nan=3)
    whole = random.integers(0, 2**32, (HEIGHT, WIDTH), dtype=np.uint32)
    write("exr-mixed.exr", {"Y": GREY, "id": whole, "A": half[..., 0].copy()})
    read("exr-mixed.exr", np.dstack([GREY.astype(float), half[..., 0].astype(float), whole.astype(float)]), ["y", "a", "id"])
    tiles = OpenEXR.TileDescription()
    tiles.xSize, tiles.ySize = 4, 4
    write("exr-tiles.exr", {"RGB": COLOR}, type=OpenEXR.tiledimage, tiles=tiles)
    read("exr-tiles.exr", COLOR, "rgb")
    window = (np.array([1, 1], np.int32), np.array([WIDTH, HEIGHT], np.int32))
    write("exr-window.exr", {"RGB": COLOR}, dataWindow=window, displayWindow=(np.zeros(2, np.int32), np.array([9, 9], np.int32)))
    convert.refused("image", "exr-window.exr", "window")
    whole = pathlib.Path(path("exr-ZIP.exr")).read_bytes()
    for part in [10, len(whole) // 2, len(whole) - 1]:
        pathlib.Path(path(f"exr-cut-{part}.exr")).write_bytes(whole[:part])
        convert.refused("image", f"exr-cut-{part}.exr", "allowed:")


def integers():
    """PNG, PPM and PGM by Pillow and OpenCV, and by hand where they write none of the kind."""
    bytes_, words = (random.integers(0, 2**bits, (HEIGHT, WIDTH, 3)) for bits in (8, 16))
    bytes_, words = bytes_.astype(np.uint8), words.astype(np.uint16)
    for ending in ["png", "ppm"]:
        Image.fromarray(bytes_).save(path(f"pillow-8.{ending}"))
        read(f"pillow-8.{ending}", bytes_ / 255, "rgb", 1 / 255)
        cv2.imwrite(path(f"opencv-16.{ending}"), words[..., ::-1])
        read(f"opencv-16.{ending}", words / 65535, "rgb", 1 / 65535)
    for ending in ["png", "pgm"]:
        Image.fromarray(bytes_[..., 0]).save(path(f"pillow-grey-8.{ending}"))
        read(f"pillow-grey-8.{ending}", bytes_[..., 0] / 255, "y", 1 / 255)
        Image.fromarray(words[..., 0]).save(path(f"pillow-grey-16.{ending}"))
        read(f"pillow-grey-16.{ending}", words[..., 0] / 65535, "y", 1 / 65535)
    alpha = np.dstack([bytes_, bytes_[..., 0]])
    Image.fromarray(alpha).save(path("pillow-alpha.png"))
    read("pillow-alpha.png", alpha / 255, "rgba", 1 / 255)
    few = bytes_[..., 0] % 100
    pathlib.Path(path("hand-99.pgm")).write_bytes(b"P5 # of 99\n7 5\n99\n" + few.tobytes())
    read("hand-99.pgm", few / 99, "y", 1 / 99)
    Image.fromarray(bytes_).convert("P").save(path("pillow-palette.png"))
    convert.refused("image", "pillow-palette.png", "palette")
    Image.fromarray(bytes_[..., 0] > 99).save(path("pillow-bits.png"))
    convert.refused("image", "pillow-bits.png", "1 bits")


def pfm_read():
    cv2.imwrite(path("opencv.pfm"), COLOR[..., ::-1])
    read("opencv.pfm", COLOR, "rgb")
    Image.fromarray(GREY).save(path("pillow.pfm"))
    read("pillow.pfm", GREY, "y")
    scaled = b"Pf\n7 5\n-2.0\n" + GREY[::-1].tobytes()
    pathlib.Path(path("scaled.pfm")).write_bytes(scaled)
    convert.refused("image", "scaled.pfm", "scale")


def arrays():
    for kind in ["<f4", ">f8"]:
        np.save(path(f"numpy-{kind[1:]}.npy"), COLOR.astype(kind))
        read(f"numpy-{kind[1:]}.npy", COLOR, "rgb")
    np.save(path("numpy-int.npy"), np.zeros((HEIGHT, WIDTH), np.uint8))
    convert.refused("image", "numpy-int.npy", "integers")


def cameras():
    """A camera of volver as VTK's importer of glTF has it."""
    lenses = [("orthographic", {"height": 2.5}), ("perspective", {"angle_degrees": 35.0})]
    for lens, said in lenses:
        camera = {"position": [1.5, -2.0, 3.0], "target": [0.25, 0.5, -1.0], "up": [0.0, 1.0, 0.5], lens: said}
        pathlib.Path(path(f"{lens}.json")).write_text(json.dumps(camera))
        convert.run("camera", f"{lens}.json", f"{lens}.gltf")
        seen = imported(f"{lens}.gltf")
        position, target = (np.array(camera[key]) for key in ["position", "target"])
        forward = (target - position) / np.linalg.norm(target - position)
        up = camera["up"] - forward * (forward @ camera["up"])
        near = lambda a, b: np.allclose(a, b, rtol=0, atol=1e-14)
        convert.row(f"{lens}.gltf, VTK", "place", near(seen.GetPosition(), position))
        convert.row(f"{lens}.gltf, VTK", "direction", near(seen.GetDirectionOfProjection(), forward))
        across = np.array(seen.GetViewUp()) - forward * (forward @ np.array(seen.GetViewUp()))
        convert.row(f"{lens}.gltf, VTK", "up", near(across / np.linalg.norm(across), up / np.linalg.norm(up)))
        if lens == "orthographic":
            right = seen.GetParallelProjection() and near(2 * seen.GetParallelScale(), said["height"])
        else:
            right = not seen.GetParallelProjection() and near(seen.GetViewAngle(), said["angle_degrees"])
        convert.row(f"{lens}.gltf, VTK", "lens", bool(right))
        convert.run("camera", f"{lens}.gltf", "again.json")
        again = json.loads(pathlib.Path(path("again.json")).read_text())
        convert.row(f"{lens}.gltf", "place, direction and lens again", again["position"] == camera["position"]
                    and np.allclose(np.subtract(again["target"], again["position"]), forward, rtol=0, atol=1e-15)
                    and np.allclose(list(again[lens].values()), list(said.values()), rtol=1e-15))  # fmt: skip


def color_map():
    """A colour map of ParaView as VTK's functions have it: opacities of the length 1, which are extinctions here."""
    points = [-1.0, 0.05, 0.3, 0.0, 0.5, 0.95, 0.5, 0.0, 2.0, 0.25, 0.8, 0.0, 3.0, 0.0, 0.5, 0.0]
    colors = [-0.5, 0.1, 0.9, 0.2, 1.25, 0.7, 0.0, 1.0, 2.5, 0.3, 0.6, 0.4]
    pathlib.Path(path("map.json")).write_text(json.dumps([{"ColorSpace": "RGB", "RGBPoints": colors, "Points": points}]))
    said = convert.run("transfer", "map.json", "ours.json")
    ours = json.loads(pathlib.Path(path("ours.json")).read_text())["points"]
    opacity, color = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
    for i in range(0, len(points), 4):
        opacity.AddPoint(*points[i : i + 4])
    for i in range(0, len(colors), 4):
        color.AddRGBPoint(*colors[i : i + 4])
    places = np.linspace(-1.5, 3.5, 5001)
    s = [point["s"] for point in ours]
    wanted = -np.log1p([-opacity.GetValue(place) for place in places])
    off = np.abs(np.interp(places, s, [point["extinction"] for point in ours]) - wanted).max() / wanted.max()
    convert.row("map.json, VTK", "extinction", off <= said["error"] <= 1e-6, f"{off:.0e} off, {said['error']:.0e} said")
    emission = np.array([[np.interp(place, s, [point["emission"][i] for point in ours]) for i in range(3)] for place in places])
    # VTK's colours of a place come in binary64.
    right = np.allclose(emission, [color.GetColor(place) for place in places], rtol=0, atol=1e-12)
    convert.row("map.json, VTK", "emission", right)


def imported(name):
    """The camera of VTK's importer, which draws nothing for it: a triangle is in the file beside the camera."""
    whole = json.loads(pathlib.Path(path(name)).read_text())
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    pathlib.Path(path("triangle.bin")).write_bytes(corners)
    whole["buffers"] = [{"uri": "triangle.bin", "byteLength": 36}]
    whole["bufferViews"] = [{"buffer": 0, "byteLength": 36}]
    whole["accessors"] = [
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}
    ]
    whole["meshes"] = [{"primitives": [{"attributes": {"POSITION": 0}}]}]
    whole["nodes"].append({"mesh": 0})
    whole["scenes"][0]["nodes"].append(1)
    pathlib.Path(path(f"vtk-{name}")).write_text(json.dumps(whole))
    importer = vtk.vtkGLTFImporter()
    importer.SetFileName(path(f"vtk-{name}"))
    importer.Update()
    return importer.GetImportedCameras().GetItemAsObject(0)


exr_written()
exr_read()
integers()
pfm_read()
arrays()
cameras()
color_map()
convert.end("pictures, cameras and transfer functions")
