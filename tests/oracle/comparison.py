# SPDX-License-Identifier: GPL-2.0-or-later
"""Pairs of numbers to compare, found by grainscope and expected by the oracle, each with the scale that its rounding
errors have."""
from dataclasses import dataclass

import numpy as np

from oracle import contacts, fabric, surface
from oracle.state import chosen_rows

TINY = 1e-300
# Tangential forces and their powers this much smaller than normal ones are what rounding leaves of zero.
SMALL = 1e-4


@dataclass
class Comparison:
    name: str
    found: np.ndarray
    expected: np.ndarray
    scale: float
    counted: bool = False  # whole numbers: equal, not close

    def error(self):
        """Largest difference over the scale."""
        if not np.size(self.expected):
            return 0.0
        return float(np.max(np.abs(np.asarray(self.found) - np.asarray(self.expected)))) / self.scale


def magnitude(values):
    return max(float(np.max(np.abs(values), initial=0.0)), TINY)


def compare(name, found, expected, scale=None, counted=False):
    return Comparison(
        name, np.asarray(found, dtype=float), np.asarray(expected, dtype=float), scale or magnitude(expected), counted
    )


def rubbing(rows):
    return SMALL * magnitude(rows["fn"]) * magnitude(rows["ut"])


def of_fabric(found, rows, plane=(0, 1)):
    """Angles and axes follow the tensor's errors, blown up by the gap between eigenvalues."""
    expected = fabric.fabric_vector(rows, plane)
    f, (a, b) = expected, plane
    values = f[6:9]
    gap = max(min(values[0] - values[1], values[1] - values[2]), 1e-10)
    tensor = np.array([[f[0], f[3], f[4]], [f[3], f[1], f[5]], [f[4], f[5], f[2]]])
    in_plane = max(np.hypot(tensor[a, a] - tensor[b, b], 2 * tensor[a, b]), 1e-10)
    yield compare("fabric F", found[:6], f[:6], 1.0)
    yield compare("fabric eigenvalues", found[6:9], values, 1.0)
    yield compare("fabric eigenvectors", found[9:18], f[9:18], 1.0 / gap)
    yield compare("fabric deviator", found[18], f[18], 1.0)
    yield compare("fabric angle", found[19], f[19], 1.0 / in_plane)
    yield compare("fabric ratio", found[20], f[20], max(f[20], 1.0))
    yield compare("fabric contacts", found[21], f[21], 1.0, True)


def of_weighted(found, rows):
    """branch, force/normal, force/tangential, in this order; their weights 1/(1 + a_c:nn) blow up the errors of F."""
    n = rows["normal"]
    if not len(n):
        yield compare("fabric weighted", found, np.zeros(18), 1.0)
        return
    share = 1.0 + np.einsum("ca,ab,cb->c", n, 7.5 * fabric.traceless(fabric.fabric_tensor(n)), n)
    parts = (
        ("branch", fabric.branch, np.linalg.norm(rows["branch"], axis=1)),
        ("force/normal", fabric.force_normal, rows["fn"]),
        ("force/tangential", fabric.force_tangential, np.linalg.norm(rows["ft"], axis=1)),
    )
    for k, (name, tensor, amount) in enumerate(parts):
        total = abs(np.sum((rows["fn"] if k else amount) / share))
        blown_up = 7.5 * np.sum(np.abs(amount) / share**2) / total if total else 1.0
        yield compare(f"fabric {name}", found[6 * k : 6 * k + 6], tensor(rows), max(7.5 * blown_up, 1.0))


def steady_bins(angles, edges, doubt):
    """The bins that no angle within `doubt` of an edge may enter or leave."""
    steady = np.ones(len(edges) - 1, dtype=bool)
    for angle in angles:
        for k in np.flatnonzero(np.abs(edges - angle) < doubt):
            steady[max(k - 1, 0)] = steady[min(k, len(steady) - 1)] = False
    return steady


def of_bins(label, found, expected, names, counts, steady, sums, least=0.0):
    """Columns of a histogram, bin by bin where `steady`, and summed over all bins; `sums`: columns that are sums
    already; `least`: a size below which values are rounding errors of larger ones."""
    for column, name in names.items():
        scale = max(magnitude(expected[:, column]), least)
        yield compare(f"{label} {name}", found[steady, column], expected[steady, column], scale)
        weight_found, weight_expected = (1.0, 1.0) if column in sums else (found[:, counts], expected[:, counts])
        total = np.sum(expected[:, column] * weight_expected)
        size = max(np.sum(np.abs(expected[:, column] * weight_expected)), scale)
        yield compare(f"{label} {name}, all bins", np.sum(found[:, column] * weight_found), total, size)


