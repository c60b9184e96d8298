# SPDX-License-Identifier: GPL-2.0-or-later
"""Every measurement there is, continued from one restart file on every decomposition: the same numbers, in every step,
through a flip."""
from dataclasses import dataclass, replace
import sys

import numpy as np

from case import main, require
from catalogue import DISPLACEMENT, MEMORY
from deck import Deck, thermo
from everything import LEDGER, RATE, Differences, Questions, differences, press
from grainscope.columns import outputs
from packing import dense_packing, tilted
from run import run

C_MEMORY = outputs("velocity/memory").of("memory")
C_STRESS = outputs("stress/contact").of("stress")
F_PRESS = outputs("press/strain").of("press")

# Sums in another order. What a few sums of 1e3 terms lose is 1e-14 of their scale; angles and eigenvectors multiply
# that by scale over gap, and three steps of a stiff packing (forces answer to positions by E a/F = 1e3 and more) do the
# same to single forces.
SUMS = 1e-10
# For `surface superquadric` the host's solver stops at about 1e-7, and sees a contact from one side or the other. Where
# two surfaces run side by side the contact point is known to the square root of that only; it is the lever of forces,
# so torques are the worst.
SOLVER = 1e-3
ALL_GRIDS = (
    "2 1 1",
    "1 2 1",
    "1 1 2",
    "3 1 1",
    "1 3 1",
    "2 2 1",
    "4 1 1",
    "1 1 4",
    "8 1 1",
    "1 8 1",
    "1 1 8",
    "2 2 2",
    "4 2 1",
    "2 1 4",
)
STEPS = 4


@dataclass(frozen=True)
class Start:
    """A state: its deck, whether the box is turned back in the steps that are compared, how far numbers may differ."""

    deck: Deck
    tolerance: float = SUMS
    steps: int = 150
    flips: bool = False

    def ready(self):
        """The deck, its box tilted so that it turns back before the last of the steps, whatever its length does."""
        if not self.flips:
            return self.deck
        edges = self.deck.packing.edges
        still = 0.5 * RATE * self.deck.dt() * self.steps * edges[1] / edges[0]  # or so: the length changes
        return replace(self.deck, packing=tilted(self.deck.packing, 0.5 - still))


def integrated(deck):
    """Ellipsoids turn by the package's own integrator, as its pages advise."""
    return (
        ["unfix integrate", "fix integrate all nve/spheroid"]
        if deck.surface == "ellipsoid" and deck.packing.atom_style != "sphere"
        else []
    )


def state_of(start):
    """The restart file, and the deck that goes on from it on any grid of processors."""
    deck = start.ready()
    questions = Questions(deck.packing)
    flow = [
        *integrated(deck),
        f"{press(2e5)} limit 0.5 maxrate 1e6",
        *questions.defined(),
    ]  # no clip: dL/dt comes from sums
    asked = [*thermo(1, "xy", *(q for w in (DISPLACEMENT, MEMORY, LEDGER) for q in w.columns()))]
    saved = run(replace(deck, body=[*flow, *asked, "restart 1 state.*", f"run {start.steps}"]))
    turns = np.flatnonzero(np.diff(saved.thermo()[-1]["xy"]) < 0.0)
    require(len(turns) == start.flips, f"the box turned back {len(turns)} times")
    file = saved.folder / f"state.{turns[0] - 1 if start.flips else start.steps}"
    body = [*flow, *questions.output(), f"run {STEPS}"]

    def on(grid):
        ranks = int(np.prod([int(n) for n in grid.split()]))
        return run(replace(deck, processors=grid).restarted(file, body), ranks)

    return questions, on


def sweep(start, grids, table=None):
    def case(_):
        questions, on = state_of(start)
        one = on("1 1 1")
        printed = one.thermo()[-1]
        require(
            printed[C_STRESS["N_c"]].min() > 100 and printed[C_STRESS["sliding"]].max() > 0.0,
            "too few contacts, or none that slides",
        )
        require(printed[C_MEMORY["samples"]][-1] > 4 and printed[F_PRESS["inputs"]][-1] > 3, "nothing was remembered")
        require(
            np.ptp(printed[F_PRESS["L_rate"]]) > 0.0 and np.ptp(printed[F_PRESS["clipped"]]) == 0.0,
            "no input that is not clipped",
        )
        require(
            (np.diff(printed["xy"]).min() < 0.0) == start.flips,
            f"tilts {printed['xy']}: the box was to turn back: {start.flips}",
        )
        worst = Differences()
        for grid in grids:
            found = differences(questions, on(grid), one)
            name, value = max(found.items(), key=lambda item: item[1])
            print(
                f"processors {grid}: worst {value:.2e} in {name}; {found.moved} bins differ by contacts on their edge",
                flush=True,
            )
            for quantity, difference in found.items():
                require(
                    difference <= start.tolerance,
                    f"processors {grid}: {quantity} differs by {difference:.3e} of its scale",
                )
            require(found.moved <= 4 * (STEPS + 1), f"processors {grid}: {found.moved} bins differ")
            worst.merge(found)
        return worst

    return case


def deck_of(packing, surface="ellipsoid"):
    return Deck(packing, surface=surface, extra="ledger on tangential_damping off")


STARTS = {
    "spheres": Start(deck_of(dense_packing(atom_style="sphere", speed=0.2))),
    "spheroids": Start(deck_of(dense_packing(1.5, speed=0.2))),
    "oblate-grains": Start(deck_of(dense_packing(0.5, speed=0.2))),
    "superquadrics": Start(deck_of(dense_packing(1.5, speed=0.2), "superquadric"), SOLVER),
}
STARTS.update({f"{name}-through-a-flip": replace(start, flips=True) for name, start in list(STARTS.items())})


def every_start(_):
    """The table: the worst difference of each quantity over all decompositions, by state."""
    columns = {name: sweep(start, ALL_GRIDS)(1) for name, start in STARTS.items()}
    quantities = sorted({q for column in columns.values() for q in column})
    lines = ["| quantity | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    for q in quantities:
        lines.append(f"| {q} | " + " | ".join(f"{c[q]:.0e}" if q in c else "-" for c in columns.values()) + " |")
    text = "\n".join(lines)
    print(text)
    if len(sys.argv) > 3:
        with open(sys.argv[3], "w", encoding="utf-8") as file:
            file.write(text + "\n")


FEW = ("2 2 2", "1 3 1")
CASES = {
    **{name: sweep(start, FEW) for name, start in STARTS.items()},
    "every-decomposition": every_start,
}

if __name__ == "__main__":
    main(CASES)
