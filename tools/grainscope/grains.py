# SPDX-License-Identifier: GPL-2.0-or-later
"""Places, shapes and orientations of the grains of a dump, by whichever of their names it has."""
from dataclasses import dataclass

import numpy as np

from grainscope.dumps import Dump
from grainscope.errors import InputError

PLACES = (("x", "y", "z"), ("xu", "yu", "zu"))
FRACTIONS = ("xs", "ys", "zs")
SEMI_AXES = (("shapex", "shapey", "shapez"), ("c_shape[1]", "c_shape[2]", "c_shape[3]"))
# Scalar part first; columns c_orient are in the order of OVITO (doc/visualise.md).
QUATERNIONS = (
    ("quat1", "quat2", "quat3", "quat4"),
    ("quatw", "quati", "quatj", "quatk"),
    ("c_orient[4]", "c_orient[1]", "c_orient[2]", "c_orient[3]"),
)
BLOCKINESS = ("blockiness1", "blockiness2")

OF_SPHERES = "dump grains all custom 1000 grains.*.dump id type x y z radius"
OF_ELLIPSOIDS = (
    "dump grains all custom 1000 grains.*.dump id type x y z quat1 quat2 quat3 quat4 shapex shapey shapez "
    "(any further columns may follow)"
)
REMEDY = f"Dump spheres by\n  {OF_SPHERES}\nand ellipsoids by\n  {OF_ELLIPSOIDS}"


@dataclass
class Grains:
    """Positions (N,3), rotation matrices (N,3,3) from the body to the laboratory, semi-axes (N,3); box origin and edge
    vectors (rows of a 3x3 matrix)."""

    positions: np.ndarray
    rotations: np.ndarray
    semi_axes: np.ndarray
    origin: np.ndarray
    edges: np.ndarray


def rotation_matrices(quaternions):
    """Rotation matrices (N,3,3) of quaternions (N,4) of any length but 0, scalar part first."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)


def _first_that_is_there(snapshot, sets):
    return next((names for names in sets if all(name in snapshot for name in names)), None)


def positions(snapshot):
    names = _first_that_is_there(snapshot, PLACES)
    if names:
        return snapshot.vectors(*names)
    if all(name in snapshot for name in FRACTIONS):
        return snapshot.box.origin + snapshot.vectors(*FRACTIONS) @ snapshot.box.edges
    snapshot.require(*PLACES[0], remedy=REMEDY)


def semi_axes(snapshot):
    """Of spheres three times the radius."""
    names = _first_that_is_there(snapshot, SEMI_AXES)
    if names:
        return snapshot.vectors(*names)
    if "diameter" in snapshot and "radius" not in snapshot:
        return np.repeat(0.5 * snapshot.vectors("diameter"), 3, axis=1)
    if not any(name in snapshot for name in QUATERNIONS[0]):
        snapshot.require("radius", remedy=REMEDY)
        return np.repeat(snapshot.vectors("radius"), 3, axis=1)
    snapshot.require(*SEMI_AXES[0], remedy=REMEDY)


def quaternions(snapshot):
    """(N,4), scalar part first; 1 0 0 0 for spheres."""
    names = _first_that_is_there(snapshot, QUATERNIONS)
    if names:
        found = snapshot.vectors(*names)
        if not np.linalg.norm(found, axis=1).all():
            raise InputError(f"{snapshot.path}: step {snapshot.step}: a quaternion ({' '.join(names)}) is 0 0 0 0")
        return found
    sizes = semi_axes(snapshot)
    if (np.ptp(sizes, axis=1) > 0).any():
        snapshot.require(*QUATERNIONS[0], remedy=REMEDY)
    return np.tile([1.0, 0.0, 0.0, 0.0], (len(sizes), 1))


def blockiness(snapshot):
    """Exponents n1, n2 of superquadrics (N,2); 2 2, which are ellipsoids, where the dump does not have them."""
    if all(name in snapshot for name in BLOCKINESS):
        return snapshot.vectors(*BLOCKINESS)
    return np.full((len(snapshot), 2), 2.0)


def grains_of(snapshot):
    box = snapshot.box
    return Grains(
        positions(snapshot), rotation_matrices(quaternions(snapshot)), semi_axes(snapshot), box.origin, box.edges
    )


def read_grains(path):
    """Those of the last snapshot of a dump."""
    last = Dump(path)[-1]
    if len(last) == 0:
        raise InputError(f"{path}: the last snapshot holds no grains")
    return grains_of(last)
