"""A ray marcher through a grid and the tables of a transfer function: middle samples, front to back."""

import math

import volver_kernel


def linear(values, at):
    """Between the two values beside a place."""
    i = min(int(at), len(values) - 2)
    return values[i] + (at - i) * (values[i + 1] - values[i])


def lookup(table, s, first, last):
    """The entry of a table that belongs to a field value."""
    entry = (s - first) / (last - first) * (len(table) - 1) if last > first else 0.0
    return linear(table, min(max(entry, 0.0), len(table) - 1.0))


def render(task):
    grid, table = task["data"]["field"], task["data"]["table"]
    radiance, transmittance = [0.0] * len(task["channels"]), 1.0
    begin, end, step = 0.0, task["length"], task["step"]
    for i in range(math.ceil((end - begin) / step - 1e-9)):
        at = begin + i * step
        d = min(step, end - at)
        place = (at + d / 2) / task["length"] * (len(grid) - 1)
        s = linear(grid, place)
        opacity = -math.expm1(-lookup(table["extinction"], s, table["first"], table["last"]) * d)
        for k, emission in enumerate(table["emission"]):
            radiance[k] += transmittance * opacity * lookup(emission, s, table["first"], table["last"])
        transmittance *= 1.0 - opacity
    return radiance


volver_kernel.serve({"name": "volume", "form": "volume", "sampling": "middle", "order": 2}, render)
