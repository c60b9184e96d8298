"""Reads what examples/simple_shear writes: series.txt, parameters.txt, and the files of `measure all`."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from grainscope.errors import InputError
from grainscope.tables import Columns, blocks, numbers, read_rows


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
        for step, length, table in blocks(part / name, rows, length_of, end):
            if len(table) < length:
                raise InputError(f"{part / name}: the table of step {step} is incomplete, {length - 1} rows are needed")
            if step > begin or begin == 0:
                found.append(table)
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


def add_run_arguments(parser):
    """What every command about finished runs takes."""
    parser.add_argument("run", nargs="+", help="output folder of a run (it holds series.txt and parameters.txt)")
    parser.add_argument(
        "--from",
        dest="start",
        type=float,
        metavar="STRAIN",
        help="where the steady state starts (default: 6, or 4 below I = 0.01, at most half the run)",
    )
