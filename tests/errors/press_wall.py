# SPDX-License-Identifier: GPL-2.0-or-later
"""What fix press/wall refuses because of the mesh, of other movers, the grains, the box, models and variables."""
from dataclasses import replace

from case import main
from plates import bed, plated, press
from refusal import require_refused

WHO = "ERROR: fix press/wall: "
GOOD = press(1e4)
MOVE = "fix swing all move/mesh mesh plate linear 0 0 0.1"
HYSTERESIS = [
    f"fix {name} all property/global coefficient{name} peratomtypepair 1 {value}"
    for name, value in (("MaxElasticStiffness", 5.0), ("AdhesionStiffness", 0.5), ("PlasticityDepth", 0.3))
]


def deck(*lines, mesh="mesh/surface", boundary="p p f", packing=None, more="", **choices):
    """`more`: at the end of the mesh's line."""
    made = plated(packing or bed(across=3, layers=2), mesh, boundary, **choices)
    made.body = [line + more if line.startswith("fix plate") else line for line in made.body]
    made.body += [*lines, "run 1"]
    return made


def refused(*triples):
    """(deck, words of the message) each."""

    def case(ranks):
        for made, words in triples:
            require_refused(made, ranks, words)

    return case


def moved_up(packing, distance):
    """With half of the grains above the plate."""
    grains = [
        replace(g, position=(*g.position[:2], g.position[2] + distance)) if k % 2 else g
        for k, g in enumerate(packing.grains)
    ]
    return replace(packing, grains=grains)


def open_sideways():
    """Without the floor, which is only let be in a periodic box."""
    made = deck(GOOD, boundary="s f f")
    made.body = [line for line in made.body if not line.startswith("fix floor")]
    return made


def without_grains():
    empty = replace(bed(across=3, layers=2), grains=[])
    return deck("atom_modify sort 0 0", press(1e4, "every/step 5 toward -"), packing=empty, timestep=1e-3)


def leaning():
    tilted = replace(bed(3, 2), triclinic=True, tilt=1.0)
    made = deck(GOOD.replace("axis z", "axis x"), boundary="f p p", packing=tilted)
    made.body = [
        line.replace("meshes plate", "meshes plate allow_special_domain_periodic yes")
        for line in made.body
        if not line.startswith("fix floor")
    ]
    return made


CASES = {
    "mesh": refused(
        (
            deck(GOOD.replace("mesh plate", "mesh plat")),
            WHO + "'mesh' must name a mesh of a fix wall/gran, got 'plat': there are plate: did you mean 'plate'?",
        ),
        (
            deck(GOOD.replace("mesh plate", "mesh floor")),
            "must name a mesh of a fix wall/gran, got 'floor': there are plate",
        ),
        (
            deck(GOOD, more=" surface_vel 0.5 0 0"),
            WHO + "mesh 'plate' has the surface velocity of a conveyor belt, but a plate must have the velocity of "
            "its motion",
        ),
        (
            deck(GOOD, "run 1", "unfix lid"),
            WHO + "'mesh' must name a mesh of a fix wall/gran, got 'plate': there are none",
        ),
        (
            deck(GOOD, "run 1", "unfix lid", "unfix plate"),
            "may not unfix a moving mesh while a fix move is applied to it",
        ),
    ),
    "second-mover": refused(
        (deck(MOVE, GOOD), WHO + "mesh 'plate' is moved by fix swing too: remove one of them"),
        (deck(GOOD, MOVE), WHO + "mesh 'plate' is moved by fix swing too: remove one of them"),
        (deck(GOOD, GOOD.replace("fix press", "fix two")), WHO + "mesh 'plate' is moved by fix press too"),
        (
            deck(
                GOOD,
                mesh="mesh/surface/stress/servo",
                more=" com 0 0 0 ctrlPV force axis 0 0 -1 target_val 10.0 vel_max 0.1 kp 5.0",
            ),
            WHO
            + "mesh 'plate' moves by itself (mesh/surface/stress/servo): use a fix mesh/surface or mesh/surface/stress",
        ),
    ),
    "grains": refused(
        (
            deck(GOOD, packing=moved_up(bed(3, 2), 2.3)),
            WHO + "'toward +' or 'toward -' is required where the grains of its group are not all on one side of the "
            "mesh, got 9 below it along the axis, 9 above it, and 0 between its ends",
        ),
        (
            deck(press(1e4, "every/step 5 toward +")),
            WHO + "mesh 'plate' is pushed toward +, but all 18 grains are on its other side",
        ),
        (deck("group none id 1000", GOOD.replace("press all", "press none")), "got 0 below it"),
        (
            without_grains(),
            WHO + "'limit' and a distance are required: the default is the size of the grains, and there are none yet",
        ),
    ),
    "speed": refused(
        (
            deck(press(1e4, "every/step 2 limit 0.5")),
            WHO + "'limit' and 'maxrate' must keep the motion of the plate in a step at or below half of the "
            "neighbour skin, 0.1, got 0.25",
        ),
    ),
    "box": refused(
        (
            deck(GOOD, boundary="p p p"),
            WHO + "the box must not be periodic along 'axis z', because grains would be on both sides of the plate",
        ),
        (
            open_sideways(),
            WHO + "'area box' cannot be used, because the box is shrink-wrapped along x: give the area of",
        ),
        (
            leaning(),
            WHO + "'area box' cannot be used, because the box is not at right angles to the axis along y: give the",
        ),
    ),
    "leaves-the-box": refused(
        (
            deck(
                "group none id 1000",
                press(1e4, "every/step 1 limit 0.05 maxrate 1e3 toward +").replace("press all", "press none"),
                "unfix integrate",
                "run 400",
            ),
            WHO + "mesh 'plate' would leave the box, at z = ",
        )
    ),
    "pair": refused((deck(GOOD, pair="gran"), "fix press/wall requires pair_style gran/insitu, got 'gran'")),
    "unknown-model": refused(
        (
            deck(*HYSTERESIS, GOOD, normal="hooke/hysteresis"),
            WHO + "'gain auto' works with the normal models hertz, hooke, hertz/stiffness and "
            "hooke/stiffness only: give a number, or change the models of wall 'plate', got 'model hooke/hysteresis",
        )
    ),
    "variables": refused(
        (deck(press("v_no")), WHO + "'target' must be an equal-style variable that is defined, got 'v_no'"),
        (
            deck("variable low equal 2-step", press("v_low"), "run 5"),
            WHO + "'target' must be a positive number, got 'v_low = 0'",
        ),
    ),
}

if __name__ == "__main__":
    main(CASES)
