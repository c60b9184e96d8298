# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads the text dumps of LIGGGHTS: dump custom (grains) and dump local (contacts), many snapshots in a file or a file
for each step, plain or .gz.

    dump = Dump("grains.*.dump")     a name, a pattern with *, or a list of these
    dump.steps                       [0, 1000, 2000]
    dump.names(1000)                 the names of a step's columns, without its rows
    dump.notes                       sentences for the user: what was left out, and why
    for snapshot in dump: ...        one at a time; nothing but this snapshot is in memory
    last = dump[-1]
    last["x"]                        a column, as a numpy array; an error that says what there is if it is missing
    last.vectors("x", "y", "z")      columns side by side, (rows, 3)
    last.frame()                     all of them, as a pandas DataFrame
    last.box.edges                   edge vectors as rows, of orthogonal and triclinic boxes

A snapshot that ends before its last row, as a killed run leaves it, is left out, and `notes` says so.
"""
from dataclasses import dataclass
import glob
import gzip
import mmap
from pathlib import Path
import re

import numpy as np

from grainscope.errors import InputError

BEGIN = b"ITEM: TIMESTEP\n"
HEADER = re.compile(
    BEGIN + rb"(?P<step>\d+)\n"
    rb"(?:ITEM: LABEL\n.*\n)?"
    rb"ITEM: NUMBER OF (?P<kind>.+)\n(?P<rows>\d+)\n"
    rb"ITEM: BOX BOUNDS(?P<sides>.*)\n(?P<bounds>(?:.*\n){3})"
    rb"ITEM: (?P=kind) (?P<names>.*)\n"
)


@dataclass
class Box:
    """Lowest corner, edge vectors (rows of a 3x3 matrix), and which edges are periodic."""

    origin: np.ndarray
    edges: np.ndarray
    periodic: np.ndarray

    def nearest(self, vectors):
        """These vectors (N,3) less the periodic edges that bring them closest to zero, edge by edge."""
        fractions = vectors @ np.linalg.inv(self.edges)
        return vectors - np.where(self.periodic, np.round(fractions), 0.0) @ self.edges

    def corners(self):
        """The eight corners; the first edge varies last."""
        return self.origin + np.array(list(np.ndindex(2, 2, 2))) @ self.edges


@dataclass
class Snapshot:
    """One step of a dump: its file, step and box, the number of rows, and columns by name."""

    path: str
    step: int
    box: Box
    rows: int
    columns: dict

    def __len__(self):
        return self.rows

    def __contains__(self, name):
        return name in self.columns

    def __getitem__(self, name):
        self.require(name)
        return self.columns[name]

    def require(self, *names, remedy=""):
        """An error that names the columns that are missing, those that there are, and the remedy where one is given."""
        missing = [name for name in names if name not in self.columns]
        if missing:
            found = f"{self.path}: no column {', '.join(missing)}; it has {' '.join(self.columns)}"
            raise InputError(f"{found}\n{remedy}" if remedy else found)

    def vectors(self, *names):
        return np.stack([self[name] for name in names], axis=1)

    def frame(self):
        try:
            import pandas
        except ImportError:
            raise InputError("pandas was not found. On Debian or Ubuntu: sudo apt-get install python3-pandas") from None
        return pandas.DataFrame(self.columns)


class Dump:
    """The snapshots of all files in the order of their steps. A step that a file has twice, as a resumed run leaves it,
    counts as it was written last."""

    def __init__(self, patterns):
        patterns = [patterns] if isinstance(patterns, (str, Path)) else list(patterns)
        self.notes = []
        self._places = {}
        self._opened = (None, b"")  # the file that was read last
        for path in _files(patterns):
            for step, place in self._whole_snapshots(path):
                other = self._places.get(step, (path,))[0]
                if other != path:
                    raise InputError(f"step {step} is in two files, {other} and {path}")
                self._places[step] = (path, *place)
        if not self._places:
            raise InputError("\n".join([f"{' '.join(map(str, patterns))}: no whole snapshot", *self.notes]))
        self.steps = sorted(self._places)

    @property
    def files(self):
        return {Path(path) for path, _, _ in self._places.values()}

    def __len__(self):
        return len(self.steps)

    def __getitem__(self, number):
        return self.at(self.steps[number])

    def __iter__(self):
        return map(self.at, self.steps)

    def at(self, step):
        """The snapshot of a step."""
        if step not in self._places:
            raise InputError(f"no snapshot of step {step}; there are {', '.join(map(str, self.steps))}")
        path, start, end = self._places[step]
        return _snapshot(path, self._content(path)[start:end])

    def path(self, step):
        """The file of a step."""
        return self._places[step][0]

    def names(self, step):
        """The names of the columns of a step, without reading its rows."""
        path, start, end = self._places[step]
        return HEADER.match(self._content(path), start, end)["names"].decode().split()

    def _content(self, path):
        opened = self._opened  # taken once: a film reads its snapshots side by side
        if opened[0] != path:
            opened = self._opened = (path, _content(path))
        return opened[1]

    def _whole_snapshots(self, path):
        """Step, and first and last place in the file, of each snapshot that is whole."""
        content = self._content(path)
        if not content[: len(BEGIN)] == BEGIN:
            raise InputError(f"{path}: not a text dump of LIGGGHTS: it must begin with '{BEGIN.decode().strip()}'")
        starts = []
        while (at := content.find(BEGIN, starts[-1] + 1 if starts else 0)) >= 0:
            starts.append(at)
        for start, end in zip(starts, [*starts[1:], len(content)]):
            block = content[start:end]
            header = HEADER.match(block)
            if header is None:
                self.notes.append(f"{path}: a snapshot without a whole header, at byte {start}, is left out")
                continue
            found, rows = block.count(b"\n", header.end()), int(header["rows"])
            if found < rows:
                self.notes.append(
                    f"{path}: the snapshot of step {int(header['step'])} is incomplete, {found} whole rows of {rows}; "
                    "it is left out"
                )
            else:
                yield int(header["step"]), (start, end)


def _files(patterns):
    for pattern in map(str, patterns):
        found = sorted(glob.glob(pattern)) if glob.has_magic(pattern) and not Path(pattern).exists() else [pattern]
        if not found:
            raise InputError(f"{pattern}: no such file")
        yield from found


def _content(path):
    """The bytes of a file, of which those that are looked at alone are read."""
    try:
        if str(path).endswith(".gz"):
            with gzip.open(path) as file:
                return file.read()
        with open(path, "rb") as file:
            return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) if Path(path).stat().st_size else b""
    except (OSError, EOFError) as error:
        raise InputError(f"{path}: {getattr(error, 'strerror', None) or error}") from None


def _snapshot(path, block):
    header = HEADER.match(block)
    rows, names = int(header["rows"]), header["names"].decode().split()
    lines = block[header.end() :].split(b"\n")[:rows]
    step = int(header["step"])
    try:
        box = _box(header)
        columns = _columns(lines, names)
    except ValueError as error:
        raise InputError(f"{path}: the snapshot of step {step} is damaged: {error}") from None
    return Snapshot(path, step, box, rows, columns)


def _box(header):
    """A triclinic box is dumped as the bounds of the box that holds it, with its tilts."""
    bounds = np.array([line.split() for line in header["bounds"].splitlines()], dtype=float)
    xy, xz, yz = bounds[:, 2] if bounds.shape[1] == 3 else (0.0, 0.0, 0.0)
    low, high = bounds[:, 0], bounds[:, 1]
    low = low - [min(0.0, xy, xz, xy + xz), min(0.0, yz), 0.0]
    high = high - [max(0.0, xy, xz, xy + xz), max(0.0, yz), 0.0]
    lx, ly, lz = high - low
    sides = [word for word in header["sides"].decode().split() if word not in ("xy", "xz", "yz")]
    periodic = np.array([word == "pp" for word in sides] or [False] * 3)
    return Box(low, np.array([[lx, 0.0, 0.0], [xy, ly, 0.0], [xz, yz, lz]]), periodic)


def _columns(lines, names):
    """Columns by name: numbers, or words where the first row has one that is no number (dump custom's `element`)."""
    if not lines:
        return {name: np.empty(0) for name in names}
    try:
        table = np.loadtxt(lines, ndmin=2).T
    except ValueError:
        rows = [line.decode().split() for line in lines]
        wrong = next((n for n, row in enumerate(rows, 1) if len(row) != len(names)), None)
        if wrong:
            raise ValueError(f"row {wrong} has {len(rows[wrong - 1])} values for {len(names)} columns") from None
        table = [np.array(column, dtype=float if _is_number(column[0]) else str) for column in zip(*rows)]
    if len(table) != len(names):
        raise ValueError(f"rows have {len(table)} values for {len(names)} columns")
    return dict(zip(names, table))


def _is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True
