# SPDX-License-Identifier: GPL-2.0-or-later
"""What computes of walls refuse: names of walls that there are not, walls that come or go between runs, models whose
losses are not known."""
from dataclasses import replace

from case import main, require
from deck import Deck, thermo
from packing import dense_packing
from refusal import require_refused
from run import run

SPHERES = dense_packing(atom_style="sphere")
WALL = "all wall/gran {} primitive type 1 {} allow_special_domain_periodic yes"
THERE = "there are floor, side"


def deck(*lines, **choices):
    made = Deck(SPHERES, **choices)
    made.body = [wall("floor", "zplane 0", made), wall("side", "xcylinder 3 5 5", made), *lines]
    return made


def wall(name, shape, made):
    return f"fix {name} " + WALL.format(made.model(), shape)


def refused(*pairs):
    """(lines after the walls, the message) each."""

    def case(ranks):
        for lines, message in pairs:
            require_refused(deck(*lines), ranks, message)

    return case


def contact(words, message):
    return [f"compute w all wall/contact {words}", "run 0"], f"ERROR: compute wall/contact: {message}"


LID = wall("lid", "zplane 40", Deck(SPHERES))
ANY = "'walls' must name walls (a fix wall/gran primitive, or a mesh of one), got"
NAMES = refused(
    contact("walls flor", f"{ANY} 'flor': {THERE}: did you mean 'floor'?"),
    contact("walls floor lid about 0 0 0", f"{ANY} 'lid': {THERE}"),
    contact("walls floor side floor", "'walls' names 'floor' twice"),
    contact("area floor 0", "'area floor' must be an area > 0, got '0'"),
    contact("area floor 3 side", "'area side' must be an area > 0, got ''"),
    contact("area floor 3 floor 3", "'area' names 'floor' twice"),
    contact("walls floor area side 3", "'area' names 'side', which is not one of the chosen walls"),
    (
        ["compute t all wall/triangle walls floor"],
        "ERROR: compute wall/triangle: 'walls' must name meshes of a fix wall/gran, got 'floor': there are none",
    ),
)
GONE = refused(
    (
        ["compute w all wall/contact", "run 1", "unfix side", "run 1"],
        "ERROR: compute wall/contact w: wall 'side' no longer exists: there are floor. Define the compute again",
    ),
    (
        ["compute w all wall/contact", LID, "run 1"],
        "ERROR: compute wall/contact w: wall 'lid' was defined after the compute, which measures all walls",
    ),
)


def come_and_gone(ranks):
    """Walls that it does not name may come and go, and a wall may be made again under its name."""
    floor = wall("floor", "zplane 0", Deck(SPHERES))
    lines = ["compute w all wall/contact walls floor", *thermo(1, "c_w"), "run 1", "unfix side", LID, "run 1"]
    table = run(deck(*lines, "unfix floor", floor, "run 1"), ranks).thermo()
    require(len(table) == 3 and all(t["c_w"].min() > 0.0 for t in table), "the floor bears nothing")


def unknown_losses(ranks):
    """Named, with the way out, which has no such columns."""
    grains = Deck(SPHERES)
    hysteresis = [
        *(
            f"fix {name} all property/global coefficient{name} peratomtypepair 1 {value}"
            for name, value in (("MaxElasticStiffness", 2.0), ("AdhesionStiffness", 0.5), ("PlasticityDepth", 0.1))
        ),
        wall("floor", "zplane 0", replace(grains, normal="hooke/hysteresis")),
    ]
    body = [*hysteresis, "compute w all wall/contact", "run 1"]
    require_refused(
        replace(grains, body=body),
        ranks,
        "ERROR: compute wall/contact: wall 'floor': works with the normal models",
        "change its models, or use 'losses no'",
    )
    body = [*hysteresis, "compute w all wall/contact losses no", *thermo(1, "c_w[9]", "c_w[14]", "c_w[1][14]"), "run 1"]
    require(run(replace(grains, body=body), ranks).thermo()[0]["c_w[9]"].min() > 0.0, "the floor bears nothing")
    body[-1:] = [*thermo(1, "c_w[15]"), "run 1"]
    require_refused(replace(grains, body=body), ranks, "c_w[15]")


CASES = {"names": NAMES, "gone": GONE, "come-and-gone": come_and_gone, "unknown-losses": unknown_losses}

if __name__ == "__main__":
    main(CASES)
