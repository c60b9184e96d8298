# SPDX-License-Identifier: GPL-2.0-or-later
"""Rattlers, clusters and force statistics in numpy, from rows of contacts: ids (n, 2), 0 for a wall."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def backbone(grains, ids, limit):
    """IDs of the grains that are no rattlers: one grain is removed at a time, the first that has too few contacts."""
    held = set(int(g) for g in grains)
    while True:
        degree = dict.fromkeys(held, 0)
        for i, j in ids.astype(int):
            if i in held and (j == 0 or j in held):
                degree[i] += 1
                if j:
                    degree[j] += 1
        rattlers = sorted(g for g in held if degree[g] < limit)
        if not rattlers:
            return held
        held.remove(rattlers[0])


def backbone_contacts(held, ids):
    """(between grains, with walls)."""
    inside = [(i in held, j == 0, j in held) for i, j in ids.astype(int)]
    return sum(i and j for i, _, j in inside), sum(i and wall for i, wall, _ in inside)


def clusters(ids, strong):
    """Lowest ID of the cluster of each row, 0 for rows that are not strong; and {lowest ID: number of grains}."""
    ends = ids[strong].astype(int)
    named = np.where(ends[:, 1:] == 0, ends[:, :1], ends)
    size = int(ids.max()) + 1
    graph = coo_matrix((np.ones(len(named)), (named[:, 0], named[:, 1])), shape=(size, size))
    label = connected_components(graph, directed=False)[1]
    in_network = np.unique(named)
    lowest, grains = {}, {}
    for grain in in_network:
        root = lowest.setdefault(label[grain], int(grain))
        grains[root] = grains.get(root, 0) + 1
    found = np.zeros(len(ids))
    found[strong] = [lowest[label[i]] for i in named[:, 0]]
    return found, grains


def force_statistics(fn, ft, force, branch, tail, dimension=3):
    """By name, as compute contact/force calls them; ft: magnitudes."""
    mean = fn.mean()
    f, strong = fn / mean, fn > mean
    beyond, weak = f[f > tail], f[(f > 0) & (f < 1)]

    def deviator(chosen):
        m = np.einsum("ca,cb->ab", force[chosen], branch[chosen])
        m = 0.5 * (m + m.T)[:dimension, :dimension]
        return m - np.trace(m) / dimension * np.eye(dimension)

    def trace(chosen):
        return np.einsum("ca,ca->", force[chosen], branch[chosen])

    every = np.ones(len(fn), dtype=bool)
    beta = len(beyond) / np.sum(beyond - tail)
    decay = len(weak) / np.sum(-np.log(weak))
    return {
        "F_n": mean,
        "F_t": ft.mean(),
        "F_n_rms": np.sqrt(np.mean(fn**2)),
        "F_t_rms": np.sqrt(np.mean(ft**2)),
        "F_n_max": fn.max(),
        "F_t_max": ft.max(),
        "participation": mean**2 / np.mean(fn**2),
        "beta": beta,
        "beta_error": beta / np.sqrt(len(beyond)),
        "alpha": 1.0 - decay,
        "alpha_error": decay / np.sqrt(len(weak)),
        "strong_pressure": trace(strong) / trace(every),
        "strong_deviator": np.sum(deviator(strong) * deviator(every)) / np.sum(deviator(every) ** 2),
        "N_strong": strong.sum(),
        "N_negative": np.sum(fn < 0),
        "N_tail": len(beyond),
        "N_weak": len(weak),
        "F_n_sum": fn.sum(),
        "F_t_sum": ft.sum(),
        "F_n2_sum": np.sum(fn**2),
        "F_t2_sum": np.sum(ft**2),
        "tail_sum": np.sum(beyond - tail),
        "weak_sum": np.sum(-np.log(weak)),
    }
