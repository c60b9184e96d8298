"""The slices of time that a study was given: slices.csv, a row for each."""

import csv
from datetime import datetime, timezone
from pathlib import Path

from grainscope.errors import InputError

NAMES = ["begin", "end", "hours", "jobs"]  # begin and end in UTC, hours as allowed


def now():
    return datetime.now(timezone.utc).replace(microsecond=0)


def read_slices(output):
    """Dictionaries of NAMES; the end of a slice that runs, or was killed, is empty."""
    path = Path(output) / "slices.csv"
    if not path.exists():
        return []
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        try:
            row["begin"] = datetime.fromisoformat(row["begin"])
            row["end"] = datetime.fromisoformat(row["end"]) if row["end"] else None
        except (KeyError, TypeError, ValueError):
            raise InputError(f"{path}: must be a table of {', '.join(NAMES)}, got {row}") from None
    return rows


class Slice:
    """Writes its row at its begin, and again with its end."""

    def __init__(self, output, hours, jobs):
        self.path = Path(output) / "slices.csv"
        self.row = [now().isoformat(), "", f"{hours:g}", str(jobs)]

    def write(self, rows):
        new = self.path.with_suffix(".new")
        with new.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([NAMES, *rows])
        new.replace(self.path)

    def __enter__(self):
        self.earlier = []
        if self.path.exists():
            with self.path.open(newline="") as file:
                self.earlier = list(csv.reader(file))[1:]
        self.write([*self.earlier, self.row])

    def __exit__(self, *_):
        self.row[1] = now().isoformat()
        self.write([*self.earlier, self.row])
