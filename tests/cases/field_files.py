# SPDX-License-Identifier: GPL-2.0-or-later
"""fix field/write: means over time are ratios of sums of what compute field gave in each sample, errors those of
blocks, and its files hold the same numbers."""
from dataclasses import replace
import re

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, shear, thermo
from grainscope.fields import read_field
from packing import dense_packing
from refusal import require_refused
from run import run

QUANTITIES = "density momentum velocity temperature stress coordination"
NAMES = ["x", "y", "z", "V", "N", "rho", "p_x", "p_y", "p_z", "v_x", "v_y", "v_z", "T_x", "T_y", "T_z", "T"]
NAMES += [f"s_{a}{b}" for a in "xyz" for b in "xyz"] + ["Z"]
CELLS = 9  # some of them without grains in some samples
EVERY, REPEAT, FREQUENCY, BLOCKS = 3, 6, 21, 3
FIELD = f"compute f all field grid 1 1 {CELLS} z 0.0 14.0 quantities {QUANTITIES}"
WRITE = f"fix w all field/write {EVERY} {REPEAT} {FREQUENCY} c_f blocks {BLOCKS} file"
# The same sums in another order.
EXACT = 1e-11


def loose():
    """Grains in a part of a long box."""
    packing = dense_packing(atom_style="sphere", speed=2.0, minimum=60)
    return Deck(replace(packing, edges=(*packing.edges[:2], 1.6 * packing.edges[2])))


def means(samples):
    """Of rows of CELLS x NAMES: what a mean over them is of each column."""
    at = {name: k for k, name in enumerate(NAMES)}
    total = {name: sum(s[:, at[name]] for s in samples) for name in ("V", "N")}
    mass = [s[:, at["rho"]] * s[:, at["V"]] for s in samples]
    found = np.zeros((CELLS, len(NAMES)))
    for name, k in at.items():
        weight = [s[:, at["V"]] for s in samples]
        if name[0] in "vT":
            weight = mass
        if name == "Z":
            weight = [s[:, at["N"]] for s in samples]
        if name in ("x", "y", "z"):
            found[:, k] = samples[-1][:, k]
            continue
        if name in ("V", "N"):
            found[:, k] = total[name] / len(samples)
            continue
        below = sum(weight)
        above = sum(w * s[:, k] for w, s in zip(weight, samples))
        found[:, k] = np.divide(above, below, out=np.zeros(CELLS), where=below > 0.0)
    return found


def averages(ranks):
    asked = [f"c_f[{row}][{column}]" for row in range(1, CELLS + 1) for column in range(1, len(NAMES) + 1)]
    body = [shear(0.3), FIELD, WRITE + " field.*.csv field.*.vts last.csv", *thermo(1, *asked), "run 45", "run 20"]
    result = run(replace(loose(), body=body), ranks)
    steps = {}
    for table in result.thermo():
        for row, step in enumerate(table["step"]):
            steps[int(step)] = np.array([table[word][row] for word in asked]).reshape(CELLS, len(NAMES))
    files = sorted(result.folder.glob("field.*.csv"), key=lambda p: int(p.name.split(".")[1]))
    require_equal([int(p.name.split(".")[1]) for p in files], [21, 42, 63], "files")
    some_empty = some_unknown = False
    for file in files:
        step = int(file.name.split(".")[1])
        samples = [steps[step - EVERY * back] for back in reversed(range(REPEAT))]
        some_empty = some_empty or any((s[:, 4] == 0).any() for s in samples)
        table = read_field(file)
        require(list(table.columns)[: len(NAMES)] == NAMES, f"columns {list(table.columns)}")
        expected = means(samples)
        per = REPEAT // BLOCKS
        rests = [means(samples[:k] + samples[k + per :]) for k in range(0, REPEAT, per)]
        errors = np.sqrt((BLOCKS - 1) / BLOCKS * ((rests - np.mean(rests, axis=0)) ** 2).sum(axis=0))
        with_grains = sum((sum(s[:, 4] for s in samples[k : k + per]) > 0).astype(int) for k in range(0, REPEAT, per))
        for k, name in enumerate(NAMES):
            size = max(np.abs(expected[:, k]).max(), np.abs([s[:, k] for s in samples]).max(), 1e-300)
            require_close(table[name], expected[:, k], EXACT, f"step {step}, {name}", size)
            if name not in ("x", "y", "z"):
                found, known = table.error(name), np.ones(CELLS, dtype=bool)
                if name[:2] in ("v_", "T_") or name in ("T", "Z"):
                    known = with_grains >= 2
                require_equal(np.isnan(found), ~known, f"step {step}, {name}: errors that are known")
                # A difference of numbers of that size.
                require_close(found[known], errors[known, k], 1e-7, f"step {step}, error of {name}", size)
                some_unknown = some_unknown or not known.all()
    require(some_empty and some_unknown, "cells that were empty in a sample, and in all but one block")
    require((result.folder / "last.csv").read_text() == files[-1].read_text(), "a name without a star")
    text = (result.folder / "field.63.vts").read_text()
    found = re.search(r'Name="rho"[^>]*>([^<]*)<', text).group(1).split()
    require_equal(np.array(found, dtype=float), read_field(files[-1])["rho"], "the same numbers for VTK")


