# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run wrote, as numpy arrays: grains, box, and the rows of compute contact/local. Written from the definitions
in doc/, sharing no code with src/."""
from dataclasses import dataclass

import numpy as np

from grainscope.columns import outputs

ROW_COLUMNS = {
    "id": 2,
    "image": 3,
    "point": 3,
    "normal": 3,
    "branch": 3,
    "overlap": 1,
    "force": 3,
    "fn": 1,
    "fn_damping": 1,
    "ft": 3,
    "un": 1,
    "ut": 3,
    "sliding": 1,
    "slip": 1,
    "mobilisation": 1,
}
ROW_WIDTH = sum(ROW_COLUMNS.values())


@dataclass
class Box:
    edges: np.ndarray  # edge vectors in columns
    origin: np.ndarray
    rate: np.ndarray  # dH/dt

    @property
    def volume(self):
        return float(np.linalg.det(self.edges))

    @property
    def gradient(self):
        return self.rate @ np.linalg.inv(self.edges)

    @property
    def centre(self):
        """Where the affine flow is zero: the middle of the edges, which tilts do not move."""
        return self.origin + 0.5 * np.diag(self.edges)


def box_of(table, row, shear_rate=0.0, length_rate=0.0):
    """From the thermo columns of deck.box_columns(); the box shears in xy at `shear_rate`, and L_y grows at
    `length_rate`."""
    value = {name: float(table[name][row]) for name in ("lx", "ly", "lz", "xy", "xz", "yz", "xlo", "ylo", "zlo")}
    edges = np.array(
        [[value["lx"], value["xy"], value["xz"]], [0.0, value["ly"], value["yz"]], [0.0, 0.0, value["lz"]]]
    )
    rate = np.zeros((3, 3))
    rate[0, 1] = shear_rate * value["ly"]
    rate[1, 1] = length_rate
    return Box(edges, np.array([value["xlo"], value["ylo"], value["zlo"]]), rate)


@dataclass
class Grains:
    ids: np.ndarray
    types: np.ndarray
    x: np.ndarray
    v: np.ndarray
    omega: np.ndarray
    force: np.ndarray
    torque: np.ndarray
    mass: np.ndarray
    radius: np.ndarray
    shape: np.ndarray = None
    quaternion: np.ndarray = None

    def index(self, ids):
        return np.searchsorted(self.ids, np.asarray(ids, dtype=int))


def _vectors(columns, *names):
    return np.stack([columns[n] for n in names], axis=1)


def grains_of(columns):
    grains = Grains(
        columns["id"].astype(int),
        columns["type"].astype(int),
        _vectors(columns, "x", "y", "z"),
        _vectors(columns, "vx", "vy", "vz"),
        _vectors(columns, "omegax", "omegay", "omegaz"),
        _vectors(columns, "fx", "fy", "fz"),
        _vectors(columns, "tqx", "tqy", "tqz"),
        columns["mass"],
        columns["radius"],
    )
    if "shapex" in columns:
        grains.shape = _vectors(columns, "shapex", "shapey", "shapez")
        grains.quaternion = _vectors(columns, "quat1", "quat2", "quat3", "quat4")
    return grains


def rows_of(columns, compute):
    """A dump of the usual columns of compute contact/local, by name; one-number columns as vectors. id_j is 0 for a
    wall."""
    table = np.stack([columns[word] for word in outputs("contact/local").of(compute).all("local")[:ROW_WIDTH]], axis=1)
    rows, first = {}, 0
    for name, width in ROW_COLUMNS.items():
        rows[name] = table[:, first] if width == 1 else table[:, first : first + width]
        first += width
    order = np.lexsort((*rows["image"].T, rows["id"][:, 1], rows["id"][:, 0]))
    return {name: values[order] for name, values in rows.items()}


def chosen_rows(rows, walls):
    """The rows that the keyword `walls` chooses: no, yes or only."""
    with_wall = rows["id"][:, 1] == 0
    kept = {"no": ~with_wall, "yes": np.ones(len(with_wall), dtype=bool), "only": with_wall}[walls]
    return {name: values[kept] for name, values in rows.items()}
