# SPDX-License-Identifier: GPL-2.0-or-later
"""Correlation of velocities in space, by all pairs, and in time, by all origins; and the decay length of either."""
import itertools
import math

import numpy as np

WORTH_FITTING = 0.05
COMPONENTS = ("vx", "vy", "vz", "wx", "wy", "wz")


def component(dv, dw, name):
    k = COMPONENTS.index(name)
    return dv[:, k] if k < 3 else dw[:, k - 3]


def heights(box):
    """Distances between opposite faces."""
    h = box.edges.T
    return np.array([box.volume / np.linalg.norm(np.cross(h[(k + 1) % 3], h[(k + 2) % 3])) for k in range(3)])


def distances(x, box, periodic=(True, True, True)):
    """N x N, to the nearest image of each, found among those of the neighbouring cells."""
    s = np.linalg.solve(box.edges, x.T).T
    nearest = s[:, None, :] - s[None, :, :]
    nearest -= np.where(periodic, np.round(nearest), 0.0)
    best = np.full((len(x), len(x)), np.inf)
    for shift in itertools.product(*((-1, 0, 1) if p else (0,) for p in periodic)):
        best = np.minimum(best, np.linalg.norm((nearest + np.array(shift)) @ box.edges.T, axis=2))
    return best


def pair_sums(x, values, box, bins, reach, smallest, periodic=(True, True, True)):
    """(numerator, pairs) per bin of width reach/bins, each pair once; none in bins that end at or below `smallest`."""
    i, j = np.triu_indices(len(x), 1)
    r = distances(x, box, periodic)[i, j]
    inside = r < reach
    where = np.minimum((r[inside] * bins / reach).astype(int), bins - 1)
    numerator = np.bincount(where, (values[i] * values[j])[inside], bins)
    pairs = np.bincount(where, minlength=bins).astype(float)
    below = (np.arange(bins) + 1.0) * reach / bins <= smallest
    numerator[below] = pairs[below] = 0.0
    return numerator, pairs


def fast_length(n):
    """The next product of 2, 3, 5 and 7."""
    while True:
        rest = n
        for factor in (2, 3, 5, 7):
            while rest % factor == 0:
                rest //= factor
        if rest == 1:
            return n
        n += 1


def on_mesh(x, box, per_bin, width):
    """Positions moved to the cells of a mesh of at least `per_bin` cells to a bin's width between opposite faces."""
    size = np.array([fast_length(math.ceil(per_bin * h / width - 1e-6)) for h in heights(box)])
    s = np.linalg.solve(box.edges, (x - box.origin).T).T
    return np.minimum(np.floor((s - np.floor(s)) * size), size - 1) / size @ box.edges.T


def decay(r, c):
    """(l, standard error, bins) of exp(-r/l) fitted to the bins with C > 0.05: the best of a fine grid of l, then the
    zero of the derivative by bisection. l = 0 where an endless one is best."""
    chosen = c > WORTH_FITTING
    r, c = r[chosen], c[chosen]
    if not len(r):
        return 0.0, 0.0, 0

    def slope(log_l):
        e = np.exp(-r / math.exp(log_l))
        return np.sum((e - c) * e * r)

    grid = np.linspace(math.log(1e-3 * r.max()), math.log(1e4 * r.max()), 4001)
    sums = np.sum((np.exp(-r[:, None] / np.exp(grid)) - c[:, None]) ** 2, axis=0)
    k = int(np.clip(np.argmin(sums), 1, len(grid) - 2))
    if np.sum((1.0 - c) ** 2) <= sums[k]:
        return 0.0, 0.0, len(r)
    low, high = grid[k - 1], grid[k + 1]
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope(middle) < 0.0 else (low, middle)
    length = math.exp(low)
    e = np.exp(-r / length)
    if len(r) < 2:
        return length, 0.0, len(r)
    return length, math.sqrt(np.sum((e - c) ** 2) / (len(r) - 1) / np.sum((e * r / length**2) ** 2)), len(r)


def ratio(a, b):
    return np.divide(a, b, out=np.zeros_like(a), where=b != 0)


def correlation_table(r, numerator, pairs, mean_square, grains):
    """(array bins x 4, vector of 5) of compute velocity/correlation."""
    c = ratio(numerator, pairs) / mean_square if mean_square else np.zeros_like(r)
    length, error, fitted = decay(r, c)
    return np.column_stack([r, c, numerator, pairs]), np.array([length, error, mean_square, grains, fitted])


def memory_table(samples, strains, lags):
    """(array (lags + 1) x 4, l, error) from the values of the same grains at each sample."""
    table = np.zeros((lags + 1, 4))
    for now, then in itertools.product(range(len(samples)), repeat=2):
        if 0 <= now - then <= lags:
            table[now - then] += (strains[now] - strains[then], 0.0, samples[now] @ samples[then], len(samples[now]))
    origins = np.maximum(len(samples) - np.arange(lags + 1), 1)
    table[:, 0] /= origins
    per_pair = ratio(table[:, 2], table[:, 3])
    table[:, 1] = per_pair / per_pair[0] if per_pair[0] else 0.0
    # Lag 0 is 1 by definition: nothing to fit.
    return table, *decay(np.abs(table[1:, 0]), table[1:, 1])[:2]


def samples_of(strains, every):
    """Which calls take a sample: the first, and each that finds the strain beyond another multiple of `every` since
    then."""
    taken, last = [], -1
    for k, strain in enumerate(strains):
        multiple = math.floor(abs(strain - strains[0]) / every + 1e-9)
        if multiple > last:
            taken.append(k)
            last = multiple
    return taken
