"""Reads what examples/simple_shear writes: series.txt, parameters.txt, grains.dump, and the files of `measure all`.
Used by the other tools of this folder."""

from dataclasses import dataclass, field
from pathlib import Path
import re

import numpy as np


class InputError(Exception):
    """A file that is missing or is not what it should be; the message says which and why."""


class Columns(dict):
    """Columns of a file, by name."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, column):
        raise InputError(f"{self.path}: no column '{column}'; it has {', '.join(self)}")


@dataclass
class Run:
    """One run: its name, its parameters by name, its columns by name (arrays over rows) and their units."""

    name: str
    parameters: dict
    columns: dict
    units: dict
    folder: Path = field(default_factory=Path)

    def __getitem__(self, column):
        return self.columns[column]

    @property
    def measured_all(self):
        """Whether the run has steady means of `-var measure all`; files that an earlier run left in its folder do not
        count."""
        try:
            steps = read_table(self.folder, "micro.txt")[0]["step"]
        except InputError:
            return False
        return steps[-1] in self["step"]

    @property
    def injected(self):
        """Power that shear and box motion put in, over W0."""
        return self["W_shear"] + self["W_box"]

    @property
    def dissipated(self):
        """Power lost to normal damping and friction, over W0."""
        return self["W_n"] + self["W_t"]

    def steady(self, start=None):
        """Mask of the rows of the steady state, from strain `start`. Default: 6 (4 below I = 0.01), at most half the
        run."""
        strain = self["strain"]
        if start is None:
            start = min(6.0 if self.parameters["I"] >= 0.01 else 4.0, 0.5 * strain[-1])
        rows = strain > start + 1e-3
        if rows.sum() < 16:
            raise InputError(
                f"{self.name}: {rows.sum()} rows beyond strain {start:g}, at least 16 are needed; "
                f"the run ends at {strain[-1]:g}"
            )
        return rows


def read_rows(path):
    """Names of the columns and their units, as the last '#' line gives them in the form name[unit], and the rows as
    lists of words."""
    try:
        lines = Path(path).read_text().splitlines()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    header = [line for line in lines if line.startswith("#")]
    rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    if not header or not rows:
        raise InputError(f"{path}: a '#' line with the names of the columns and at least one row are needed")
    names, units = [], {}
    for word in header[-1].lstrip("# ").split():
        name, unit = re.fullmatch(r"([^\[\]]+)(?:\[(.*)\])?", word).groups()
        names.append(name)
        units[name] = unit or ""
    return names, units, rows


def numbers(path, rows, names):
    """The rows as an array of floats, one column per name."""
    for number, row in enumerate(rows, 1):
        if len(row) != len(names):
            raise InputError(f"{path}: row {number} has {len(row)} values, the header names {len(names)} columns")
    try:
        return np.array(rows, dtype=float)
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None


def read_parameters(folder):
    """Columns of parameters.txt: one row for each attempt at the run."""
    path = Path(folder) / "parameters.txt"
    names, _, rows = read_rows(path)
    return Columns(path, zip(names, numbers(path, rows, names).T))


def attempts(folder):
    """Of each attempt at the run: the folder of its tables, the step at which it began, and the step up to which its
    rows count, since a later attempt began there. A run that was never taken up again has one."""
    begins = read_parameters(folder)["from"].astype(int)
    for number, begin in enumerate(begins):
        yield Path(folder) / (f"from_{begin}" if begin else ""), begin, min(begins[number + 1 :], default=np.inf)


def joined(folder, name, length_of):
    """A file of the run's tables: names and units of its columns, and of all its attempts the tables that count, as
    lists of rows; a table begins with a row whose first word is the step, and length_of tells of this row how many rows
    the table has."""
    found, names, units, missing = [], [], {}, None
    for part, begin, end in attempts(folder):
        try:
            names, units, rows = read_rows(part / name)
        except InputError as error:
            missing = error
            continue
        place = 0
        while place < len(rows):
            try:
                step = int(rows[place][0])
                if step > end:
                    break
                length = length_of(rows[place])
            except (IndexError, ValueError):
                raise InputError(
                    f"{part / name}: row {place + 1} must begin with a step, got '{' '.join(rows[place])}'"
                ) from None
            if place + length > len(rows):
                raise InputError(f"{part / name}: the table of step {step} is incomplete, {length - 1} rows are needed")
            if step > begin or begin == 0:
                found.append(rows[place : place + length])
            place += length
    if not found:
        raise missing or InputError(f"{Path(folder) / name}: none of its rows belongs to the run")
    return names, units, found


def read_table(folder, name):
    """Columns and units of a file of the run with one row per step, whose last '#' line names its columns as
    name[unit]."""
    path = Path(folder) / name
    names, units, rows = joined(folder, name, lambda row: 1)
    return Columns(path, zip(names, numbers(path, [row for row, in rows], names).T)), units


def read_blocks(folder, name):
    """Columns of a file of the run with tables, each introduced by a line `step rows`, as arrays (tables, rows)."""
    path = Path(folder) / name
    names, _, tables = joined(folder, name, lambda row: 1 + int(row[1]))
    values = numbers(path, [row for table in tables for row in table[1:]], names)
    return Columns(path, zip(names, values.reshape(len(tables), -1, len(names)).transpose(2, 0, 1)))


def read_run(folder):
    """The run whose output is in `folder`."""
    folder = Path(folder)
    columns, units = read_table(folder, "series.txt")
    parameters = read_parameters(folder)
    last = Columns(parameters.path, ((name, values[-1]) for name, values in parameters.items()))
    return Run(folder.resolve().name, last, columns, units, folder)


def mean_and_error(values):
    """Mean and its standard error by blocking: blocks of 1, 2, 4 ... rows, at least 8 of them where there are so many
    rows; the largest error counts. One row has no error: 0."""
    error, blocks = 0.0, np.asarray(values)
    while len(blocks) >= min(8, max(2, len(values))):
        error = max(error, blocks.std(ddof=1) / np.sqrt(len(blocks)))
        blocks = blocks[: len(blocks) // 2 * 2].reshape(-1, 2).mean(axis=1)
    return np.mean(values), error


@dataclass
class Grains:
    """A dump: positions (N,3), rotation matrices (N,3,3) from the body to the laboratory, semi-axes (N,3); box origin
    and edge vectors (rows of a 3x3 matrix)."""

    positions: np.ndarray
    rotations: np.ndarray
    semi_axes: np.ndarray
    origin: np.ndarray
    edges: np.ndarray


def rotation_matrices(quaternions):
    """Rotation matrices (N,3,3) of unit quaternions (N,4), scalar part first."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)


