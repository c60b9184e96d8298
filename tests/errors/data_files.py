# SPDX-License-Identifier: GPL-2.0-or-later
"""Lines of a superquadric's data file that are refused, and grains that no such file can hold."""
from cases.data_files import SETTINGS, hand_deck, packing, reading, write_file
from case import main
from deck import Deck
from refusal import refusal, require_refused

GOOD = ["1 1 1000 1 1 1.5 2 2 -1.99 0 0", "2 1 1000 1 1 1.5 2 2 0 0 0", "3 2 1000 1 1 1.5 2 2 3 4.5 0"]
TURNED = [f"{line} 1 0 0 0" for line in GOOD]
IMAGED = [f"{line} 0 0 0" for line in GOOD]
VELOCITIES = ["", "Velocities", "", "1 0 0 0 0 0 0", "2 0 0 0 0 0 0"]


def changed(lines, old, new):
    changed_lines = [line.replace(old, new) for line in lines]
    assert changed_lines != lines
    return changed_lines


def refused(lines, grain, *words, section="Atoms"):
    def case(ranks):
        deck = reading(hand_deck(), write_file(lines), "run 0")
        require_refused(deck, ranks, f"read_data: {section} of atom_style superquadric, grain {grain}:", *words)

    return case


def must(name, requirement, got):
    return f"'{name}' must be {requirement}, got '{got}'"


def written(*settings):
    return lambda: Deck(packing(0.0), body=[*SETTINGS, *settings, "write_data grains.data"])


COUNT = "expected 11, 14, 15 or 18 columns (id type density shapex shapey shapez blockiness1 blockiness2 x y z,"
POSITIVE, TYPE = "a whole number from 1 to 2147483647", "a whole number from 1 to 2"
IMAGE = "a whole number from -512 to 511"
NOT_OF_SHAPE = "are not those of its shape and density"
CASES = {
    "columns-of-a-sphere": refused(["1 1 2 1000 0 0 0", *GOOD[1:]], 1, COUNT, "got 7"),
    "a-column-too-few": refused([*GOOD[:2], "3 1 1000 1 1 1.5 2 2 3 4.5"], 3, COUNT, "got 10"),
    "three-numbers-of-a-quaternion-and-images": refused([f"{line} 0 0 0 0 0 0" for line in GOOD], 1, COUNT, "got 17"),
    "lines-of-several-lengths": refused(
        [GOOD[0], IMAGED[1], GOOD[2]], 2, "all lines must have the same number of columns, got 14 after 11"
    ),
    "an-empty-line": refused([GOOD[0], "", *GOOD[1:]], "(an empty line)", COUNT, "got 0"),
    "id-zero": refused(changed(GOOD, "2 1 1000", "0 1 1000"), 0, must("id", POSITIVE, "0")),
    "id-no-number": refused(changed(GOOD, "2 1 1000", "2.5 1 1000"), "2.5", must("id", POSITIVE, "2.5")),
    "type-too-large": refused(changed(GOOD, "3 2 1000", "3 3 1000"), 3, must("type", TYPE, "3")),
    "density-zero": refused(changed(GOOD, "2 1 1000", "2 1 0"), 2, must("density", "above 0", "0")),
    "shape-negative": refused(changed(GOOD, "1 1.5", "-1 1.5"), 1, must("shapey", "above 0", "-1")),
    "shape-not-finite": refused(changed(GOOD, "1 1.5", "1 inf"), 1, must("shapez", "a finite number", "inf")),
    "blockiness-below-2": refused(
        changed(GOOD, "2 2 0 0 0", "2 1.5 0 0 0"), 2, must("blockiness2", "at least 2", "1.5")
    ),
    "place-no-number": refused(changed(GOOD, "3 4.5 0", "3 4.5. 0"), 3, must("y", "a finite number", "4.5.")),
    "quaternion-zero": refused(
        [*TURNED[:2], f"{GOOD[2]} 0 0 0 0"], 3, must("quatw quatx quaty quatz", "of a length above 0", "0 0 0 0")
    ),
    "quaternion-not-finite": refused([*TURNED[:2], f"{GOOD[2]} 1 0 nan 0"], 3, must("quaty", "a finite number", "nan")),
    "image-out-of-range": refused([*IMAGED[:2], f"{GOOD[2]} 0 512 0"], 3, must("iy", IMAGE, "512")),
    "image-no-whole-number": refused([f"{GOOD[0]} 0.5 0 0", *IMAGED[1:]], 1, must("ix", IMAGE, "0.5")),
    "velocity-of-three": refused(
        [*GOOD, *VELOCITIES, "3 0 0 0"],
        3,
        "expected 7 columns (id vx vy vz omegax omegay omegaz), got 4",
        section="Velocities",
    ),
    "velocity-not-finite": refused(
        [*GOOD, *VELOCITIES, "3 0 0 0 0 nan 0"], 3, must("omegay", "a finite number", "nan"), section="Velocities"
    ),
    "write-own-mass": refusal(
        written("set atom 5 mass 3.0"),
        "write_data: the radius, volume, mass or moments of inertia of grain 5",
        NOT_OF_SHAPE,
        "use write_restart",
    ),
    "write-own-inertia": refusal(
        written("set atom 2 inertiay 3.0", "set atom 7 inertiax 1"), "of grain 2", NOT_OF_SHAPE
    ),
    "write-disk-full": refusal(lambda: Deck(packing(0.0), body=["write_data /dev/full"]), "is the disk full?"),
    "write-own-radius": refusal(written("set atom 9 diameter 1.9"), "of grain 9", NOT_OF_SHAPE),
}

if __name__ == "__main__":
    main(CASES)
