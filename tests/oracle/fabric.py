# SPDX-License-Identifier: GPL-2.0-or-later
"""Fabric of the contact network: F = 1/N_c sum n n, its axes, and the branch and force tensors weighed against it."""
import math

import numpy as np

from oracle.measures import line_angle, six

DEGENERATE = 1e-10


def upright(vector):
    """The same line, its largest component (the first of equal ones) positive."""
    return vector if vector[int(np.argmax(np.abs(vector)))] > 0.0 else -vector


def axes(tensor):
    """(eigenvalues descending, unit eigenvectors in rows). Where two are equal, the lab axis least along the third,
    laid into their plane, and the normal to both; where all are, x, y, z."""
    values, vectors = np.linalg.eigh(tensor)
    values, vectors = values[::-1], vectors[:, ::-1].T
    same = values[:-1] - values[1:] <= DEGENERATE
    if same.all():
        return values, np.eye(3)
    if same.any():
        lone = 2 if same[0] else 0
        third = vectors[lone]
        lab = np.eye(3)[int(np.argmin(np.abs(third)))]
        first = lab - (lab @ third) * third
        first /= np.linalg.norm(first)
        pair = [first, np.cross(third, first)]
        vectors = np.array([*pair, third] if lone == 2 else [third, *pair])
    return values, np.array([upright(v) for v in vectors])


def traceless(tensor):
    return tensor - np.trace(tensor) / 3.0 * np.eye(3)


def fabric_tensor(normals):
    return np.einsum("ca,cb->ab", normals, normals) / len(normals)


def fabric_vector(rows, plane=(0, 1)):
    """The 22 entries every compute fabric has."""
    n = rows["normal"]
    if not len(n):
        return np.zeros(22)
    tensor, (a, b) = fabric_tensor(n), plane
    values, vectors = axes(tensor)
    deviator = math.sqrt(1.5 * np.sum(traceless(tensor) ** 2))
    angle = line_angle(0.5 * math.atan2(2.0 * tensor[a, b], tensor[a, a] - tensor[b, b]))
    ratio = values[0] / values[1] if values[1] > 1e-14 else 0.0
    return np.array([*six(tensor), *values, *vectors.ravel(), deviator, angle, ratio, len(n)])


def weighted(rows, amount):
    """W = sum w amount n n with w = 1/(N_c (1 + a_c:nn)), a_c = 15/2 (F - 1/3)."""
    n = rows["normal"]
    anisotropy = 7.5 * traceless(fabric_tensor(n))
    weight = 1.0 / (len(n) * (1.0 + np.einsum("ca,ab,cb->c", n, anisotropy, n)))
    return np.einsum("c,ca,cb->ab", weight * amount, n, n)


def deviation(tensor, trace, factor):
    return six(factor / trace * traceless(tensor)) if trace else np.zeros(6)


def branch(rows):
    tensor = weighted(rows, np.linalg.norm(rows["branch"], axis=1))
    return deviation(tensor, np.trace(tensor), 7.5)


def force_normal(rows):
    tensor = weighted(rows, rows["fn"])
    return deviation(tensor, np.trace(tensor), 7.5)


def force_tangential(rows):
    """In units of the normal force: divided by the trace of the normal tensor."""
    return deviation(weighted(rows, np.linalg.norm(rows["ft"], axis=1)), np.trace(weighted(rows, rows["fn"])), 5.0)
