# SPDX-License-Identifier: GPL-2.0-or-later
"""What fix press/strain refuses because of variables, box, walls and other fixes."""
from dataclasses import replace

from case import main
from deck import Deck, shear
from packing import dense_packing
from refusal import refusal

GOOD = {"axis": "y", "target": "1e5", "shear": "xy rate 0.05", "every": "1e-3"}


def line(**changes):
    """The good line with keywords changed; None leaves one out."""
    words = {**GOOD, **{k.replace("_", "/"): v for k, v in changes.items()}}
    return "fix press all press/strain " + " ".join(f"{k} {v}" for k, v in words.items() if v is not None)


def refused(*words, before=(), triclinic=True, boundary="p p p", normal="hertz", **changes):
    def deck():
        packing = replace(dense_packing(atom_style="sphere"), triclinic=triclinic)
        return Deck(packing, boundary=boundary, normal=normal, body=[*before, line(**changes), "run 1"])

    return refusal(deck, *words)


WALL = (
    "fix floor all wall/gran model hertz tangential history primitive type 1 {}plane 0.0 "
    "allow_special_domain_periodic yes"
)
TUBE = WALL.format("y").replace("floor", "tube").replace("yplane 0.0", "xcylinder 9.0 0.0 0.0")
HYSTERESIS = [
    f"fix {name} all property/global coefficient{name} peratomtypepair 1 {value}"
    for name, value in (("MaxElasticStiffness", 5.0), ("AdhesionStiffness", 0.5), ("PlasticityDepth", 0.3))
]
KNOWN = "'gain auto' works with the normal models hertz, hooke, hertz/stiffness and hooke/stiffness only"
CASES = {
    "gain-auto-unknown-model": refused(
        f"{KNOWN}: give a number, or change the models of pair_style gran/insitu, got 'model hooke/hysteresis",
        before=HYSTERESIS,
        normal="hooke/hysteresis",
    ),
    "gain-auto-unknown-model-of-a-wall": refused(
        f"{KNOWN}: give a number, or change the models of wall 'floor', got 'model hooke/hysteresis",
        before=[*HYSTERESIS, WALL.format("z").replace("hertz", "hooke/hysteresis")],
    ),
    "target-no-such-variable": refused(
        "'target' must name an equal-style variable, got 'v_nothing'", target="v_nothing"
    ),
    "target-variable-negative": refused(
        "'target' must be a pressure >= 0, got v_low = -1", target="v_low", before=["variable low equal -1"]
    ),
    "rate-variable-zero": refused(
        "'rate' must be a shear rate other than 0, got v_still = 0",
        shear="xy rate v_still",
        before=["variable still equal 0"],
    ),
    "orthogonal-box": refused("'shear' needs a triclinic box: add 'change_box all triclinic'", triclinic=False),
    "not-periodic-along-axis": refused(
        "cannot move box edges along 'y': the box must be periodic there",
        boundary="p f p",
        shear=None,
        every=None,
        every_step="5",
        triclinic=False,
    ),
    "wall-on-the-axis": refused(
        "cannot move box edges along 'y': fix floor is a wall on that axis", before=[WALL.format("y")]
    ),
    "cylinder-across-the-axis": refused(
        "cannot move box edges along 'y': fix tube is a wall on that axis", before=[TUBE]
    ),
    "second-fix-deform": refused("another fix already deforms the box", before=[shear(0.01)]),
}

if __name__ == "__main__":
    main(CASES)
