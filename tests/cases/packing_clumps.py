# SPDX-License-Identifier: GPL-2.0-or-later
"""compute packing of clumps, each of which is one grain, against numpy."""
import math

import numpy as np

import clumps
from case import main, require, require_close, require_equal
from deck import Deck
from grainscope.columns import outputs
from oracle import network
from packing import dense_packing
from refusal import require_refused

MEASURE = outputs("packing")
C_IT = MEASURE.of("it")
SIX_DIGITS = 1e-5  # of the tables of fix ave/time


def of_clumps(walls):
    """A clump is one grain: its spheres hold it together, and its volume is what LIGGGHTS says."""

    def case(ranks):
        words = " ".join(C_IT.vector())
        lines = [
            "compute it all packing rattlers 2 volume 500",
            f"fix it all ave/time 15 1 15 {words} file packing.txt",
        ]
        result, moments = clumps.measured(clumps.start(walls), ranks, 60, 15, lines)
        table = result.averages("packing.txt")
        compared = 0
        for moment in moments:
            if moment.step % 15 or moment.step == 0:
                continue
            row = list(table["TimeStep"]).index(moment.step)
            found = {name: float(table[C_IT[name]][row]) for name in MEASURE.names("vector")}
            mass = clumps.own(moment)[0]
            ids = np.concatenate([1000 + np.arange(len(moment.bodies["xcm"])), moment.grains["id"][moment.body < 0]])
            ends = moment.rows["id"].astype(int)
            grain = np.where(moment.body >= 0, 1000 + moment.body, moment.grains["id"]).astype(int)
            of_id = dict(zip(moment.grains["id"].astype(int), grain))
            pairs = np.array([[of_id[i], of_id[j] if j else 0] for i, j in ends])
            held = network.backbone(ids, pairs, 2)
            between, with_walls = network.backbone_contacts(held, pairs)
            numbers = [len(mass), len(mass) - len(held), between, with_walls]
            names = ("N", "N_rattlers", "N_c_backbone", "N_w_backbone")
            require_equal([found[name] for name in names], numbers, ", ".join(names))
            require(0 < len(held) < len(ids), "some are rattlers")
            # LIGGGHTS has the volume of a clump of its mass and density
            require_close(found["V_s"], mass.sum() / 1000.0, SIX_DIGITS, "volume of the grains")
            require_close(found["d"], np.cbrt(6.0 / math.pi * mass / 1000.0).mean(), SIX_DIGITS, "d")
            require_close(found["rho"], 1000.0, SIX_DIGITS, "rho")
            require_close(found["phi"], found["V_s"] / 500.0, SIX_DIGITS, "phi")
            compared += 1
        require(compared >= 4, "several snapshots")

    return case


def rigid_refused(ranks):
    deck = Deck(dense_packing(atom_style="sphere"))
    rigid = "fix body all rigid single"
    deck.body = ["unfix integrate", rigid, "compute it all packing", "thermo_style custom step c_it", "run 1"]
    require_refused(deck, ranks, "compute packing", "fix body")


CASES = {
    "clumps": of_clumps(False),
    "clumps-between-walls": of_clumps(True),
    "rigid-refused": rigid_refused,
}

if __name__ == "__main__":
    main(CASES)
