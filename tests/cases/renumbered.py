# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixes that wait for a step when `reset_timestep` gives it a lower number: they begin again in the new numbers, and
write what the same fixes write that are defined afterwards."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close
from deck import Deck, shear, thermo
from grainscope.columns import outputs
from grainscope.fields import read_field
from packing import dense_packing
from run import run

P = outputs("stress/contact").word("s", "P")
WINDOW = "2 3 10"  # the mean of three samples, two steps apart, every ten steps
FIXES = [
    f"fix times all ave/time {WINDOW} {P} file times.txt",
    f"fix histo all ave/histo {WINDOW} -5 5 8 vx mode vector file histo.txt",
    f"fix bins all ave/spatial {WINDOW} x lower 0.25 vx units reduced file bins.txt",
    f"fix lags all ave/correlate 2 3 10 {P} file lags.txt",
    f"fix grains all ave/atom {WINDOW} vx vy",
    "variable p equal c_s",
    'fix words all print 10 "${p}" file words.txt screen no',
    "compute f all field grid 1 1 2 quantities density",
    f"fix cells all field/write {WINDOW} c_f file cells.*.csv",
]
FILES = ("times.txt", "histo.txt", "bins.txt", "lags.txt", "words.txt")
# Atoms are dumped when a window is complete.
DUMP = ["dump atoms all custom 10 atoms.dump id f_grains[1] f_grains[2]", "dump_modify atoms sort id first no"]
# In the middle of a window, of which samples were taken.
BEFORE, AFTER = ["run 27", "reset_timestep 0"], "run 30"


def deck():
    return Deck(dense_packing(atom_style="sphere", speed=2.0))


def rows(text):
    """Numbers of each row."""
    return [[float(word) for word in line.split()] for line in text.splitlines() if not line.startswith("#")]


def require_same(found, expected, what):
    """But for rounding: other computes may take the contacts in another order."""
    require([len(row) for row in found] == [len(row) for row in expected], f"{what}: {found} and not {expected}")
    found, expected = np.concatenate(found), np.concatenate(expected)
    size = np.maximum(np.abs(expected), 1e-12)
    require_close(found / size, expected / size, 1e-5, what, 1.0)  # six digits are written


def begun_again(ranks):
    start = [shear(0.3), "compute s all stress/contact"]
    kept = run(replace(deck(), body=[*start, *FIXES, *BEFORE, *DUMP, AFTER]), ranks)
    anew = run(replace(deck(), body=[*start, *BEFORE, *FIXES, *DUMP, AFTER]), ranks)
    for name in FILES:
        expected, found = (rows(one.file(name).read_text()) for one in (anew, kept))
        require(len(expected) >= 3, f"{name}: {expected}")
        require_same(found[-len(expected) :], expected, name)
        require(len(found) > len(expected), f"{name}: no rows from before: {found}")
    dumps = (one.dump("atoms.dump")[1:] for one in (kept, anew))  # without the averages from before, at the start
    for (step, found), (_, expected) in zip(*dumps, strict=True):
        for name in expected:
            require_close(found[name], expected[name], 1e-5, f"step {step}, {name}")
    for step in (10, 20, 30):
        found, expected = (read_field(one.file(f"cells.{step}.csv"))["rho"] for one in (kept, anew))
        require_close(found, expected, 1e-12, f"density of step {step}")


def not_set_up(ranks):
    """With `run pre no` too; samples are those of the same run with other numbers."""
    start = [shear(0.3), "compute s all stress/contact", *FIXES]
    result = run(replace(deck(), body=[*start, *BEFORE, AFTER + " pre no"]), ranks)
    same = run(replace(deck(), body=[*start, *thermo(1, P), BEFORE[0], AFTER + " pre no"]), ranks).thermo()[-1]
    pressure = dict(zip(same["step"].astype(int) - int(same["step"][0]), same[P]))
    found = np.array(rows(result.file("times.txt").read_text()))[-3:]
    means = [np.mean([pressure[step - back] for back in (0, 2, 4)]) for step in (10, 20, 30)]
    require_close(found, np.transpose([(10, 20, 30), means]), 1e-5, "means", max(map(abs, means)))  # of six digits
    for step in (10, 20, 30):
        result.file(f"cells.{step}.csv")


def higher(ranks):
    """Higher numbers go on as before: the sample of the next step that was waited for, or the message of LIGGGHTS."""
    start = [shear(0.3), "compute s all stress/contact", FIXES[0], *thermo(1, P)]
    result = run(replace(deck(), body=[*start, "run 20", "reset_timestep 25", "run 15"]), ranks)
    steps = [int(row[0]) for row in rows(result.file("times.txt").read_text())]
    require(steps == [10, 20, 30, 40], f"rows of steps {steps}")


CASES = {"begun-again": begun_again, "not-set-up": not_set_up, "higher": higher}

if __name__ == "__main__":
    main(CASES)
