"""What dt_map.py and limits.py share: the material, tables that grow, runs of the decks of this folder and what they
dump."""

import argparse
import csv
import math
import os
import pathlib
import subprocess

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
YOUNG, POISSON, DENSITY = 5e6, 0.3, 1000.0
SHEAR_MODULUS = YOUNG / (2 * (1 + POISSON))
STIFFNESS = YOUNG / (2 * (1 - POISSON**2))
TANGENTIAL = 2 * (1 - POISSON) / (2 - POISSON)  # tangential over normal tangent stiffness


def rayleigh_time(alpha):
    return math.pi * min(1, alpha) / (0.8766 + 0.163 * POISSON) * math.sqrt(DENSITY / SHEAR_MODULUS)


def hertz_time(alpha, speed):
    """Duration of a head-on collision of two spheres with the smallest semi-axis."""
    return 2.94 * (5 * math.sqrt(2) * math.pi * DENSITY / (8 * STIFFNESS)) ** 0.4 * min(1, alpha) / speed**0.2


def damping_ratio(e):
    """gamma/(2 sqrt(k m)) of the contact law."""
    return math.sqrt(5 / 6) * -math.log(e) / math.hypot(math.log(e), math.pi)


class Table:
    """A csv whose rows are distinguished by their first `keys` columns; rows already there are not made again."""

    def __init__(self, name, keys, columns):
        self.path, self.keys, self.columns = HERE / f"{name}.csv", keys, columns
        self.rows = list(csv.DictReader(open(self.path))) if self.path.exists() else []
        self.done = {tuple(row[c] for c in columns[:keys]) for row in self.rows}

    def has(self, *key):
        return tuple(str(k) for k in key) in self.done

    def add(self, *values):
        row = {c: v if isinstance(v, str) else f"{v:.6g}" for c, v in zip(self.columns, values)}
        self.rows.append(row)
        with open(self.path, "w") as file:
            writer = csv.DictWriter(file, self.columns, lineterminator="\n")
            writer.writeheader()
            writer.writerows(self.rows)
        print(" ".join(f"{c} {row[c]}" for c in self.columns), flush=True)


class Runner:
    """Runs decks of this folder in a scratch folder."""

    PATIENCE = 300  # seconds: no run that keeps its grains takes a tenth of it

    def __init__(self, binary, work):
        self.binary, self.work = binary.resolve(), work.resolve()
        self.work.mkdir(parents=True, exist_ok=True)

    def output(self, deck, **variables):
        command = [str(self.binary), "-in", str(deck if os.path.isabs(deck) else HERE / deck), "-log", "none"]
        for name, value in variables.items():
            command += ["-var", name, str(value)]
        try:
            return subprocess.run(
                command, cwd=self.work, capture_output=True, text=True, errors="replace", timeout=self.PATIENCE
            ).stdout
        except subprocess.TimeoutExpired:
            return "ERROR: out of time"

    def thermo(self, deck, **variables):
        return self.rows(self.output(deck, **variables))

    @staticmethod
    def rows(text):
        """Rows of the last run's thermo output as floats, and whether the run came to its end."""
        rows, inside = [], False
        for line in text.splitlines():
            words = line.split()
            if words[:1] == ["Step"]:
                rows, inside = [], True
            elif inside and words and words[0].isdigit():
                rows.append([float(w) for w in words])
            elif inside:
                inside = False
        return np.array(rows), "ERROR" not in text and "Loop time" in text

    def packing(self, alpha, press, mu="0.4"):
        """The stem of a packing's files, made when they are not there."""
        stem = self.work / f"packing-{alpha:g}-{press}-{mu}"
        if not stem.with_name(stem.name + ".grains").exists():
            print(f"packing alpha {alpha:g} pressure {press} mu_p {mu} ...", flush=True)
            output = self.output("in.dt_packing", alpha=f"{alpha:g}", press=press, mu=mu, out=stem)
            if "ERROR" in output:
                raise SystemExit(output[-2000:])
        return stem


def read_dump(path):
    """Rows of the last snapshot, and the matrix of the box edges."""
    lines = open(path).read().splitlines()
    box = max(k for k, line in enumerate(lines) if line.startswith("ITEM: BOX"))
    start = max(k for k, line in enumerate(lines) if line.startswith(("ITEM: ENTRIES", "ITEM: ATOMS")))
    bounds = np.array([line.split() for line in lines[box + 1 : box + 4]], dtype=float)
    edges = np.diag(bounds[:, 1] - bounds[:, 0])
    if bounds.shape[1] == 3:
        edges[0, 1] = bounds[0, 2]
        edges[0, 0] -= abs(edges[0, 1])
    return np.array([line.split() for line in lines[start + 1 :] if line.strip()], dtype=float), edges


def axes_of(quaternions):
    """Symmetry axes."""
    w, x, y, z = quaternions.T
    return np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def rows_of(name, **wanted):
    """Rows of a table of this folder that have these values."""
    with open(HERE / f"{name}.csv") as file:
        return [row for row in csv.DictReader(file) if all(row[c] == v for c, v in wanted.items())]


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def run_stages(script, stages, about_folder):
    """The command line of a script whose stages are functions of a Runner."""
    parser = argparse.ArgumentParser(description=script.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path, help="the grainscope binary")
    parser.add_argument("stages", nargs="*", default=list(stages), help=f"of {', '.join(stages)} (default: all)")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("dt_map.work"), help=about_folder)
    arguments = parser.parse_args()
    runner = Runner(arguments.binary, arguments.work)
    for stage in arguments.stages:
        if stage not in stages:
            parser.error(f"stages must be of {', '.join(stages)}, got '{stage}'")
        getattr(script, stage)(runner)