def untouched(ranks):
    """Whether fields are written or not, a run is the same."""
    deck, ends = loose(), ["write_restart end.restart"]
    plain = run(replace(deck, body=[shear(0.3), "run 60", *ends]), ranks)
    seen = run(replace(deck, body=[shear(0.3), FIELD, WRITE + " f.*.csv", "run 60", *ends]), ranks)
    tables = [one.thermo()[-1] for one in (plain, seen)]
    for name in tables[0]:
        require_equal(tables[1][name], tables[0][name], name)


REFUSED = {
    "fix w all field/write 3 6 20 c_f": "needs 'file name ...'",
    "fix w all field/write 3 6 20 c_none file a.csv": "'source' must be c_ID of a compute field that is defined, got",
    "fix w all field/write 3 6 20 c_g file a.csv": "'source' must be c_ID of a compute field that is defined, "
    "got 'c_g'",
    "fix w all field/write 3 6 20 c_f file a.csv a.csv": "'file' names 'a.csv' twice",
    "fix w all field/write 3 6 20 f_f file a.csv": "'source' must be c_ID, a compute field, got 'f_f'",
    "fix w all field/write 3 6 16 c_f file a.csv": "'N_freq' must be a multiple of N_every, and more than",
    "fix w all field/write 3 6 20 c_f file a.csv blocks 4": "'blocks' must be a divisor of N_repeat, 6, got '4'",
    "fix w all field/write 3 6 20 c_f file a.txt": "'file' must be a name that ends with .csv, .vti or .vts, got",
    "fix w all field/write 1 1 100 c_f file none/a.csv": "cannot write 'none/a.csv': No such file or directory",
    "fix w all field/write 1 1 100 c_h file a.vti": "this one is tilted: use .vts",
}


def refused(ranks):
    deck = loose()
    deck = replace(deck, packing=replace(deck.packing, tilt=1.0))
    start = [FIELD, "compute g all stress/contact volume auto", "compute h all field grid 1 3 1"]
    for line, message in REFUSED.items():
        line = line.replace("3 6 20", "3 6 21")
        require_refused(replace(deck, body=[*start, line, "run 2"]), ranks, "fix field/write", message)


def between_runs(ranks):
    """A window begins again when the compute or the numbers of steps are others; nothing is lost, nothing mixed."""
    start = [shear(0.3), FIELD, "fix w all field/write 1 10 20 c_f file f.*.csv", "run 15"]
    again = ["uncompute f", FIELD.replace("field grid 1 1", "field grid 2 1"), "run 30"]
    result = run(replace(loose(), body=[*start, *again]), ranks)
    files = sorted(p.name for p in result.folder.glob("f.*.csv"))
    require(files == ["f.40.csv"], f"another compute: {files}")
    require_equal(len(read_field(result.folder / files[0]).columns["N"].ravel()), 2 * CELLS, "its cells")
    result = run(replace(loose(), body=[*start, "reset_timestep 0", "run 40"]), ranks)
    files = sorted(p.name for p in result.folder.glob("f.*.csv"))
    require(files == ["f.20.csv", "f.40.csv"], f"other numbers: {files}")
    gone = [*start, "uncompute f", "run 10 pre no"]
    message = "'source' must be c_ID of a compute field that is defined, got 'c_f'"
    require_refused(replace(loose(), body=gone), ranks, "fix field/write", message)


CASES = {"averages": averages, "untouched": untouched, "between-runs": between_runs, "refused": refused}

if __name__ == "__main__":
    main(CASES)