def read_grains(path):
    """The last snapshot of a text dump with columns id x y z quat1-4 shapex-z, of spheres x y z radius, in a triclinic
    or orthogonal box."""
    try:
        text = Path(path).read_text()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    snapshot = text.rpartition("ITEM: TIMESTEP")[2]
    match = re.search(r"ITEM: BOX BOUNDS([^\n]*)\n((?:[^\n]*\n){3})ITEM: ATOMS ([^\n]*)\n(.*)", snapshot, re.S)
    if not match:
        raise InputError(f"{path}: not a LIGGGHTS text dump")
    names = match[3].split()
    spheres = "radius" in names
    wanted = ("x y z radius" if spheres else "x y z quat1 quat2 quat3 quat4 shapex shapey shapez").split()
    missing = [name for name in wanted if name not in names]
    if missing:
        raise InputError(f"{path}: no column {', '.join(missing)}; the dump must hold {' '.join(wanted)}")
    try:
        bounds = np.array([line.split() for line in match[2].splitlines()], dtype=float)
        table = np.array(match[4].split(), dtype=float).reshape(-1, len(names))
    except ValueError:
        raise InputError(f"{path}: the last snapshot is damaged or incomplete") from None
    if len(table) == 0:
        raise InputError(f"{path}: the last snapshot holds no grains")
    columns = table[:, [names.index(name) for name in wanted]]

    xy, xz, yz = bounds[:, 2] if bounds.shape[1] == 3 else (0.0, 0.0, 0.0)
    low, high = bounds[:, 0].copy(), bounds[:, 1].copy()
    low[:2] -= min(0.0, xy, xz, xy + xz), min(0.0, yz)
    high[:2] -= max(0.0, xy, xz, xy + xz), max(0.0, yz)
    lx, ly, lz = high - low
    edges = np.array([[lx, 0.0, 0.0], [xy, ly, 0.0], [xz, yz, lz]])
    if spheres:
        rotations, semi_axes = np.tile(np.eye(3), (len(columns), 1, 1)), np.repeat(columns[:, 3:], 3, axis=1)
    else:
        rotations, semi_axes = rotation_matrices(columns[:, 3:7]), columns[:, 7:]
    return Grains(columns[:, :3], rotations, semi_axes, low, edges)
