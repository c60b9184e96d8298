#!/usr/bin/python3
"""Writes hopper.stl, a cone of 45 degrees that ends in the orifice at z = 0, and plug.stl, a square that closes it.
Argument: diameter of the orifice [m]."""
import math
from pathlib import Path
import sys

BIN_RADIUS = 0.024
ORIFICE_RADIUS = 0.5 * float(sys.argv[1] if len(sys.argv) > 1 else 0.020)
SEGMENTS = 24


def ring(radius, height):
    angles = (2.0 * math.pi * k / SEGMENTS for k in range(SEGMENTS + 1))
    return [(radius * math.cos(a), radius * math.sin(a), height) for a in angles]


def cone():
    # Corners of a polygon around the bin, so that no gap is left between the cone and the cylinder.
    wide = BIN_RADIUS / math.cos(math.pi / SEGMENTS)
    low, high = ring(ORIFICE_RADIUS, 0.0), ring(wide, wide - ORIFICE_RADIUS)
    for k in range(SEGMENTS):
        yield low[k], low[k + 1], high[k + 1]
        yield low[k], high[k + 1], high[k]


def plug():
    half = 1.1 * ORIFICE_RADIUS
    a, b, c, d = ((x * half, y * half, 0.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return [(a, b, c), (a, c, d)]


def write(name, triangles):
    lines = [f"solid {name}"]
    for corners in triangles:
        lines += ["facet normal 0 0 1", "outer loop"]  # the host finds the normals itself
        lines += ["vertex " + " ".join(f"{x + 0.0:.9g}" for x in corner) for corner in corners]
        lines += ["endloop", "endfacet"]
    (Path(__file__).parent / f"{name}.stl").write_text("\n".join([*lines, f"endsolid {name}"]) + "\n")


if __name__ == "__main__":
    write("hopper", cone())
    write("plug", plug())
