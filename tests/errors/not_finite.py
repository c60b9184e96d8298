# SPDX-License-Identifier: GPL-2.0-or-later
"""A grain whose place is no number: a measure that sorts by place ends the run with a message, and writes nowhere
else."""
from dataclasses import replace

from case import main
from deck import Deck, thermo
from packing import dense_packing
from refusal import require_refused

SPHERES = dense_packing(atom_style="sphere")
SPHEROIDS = dense_packing(1.5)
GONE = 'run 4 pre no every 2 "set atom 3 y 1e999"'  # without a set-up in between, which the host would not survive
NO_LIST = "neigh_modify delay 1000 every 1000"


def measured(command, quantity, *words, packing=SPHERES, pair="gran", surface="superquadric"):
    def case(ranks):
        deck = Deck(packing, pair=pair, surface=surface)
        lines = [
            NO_LIST,
            "variable step equal step",
            f"compute gone all {command}",
            *thermo(1, quantity),
            "thermo_modify lost ignore",
            GONE,
        ]
        require_refused(replace(deck, body=lines), ranks, *words)

    return case


def guarded(command, quantity, packing=SPHERES, surface="superquadric"):
    words = "the", "of grains", "is not finite"
    return measured(command, quantity, *words, packing=packing, pair="gran/insitu", surface=surface)


GRAINS = "the positions of 1 grains are not finite"
CASES = {
    "layering": measured("layering", "c_gone[1]", "compute layering: step", GRAINS),
    "fluctuation-profile": measured("fluctuation", "c_gone[1][2]", "compute fluctuation: step", GRAINS),
    "fluctuation-layers": measured("fluctuation flow layers 4", "c_gone[1]", "flow layers: step", GRAINS),
    "memory-layers": measured("velocity/memory strain v_step flow layers 4", "c_gone", "flow layers: step", GRAINS),
    "correlation": measured("velocity/correlation", "c_gone", "compute velocity/correlation: step", GRAINS),
    "correlation-mesh": measured(
        "velocity/correlation method mesh", "c_gone", "compute velocity/correlation: step", GRAINS
    ),
    "contact-direction": guarded("contact/direction", "c_gone[1][2]"),
    "contact-force": guarded("contact/force", "c_gone"),
    "packing": guarded("packing", "c_gone"),
    "contact-surface": guarded("contact/surface", "c_gone[1][3]", SPHEROIDS),
    "contact-surface-ellipsoid": guarded("contact/surface", "c_gone[1][3]", SPHEROIDS, "ellipsoid"),
}

if __name__ == "__main__":
    main(CASES)
