# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts by the direction of their normal in the laboratory, and summed over each grain."""
import math

import numpy as np

from oracle.measures import axis_of, line_angle, rotation
from oracle.surface import powers, share

UPRIGHT = 1e-9


def in_plane(vectors, plane):
    return np.stack([vectors[:, plane[0]], vectors[:, plane[1]]], axis=1)


def direction_table(rows, bins=72, plane=(0, 1)):
    """bins x 9 of compute contact/direction."""
    table, width = np.zeros((bins, 9)), 2.0 * math.pi / bins
    table[:, 0] = (np.arange(bins) + 0.5) * width
    normal, tangential = in_plane(rows["normal"], plane), in_plane(rows["ft"], plane)
    for n, t, fn in zip(normal, tangential, rows["fn"]):
        length = math.hypot(*n)
        if length < UPRIGHT:
            continue
        beta = math.atan2(n[1], n[0]) % math.pi
        signed = (t[1] * n[0] - t[0] * n[1]) / length
        first = min(int(beta / width), bins // 2 - 1)
        for k in (first, first + bins // 2):
            table[k, 1] += 1.0
            table[k, 6:] += (abs(fn) * length, math.hypot(*t), signed)
    table[:, 3:6] = table[:, 6:] / np.maximum(table[:, 1:2], 1.0)
    total = table[:, 1].sum()
    if total:
        table[:, 2] = table[:, 1] / total / width
    return table


def theta_of(grains, k):
    """Angle between the flow and the major axis of grain k in the xy plane; 0 where there is none."""
    if grains.shape is None:
        return 0.0
    index, kind = axis_of(grains.shape[k])
    if index is None:
        return 0.0
    p = rotation(grains.quaternion[k])[:, index]
    if math.hypot(p[0], p[1]) < UPRIGHT:
        return 0.0
    return line_angle(math.atan2(p[1], p[0]) - (0.5 * math.pi if kind == "oblate" else 0.0))


def grain_table(rows, grains, chosen):
    """grains x 7 of compute contact/grain; `rows` are the group's."""
    table = np.zeros((len(grains.ids), 7))
    normal, friction = powers(rows)
    part = share(rows)
    for k, (one, other) in enumerate(rows["id"]):
        for i in grains.index([one, other] if other else [one]):
            power = (part[k] * normal[k], part[k] * friction[k])
            table[i, :5] += (1.0, rows["sliding"][k], *power, rows["mobilisation"][k])
            table[i, 6] += other == 0
    table[:, 4] /= np.maximum(table[:, 0], 1.0)
    table[:, 5] = [theta_of(grains, k) if chosen[k] else 0.0 for k in range(len(grains.ids))]
    return table
