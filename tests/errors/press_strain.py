# SPDX-License-Identifier: GPL-2.0-or-later
"""What fix press/strain refuses: keyword, requirement, value received."""
from dataclasses import replace

from case import main
from deck import Deck, shear
from packing import dense_packing
from refusal import refusal

GOOD = {"axis": "y", "target": "1e5", "shear": "xy rate 0.05", "every": "1e-3"}


def line(**changes):
    """The good line with keywords changed; None leaves one out; `tail` is appended as it stands."""
    tail = changes.pop("tail", "")
    words = {**GOOD, **{k.replace("_", "/"): v for k, v in changes.items()}}
    return "fix press all press/strain " + " ".join(f"{k} {v}" for k, v in words.items() if v is not None) + f" {tail}"


def refused(*words, before=(), triclinic=True, boundary="p p p", pair="gran/insitu", **changes):
    def deck():
        packing = replace(dense_packing(atom_style="sphere"), triclinic=triclinic)
        return Deck(packing, boundary=boundary, pair=pair, body=[*before, line(**changes), "run 1"])
    return refusal(deck, *words)


WALL = "fix floor all wall/gran model hertz tangential history primitive type 1 {}plane 0.0 allow_special_domain_periodic yes"
TUBE = WALL.format("y").replace("floor", "tube").replace("yplane 0.0", "xcylinder 9.0 0.0 0.0")
CASES = {
    "axis": refused("fix press/strain: 'axis' must be x, y or z, got 'q'", axis="q"),
    "axis-missing": refused("fix press/strain: 'axis x', 'axis y' or 'axis z' is required", axis=None),
    "target": refused("fix press/strain: 'target' must be a pressure >= 0 or a variable v_name, got '-3'", target="-3"),
    "target-not-a-number": refused("'target' must be a pressure >= 0 or a variable v_name, got '1-2'", target="1-2"),
    "target-missing": refused("'target' and a pressure are required", target=None),
    "target-no-such-variable": refused("'target' must name an equal-style variable, got 'v_nothing'", target="v_nothing"),
    "target-variable-negative": refused("'target' must be a pressure >= 0, got v_low = -1", target="v_low",
                                        before=["variable low equal -1"]),
    "shear": refused("'shear' must be xy, xz or yz, got 'yx'", shear="yx rate 0.05"),
    "shear-without-rate": refused("'shear xy' must be followed by 'rate' and a shear rate", shear="xy speed 0.05"),
    "rate-zero": refused("'rate' must be a shear rate other than 0 or a variable v_name, got '0'", shear="xy rate 0"),
    "rate-infinite": refused("'rate' must be a shear rate other than 0 or a variable v_name, got 'inf'", shear="xy rate inf"),
    "rate-variable-zero": refused("'rate' must be a shear rate other than 0, got v_still = 0", shear="xy rate v_still",
                                  before=["variable still equal 0"]),
    "every": refused("'every' must be a strain > 0, got '0'", every="0"),
    "every-missing": refused("'every', 'every/time' or 'every/step' is required", every=None),
    "every-twice": refused("exclude each other, got a second one: 'every/step'", tail="every/step 3"),
    "every-without-shear": refused("'every' counts strain, and without 'shear' the box has none", shear=None),
    "every-time": refused("'every/time' must be a time > 0, got '-1'", every=None, every_time="-1"),
    "every-step": refused("'every/step' must be a whole number of steps >= 1, got '2.5'", every=None, every_step="2.5"),
    "gain": refused("'gain' must be auto or a velocity per pressure >= 0, got '-1e-9'", gain="-1e-9"),
    "limit": refused("'limit' must be between 0 and 1, both excluded, got '1'", limit="1"),
    "maxrate": refused("'maxrate' must be a rate > 0, got '0'", maxrate="0"),
    "momentum": refused("'momentum' must be yes or no, got 'maybe'", momentum="maybe"),
    "kinetic": refused("'kinetic' must be yes or no, got '1'", kinetic="1"),
    "keyword-twice": refused("fix press/strain: 'limit' is given twice", tail="limit 0.01 limit 0.02"),
    "unknown-keyword": refused("keywords are axis, target, shear,", "got 'gian'", gian="1"),
    "value-missing": refused("after 'limit', got the end of the command", tail="limit"),
    "orthogonal-box": refused("'shear' needs a triclinic box: add 'change_box all triclinic'", triclinic=False),
    "not-periodic-along-axis": refused("cannot move box edges along 'y': the box must be periodic there", boundary="p f p",
                                       shear=None, every=None, every_step="5", triclinic=False),
    "wall-on-the-axis": refused("cannot move box edges along 'y': fix floor is a wall on that axis", before=[WALL.format("y")]),
    "cylinder-across-the-axis": refused("cannot move box edges along 'y': fix tube is a wall on that axis", before=[TUBE]),
    "second-fix-deform": refused("another fix already deforms the box", before=[shear(0.01)]),
    "needs-gran-insitu": refused("fix press/strain requires pair_style gran/insitu, got 'gran'", pair="gran"),
}

if __name__ == "__main__":
    main(CASES)
