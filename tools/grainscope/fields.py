"""Quantities in the cells of a grid at one step: reads the csv files of fix field/write, and the tables of fix ave/time
mode vector and of fix ave/spatial, whose rows are cells along one axis."""

from dataclasses import dataclass, replace
from pathlib import Path
import re

import numpy as np

from grainscope.errors import InputError, warn
from grainscope.tables import blocks, is_csv, lines_of, no_column, numbers, read_rows

COORDINATES = (("x", "y", "z"), ("r", "t", "a"))  # of a box, and of rings about an axis
ERROR = "_error"
# Columns that mean nothing where there is no grain, and are 0 in the files.
OF_GRAINS = re.compile(r"(v|w|T|Z|F|Q|S2|n|overlap)(_[a-z]+)?")


@dataclass
class Field:
    """One file: its columns by name, as arrays over the cells along z, y, x."""

    path: Path
    step: int
    time: float
    cells: tuple  # along x, y, z
    columns: dict
    along: str = ""  # the column that is the only coordinate, of a table

    @property
    def coordinates(self):
        """Names of the coordinates of the cells."""
        if self.along:
            return (self.along,)
        for names in COORDINATES:
            if all(name in self.columns for name in names):
                return names
        raise InputError(f"{self.path}: no columns x, y, z or r, t, a with the middles of the cells; {self.has}")

    @property
    def resolved(self):
        """Names of the coordinates along which there is more than one cell."""
        return [name for name, n in zip(self.coordinates, self.cells) if n > 1]

    @property
    def quantities(self):
        """Names of what is measured: neither coordinates, nor the size of cells, nor errors."""
        if self.along:
            return [name for name in list(self.columns)[1:] if name != self.along]
        errors = {name + ERROR for name in self.columns}
        return [name for name in self.columns if name not in errors | {*self.coordinates, "V"}]

    @property
    def has(self):
        """What there is, in words."""
        return f"it has {', '.join(self.columns)}"

    @property
    def size(self):
        return " x ".join(map(str, self.cells))

    def __getitem__(self, name):
        """A column without the axes along which there is one cell."""
        return np.squeeze(self.columns[name])

    def seen(self, name):
        """The same to be drawn: nan where it means nothing."""
        if self.along or "N" not in self.columns or not OF_GRAINS.fullmatch(name):
            return self[name]
        return np.where(self["N"] > 0, self[name], np.nan)

    def error(self, name):
        """The error of a column, or None."""
        return self[name + ERROR] if name + ERROR in self.columns else None

    def sliced(self, name, k):
        """The layer k of the cells along a coordinate, counted from 0."""
        place = self.coordinates.index(name)
        columns = {one: np.take(values, [k], axis=2 - place) for one, values in self.columns.items()}
        cells = tuple(1 if n == place else count for n, count in enumerate(self.cells))
        return replace(self, cells=cells, columns=columns)


def read_notes(path, lines):
    """Step, time and cells, from the lines that begin with '#'."""
    notes = dict(re.findall(r"^# *(step|time|cells) +(.*\S)", "\n".join(lines), re.M))
    missing = [f"'# {name}'" for name in ("step", "time", "cells") if name not in notes]
    if missing:
        raise InputError(f"{path}: no line {', '.join(missing)}; a csv file of fix field/write is needed")
    try:
        step, time, cells = int(notes["step"]), float(notes["time"]), tuple(map(int, notes["cells"].split()))
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None
    if len(cells) != 3 or min(cells) < 1:
        raise InputError(f"{path}: '# cells' must be three numbers of at least 1, got '{notes['cells']}'")
    return step, time, cells


def read_field(path):
    lines = lines_of(path)
    step, time, cells = read_notes(path, [line for line in lines if line.startswith("#")])
    table = [line.split(",") for line in lines if line.strip() and not line.startswith("#")]
    if not table:
        raise InputError(f"{path}: no line with the names of the columns")
    names, rows = [name.strip() for name in table[0]], table[1:]
    nx, ny, nz = cells
    if len(rows) != nx * ny * nz:
        raise InputError(f"{path}: {len(rows)} rows, but {nx} x {ny} x {nz} cells")
    values = numbers(path, rows, names).reshape(nz, ny, nx, len(names))
    return Field(Path(path), step, time, cells, {name: values[..., k] for k, name in enumerate(names)})


def read_tables(path, along=None):
    """The tables of fix ave/time mode vector or fix ave/spatial, over a column: their first one, or `along`."""
    names, _, rows = read_rows(path)
    along = along or names[0]
    if along not in names:
        raise no_column(path, along, names)
    if not "".join(rows[0][1:2]).isdigit():
        raise InputError(
            f"{path}: each table must have a line 'step rows' before it; a row for each step is for `plot`"
        )
    found = []
    for step, length, table in blocks(path, rows, lambda row: 1 + int(row[1])):
        if len(table) < length:
            warn(f"{path}: the table of step {step} is incomplete and left out")
        elif length > 1:
            values = numbers(path, table[1:], names)
            columns = {name: values[None, None, :, k] for k, name in enumerate(names)}
            found.append(Field(Path(path), step, np.nan, (length - 1, 1, 1), columns, along))
    if not found:
        raise InputError(f"{path}: no table is complete")
    return found


def read_all(paths, along):
    """The fields of all files, which are of one kind."""
    csv = [is_csv(path) for path in paths]
    if all(csv):
        if along:
            raise InputError(
                f"--against is for tables of fix ave/time, got '{along}' for {paths[0]} of fix field/write"
            )
        return [read_field(path) for path in paths]
    if any(csv):
        raise InputError(
            "all files must be of fix field/write, or none; "
            f"{paths[csv.index(True)]} is, {paths[csv.index(False)]} is not"
        )
    return [field for path in paths for field in read_tables(path, along)]


def read_fields(paths, along=None):
    """All fields in the order of their steps; of one grid, with the same columns. `along`: of tables, the column that
    they run over."""
    fields = sorted(read_all(paths, along), key=lambda field: field.step)
    first = fields[0]
    for field in fields[1:]:
        if not field.along and field.cells != first.cells:
            raise InputError(
                f"all files must have the same cells: {first.path}: {first.size}; {field.path}: {field.size}"
            )
        if list(field.columns) != list(first.columns):
            raise InputError(
                f"all files must have the same columns; {first.path}: {first.has}; {field.path}: {field.has}"
            )
    return fields


def components(field, prefix):
    """The columns <prefix>_<one or two coordinates>."""
    if field.along:
        return []
    axes = "".join(field.coordinates)
    return [name for name in field.columns if re.fullmatch(rf"{re.escape(prefix)}_[{axes}]{{1,2}}", name)]


def prefix_of(field, name):
    """What the components of a vector or a tensor have in common; None of other columns, and where a column is called
    so."""
    if field.along:
        return None
    found = re.fullmatch(rf"(.+)_[{''.join(field.coordinates)}]{{1,2}}", name)
    return found[1] if found and found[1] not in field.columns and len(components(field, found[1])) > 1 else None


def panels(field, words=None):
    """[(title, names of columns)] of what is asked for: columns, or vectors and tensors by what their components have
    in common. Without words all quantities."""
    if not words:
        titles = dict.fromkeys(prefix_of(field, name) or name for name in field.quantities)
        return panels(field, list(titles))
    found = []
    for word in words:
        names = [word] if word in field.columns else components(field, word)
        if not names:
            raise no_column(field.path, word, list(field.columns))
        found.append((word, names))
    return found
