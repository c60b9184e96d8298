# SPDX-License-Identifier: GPL-2.0-or-later
"""Periodic faces that close in on grains at rest: no contact is missed, though no grain has moved."""
import numpy as np

from case import main, require, require_equal
from deck import Deck, number
from packing import Grain, Packing
from run import run
from watch import F_FLOW, Flow, moments_of, watched_deck

SPACING, EDGE = 2.5, 4
RATE = -2.0  # of L_y over L_y
FLOWS = {
    "pressed": f"press/strain axis y target 1e5 every/step 5 maxrate {number(-RATE)}",
    "pressed-and-sheared": f"press/strain axis y target 1e5 shear xy rate 1.0 every/step 5 maxrate {number(-RATE)}",
    "deformed": f"deform 1 y trate {number(0.4 * RATE)} remap v",
}


def loose_grains():
    """Spheres of radius 1 near a lattice, none touching another."""
    aside = np.random.default_rng(5).uniform(-0.12, 0.12, (EDGE**3, 3))
    places = SPACING * (np.array(list(np.ndindex(EDGE, EDGE, EDGE))) + 0.5) + aside
    return [Grain(tuple(x)) for x in places]


def pairs_that_touch(moment):
    """Over all images, in the box that the forces saw."""
    x, box = moment.grains.x, moment.force_box
    i, j = np.triu_indices(len(x), 1)
    s = np.linalg.solve(box.edges, (x[i] - x[j]).T)
    distance = np.full(len(i), np.inf)
    for image in np.ndindex(3, 3, 3):
        d = (box.edges @ (s - np.round(s) + np.array(image)[:, None] - 1.0)).T
        distance = np.minimum(distance, np.linalg.norm(d, axis=1))
    return int((distance < 2.0).sum())


def no_contact_is_missed(line):
    def case(ranks):
        packing = Packing((SPACING * EDGE,) * 3, loose_grains(), atom_style="sphere", triclinic="shear" in line)
        sheared = 1.0 if "shear" in line else 0.0
        flow = Flow(f"fix flow all {line}", sheared, (0, 1), F_FLOW["L_rate"] if "press" in line else "")
        result = run(watched_deck(Deck(packing), [], flow=flow, every=10, steps=60), ranks)
        found = []
        for moment in moments_of(result, flow):
            found.append(len(moment.rows["fn"]))
            require_equal(found[-1], pairs_that_touch(moment), f"contacts of step {moment.step}")
        require(found[0] == 0 and max(found) > 10, f"contacts {found}")

    return case


CASES = {name: no_contact_is_missed(line) for name, line in FLOWS.items()}

if __name__ == "__main__":
    main(CASES)
