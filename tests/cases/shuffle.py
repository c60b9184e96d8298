# SPDX-License-Identifier: GPL-2.0-or-later
"""The same grains with other numbers, in another order in memory, in other lists of neighbours: the same results but
for rounding."""
from dataclasses import replace

import numpy as np

from case import main, require
from deck import Deck
from everything import Questions, differences, press
from packing import dense_packing, tilted
from run import run

STEPS, EVERY = 100, 20
# On the same state: sums in another order, see rank_sweep.py. A packing of colliding grains parts from its twin by a
# factor of a hundred or so in a hundred steps: 3e-12 was seen at the worst, single grains' forces and mobilisations
# first. 300 times that for other seeds and processors.
SUMS, GROWN = 1e-10, 1e-9
# The host's solver of superquadrics, stopped at 1e-7, sees a contact from its first grain or its second: see
# rank_sweep.py. This grows likewise.
SOLVER, SOLVER_GROWN = 1e-3, 1e-1

ORDERS = {
    "sorted in every list": ["atom_modify sort 1 1.0"],
    "sorted coarsely": ["atom_modify sort 1 6.0"],
    "small bins": ["neigh_modify binsize 0.6"],
    "one bin": ["neigh_modify binsize 100.0"],
    "no bins": ["neighbor 0.2 nsq"],
    "lists in every step": ["neigh_modify every 1 delay 0 check no"],
}


def body(packing, before=(), settle=0):
    turn = ["unfix integrate", "fix integrate all nve/spheroid"] if packing.atom_style != "sphere" else []
    questions = Questions(packing)
    return questions, [
        *before,
        *turn,
        press(2e5),
        f"run {settle}",
        *questions.defined(),
        *questions.output(EVERY),
        f"run {STEPS}",
    ]


def require_alike(name, questions, found, expected, tolerances, numbers=None):
    for moments, tolerance in zip((slice(0, 1), slice(None)), tolerances):
        worst = differences(questions, found, expected, moments, numbers)
        quantity, value = max(worst.items(), key=lambda item: item[1])
        print(f"{name}, {'at once' if moments.stop else f'{STEPS} steps'}: worst {value:.2e} in {quantity}", flush=True)
        require(value <= tolerance, f"{name}: {quantity} differs by {value:.3e} of its scale, allowed {tolerance}")


def shuffled(packing, surface, tolerances):
    """From creation: the grains in another order, so with other numbers. From a restart file, in the midst of the flow:
    other orders."""

    def case(ranks):
        deck = Deck(packing, surface=surface, extra="ledger on tangential_damping off")
        order = np.random.default_rng(11).permutation(len(packing.grains))
        other = replace(packing, grains=[packing.grains[k] for k in order])
        questions, lines = body(
            packing, ["atom_modify sort 0 0"], 10
        )  # ten steps make springs: of nothing but rounding there is no scale
        expected = run(replace(deck, body=lines))
        found = run(replace(deck, packing=other, body=lines), ranks)
        require_alike("other numbers", questions, found, expected, tolerances, order + 1.0)

        saved = run(replace(deck, body=[press(2e5), "run 100", "write_restart state.restart"])).folder / "state.restart"
        expected = run(deck.restarted(saved, body(packing, ["atom_modify sort 0 0"])[1]))
        for name, before in ORDERS.items():
            found = run(deck.restarted(saved, body(packing, before)[1]), ranks)
            require_alike(name, questions, found, expected, tolerances)

    return case


CASES = {
    "spheres": shuffled(tilted(dense_packing(atom_style="sphere", speed=0.2), 0.45), "", (SUMS, GROWN)),
    "ellipsoids": shuffled(tilted(dense_packing(1.5, speed=0.2), 0.45), "ellipsoid", (SUMS, GROWN)),
    "superquadrics": shuffled(tilted(dense_packing(1.5, speed=0.2), 0.45), "superquadric", (SOLVER, SOLVER_GROWN)),
}

if __name__ == "__main__":
    main(CASES)
