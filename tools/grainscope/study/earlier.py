"""Runs of a study that ended before, perhaps on another machine: `earlier` in its configuration names a data set that
`study export` wrote. They are not made again; tables and data sets take their rows, curves and provenance from there.
"""
import csv
import json
from pathlib import Path

from grainscope.errors import InputError
from grainscope.program import TOP
from grainscope.shear.quantities import CURVES, MEASURED

SAME = ("alpha", "mu", "I", "N", "seed", "e", "strain", "steady")


class Earlier:
    """`planned`: the values of each planned run by its name, as words; `rows`: those of the data set's table.csv that
    are planned, by name."""

    def __init__(self, folder=None, planned=()):
        self.folder = folder and Path(folder)
        self.rows = {}
        if folder:
            rows = {row.get("run"): row for row in self._read("table.csv") if row.get("state") == "ended"}
            self.rows = {name: row for name, row in rows.items() if name in planned}
            for name, row in self.rows.items():
                self._check(row, planned[name])

    def _read(self, name):
        path = self.folder / name
        try:
            with path.open(newline="") as file:
                return list(csv.DictReader(file))
        except (OSError, ValueError) as error:
            raise InputError(f"earlier: {path}: {getattr(error, 'strerror', error)}") from None

    def _check(self, row, values):
        where = f"earlier: {self.folder / 'table.csv'}: {row['run']}"
        again = "remove the row, and the run is made again"
        for name in SAME:
            try:
                same = float(row.get(name)) == float(values[name])
            except (TypeError, ValueError):
                same = False
            if not same:
                found = row.get(name) or "missing"
                raise InputError(f"{where}: {name} must be {values[name]} as in the study, is {found}; {again}")
        if values.get("measure") == "all" and not any(row.get(name) for name in MEASURED):
            raise InputError(f"{where}: must have been run with measure all, was with basic; {again}")

    def without(self, names):
        """The same without these runs."""
        other = Earlier()
        other.folder = self.folder
        other.rows = {name: row for name, row in self.rows.items() if name not in names}
        return other

    def cost(self, run):
        """Steps and wall time of a planned run."""
        row = self.rows[run.name]
        core_time = row.get("core_time")
        return (int(float(row["steps"])), float(core_time) / run.ranks) if core_time else (0, 0.0)

    def curve_rows(self, curve):
        """Lines of a file of curves/."""
        name = f"curves/{curve}.csv"
        rows = [row for row in self._read(name) if row.get("run") in self.rows] if self.rows else []
        try:
            return [[row["run"], *(row[column] for column in CURVES[curve])] for row in rows]
        except KeyError as column:
            raise InputError(
                f"earlier: {self.folder / name}: must have a column {column}, has {', '.join(rows[0])}"
            ) from None

    def provenance(self):
        """What provenance.json says."""
        path = self.folder / "provenance.json"
        try:
            return json.loads(path.read_text())
        except (OSError, ValueError) as error:
            raise InputError(f"earlier: {path}: {getattr(error, 'strerror', error)}") from None


def earlier_of(config, runs):
    """The Earlier of a configuration and its planned runs; `earlier` is a path from the top of the source tree, or an
    absolute one."""
    folder = config.get("earlier")
    return Earlier(TOP / folder if folder else None, {run.name: run.variables for run in runs})
