# SPDX-License-Identifier: GPL-2.0-or-later
"""What compute field must refuse, and with which words: the keyword and what it got."""
from case import main, require
from deck import Deck
from packing import dense_packing, disc_packing
from refusal import require_refused
from run import run

SPHERES = dense_packing(atom_style="sphere", minimum=30)
REGIONS = (
    "region ball sphere 2 2 2 1 units box",
    "region part block 0 2 0 3 0 4 units box",
    "region out block 0 2 0 3 0 4 side out units box",
    "region flat block 0 2 3 3 0 4 units box",
    "region turns block 0 2 0 3 0 4 units box rotate v_turn 1 1 1 0 0 1",
)
GRID = "grid 2 3 4"
ABOUT = "grid 2 1 2 about z 4 4 r 0.5 3"
REFUSED = {
    "numbers": [
        *(
            (f"grid {words} quantities density", ("'grid'", f"got '{got}'"))
            for words, got in (
                ("0 1 1", "0"),
                ("1 -2 1", "-2"),
                ("1 1 2.5", "2.5"),
                ("1 nan 1", "nan"),
                ("1 1e999 1", "1e999"),
                ("many 1 1", "many"),
            )
        ),
        ("grid 2 3", ("grid", "got the end of the command")),
        ("quantities density", ("grid",)),
        (f"{GRID} {GRID} quantities density", ("'grid' is given twice",)),
    ],
    "too-many-cells": [
        ("grid 1000 1000 11 quantities density", ("'grid'", "10000000 cells", "got")),
        ("grid 100000 100000 100000 quantities density", ("'grid'", "cells")),
    ],
    "quantities": [
        (f"{GRID} quantities density mass", ("'quantities'", "got 'mass'")),
        (f"{GRID} quantities Density", ("got 'Density'",)),
        (f"{GRID} quantities density density", ("density", "twice")),
        (f"{GRID} quantities", ("quantities", "got the end of the command")),
        (f"{GRID} quantites density", ("got 'quantites': did you mean 'quantities'?",)),
        (f"{GRID} quantities density quantities phi", ("'quantities' is given twice",)),
    ],
    "bounds": [
        (f"{GRID} x 2.0 2.0 quantities density", ("'x'", "2")),
        (f"{GRID} y 3.0 1.0 quantities density", ("'y'", "1")),
        (f"{GRID} z nan 1.0 quantities density", ("'z", "got 'nan'")),
        (f"{GRID} z 1.0 quantities density", ("'z", "got 'quantities'")),
        (f"{GRID} x 1.0 2.0 x 1.0 2.0 quantities density", ("'x' is given twice",)),
        (f"{GRID} region nowhere quantities density", ("'region' must be a region that is defined", "got 'nowhere'")),
        (f"{GRID} region ball quantities density", ("region", "ball", "block")),
        (f"{GRID} region out quantities density", ("region 'out'", "the inside of a block")),
        (f"{GRID} region flat quantities density", ("region 'flat' has no thickness along y",)),
        (f"{GRID} y -1e9 1e9 quantities density", ("images of the box along y, at most 100",)),
        (f"{GRID} kernel gaussian width 1e300 quantities density", ("images of the box along x, at most 100",)),
        (f"{GRID} region part x 0.0 1.0 quantities density", ("region", "x")),
        (f"{GRID} frame sideways quantities density", ("'frame' must be box or lab, got 'sideways'",)),
    ],
    "kernels": [
        (f"{GRID} width 0.5 quantities density", ("width", "kernel")),
        (f"{GRID} kernel cell width 0.5 quantities density", ("width", "kernel")),
        (f"{GRID} kernel lucy quantities density", ("width", "lucy")),
        (f"{GRID} kernel gaussian quantities density", ("width", "gaussian")),
        (f"{GRID} kernel gaussian width 0 quantities density", ("'width'", "got '0'")),
        (f"{GRID} kernel gaussian width -1 quantities density", ("'width'", "got '-1'")),
        (f"{GRID} kernel lucy width nan quantities density", ("'width'", "got 'nan'")),
        (f"{GRID} kernel box quantities density", ("'kernel' must be cell, lucy or gaussian, got 'box'",)),
    ],
    "rings": [
        (f"{ABOUT} kernel lucy width 0.5 quantities density", ("about", "lucy")),
        (f"{ABOUT} kernel gaussian width 0.5 quantities density", ("about", "gaussian")),
        ("grid 2 1 2 about w 4 4 r 0.5 3 quantities density", ("'about'", "got 'w'")),
        ("grid 2 3 2 about z 4 4 r 0.5 3 quantities density", ("grid", "1")),
        ("grid 2 1 2 about z 4 4 r 3 0.5 quantities density", ("'r'", "0.5")),
        ("grid 2 1 2 about z 4 4 r -1 3 quantities density", ("'r", "-1")),
        ("grid 2 1 2 about z 400 4 quantities density", ("the axis of rings must lie in the box",)),
        (f"{GRID} r 0.5 3 quantities density", ("'r'", "about")),
        (f"{ABOUT} frame box quantities density", ("about", "frame")),
    ],
    "choices": [
        (f"{GRID} walls some quantities density", ("'walls' must be no, yes or only, got 'some'",)),
        (f"{GRID} types 0 1 quantities density", ("'types'", "got '0'")),
        (f"{GRID} axis middle quantities Q", ("'axis' must be auto, symmetry, long or short, got 'middle'",)),
        (f"{GRID} q density", ("got 'q'",)),
    ],
}
DISCS = {
    "grid 2 2 2 quantities density": ("grid", "dimension 2"),
    "grid 2 2 1 quantities density all": ("'quantities'", "got 'all'"),
    "grid 2 2 1 quantities density Q": ("Q",),
    "grid 2 2 1 quantities S2": ("S2",),
    "grid 2 2 1 quantities director": ("director",),
}


def asked(packing, words):
    body = ["variable turn equal step*dt", *REGIONS, f"compute it all field {words}", "thermo_style custom step c_it"]
    return Deck(packing, body=[*body, "run 1"])


def refused(name):
    def case(ranks):
        for words, said in REFUSED[name]:
            require_refused(asked(SPHERES, words), ranks, "compute field", *said)

    return case


def two_dimensions(ranks):
    for words, said in DISCS.items():
        require_refused(asked(disc_packing(), words), ranks, "compute field", *said)


def taken(ranks):
    """At the limits."""
    for words in (
        "grid 1 1 1 quantities density",
        "grid 1 1 1000 quantities contacts overlap",
        f"{GRID} x -1e2 1e2 quantities stress",
        f"{GRID} kernel gaussian width 1e-3 quantities density",
        f"{GRID} kernel lucy width 2.0 quantities stress",
        f"{ABOUT} quantities temperature",
        f"{GRID} quantities Q S2 director",  # spheres have no axes: 0
        f"{GRID} quantities all",
        f"{GRID} region part quantities phi",
        f"{GRID} frame box x 0.0 0.5 quantities phi",
    ):
        result = run(asked(SPHERES, words), ranks)
        require(len(result.thermo()[-1]["c_it"]) > 0, words)


CASES = {**{name: refused(name) for name in REFUSED}, "two-dimensions": two_dimensions, "taken": taken}

if __name__ == "__main__":
    main(CASES)
