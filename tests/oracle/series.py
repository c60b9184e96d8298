# SPDX-License-Identifier: GPL-2.0-or-later
"""What needs several moments, or the whole box: non-affine displacement, and layering."""
import numpy as np

from oracle.correlation import heights
from oracle.motion import fractions


def unflipped(before, now, strain, plane):
    """Edges of the box `now` with the driven tilt as if it had not been turned back since `before`; `strain`: what was
    sheared."""
    a, b = plane
    expected = before.edges[a, b] + strain * 0.5 * (before.edges[b, b] + now.edges[b, b])
    edges = now.edges.copy()
    edges[:, b] += round((expected - now.edges[a, b]) / now.edges[a, a]) * now.edges[:, a]
    return edges


def reduced(x, image, box, wrapping, edges):
    """Unwrapped positions in units of `edges`, from a point that the flow leaves where it is: the centre but for the
    tilts, with which the centre moves (and jumps where the box is turned back). Image flags count the edges of the box
    `wrapping` that grains were last wrapped into: that of the force evaluation, one step behind."""
    still = box.origin + 0.5 * np.diag(box.edges)
    return np.linalg.solve(edges, (x + image @ wrapping.edges.T - still).T).T


def modulo_images(step):
    """The host's image flags count modulo 1024."""
    return step - 1024.0 * np.round(step / 1024.0)


def displacements(calls, plane=(0, 1)):
    """Non-affine displacements d (grains x 3) after each of the calls (x, image, box, box of the force evaluation,
    strain), zero at the first."""
    d, found = np.zeros_like(calls[0][0]), []
    for k, (x, image, box, wrapping, strain) in enumerate(calls):
        if k:
            x0, image0, box0, wrapping0, strain0 = calls[k - 1]
            edges = unflipped(box0, box, strain - strain0, plane)
            before = reduced(x0, image0, box0, wrapping0, box0.edges)
            step = modulo_images(reduced(x, image, box, wrapping, edges) - before)
            d = d + step @ (0.5 * (box0.edges + edges)).T
        found.append(d)
    return found


def half_slope(strain, values):
    """Half the slope of the free-intercept least squares line."""
    about = strain - np.mean(strain)
    return 0.5 * (about @ values) / (about @ about) if np.any(about) else np.zeros(values.shape[1])


def displacement_vector(calls, plane=(0, 1)):
    """The 8 entries of compute displacement/shear after the last of the calls."""
    squares = np.array([np.mean(d**2, axis=0) for d in displacements(calls, plane)])
    strain = np.array([call[-1] for call in calls]) - calls[0][-1]
    return np.array([strain[-1], *squares[-1], *half_slope(strain, squares), len(calls[0][0])])


def layering(x, box, axis=1, layers=40):
    """(array (layers/2 + 1) x 2, vector of 4). L is the distance between the faces that cut the axis, so that V/L is
    their area."""
    length, grains = heights(box)[axis], len(x)
    array = np.zeros((layers // 2 + 1, 2))
    array[:, 0] = np.arange(layers // 2 + 1) * length / layers
    if not grains:
        return array, np.zeros(4)
    s = fractions(x, box)[:, axis]
    where = np.minimum(((s - np.floor(s)) * layers).astype(int), layers - 1)
    mean = grains / box.volume
    excess = np.bincount(where, minlength=layers) * layers / box.volume - mean
    for j in range(layers // 2 + 1):
        array[j, 1] = box.volume / length / (mean * layers) * (excess @ np.roll(excess, -j))
    peak = 1 + int(np.argmax(array[1:, 1]))
    return array, np.array([array[peak, 1], array[peak, 0], array[0, 1], grains])
