"""Reads tables of numbers whose last '#' line names the columns."""

from pathlib import Path
import re

import numpy as np

from grainscope.errors import InputError


class Columns(dict):
    """Columns of a file, by name."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, column):
        raise InputError(f"{self.path}: no column '{column}'; it has {', '.join(self)}")


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
