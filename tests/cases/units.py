# SPDX-License-Identifier: GPL-2.0-or-later
"""All measures in other units: where LIGGGHTS has no factors between force, energy and pressure, a deck means the same
numbers in each of them, and every measure gives them to the last bit."""
from dataclasses import replace

from case import main, require, require_equal
from deck import Deck, Material
from everything import Questions, press
from packing import dense_packing
from run import run
from wall_measures import BOX
from watch import Watched, watched_deck

FIELDS = (
    "density phi momentum velocity spin temperature stress stress_normal stress_tangential stress_kinetic",
    "traction contacts coordination fabric P_n P_t overlap",
)
# LIGGGHTS refuses softer grains with units cgs.
HARD = Material(young=(5e7,))
AT_WALLS = [
    Watched("state", "packing", True, 18),
    Watched("forces", "contact/force", True, 27),
    Watched("walls", "wall/contact", True, 6),
    Watched("cells", f"field grid 1 3 2 quantities {' '.join(FIELDS)}", True, 4, (6, 67)),
]


def everything(atom_style):
    packing = dense_packing(alpha=1.0 if atom_style == "sphere" else 1.5, atom_style=atom_style)
    questions = Questions(packing)
    surface = "ellipsoid" if atom_style == "superquadric" else "superquadric"
    body = [press(1e5), *questions.defined(), *questions.output(), "run 12"]
    extra = "ledger on tangential_damping off"
    return Deck(packing, body=body, material=HARD, extra=extra, surface=surface)


def at_walls():
    return watched_deck(replace(BOX.deck, material=HARD), AT_WALLS, settle=20)


def same_numbers(deck):
    def case(ranks):
        expected = run(deck, ranks)
        for units in ("cgs", "micro", "lj"):
            found = run(replace(deck, units=units), ranks)
            for one, other in zip(found.thermo(), expected.thermo()):
                require(len(other["step"]) > 1, "steps")
                for name in other:
                    require_equal(one[name], other[name], f"units {units}, {name}")
            for name in ("grains.dump", "rows.dump"):
                for (_, one), (_, other) in zip(found.dump(name), expected.dump(name)):
                    for column in other:
                        require_equal(one[column], other[column], f"units {units}, {name}, {column}")

    return case


CASES = {
    "spheres": same_numbers(everything("sphere")),
    "spheroids": same_numbers(everything("superquadric")),
    "walls": same_numbers(at_walls()),
}

if __name__ == "__main__":
    main(CASES)
