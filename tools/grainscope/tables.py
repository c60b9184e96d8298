"""Reads tables of numbers with a line that names the columns: files of fix ave/time and fix print, and those of
examples/simple_shear."""

from difflib import get_close_matches
from pathlib import Path
import re

import numpy as np

from grainscope.errors import InputError, warn


def no_column(path, name, names):
    """The error of a column that a file does not have, with the nearest that it has."""
    near = get_close_matches(name, names, n=3, cutoff=0.5)
    nearest = f"; nearest: {', '.join(near)}" if near else ""
    return InputError(f"{path}: no column '{name}'{nearest}; it has {', '.join(names)}")


def files_and_columns(first, more):
    """The words of a command line that are files, and the others."""
    files = [first] + [word for word in more if Path(word).is_file()]
    return files, [word for word in more if word not in files]


class Columns(dict):
    """Columns of a file, by name."""

    def __init__(self, path, columns):
        super().__init__(columns)
        self.path = path

    def __missing__(self, column):
        raise no_column(self.path, column, list(self))


def lines_of(path):
    try:
        return Path(path).read_text().splitlines()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: not a text file") from None


def is_ended(path):
    """Whether the last line has its end: a run that goes on, or was killed, leaves one without, and numbers in it that
    may lack digits."""
    return Path(path).read_bytes().endswith(b"\n")


def is_csv(path):
    """Whether it is of fix field/write."""
    return any("," in line for line in lines_of(path) if not line.startswith("#"))


def is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def read_rows(path):
    """Names of the columns and their units, and the rows as lists of words. The last '#' line gives the names, or a
    line without '#' in front of the first row. In name[unit] brackets hold the unit; in c_stress[26] they belong to
    the name. A last line without its end is left out."""
    lines = lines_of(path)
    if not is_ended(path):
        del lines[-1:]
    titles = [line for line in lines if line.startswith("#")]
    rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    while rows and not is_number(rows[0][0]):
        titles.append(" ".join(rows.pop(0)))
    if not titles or not rows:
        raise InputError(f"{path}: a line with the names of the columns and at least one row are needed")
    names, units = [], {}
    for word in titles[-1].lstrip("# ").split():
        unit = re.fullmatch(r"([^\[\]]+)\[([^\[\]]*)\]", word)
        name = unit[1] if unit and not unit[2].isdigit() else word
        names.append(name)
        units[name] = unit[2] if name != word else ""
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


def read_series(path):
    """Columns of a file with a row for each step, and their units."""
    if is_csv(path):
        raise InputError(f"{path}: files of fix field/write are drawn by `rows`")
    names, units, rows = read_rows(path)
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"{path}: each column must have a name of its own, got '{twice}' twice")
    if len(rows[0]) == 2 != len(names) and rows[0][1].isdigit():
        raise InputError(f"{path}: tables with a line 'step rows' before each (mode vector) are drawn by `rows`")
    if not is_ended(path):
        warn(f"{path}: the last row is incomplete and left out")
    return Columns(path, zip(names, numbers(path, rows, names).T)), units


def blocks(path, rows, length_of, end=np.inf):
    """(step, number of its rows, its rows) of the tables that follow each other in a file, up to the step `end`. A
    table begins with a row whose first word is the step; length_of tells of this row how many rows the table has,
    itself among them. The last one may have fewer, where the run has not ended it."""
    place = 0
    while place < len(rows):
        try:
            step = int(rows[place][0])
            if step > end:
                return
            length = length_of(rows[place])
        except (IndexError, ValueError):
            raise InputError(f"{path}: row {place + 1} must begin with a step, got '{' '.join(rows[place])}'") from None
        yield step, length, rows[place : place + length]
        place += length
