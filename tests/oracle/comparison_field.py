# SPDX-License-Identifier: GPL-2.0-or-later
"""A compute field, the grid that the oracle takes for it, and the two compared, each column with the scale of its
rounding errors."""
from dataclasses import dataclass

import numpy as np

from case import require_close, require_equal
from oracle import field as oracle
from oracle.field_grid import Grid
from watch import Watched

OF_GRAINS = ("density", "phi", "momentum", "velocity", "spin", "temperature", "stress_kinetic")
OF_CONTACTS = (
    *oracle.OF_BRANCHES,
    "traction",
    "contacts",
    "coordination",
    "fabric",
    "P_n",
    "P_t",
    "overlap",
)
# Sums of some hundred terms in another order.
EXACT = 1e-11
TOTALS = ("N_total", "M_total", "V_total", "N_outside")
DEGENERATE = 1e-3


def words_of(grid):
    """The keywords that make this grid."""
    yield "grid " + " ".join(map(str, grid.cells))
    for axis, bound in zip("xyz", grid.bounds):
        if bound is not None:
            yield f"{axis} {bound[0]!r} {bound[1]!r}"
    if grid.about:
        yield "about " + " ".join(map(str, grid.about)) + f" r {grid.ring[0]!r} {grid.ring[1]!r}"
    elif grid.frame != ("lab" if any(grid.bounds) else "box"):
        yield f"frame {grid.frame}"
    if grid.kernel != "cell":
        yield f"kernel {grid.kernel} width {grid.width!r}"


@dataclass(frozen=True)
class Asked:
    """`types`: a pair, None for any; `wall_type` is that of all walls."""

    name: str
    grid: Grid
    quantities: tuple = (*OF_GRAINS, *OF_CONTACTS)
    walls: str = "yes"
    types: tuple = ()
    wall_type: int = 1
    points: int = 200
    quadrature: float = EXACT  # of the stresses of smooth kernels

    @property
    def command(self):
        words = ["field", *words_of(self.grid), "quantities " + " ".join(self.quantities)]
        words += [f"walls {self.walls}"]
        if self.types:
            words.append("types " + " ".join("*" if t is None else str(t) for t in self.types))
        return " ".join(words)

    @property
    def names(self):
        return oracle.names_of(self.quantities)

    @property
    def watched(self):
        return Watched(self.name, self.command, True, len(TOTALS), (self.grid.number, len(self.names)))

    def of_types(self, rows, grains):
        if not self.types or rows is None:
            return rows
        at_wall = rows["id"][:, 1] == 0
        one = grains.types[grains.index(rows["id"][:, 0])]
        other = np.where(at_wall, self.wall_type, grains.types[np.minimum(grains.index(rows["id"][:, 1]), len(one))])
        (a, b), fits = self.types, np.zeros(len(one), bool)
        for i, j in ((one, other), (other, one)):
            fits |= ((a is None) | (i == a)) & ((b is None) | (j == b))
        return {name: values[fits] for name, values in rows.items()}

    def expected(self, moment, **choices):
        rows = self.of_types(moment.rows, moment.grains)
        branches = any(q in self.quantities for q in oracle.OF_BRANCHES)
        choices = {"points": self.points, "branches": branches, **choices}
        placed = self.grid, rows, moment.grains, moment.force_box, moment.chosen
        return oracle.field(*placed, self.walls, **choices)

    def found(self, moment):
        return dict(zip(self.names, moment.array(self.watched).T))


def block(table, quantity):
    return np.stack([table[name] for name in oracle.QUANTITIES[quantity]], axis=1)


def largest(values, least=0.0):
    return max(float(np.abs(values).max()), least) if np.size(values) else least


def scale_of(quantity, expected, grains):
    """Of what cancels, what it is made of."""
    speed = largest(np.linalg.norm(grains.v, axis=1)) if len(grains.v) else 0.0
    if quantity in oracle.OF_BRANCHES:
        return largest([expected[n] for q in oracle.OF_BRANCHES for n in oracle.QUANTITIES[q]])
    if quantity in ("P_n", "P_t"):
        return largest([expected["P_n"], expected["P_t"]])
    made_of = {
        "velocity": speed,
        "momentum": speed * largest(expected["rho"]),
        "temperature": speed**2,
        "stress_kinetic": speed**2 * largest(expected["rho"]),
        "spin": largest(grains.omega),
        "fabric": 1.0,
        "Q": 1.0,
        "S2": 1.0,
        "director": 1.0,
    }
    return made_of.get(quantity) or largest(block(expected, quantity))


def sure_directors(expected):
    """Cells whose largest eigenvalue is alone, and whose director has a largest component that is alone."""
    sure = []
    for q, n in zip(block(expected, "Q"), block(expected, "director")):
        tensor = np.array([[q[0], q[3], q[4]], [q[3], q[1], q[5]], [q[4], q[5], q[2]]])
        values, parts = np.linalg.eigvalsh(tensor), np.sort(np.abs(n))
        sure.append(not n.any() or (values[2] - values[1] > DEGENERATE and parts[2] - parts[1] > DEGENERATE))
    return np.array(sure)


def differences(asked, moment, expected):
    """(quantity, found, expected, tolerance, scale) of all columns."""
    found = asked.found(moment)
    size = max(largest(moment.force_box.origin), largest(moment.force_box.edges))
    for name in oracle.ALWAYS:
        scale = size if name in "xyz" else largest(expected[name], 1e-300)
        exact = name == "N" and asked.grid.kernel == "cell"
        yield name, found[name], expected[name], 0.0 if exact else EXACT, scale
    for quantity in oracle.QUANTITIES:
        if quantity not in asked.quantities:
            continue
        one, other = block(found, quantity), block(expected, quantity)
        tolerance = EXACT
        if quantity in oracle.OF_BRANCHES and asked.grid.kernel != "cell":
            tolerance = asked.quadrature
        if quantity == "contacts" and asked.grid.kernel == "cell":
            tolerance = 0.0
        if quantity == "director":
            sure, tolerance = sure_directors(expected), EXACT / DEGENERATE
            one, other = one[sure], other[sure]
        yield quantity, one, other, tolerance, scale_of(quantity, expected, moment.grains) or 1.0


def require_agreement(asked, moment):
    table = asked.expected(moment)
    for what, found, expected, tolerance, scale in differences(asked, moment, table):
        require_close(found, expected, tolerance, f"{asked.name}, step {moment.step}, {what}", scale)
    placed_totals = oracle.totals(asked.grid, moment.grains, moment.force_box, moment.chosen)
    vector = moment.vector(asked.watched)
    for name, one, other in zip(TOTALS, vector, placed_totals):
        if asked.grid.kernel == "cell" or name == "V_total":
            require_close(one, other, EXACT, f"{asked.name}, step {moment.step}, {name}", max(abs(other), 1.0))
    if asked.grid.kernel == "cell":
        require_equal(moment.scalar(asked.watched), oracle.cells_with_grains(table), f"{asked.name}: cells with one")
