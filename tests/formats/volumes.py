"""Volumes: volumes.py CONVERT FOLDER."""

import pathlib
import sys

import nrrd
import numpy as np
import SimpleITK as sitk
import vtk
from converter import Converter
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

vtk.vtkObject.GlobalWarningDisplayOff()
convert = Converter(*sys.argv[1:3])
path = convert.path
random = np.random.default_rng(25)
# (x, y, z): more than ten along x, as VTK's reader of NRRD wants it, and no axis like another.
SIZE = (12, 5, 3)
ORIGIN = (0.1, -2.0 / 3.0, 1e-7)
SPACING = (0.1, 1.0 / 3.0, 2.5)


def rotation():
    """About an axis that is no coordinate's."""
    x, y, z = np.array([1.0, 2.0, -3.0]) / np.sqrt(14.0)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(0.7) * cross + (1 - np.cos(0.7)) * cross @ cross


ALONG, TURNED = np.eye(3), rotation()
SINGLE = random.standard_normal(SIZE[::-1]).astype(np.float32)
DOUBLE = random.standard_normal(SIZE[::-1])


def geometry(name, said, origin, spacing, direction, digits=0.0):
    """Whether samples stand where they did, within a relative error that is that of the writer's digits."""
    places = [("origin", origin), ("spacing", spacing), ("direction", direction)]
    for what, wanted in places:
        wanted = np.asarray(wanted, float)
        near = np.allclose(said[what], wanted, rtol=digits, atol=digits)
        convert.row(name, what, near, f"{np.abs(said[what] - wanted).max():.0e} off" if not near or digits else "")


def itk_of(name):
    image = sitk.ReadImage(path(name))
    return sitk.GetArrayFromImage(image), {
        "origin": image.GetOrigin(),
        "spacing": image.GetSpacing(),
        "direction": np.reshape(image.GetDirection(), (3, 3)),
    }


def vtk_said(image):
    matrix = image.GetDirectionMatrix()
    values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])
    return values, {
        "origin": image.GetOrigin(),
        "spacing": image.GetSpacing(),
        "direction": np.array([[matrix.GetElement(i, j) for j in range(3)] for i in range(3)]),
    }


def vtk_of(name):
    kinds = {"vti": vtk.vtkXMLImageDataReader, "nrrd": vtk.vtkNrrdReader, "mha": vtk.vtkMetaImageReader}
    reader = kinds[name.rsplit(".")[-1]]()
    reader.SetFileName(path(name))
    reader.Update()
    return vtk_said(reader.GetOutput())


def pynrrd_of(name):
    values, header = nrrd.read(path(name))
    steps = np.asarray(header["space directions"])
    spacing = np.linalg.norm(steps, axis=1)
    return values.transpose(2, 1, 0), {
        "origin": header["space origin"],
        "spacing": spacing,
        "direction": (steps / spacing[:, None]).T,
    }


def vtk_image(values, origin, spacing, direction, first=(0, 0, 0)):
    image = vtk.vtkImageData()
    depth, height, width = values.shape
    ends = [end for at, size in zip(first, (width, height, depth)) for end in (at, at + size - 1)]
    image.SetExtent(*ends)
    image.SetOrigin(origin)
    image.SetSpacing(spacing)
    image.SetDirectionMatrix(*direction.ravel())
    array = numpy_to_vtk(values.ravel(), deep=1)
    array.SetName("field")
    image.GetPointData().SetScalars(array)
    return image


def itk_image(values, origin, spacing, direction):
    image = sitk.GetImageFromArray(values)
    image.SetOrigin(origin)
    image.SetSpacing(spacing)
    image.SetDirection(direction.ravel())
    return image


def read(name, values, origin, spacing, direction, digits=0.0):
    """Whether volver reads a file as it was meant."""
    try:
        said = convert.run("volume", name, "read.npy")
    except ValueError as error:
        convert.row(name, "values", False, str(error))
        return
    seen = np.load(path("read.npy"))
    held = "f4" if values.dtype.itemsize <= 2 or values.dtype.newbyteorder("=") == np.float32 else "f8"
    right = seen.dtype == held and seen.shape == values.shape and np.array_equal(seen, values.astype(held), equal_nan=True)
    convert.row(name, f"values, {values.dtype} as {seen.dtype}", right)
    geometry(name, said, origin, spacing, direction, digits)


