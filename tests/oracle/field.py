# SPDX-License-Identifier: GPL-2.0-or-later
"""compute field by brute force: every point against every cell and every image. Branches are clipped against each cell
by half spaces, or sampled; smooth kernels take a dense quadrature; temperature takes lstsq.

What is left open by the definitions is read so:
- positions, forces and grid belong to the box that the force evaluation saw, as for regions;
- a smooth weight is phi times the measure of a cell in the resolved axes, so that weights add up to about 1; along an
  axis with one cell a point counts when it lies between the bounds;
- G_k fits v(k') = a + G c(k') over the means of the cell and its neighbours, over corners too, that hold mass, with
  weights M(k'), a free, the least G where it is not determined; G has no part along the edges of axes with one cell.
  (Without the corners four means determine G in three axes, and T of a few grains becomes 10^4 times v^2.)
- a grid of the laboratory has no neighbours across a face of the box whose edge is tilted;
- rings fit v_r, v_t, v_a against r and the axis;
- mean n n and mean overlap are over contacts with grains and walls together."""
import math

import numpy as np

from oracle.field_grid import AXES
from oracle.measures import SIX, axis_of, rotation
from oracle.state import chosen_rows
from oracle.surface import powers

NINE = [a + b for a in AXES for b in AXES]
SYMMETRIC = [AXES[a] + AXES[b] for a, b in SIX]
ALWAYS = ("x", "y", "z", "V", "N")
QUANTITIES = {
    "density": ("rho",),
    "phi": ("phi",),
    "momentum": tuple(f"p_{a}" for a in AXES),
    "velocity": tuple(f"v_{a}" for a in AXES),
    "spin": tuple(f"w_{a}" for a in AXES),
    "temperature": (*(f"T_{a}" for a in AXES), "T"),
    "stress": tuple(f"s_{ab}" for ab in NINE),
    "stress_normal": tuple(f"sn_{ab}" for ab in NINE),
    "stress_tangential": tuple(f"st_{ab}" for ab in NINE),
    "stress_kinetic": tuple(f"sk_{ab}" for ab in SYMMETRIC),
    "traction": tuple(f"t_{a}" for a in AXES),
    "contacts": ("N_c", "N_w"),
    "coordination": ("Z",),
    "fabric": tuple(f"F_{ab}" for ab in SYMMETRIC),
    "P_n": ("P_n",),
    "P_t": ("P_t", "P_t_damp"),
    "overlap": ("overlap",),
    "Q": tuple(f"Q_{ab}" for ab in SYMMETRIC),
    "S2": ("S2",),
    "director": tuple(f"n_{a}" for a in AXES),
}
OF_AXES = ("Q", "S2", "director")
OF_BRANCHES = ("stress", "stress_normal", "stress_tangential")


def names_of(quantities):
    """Columns in the order of the definitions, whatever the order of the question."""
    return [*ALWAYS, *(name for q, names in QUANTITIES.items() if q in quantities for name in names)]


def over(sums, below):
    """Ratios; 0 where nothing is below."""
    below = np.asarray(below, dtype=float)
    below = below.reshape(below.shape + (1,) * (np.ndim(sums) - below.ndim))
    return np.divide(sums, below, out=np.zeros(np.broadcast(sums, below).shape), where=below > 0.0)


def volumes_of(grains, dimension):
    if dimension == 2:
        return math.pi * grains.radius**2
    if grains.shape is None:
        return 4.0 / 3.0 * math.pi * grains.radius**3
    return 4.0 / 3.0 * math.pi * grains.shape.prod(axis=1)


def axes_of(grains):
    """Unit axes of symmetry, and which grains have one."""
    found, has = np.zeros((len(grains.ids), 3)), np.zeros(len(grains.ids), bool)
    if grains.shape is not None:
        for k, (shape, q) in enumerate(zip(grains.shape, grains.quaternion)):
            index, _ = axis_of(shape)
            if index is not None:
                found[k], has[k] = rotation(q)[:, index], True
    return found, has


class Sums:
    """Sums per cell of what is at points."""

    def __init__(self, placed, x):
        self.placed = placed
        self.point, self.shift, self.cell, self.weight, self.at = placed.entries(x)

    def add(self, values):
        """values: of each entry."""
        values = np.asarray(values, dtype=float)
        total = np.zeros((self.placed.grid.number, *values.shape[1:]))
        np.add.at(total, self.cell, self.weight.reshape(-1, *(1,) * (values.ndim - 1)) * values)
        return total

    def count(self):
        return self.add(np.ones(len(self.point)))

    def of(self, values):
        return self.add(np.asarray(values)[self.point])

    def vectors(self, values):
        return self.add(self.placed.turned(np.asarray(values)[self.point], self.at))


def put(table, names, values):
    for name, column in zip(names, np.asarray(values).reshape(len(values), -1).T):
        table[name] = column


def six_of(tensors):
    return np.stack([tensors[:, a, b] for a, b in SIX], axis=1)