def of_surface(found, vector, moment, angle="polar", axis="auto", doubt=0.0, walls="no"):
    bins, rows, grains = len(found), chosen_rows(moment.rows, walls), moment.grains
    expected, expected_vector = surface.surface_table(
        moment.rows, grains, moment.force_box.volume, moment.chosen, bins, angle, axis, walls
    )
    edges = np.arange(bins + 1) * 0.5 * np.pi / bins
    edges[[0, -1]] = -1.0, 4.0  # folded: nothing leaves there
    index = surface.named_axis(grains.shape[np.flatnonzero(moment.chosen)[0]], axis) if moment.chosen.any() else 2
    psi = [
        surface.psi_of(p, grains.shape[i], grains.quaternion[i], index, angle) for _, i, p in surface.ends(rows, grains)
    ]
    steady = steady_bins(psi, edges, doubt)
    yield compare("surface psi", found[:, 0], expected[:, 0])
    yield compare("surface area", found[:, 1], expected[:, 1])
    yield compare("surface contacts", found[steady, 2], expected[steady, 2], 1.0, doubt == 0.0)
    yield compare("surface all contacts", found[:, 2].sum(), expected[:, 2].sum(), 1.0, doubt == 0.0)
    yield from of_bins("surface", found, expected, {3: "rho", 4: "rho A", 9: "P_n"}, 2, steady, (3, 4, 9))
    yield from of_bins("surface", found, expected, {10: "P_t"}, 2, steady, (10,), rubbing(rows))
    yield from of_bins(
        "surface", found, expected, {5: "F_n", 6: "F_t"}, 2, steady, (), SMALL * magnitude(expected[:, 5])
    )
    yield from of_bins("surface", found, expected, {7: "mobilisation", 8: "sliding"}, 2, steady, (), SMALL)
    sums, least = {
        13: "sum of F_n",
        14: "sum of F_t",
        15: "sum of mobilisation",
        16: "sum of sliding",
    }, SMALL * magnitude(expected[:, 13])
    yield from of_bins("surface", found, expected, sums, 2, steady, (13, 14, 15, 16), least)
    power = expected[:, 9] + expected[:, 10]
    # The total power is a difference where single contacts gain energy.
    blown_up = np.sum(np.abs(power)) / max(abs(power.sum()), TINY) if power.any() else 1.0
    for column, name in ((11, "inhomogeneity"), (12, "inhomogeneity, printed")):
        yield compare(
            f"surface {name}",
            found[steady, column],
            expected[steady, column],
            magnitude(expected[:, column]) * blown_up,
        )
    yield compare(
        "surface P, area, grains",
        vector / np.maximum(np.abs(expected_vector), TINY),
        expected_vector / np.maximum(np.abs(expected_vector), TINY),
        1.0,
    )


def of_direction(found, rows, plane=(0, 1), doubt=0.0):
    bins = len(found)
    expected = contacts.direction_table(rows, bins, plane)
    normals = contacts.in_plane(rows["normal"], plane)
    beta = np.arctan2(normals[:, 1], normals[:, 0])
    edges = np.arange(bins + 1) * 2.0 * np.pi / bins
    around = np.concatenate([beta % (2 * np.pi) + k * np.pi for k in (-2, -1, 0, 1, 2)])
    steady = steady_bins(around, edges, doubt)
    yield compare("direction beta", found[:, 0], expected[:, 0])
    yield compare("direction contacts", found[steady, 1], expected[steady, 1], 1.0, doubt == 0.0)
    yield from of_bins("direction", found, expected, {2: "density"}, 1, steady, (2,))
    forces = {3: "F_n", 4: "F_t", 5: "F_t signed"}
    yield from of_bins("direction", found, expected, forces, 1, steady, (), SMALL * magnitude(expected[:, 3]))
    sums = {6: "sum of F_n", 7: "sum of F_t", 8: "sum of F_t signed"}
    yield from of_bins("direction", found, expected, sums, 1, steady, (6, 7, 8), SMALL * magnitude(expected[:, 6]))


def of_grains(found, rows, grains, chosen):
    expected = contacts.grain_table(rows, grains, chosen)
    yield compare("grain contacts", found[:, :2], expected[:, :2], 1.0, True)
    yield compare("grain P_n", found[:, 2], expected[:, 2])
    yield compare("grain P_t", found[:, 3], expected[:, 3], max(magnitude(expected[:, 3]), rubbing(rows)))
    yield compare("grain mobilisation", found[:, 4], expected[:, 4], max(magnitude(expected[:, 4]), SMALL))
    yield compare("grain theta", found[:, 5], expected[:, 5], 1.0)
    yield compare("grain contacts with walls", found[:, 6], expected[:, 6], 1.0, True)
