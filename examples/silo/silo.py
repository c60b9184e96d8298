#!/usr/bin/python3
"""Reads what in.silo wrote in the current folder; sets the mass flow against Beverloo's law, the pressure on the side
against Janssen's; tells where the energy went. Argument: diameter of the orifice [m]."""
import math
from pathlib import Path
import sys

import numpy as np

GRAVITY, RADIUS, DIAMETER, DENSITY = 9.81, 0.024, 0.004, 2500.0
CONE = 0.0142  # height
TIME_STEP = 4e-5


def last_profile(path):
    """Height, mass, push and drag of slices, of the last block of a fix ave/spatial file."""
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    start = max(k for k, row in enumerate(rows) if len(row) == 2)
    table = np.array(rows[start + 1 :], dtype=float)
    return table[:, 1], *(table[:, 2] * table[:, k] for k in (3, 4, 5))


def janssen(folder):
    height, mass, push, drag = last_profile(folder / "profile.txt")
    inside = (height > CONE) & (mass > 0.9 * np.median(mass[mass > 0.0]))  # neither in the cone nor at the surface
    thickness = height[1] - height[0]
    above = GRAVITY * mass - drag  # what a slice adds to the vertical force
    force = np.cumsum(above[::-1])[::-1] - 0.5 * above  # in the middle of the slice
    area = math.pi * RADIUS**2
    stress, pressure = force / area, push / (2.0 * math.pi * RADIUS * thickness)
    friction = drag[inside].sum() / push[inside].sum()
    ratio = pressure[inside].sum() / stress[inside].sum()
    weight = GRAVITY * mass[height > CONE].sum()
    bulk = mass[inside].sum() / (area * thickness * inside.sum())
    limit = bulk * GRAVITY * area * RADIUS / (2.0 * friction * ratio)
    carried = weight - limit * (1.0 - math.exp(-weight / limit))
    print(f"solid fraction {bulk / DENSITY:.3f}, friction of the side {friction:.3f}, K = {ratio:.2f}")
    spread = np.std(pressure[inside] / stress[inside])
    print(f"K of single slices scatters by {spread:.2f}")
    print(
        f"carried by the side: {drag.sum() / weight:.3f} of the weight above the cone, Janssen {carried / weight:.3f}"
    )
    rest = np.loadtxt(folder / "rest.txt")[-1]
    print(
        f"push on the side {rest[4]:.3f} N, Janssen {carried / friction:.3f} N; drag {rest[2]:.3f} N, {carried:.3f} N"
    )
    print(f"side and bottom carry {(rest[2] + rest[3]) / rest[1]:.4f} of the weight")
    return bulk


def beverloo(folder, bulk, orifice):
    flow = np.loadtxt(folder / "discharge.txt")
    flow = flow[flow[:, 0] > flow[0, 0] + 0.2 / TIME_STEP]  # without the first 0.2 s
    parts = np.array_split(flow, 5)
    rates = [-np.polyfit(TIME_STEP * part[:, 0], part[:, 1], 1)[0] for part in parts]
    rate, error = np.mean(rates), np.std(rates, ddof=1) / math.sqrt(len(rates))
    scale = bulk * math.sqrt(GRAVITY) * (orifice - 1.4 * DIAMETER) ** 2.5
    print(f"mass flow {rate:.4f} +- {error:.4f} kg/s: C = {rate / scale:.3f} +- {error / scale:.3f} with k = 1.4")


def energies(folder):
    path = folder / "energy.txt"
    names, last = path.read_text().splitlines()[1].split()[2:], np.loadtxt(path)[-1, 1:]
    energy = dict(zip(names, last))
    print(f"work of gravity {1e3 * energy['W_gravity']:.3f} mJ; of this, in %:")
    print(", ".join(f"{name} {100.0 * energy[name] / energy['W_gravity']:.2f}" for name in names[1:-3]))
    print(f"imbalance {energy['imbalance']:.1e}")


if __name__ == "__main__":
    here = Path.cwd()
    beverloo(here, janssen(here), float(sys.argv[1] if len(sys.argv) > 1 else 0.020))
    energies(here)