def written():
    """What volver writes, read by others."""
    for kind, values in [("f32", SINGLE), ("f64", DOUBLE)]:
        for turn, direction in [("along", ALONG), ("turned", TURNED)]:
            # The way into volver is a file of its own kind, whose header is written by hand here.
            source = f"in-{kind}-{turn}.vti"
            hand_written(source, values, direction)
            for ending, readers in [
                ("vti", {"VTK": vtk_of}),
                ("nrrd", {"ITK": itk_of, "VTK": vtk_of, "pynrrd": pynrrd_of}),
                ("mha", {"ITK": itk_of} | ({"VTK": vtk_of} if turn == "along" else {})),
            ]:
                name = f"volver-{kind}-{turn}.{ending}"
                convert.run("volume", source, name)
                for reader, of in readers.items():
                    seen, said = of(name)
                    label = f"{name}, {reader}"
                    convert.row(label, "values", seen.dtype == values.dtype and np.array_equal(seen, values))
                    # VTK's reader of NRRD takes no direction.
                    place = ALONG if (ending, reader) == ("nrrd", "VTK") and turn == "turned" else direction
                    if place is direction:
                        exact = ending != "nrrd"
                        geometry(label, said, ORIGIN, SPACING, direction, 0.0 if exact else 4e-16)
            name = f"volver-{kind}-{turn}.npy"
            convert.run("volume", source, name)
            convert.row(f"{name}, NumPy", "values", np.array_equal(np.load(path(name)), values))


def hand_written(name, values, direction):
    ends = " ".join(f"0 {size - 1}" for size in SIZE)
    numbers = {"Origin": ORIGIN, "Spacing": SPACING, "Direction": direction.ravel()}
    attributes = " ".join(f'{key}="{" ".join(repr(float(part)) for part in parts)}"' for key, parts in numbers.items())
    kind = {4: "Float32", 8: "Float64"}[values.dtype.itemsize]
    text = " ".join(repr(value) for value in values.ravel().tolist())
    pathlib.Path(path(name)).write_text(
        f'<VTKFile type="ImageData" version="1.0"><ImageData WholeExtent="{ends}" {attributes}><Piece Extent="{ends}">'
        f'<PointData><DataArray type="{kind}" Name="a" format="ascii">{text}</DataArray></PointData></Piece></ImageData></VTKFile>'
    )


def by_vtk():
    modes = {"ascii": "SetDataModeToAscii", "inline": "SetDataModeToBinary", "appended": "SetDataModeToAppended"}
    types = [np.uint8, np.int16, np.uint32, np.int64, np.float32, np.float64]
    for mode, setting in modes.items():
        for packing in ["plain", "zlib"]:
            for coding in ["base64", "raw"] if mode == "appended" else ["base64"]:
                for kind in types:
                    values = (100 * DOUBLE + 400 if np.issubdtype(kind, np.integer) else DOUBLE).astype(kind)
                    writer = vtk.vtkXMLImageDataWriter()
                    name = f"vtk-{mode}-{packing}-{coding}-{np.dtype(kind)}.vti"
                    writer.SetFileName(path(name))
                    getattr(writer, setting)()
                    writer.SetCompressorTypeToZLib() if packing == "zlib" else writer.SetCompressorTypeToNone()
                    writer.SetEncodeAppendedData(coding == "base64")
                    writer.SetHeaderTypeToUInt64() if kind is np.float32 else writer.SetHeaderTypeToUInt32()
                    writer.SetByteOrderToBigEndian() if kind is np.int16 else writer.SetByteOrderToLittleEndian()
                    # Blocks that end within the values of a row.
                    writer.SetBlockSize(64)
                    writer.SetInputData(vtk_image(values, ORIGIN, SPACING, TURNED))
                    writer.Write()
                    read(name, values, ORIGIN, SPACING, TURNED)
    name, first = "vtk-extent.vti", (2, -1, 5)
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetFileName(path(name))
    writer.SetInputData(vtk_image(DOUBLE, ORIGIN, SPACING, TURNED, first))
    writer.Write()
    moved = np.array(ORIGIN) + TURNED @ (np.array(SPACING) * first)
    read(name, DOUBLE, moved, SPACING, TURNED, 1e-15)
    mirrored = vtk_image(DOUBLE, ORIGIN, SPACING, np.diag([1.0, -1.0, 1.0]))
    vector = vtk_image(DOUBLE, ORIGIN, SPACING, ALONG)
    vector.GetPointData().SetScalars(numpy_to_vtk(np.zeros((DOUBLE.size, 3)), deep=1))
    cells = vtk_image(DOUBLE, ORIGIN, SPACING, ALONG)
    cells.GetPointData().Initialize()
    cell = numpy_to_vtk(np.zeros(cells.GetNumberOfCells()), deep=1)
    cell.SetName("c")
    cells.GetCellData().SetScalars(cell)
    sheared = vtk_image(DOUBLE, ORIGIN, SPACING, np.array([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]))
    for name, image, word in [
        ("vtk-mirrored.vti", mirrored, "mirrored"),
        ("vtk-vector.vti", vector, "NumberOfComponents"),
        ("vtk-cells.vti", cells, "data of cells"),
        ("vtk-sheared.vti", sheared, "sheared"),
    ]:
        writer.SetFileName(path(name))
        writer.SetInputData(image)
        writer.Write()
        convert.refused("volume", name, word)
    for name, packing in [("vtk-plain.mha", False), ("vtk-zlib.mha", True), ("vtk-plain.mhd", False)]:
        writer = vtk.vtkMetaImageWriter()
        writer.SetFileName(path(name))
        writer.SetCompression(packing)
        writer.SetInputData(vtk_image(DOUBLE, ORIGIN, SPACING, ALONG))
        writer.Write()
        read(name, DOUBLE, ORIGIN, SPACING, ALONG)


