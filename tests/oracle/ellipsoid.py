# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact of two ellipsoids by the Perram-Wertheim function: p = ((1-l) B1 + l B2)^-1 d with B = R diag(s^2) R^T, d =
x2 - x1, and l where (1-l) sqrt(p.B1 p) = l sqrt(p.B2 p). The contact point is x1 + (1-l) B1 p, the normal lies along p,
and the overlap is the sum of the distances from the contact point to the two surfaces along the normal."""
import itertools

import numpy as np

from oracle.measures import rotation


def matrix(semi_axes, quaternion):
    r = rotation(quaternion)
    return r @ np.diag(np.square(semi_axes)) @ r.T


def contact(x1, b1, x2, b2):
    """(point, unit normal from 2 to 1, overlap), or None when the ellipsoids are apart."""
    d = x2 - x1
    low, high = 0.0, 1.0
    for _ in range(60):
        lam = 0.5 * (low + high)
        p = np.linalg.solve((1 - lam) * b1 + lam * b2, d)
        a, b = np.sqrt(p @ b1 @ p), np.sqrt(p @ b2 @ p)
        if d @ p > a + b:
            return None
        if (1 - lam) * a > lam * b:
            low = lam
        else:
            high = lam
    n = p / np.linalg.norm(p)
    point = x1 + (1 - lam) * b1 @ p
    return point, -n, to_surface(point - x1, n, b1) + to_surface(point - x2, -n, b2)


def to_surface(start, direction, b):
    """Distance from a point inside an ellipsoid to its surface: y.B^-1 y = 1 with y = start + t direction."""
    inverse = np.linalg.inv(b)
    q2, q1, q0 = direction @ inverse @ direction, start @ inverse @ direction, start @ inverse @ start - 1.0
    return (-q1 + np.sqrt(q1 * q1 - q2 * q0)) / q2


def contacts(grains, box):
    """{(id i, id j, image): (point, normal, overlap)} of all pairs, i < j."""
    matrices = [matrix(s, q) for s, q in zip(grains.shape, grains.quaternion)]
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)))
    found = {}
    for i, j in itertools.combinations(range(len(grains.ids)), 2):
        partners = grains.x[j] + shifts @ box.edges.T
        near = np.linalg.norm(partners - grains.x[i], axis=1) < grains.radius[i] + grains.radius[j]
        for k in np.flatnonzero(near):
            touch = contact(grains.x[i], matrices[i], partners[k], matrices[j])
            if touch:
                found[(int(grains.ids[i]), int(grains.ids[j]), *map(int, shifts[k]))] = touch
    return found