def of_grains(table, placed, grains, chosen):
    """Density to temperature, kinetic stress; returns the sums, for others' ratios."""
    box, grid = placed.box, placed.grid
    sums = Sums(placed, grains.x[chosen])
    m = grains.mass[chosen][sums.point]
    v = placed.turned(grains.v[chosen][sums.point] + sums.shift @ box.rate.T, sums.at)
    x = placed.coordinates(sums.at)
    count, mass, p = sums.count(), sums.add(m), sums.add(m[:, None] * v)
    volume = placed.volumes()
    table["N"] = count
    put(table, QUANTITIES["density"], over(mass, volume)[:, None])
    put(table, QUANTITIES["phi"], over(sums.of(volumes_of(grains, grid.dimension)[chosen]), volume)[:, None])
    put(table, QUANTITIES["momentum"], over(p, volume))
    mean, centroid = over(p, mass), over(sums.add(m[:, None] * x), mass)
    put(table, QUANTITIES["velocity"], mean)
    put(table, QUANTITIES["spin"], over(sums.vectors(grains.omega[chosen]), count))
    gradient = placed.gradients(mass, mean, centroid)
    dv = v - mean[sums.cell] - np.einsum("iab,ib->ia", gradient[sums.cell], x - centroid[sums.cell])
    tensor = sums.add(m[:, None, None] * dv[:, :, None] * dv[:, None, :])
    diagonal = over(np.einsum("kaa->ka", tensor), mass)
    put(table, QUANTITIES["temperature"], np.column_stack([diagonal, diagonal[:, : grid.dimension].mean(axis=1)]))
    put(table, QUANTITIES["stress_kinetic"], over(-six_of(tensor), volume))
    return sums


def of_axes(table, sums, grains, chosen):
    axes, has = (one[chosen] for one in axes_of(grains))
    p = sums.placed.turned(axes[sums.point], sums.at)
    with_axis = sums.add(has[sums.point].astype(float))
    q = over(sums.add(p[:, :, None] * p[:, None, :]), with_axis) - np.eye(3) / 3.0
    q[with_axis == 0.0] = 0.0
    values, vectors = np.linalg.eigh(q)
    director = vectors[:, :, 2]
    largest = np.take_along_axis(director, np.abs(director).argmax(axis=1)[:, None], axis=1)
    put(table, QUANTITIES["Q"], six_of(q))
    put(table, QUANTITIES["S2"], 1.5 * values[:, 2:])
    put(table, QUANTITIES["director"], np.where((with_axis > 0.0)[:, None], director * np.sign(largest), 0.0))


def of_contact_points(table, placed, rows, ends, count):
    volume = placed.volumes()
    sums, at_wall = Sums(placed, rows["point"]), rows["id"][:, 1] == 0
    n = placed.turned(rows["normal"][sums.point], sums.at)
    contacts, normal_friction = sums.count(), powers(rows)
    put(table, QUANTITIES["contacts"], np.column_stack([sums.of(~at_wall), sums.of(at_wall)]))
    put(table, QUANTITIES["fabric"], over(six_of(sums.add(n[:, :, None] * n[:, None, :])), contacts))
    for name, power in zip(("P_n", "P_t"), normal_friction):
        put(table, (name,), over(sums.of(power), volume)[:, None])
    put(table, ("P_t_damp",), np.zeros((len(volume), 1)))  # of decks without tangential damping
    put(table, QUANTITIES["overlap"], over(sums.of(rows["overlap"]), contacts)[:, None])
    put(table, QUANTITIES["traction"], over(sums.vectors(rows["force"] * at_wall[:, None]), volume))
    put(table, QUANTITIES["coordination"], over(Sums(placed, ends).count(), count)[:, None])


def of_branches(table, placed, rows, grains, points, sampled):
    end = grains.x[grains.index(rows["id"][:, 0])]
    normal = rows["fn"][:, None] * rows["normal"]
    parts = (rows["force"], normal, rows["force"] - normal)
    found = placed.dyads(end - rows["branch"], end, parts, points, sampled)
    for quantity, tensor in zip(OF_BRANCHES, found):
        put(table, QUANTITIES[quantity], -tensor.reshape(len(tensor), 9) / placed.volumes()[:, None])


def ends_of(rows, grains):
    """Positions of the grains of each contact."""
    at_wall = rows["id"][:, 1] == 0
    one, other = grains.index(rows["id"][:, 0]), grains.index(rows["id"][~at_wall, 1])
    return grains.x[np.concatenate([one, other])]


def field(grid, rows, grains, box, chosen, walls="yes", points=200, sampled=0, branches=True):
    """{column: values of the cells}; `rows` are the group's, `box` that of the force evaluation. Without `branches`,
    which take long, no stresses of contacts."""
    placed, table = grid.in_box(box), {}
    put(table, ("x", "y", "z"), placed.middles())
    table["V"] = placed.volumes()
    sums = of_grains(table, placed, grains, chosen)
    of_axes(table, sums, grains, chosen)
    if rows is not None:
        rows = chosen_rows(rows, walls)
        of_contact_points(table, placed, rows, ends_of(rows, grains), table["N"])
        if branches:
            of_branches(table, placed, rows, grains, points, sampled)
    return table


def totals(grid, grains, box, chosen):
    """N_total, M_total, V_total (of the cells), N_outside."""
    placed = grid.in_box(box)
    sums = Sums(placed, grains.x[chosen])
    outside = int(np.sum(chosen)) - len(set(sums.point.tolist()))
    return np.array([sums.count().sum(), sums.of(grains.mass[chosen]).sum(), placed.volumes().sum(), outside])


def cells_with_grains(table):
    return int(np.sum(table["N"] > 0.0))
