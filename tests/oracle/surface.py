# SPDX-License-Identifier: GPL-2.0-or-later
"""Where on their surface grains touch: bins in the angle psi between the contact point and an axis of the grain, areas
of the bins by quadrature (Gauss-Legendre in psi, trapezoid around the axis), contacts, forces and powers per bin."""
import math

import numpy as np

from oracle.measures import axis_of, contact_stress, rotation
from oracle.state import chosen_rows

NODES, WEIGHTS = np.polynomial.legendre.leggauss(48)
AROUND = 2.0 * math.pi * np.arange(256) / 256


def across(shape, axis):
    """Semi-axes (a, b, c), c the one along `axis`."""
    return shape[(axis + 1) % 3], shape[(axis + 2) % 3], shape[axis]


def area_element(psi, phi, abc, angle):
    """dA / (dpsi dphi). parametric: x = a sin psi cos phi, y = b sin psi sin phi, z = c cos psi. polar: the point of
    the surface in direction s, at r = (s.D s)^(-1/2) with D = diag(1/a^2, 1/b^2, 1/c^2): r^4 |D s| sin psi."""
    a, b, c = abc
    s = np.array([np.sin(psi) * np.cos(phi), np.sin(psi) * np.sin(phi), np.cos(psi) * np.ones_like(phi)])
    if angle == "parametric":
        return np.sin(psi) * np.sqrt((b * c * s[0]) ** 2 + (a * c * s[1]) ** 2 + (a * b * s[2]) ** 2)
    d = np.array([a, b, c])[:, None, None] ** -2.0
    return np.sin(psi) * np.sqrt(np.sum((d * s) ** 2, axis=0)) / np.sum(d * s * s, axis=0) ** 2


def areas(shape, axis, bins, angle, pieces=4):
    """Exact areas of the bins of an ellipsoid, both hemispheres folded on (0, pi/2)."""
    width = 0.5 * math.pi / bins / pieces
    found = []
    for k in range(bins * pieces):
        psi = width * (k + 0.5 + 0.5 * NODES)[:, None]
        element = area_element(psi, AROUND[None, :], across(shape, axis), angle).mean(axis=1) * 2.0 * math.pi
        found.append(2.0 * 0.5 * width * WEIGHTS @ element)
    return np.sum(np.reshape(found, (bins, pieces)), axis=1)


def spheroid_area(equator, pole):
    """Closed form."""
    if equator == pole:
        return 4.0 * math.pi * equator**2
    if pole > equator:
        e = math.sqrt(1.0 - (equator / pole) ** 2)
        return 2.0 * math.pi * equator**2 * (1.0 + pole / (equator * e) * math.asin(e))
    e = math.sqrt(1.0 - (pole / equator) ** 2)
    return 2.0 * math.pi * equator**2 * (1.0 + (1.0 - e * e) / e * math.atanh(e))


def named_axis(shape, name):
    """Index of the body axis: by name, the axis of symmetry for auto, z for spheres."""
    if name != "auto":
        return "xyz".index(name)
    index, _ = axis_of(shape)
    return 2 if index is None else index


def psi_of(point, shape, quaternion, axis, angle):
    """Angle in [0, pi/2] of a point (from the grain's centre, in the laboratory)."""
    a, b, c = across(shape, axis)
    body = rotation(quaternion).T @ point
    x, y, z = across(body, axis)
    if angle == "parametric":
        return math.atan2(math.hypot(x / a, y / b), abs(z) / c)
    return math.atan2(math.hypot(x, y), abs(z))


def bin_of(psi, bins):
    return min(int(psi * bins / (0.5 * math.pi)), bins - 1)


def ends(rows, grains):
    """Each contact seen from its grains: (row, index of the grain, contact point from its centre)."""
    for k, (i, j) in enumerate(grains.index(rows["id"])):
        point = rows["point"][k] - grains.x[i]
        yield k, i, point
        if rows["id"][k, 1]:
            yield k, j, point + rows["branch"][k]


def share(rows):
    """Of a contact's power that each of its grains has."""
    return np.where(rows["id"][:, 1] == 0, 1.0, 0.5)


def powers(rows):
    """P_n and P_t of each contact, instantaneous."""
    normal = -rows["fn_damping"] * rows["un"]
    return normal, -np.einsum("ca,ca->c", rows["ft"], rows["ut"]) * (rows["slip"] > 0)


def surface_table(all_rows, grains, volume, chosen, bins=10, angle="polar", axis="auto", walls="no"):
    """(array bins x 17, vector P, mean area, grains) of compute contact/surface; `all_rows` are the group's."""
    rows = chosen_rows(all_rows, walls)
    table, members = np.zeros((bins, 17)), np.flatnonzero(chosen)
    table[:, 0] = (np.arange(bins) + 0.5) * 0.5 * math.pi / bins
    if not len(members):
        return table, np.zeros(3)
    index = named_axis(grains.shape[members[0]], axis)
    shares = areas(grains.shape[members[0]], index, bins, angle)
    own = {i: shares.sum() * (grains.shape[i][0] / grains.shape[members[0]][0]) ** 2 for i in members}
    mean_area = float(np.mean([own[i] for i in members]))
    pressure = -contact_stress(all_rows, volume)[1, 1] if len(all_rows["fn"]) else 0.0
    scale = 1.0 / pressure if pressure > 0.0 else 0.0
    normal, friction = powers(rows)
    sums = np.zeros((bins, 7))  # contacts, F_n/(P A), |F_t|/(P A), mobilisation, sliding, P_n, P_t
    for k, i, point in ends(rows, grains):
        j = bin_of(psi_of(point, grains.shape[i], grains.quaternion[i], index, angle), bins)
        sums[j] += (
            1.0,
            rows["fn"][k] * scale / own[i],
            np.linalg.norm(rows["ft"][k]) * scale / own[i],
            rows["mobilisation"][k],
            rows["sliding"][k],
            share(rows)[k] * normal[k],
            share(rows)[k] * friction[k],
        )
    fill(table, sums, shares / shares.sum() * mean_area, mean_area)
    return table, np.array([pressure, mean_area, len(members)])


def fill(table, sums, area, whole):
    contacts = sums[:, 0].sum()
    power = sums[:, 5] + sums[:, 6]
    table[:, 1], table[:, 2] = area, sums[:, 0]
    if contacts:
        table[:, 3] = sums[:, 0] / contacts / area
        table[:, 4] = sums[:, 0] / contacts / (area / whole)
    table[:, 5:9] = sums[:, 1:5] / np.maximum(sums[:, :1], 1.0)
    table[:, 9:11] = sums[:, 5:]
    table[:, 13:] = sums[:, 1:5]
    if power.sum():
        table[:, 11] = power / area / (power.sum() / whole)
        table[:, 12] = table[:, 11] * whole / area
