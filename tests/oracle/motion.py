# SPDX-License-Identifier: GPL-2.0-or-later
"""Motion of grains against a mean flow: four mean flows, and what compute fluctuation reads off."""
import math

import numpy as np

from oracle.measures import rotation


def mass_mean(m, values):
    return m @ values / m.sum()


def fractions(x, box):
    return np.linalg.solve(box.edges, (x - box.origin).T).T


def layer_of(x, box, gradient, layers):
    s = fractions(x, box)[:, gradient]
    return np.minimum(((s - np.floor(s)) * layers).astype(int), layers - 1)


def slope_against(y, v, m):
    """Of the mass-weighted least squares straight line of v (3 components) against y."""
    from_middle = y - mass_mean(m, y)
    spread = m @ from_middle**2
    return (m * from_middle) @ v / spread if spread > 0.0 else np.zeros(3)


def less_mean(m, v):
    return v - mass_mean(m, v)


def peculiar(x, v, omega, m, box, flow=("box",), plane=(0, 1)):
    """(dv, dw) of the given grains. flow: ("box",), ("rate", G), ("fit",) or ("layers", n)."""
    if not len(m):
        return np.zeros((0, 3)), np.zeros((0, 3))
    kind, (a, b), about = flow[0], plane, x - box.centre
    dw = omega - omega.mean(axis=0)
    if kind == "rate":
        gradient = np.zeros((3, 3))
        gradient[a, b] = flow[1]
        return less_mean(m, v - about @ gradient.T), dw
    if kind == "fit":
        return less_mean(m, v - np.outer(about[:, b], slope_against(about[:, b], v, m))), dw
    against_box = v - about @ box.gradient.T
    if kind == "box":
        return less_mean(m, against_box), dw
    layer, dw = layer_of(x, box, b, flow[1]), omega.copy()
    for k in set(layer):
        inside = layer == k
        against_box[inside] -= mass_mean(m[inside], against_box[inside])
        dw[inside] -= omega[inside].mean(axis=0)
    return against_box, dw


def of_group(grains, chosen, box, flow=("box",), plane=(0, 1)):
    return peculiar(grains.x[chosen], grains.v[chosen], grains.omega[chosen], grains.mass[chosen], box, flow, plane)


def inertia(grains, k):
    """Inertia tensor of grain k in the laboratory."""
    m = grains.mass[k]
    if grains.shape is None:
        return 0.4 * m * grains.radius[k] ** 2 * np.eye(3)
    a, b, c = grains.shape[k]
    r = rotation(grains.quaternion[k])
    return r @ np.diag([b * b + c * c, a * a + c * c, a * a + b * b]) @ r.T * m / 5.0


def equivalent_diameter(grains, chosen):
    if grains.shape is None:
        return 2.0 * grains.radius[chosen].mean()
    return (2.0 * np.cbrt(np.prod(grains.shape[chosen], axis=1))).mean()


def layer_means(grains, chosen, box, layers, gradient):
    """(grains, mean box-peculiar velocity with the group's mean removed) of each layer."""
    dv, _ = of_group(grains, chosen, box)
    m, layer = grains.mass[chosen], layer_of(grains.x[chosen], box, gradient, layers)
    counts = np.bincount(layer, minlength=layers) if len(m) else np.zeros(layers)
    means = np.array([mass_mean(m[layer == k], dv[layer == k]) if counts[k] else np.zeros(3) for k in range(layers)])
    return counts, means


def fluctuation(grains, chosen, box, flow=("box",), plane=(0, 1), layers=10, diameter=None):
    """(vector of 14, array layers x 5)."""
    (a, b), count = plane, int(np.sum(chosen))
    length = box.edges[b, b]
    counts, means = layer_means(grains, chosen, box, layers, b)
    array = np.column_stack([((np.arange(layers) + 0.5) / layers - 0.5) * length, counts, means])
    rate = box.gradient[a, b]
    vector = np.zeros(14)
    vector[10] = rate
    if not count:
        return vector, array
    dv, dw = of_group(grains, chosen, box, flow, plane)
    m, members = grains.mass[chosen], np.flatnonzero(chosen)
    vector[:3], vector[3:6] = np.sqrt(np.mean(dv**2, axis=0)), np.sqrt(np.mean(dw**2, axis=0))
    vector[6] = 0.5 * m @ np.sum(dv**2, axis=1)
    vector[7] = sum(0.5 * w @ inertia(grains, k) @ w for w, k in zip(dw, members))
    vector[8] = vector[7] / vector[6] if vector[6] else 0.0
    vector[11] = slope_against(grains.x[chosen][:, b], grains.v[chosen], m)[a]
    if rate:
        deq = diameter or equivalent_diameter(grains, chosen)
        vector[9] = math.sqrt(np.mean(np.sum(dv**2, axis=1))) / (abs(rate) * deq)
        vector[12] = math.sqrt(np.mean(means[counts > 0, a] ** 2)) / (abs(rate) * length)
        vector[13] = math.sqrt(np.mean(dv[:, a] ** 2) / (count / (counts > 0).sum())) / (abs(rate) * length)
    return vector, array
