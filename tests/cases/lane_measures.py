# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of contacts that were worked out four at a time are those of contacts that the models made one by one: of
one and the same flow, to the last bit, but for the order of sums. A rolling model whose coefficient is 0 does nothing
but that."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_same_snapshots
from catalogue import SURFACE
from deck import Deck, Material, shear
from everything import RATE, Questions
from packing import dense_packing
from run import run

STEPS = 60
EVERY = 10
SIZES = (0.8, 0.9, 1.0, 1.1, 1.2)
TYPES = Material(
    young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.1, 0.4, 0.4, 0.9), rolling=(0.0, 0.0, 0.0, 0.0)
)
ONE_TYPE = Material(rolling=(0.0,))


def mixed():
    """Prolate, oblate and triaxial grains and spheres, the symmetry axis along any body axis."""
    shapes = ((1.0, 1.0, 1.4), (1.1, 1.1, 1.1), (1.3, 1.1, 0.9), (1.4, 1.0, 1.0), (1.2, 0.8, 1.2), (1.0, 1.0, 1.0))
    packing = dense_packing(1.4)
    return replace(packing, grains=[replace(g, semi_axes=shapes[k % 6]) for k, g in enumerate(packing.grains)])


class OfAnyShape(Questions):
    def computes(self):
        return [watched for watched in super().computes() if watched is not SURFACE]


def same_one_by_one(deck):
    def case(ranks):
        side_by_side, single = run(deck, ranks), run(replace(deck, rolling="cdt"), ranks)
        found, expected = side_by_side.thermo()[-1], single.thermo()[-1]
        require(len(expected["step"]) == STEPS // EVERY + 1, "rows are missing")
        require(found.keys() == expected.keys(), "different columns")
        for name in expected:
            compute = [np.abs(expected[other]).max() for other in expected if other.split("[")[0] == name.split("[")[0]]
            # what is 0 but for rounding is so by that of all numbers of the compute
            scale = np.abs(expected[name]).max() + 1e-2 * max(compute)
            require_close(found[name], expected[name], 1e-13, name, scale)
        for file in ("grains.dump", "rows.dump"):
            require_same_snapshots(side_by_side.dump(file), single.dump(file), file)
        contacts = [len(rows["c_rows[1]"]) for _, rows in single.dump("rows.dump")]
        require(min(contacts) >= len(deck.packing.grains), f"too few contacts to prove anything: {min(contacts)}")

    return case


def sheared(packing, material=ONE_TYPE, ask=Questions, **choices):
    deck = Deck(packing, material=material, surface="ellipsoid", **choices)
    questions = ask(packing, ledger=False, pressed=False)
    deck.body = [shear(RATE), *questions.defined(), *questions.output(EVERY), f"run {STEPS}"]
    return same_one_by_one(deck)


CASES = {
    "spheres": sheared(dense_packing(atom_style="sphere")),
    "spheres-of-five-sizes": sheared(dense_packing(atom_style="sphere", sizes=SIZES)),
    "spheres-of-two-types": sheared(dense_packing(atom_style="sphere", types=2), material=TYPES),
    "spheres-hooke": sheared(dense_packing(atom_style="sphere"), normal="hooke"),
    "spheres-no-history": sheared(dense_packing(atom_style="sphere"), tangential="no_history"),
    "spheres-without-friction": sheared(dense_packing(atom_style="sphere"), tangential="off"),
    "spheres-limit-force": sheared(dense_packing(atom_style="sphere"), extra="limitForce on tangential_damping off"),
    "round-ellipsoids": sheared(dense_packing()),
    "spheroid-0.5": sheared(dense_packing(0.5)),
    "spheroid-1.5": sheared(dense_packing(1.5)),
    "spheroid-1.5-of-two-types": sheared(dense_packing(1.5, types=2, sizes=SIZES), material=TYPES),
    "spheroid-1.5-hooke": sheared(dense_packing(1.5), normal="hooke"),
    "spheroid-1.5-no-history": sheared(dense_packing(1.5), tangential="no_history"),
    "spheroid-1.5-without-friction": sheared(dense_packing(1.5), tangential="off"),
    "spheroid-1.5-limit-force": sheared(dense_packing(1.5), extra="limitForce on tangential_damping off"),
    "mixed-shapes": sheared(mixed(), ask=OfAnyShape),
}

if __name__ == "__main__":
    main(CASES)
