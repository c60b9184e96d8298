# SPDX-License-Identifier: GPL-2.0-or-later
"""The grains of a snapshot that are to be drawn: where they are, how they lie, their shapes."""

from dataclasses import dataclass

import numpy as np

from grainscope import grains
from grainscope.dumps import Snapshot
from grainscope.errors import InputError
from grainscope.render.camera import AXES


@dataclass
class Drawn:
    """Positions (N,3), inside periodic boxes, rotations (N,3,3) from the body to the laboratory, semi-axes (N,3), and
    exponents n1, n2 (N,2) of superquadrics; `rows` are theirs in the snapshot."""

    snapshot: Snapshot
    rows: np.ndarray
    positions: np.ndarray
    rotations: np.ndarray
    semi_axes: np.ndarray
    exponents: np.ndarray

    def __len__(self):
        return len(self.positions)

    @property
    def are_ellipsoids(self):
        return np.all(self.exponents == 2.0, axis=1)

    @property
    def are_spheres(self):
        sizes = self.semi_axes
        return self.are_ellipsoids & (np.ptp(sizes, axis=1) < 1e-9 * sizes.max(axis=1))

    @property
    def reach(self):
        """Radius of a sphere about each that holds it; the corners of superquadrics reach beyond their semi-axes."""
        corners = np.linalg.norm(self.semi_axes, axis=1)
        return np.where(self.are_ellipsoids, self.semi_axes.max(axis=1), corners)

    @property
    def lie_flat(self):
        """Whether all are at one z, as with `dimension 2`."""
        return len(self) > 1 and np.ptp(self.positions[:, 2]) == 0.0


def drawn_of(snapshot, condition=None, cuts=()):
    """Of a snapshot the grains for which the condition holds, with centres between the ends of all cuts (axis, low,
    high)."""
    places, semi_axes = inside(grains.positions(snapshot), snapshot.box), grains.semi_axes(snapshot)
    if np.any(semi_axes <= 0.0):
        raise InputError(f"{snapshot.path}: step {snapshot.step}: sizes must be above 0, got {semi_axes.min():g}")
    kept = np.ones(len(places), dtype=bool)
    if condition is not None:
        kept &= condition.holds(snapshot, len(places))
    for axis, low, high in cuts:
        along = places[:, AXES.index(axis)]
        kept &= (along >= low) & (along <= high)
    rotations = grains.rotation_matrices(grains.quaternions(snapshot))
    parts = (places, rotations, semi_axes, grains.blockiness(snapshot))
    return Drawn(snapshot, np.flatnonzero(kept), *(part[kept] for part in parts))


def inside(places, box):
    """Places in the box, along the edges that are periodic."""
    fractions = (places - box.origin) @ np.linalg.inv(box.edges)
    return places - (np.floor(fractions) * np.array(box.periodic)) @ box.edges
