"""Reads the grains of a text dump."""

from dataclasses import dataclass
from pathlib import Path
import re

import numpy as np

from grainscope.errors import InputError


@dataclass
class Grains:
    """A dump: positions (N,3), rotation matrices (N,3,3) from the body to the laboratory, semi-axes (N,3); box origin
    and edge vectors (rows of a 3x3 matrix)."""

    positions: np.ndarray
    rotations: np.ndarray
    semi_axes: np.ndarray
    origin: np.ndarray
    edges: np.ndarray


def rotation_matrices(quaternions):
    """Rotation matrices (N,3,3) of unit quaternions (N,4), scalar part first."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)


def read_grains(path):
    """The last snapshot of a text dump with columns id x y z quat1-4 shapex-z, of spheres x y z radius, in a triclinic
    or orthogonal box."""
    try:
        text = Path(path).read_text()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    snapshot = text.rpartition("ITEM: TIMESTEP")[2]
    match = re.search(r"ITEM: BOX BOUNDS([^\n]*)\n((?:[^\n]*\n){3})ITEM: ATOMS ([^\n]*)\n(.*)", snapshot, re.S)
    if not match:
        raise InputError(f"{path}: not a LIGGGHTS text dump")
    names = match[3].split()
    spheres = "radius" in names
    wanted = ("x y z radius" if spheres else "x y z quat1 quat2 quat3 quat4 shapex shapey shapez").split()
    missing = [name for name in wanted if name not in names]
    if missing:
        raise InputError(f"{path}: no column {', '.join(missing)}; the dump must hold {' '.join(wanted)}")
    try:
        bounds = np.array([line.split() for line in match[2].splitlines()], dtype=float)
        table = np.array(match[4].split(), dtype=float).reshape(-1, len(names))
    except ValueError:
        raise InputError(f"{path}: the last snapshot is damaged or incomplete") from None
    if len(table) == 0:
        raise InputError(f"{path}: the last snapshot holds no grains")
    columns = table[:, [names.index(name) for name in wanted]]

    xy, xz, yz = bounds[:, 2] if bounds.shape[1] == 3 else (0.0, 0.0, 0.0)
    low, high = bounds[:, 0].copy(), bounds[:, 1].copy()
    low[:2] -= min(0.0, xy, xz, xy + xz), min(0.0, yz)
    high[:2] -= max(0.0, xy, xz, xy + xz), max(0.0, yz)
    lx, ly, lz = high - low
    edges = np.array([[lx, 0.0, 0.0], [xy, ly, 0.0], [xz, yz, lz]])
    if spheres:
        rotations, semi_axes = np.tile(np.eye(3), (len(columns), 1, 1)), np.repeat(columns[:, 3:], 3, axis=1)
    else:
        rotations, semi_axes = rotation_matrices(columns[:, 3:7]), columns[:, 7:]
    return Grains(columns[:, :3], rotations, semi_axes, low, edges)
