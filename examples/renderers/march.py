#!/usr/bin/env python3
"""A ray marcher of its own: it reads a volume, transfer functions and a camera from files, and writes a picture.

    volver image wave --volume-format nrrd --picture-format npy --step-order 2 -- \\
      python3 examples/renderers/march.py {volume} {transfer} {camera} {width} {height} {step} {out}

It needs NumPy alone. Rays are cut into equal segments, at most the step long, with the sample of each in its middle;
the field is linear between samples. `--fault` makes it a wrong one, to see what is said of it.
"""

import argparse
import json

import numpy as np

FAULTS = ["none", "flip", "bgr", "half-voxel", "millimetres", "front"]


def read_nrrd(path):
    """Samples by [z, y, x], the first one's place and the distance of samples along the axes."""
    with open(path, "rb") as file:
        if not file.readline().startswith(b"NRRD000"):
            raise SystemExit(f"{path} is no NRRD file")
        keys = {}
        while line := file.readline().decode().strip():
            if not line.startswith("#"):
                key, _, value = line.partition(": ")
                keys[key] = value
        values = np.frombuffer(file.read(), {"double": "<f8", "float": "<f4"}[keys["type"]])
    sizes = [int(size) for size in keys["sizes"].split()]
    vector = lambda text: [float(part) for part in text.strip("()").split(",")]
    origin = vector(keys["space origin"])
    directions = np.array([vector(text) for text in keys["space directions"].split()])
    return values.reshape(sizes[::-1]).astype(float), np.array(origin), np.diag(directions)


def rays(camera, width, height):
    """Where the ray of every pixel begins, and its direction; from the upper left corner, row by row."""
    position, target = np.array(camera["position"]), np.array(camera["target"])
    forward = target - position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, camera["up"])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    across = (np.arange(width) + 0.5 - width / 2) / height
    above = (height / 2 - np.arange(height) - 0.5) / height
    aside = across[None, :, None] * right + above[:, None, None] * up
    if "orthographic" in camera:
        origins = position + camera["orthographic"]["height"] * aside
        return origins, np.broadcast_to(forward, origins.shape)
    angle = np.radians(camera["perspective"]["angle_degrees"])
    directions = forward + 2 * np.tan(angle / 2) * aside
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    return np.broadcast_to(position, directions.shape), directions


def trilinear(values, index):
    """The field at places in samples, x first."""
    last = np.array(values.shape[::-1]) - 1
    index = np.clip(index, 0, last)
    low = np.minimum(index.astype(int), last - 1)
    part = index - low
    total = 0
    for k in range(8):
        corner = [(k >> axis) & 1 for axis in range(3)]
        weight = np.prod([part[..., a] if corner[a] else 1 - part[..., a] for a in range(3)], axis=0)
        total = total + weight * values[low[..., 2] + corner[2], low[..., 1] + corner[1], low[..., 0] + corner[0]]
    return total


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("volume")
    parser.add_argument("transfer")
    parser.add_argument("camera")
    parser.add_argument("width", type=int)
    parser.add_argument("height", type=int)
    parser.add_argument("step", type=float)
    parser.add_argument("out")
    parser.add_argument("--fault", choices=FAULTS, default="none")
    options = parser.parse_args()
    values, origin, spacing = read_nrrd(options.volume)
    with open(options.transfer) as file:
        points = json.load(file)["points"]
    with open(options.camera) as file:
        camera = json.load(file)
    s = [point["s"] for point in points]
    extinction = np.array([point["extinction"] for point in points])
    emission = np.array([point["emission"] for point in points])
    if options.fault == "millimetres":
        extinction = extinction / 10
    if options.fault == "half-voxel":
        origin = origin + spacing / 2
    origins, directions = rays(camera, options.width, options.height)
    low, high = origin, origin + spacing * (np.array(values.shape[::-1]) - 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        near, far = (low - origins) / directions, (high - origins) / directions
    enter = np.maximum(np.fmin(near, far).max(axis=-1), 0)
    length = np.maximum(np.fmax(near, far).min(axis=-1) - enter, 0)
    count = np.maximum(np.ceil(length / options.step), 1)
    radiance = np.zeros((*length.shape, emission.shape[1]))
    transmittance = np.ones(length.shape)
    where = 0.0 if options.fault == "front" else 0.5
    for i in range(int(count.max())):
        d = np.where(i < count, length / count, 0)
        place = origins + (enter + (i + where) * length / count)[..., None] * directions
        field = trilinear(values, (place - origin) / spacing)
        alpha = -np.expm1(-np.interp(field, s, extinction) * d)
        for channel in range(emission.shape[1]):
            radiance[..., channel] += transmittance * alpha * np.interp(field, s, emission[:, channel])
        transmittance *= 1 - alpha
    if options.fault == "flip":
        radiance = radiance[::-1]
    if options.fault == "bgr":
        radiance = radiance[..., ::-1]
    np.save(options.out, radiance)


main()