def by_itk():
    types = [np.uint8, np.int8, np.uint16, np.int16, np.uint32, np.int32, np.uint64, np.int64, np.float32, np.float64]
    for ending in ["nrrd", "nhdr", "mha", "mhd"]:
        for kind in types:
            values = (10 * DOUBLE + 60 if np.issubdtype(kind, np.integer) else DOUBLE).astype(kind)
            for packing in [False, True]:
                name = f"itk-{'zlib' if packing else 'plain'}-{np.dtype(kind)}.{ending}"
                sitk.WriteImage(itk_image(values, ORIGIN, SPACING, TURNED), path(name), packing)
                read(name, values, ORIGIN, SPACING, TURNED, 1e-15)
    for ending in ["nrrd", "mha"]:
        name = f"itk-mirrored.{ending}"
        sitk.WriteImage(itk_image(DOUBLE, ORIGIN, SPACING, np.diag([1.0, 1.0, -1.0])), path(name))
        convert.refused("volume", name, "mirrored")
        name = f"itk-vector.{ending}"
        sitk.WriteImage(sitk.GetImageFromArray(np.zeros((3, 4, 5, 2)), isVector=True), path(name))
        convert.refused("volume", name, "kinds" if ending == "nrrd" else "ElementNumberOfChannels")


def by_pynrrd():
    steps = (TURNED * np.array(SPACING)).T
    turned = {"space directions": steps, "space origin": np.array(ORIGIN), "endian": "little"}
    for encoding in ["raw", "ascii", "gzip"]:
        for space in ["left-posterior-superior", "right-anterior-superior", "LPS"]:
            name = f"pynrrd-{encoding}-{space[:5]}.nrrd"
            values = DOUBLE.transpose(2, 1, 0)
            nrrd.write(path(name), values, turned | {"encoding": encoding, "space": space})
            signs = np.array([-1, -1, 1]) if space.startswith("right") else np.ones(3)
            # ITK, another reader of the same file, says what was meant.
            seen, said = itk_of(name)
            convert.row(f"{name}, ITK", "values", np.array_equal(seen, DOUBLE))
            geometry(f"{name}, ITK", said, signs * ORIGIN, SPACING, signs[:, None] * TURNED, 1e-15)
            read(name, DOUBLE, signs * ORIGIN, SPACING, signs[:, None] * TURNED, 1e-15)
    minimal = {"spacings": np.array(SPACING)}
    nrrd.write(path("pynrrd-detached.nhdr"), SINGLE.transpose(2, 1, 0), minimal, detached_header=True)
    read("pynrrd-detached.nhdr", SINGLE, (0, 0, 0), SPACING, ALONG)
    nrrd.write(path("pynrrd-mins.nrrd"), SINGLE.transpose(2, 1, 0), {"axis mins": np.zeros(3), "axis maxs": np.ones(3)})
    convert.refused("volume", "pynrrd-mins.nrrd", "with spacings beside them")
    mins = {"axis mins": np.array(ORIGIN), "spacings": np.array(SPACING)}
    for center, moved in [("node", 0.0), ("cell", 0.5)]:
        name = f"pynrrd-{center}.nrrd"
        nrrd.write(path(name), SINGLE.transpose(2, 1, 0), mins | {"centerings": [center] * 3})
        origin = np.array(ORIGIN) + moved * np.array(SPACING)
        read(name, SINGLE, origin, SPACING, ALONG, 1e-15)
        geometry(f"{name}, ITK", itk_of(name)[1], origin, SPACING, ALONG, 1e-15)
    nrrd.write(path("pynrrd-uncentred.nrrd"), SINGLE.transpose(2, 1, 0), mins)
    convert.refused("volume", "pynrrd-uncentred.nrrd", "node or cell")
    left = turned | {"space": "left-anterior-superior", "space directions": np.diag(SPACING)}
    nrrd.write(path("pynrrd-las.nrrd"), DOUBLE.transpose(2, 1, 0), left)
    convert.refused("volume", "pynrrd-las.nrrd", "mirrored")


def by_numpy():
    for kind in ["<f4", ">f4", "<f8", "<i2", ">u4", "|u1"]:
        values = (10 * DOUBLE + 60).astype(kind)
        name = f"numpy-{kind[1:]}{'-big' if kind[0] == '>' else ''}.npy"
        np.save(path(name), values)
        read(name, values, (0, 0, 0), (1, 1, 1), ALONG)
    np.save(path("numpy-fortran.npy"), np.asfortranarray(DOUBLE))
    convert.refused("volume", "numpy-fortran.npy", "Fortran")


written()
by_vtk()
by_itk()
by_pynrrd()
by_numpy()
convert.end("volumes")
