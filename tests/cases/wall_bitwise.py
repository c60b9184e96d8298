# SPDX-License-Identifier: GPL-2.0-or-later
"""fix wall/gran moves the grains exactly as LIGGGHTS's own, which a program made for that has in its place: with
pair_style gran, and with gran/insitu, alone and while every measure asks in every step. Primitive walls of all kinds
that move or not, meshes that stand, move, turn, convey and are stressed, for the contact models that there are."""
from dataclasses import replace
import os

import numpy as np

from case import main, require, require_same_snapshots
from deck import Deck, dump_grains, thermo
import meshes
from packing import Grain, Packing
from run import run

STEPS = 300
HALF = 4.5  # of the room that the grains fall about in
GRAVITY = "fix gravity all gravity 9.81 vector 0.3 -0.2 -1"
SHAPES = {"default": (1.0, 1.0, 1.0), "superquadric": (1.0, 1.0, 1.5), "ellipsoid": (1.0, 1.0, 0.6)}

PLANES = [
    f"primitive type 1 {axis}plane {side * HALF}{moving}"
    for axis, side, moving in (
        ("x", -1, ""),
        ("x", 1, " shear y 1.0"),
        ("y", -1, ""),
        ("y", 1, ""),
        ("z", -1, " shear x -2.0"),
        ("z", 1, ""),
    )
]
CYLINDERS = [
    f"primitive type 1 {axis}cylinder {HALF} 0.0 0.0{moving}"
    for axis, moving in (("x", " shear x 1.0"), ("y", " shear z 0.5"), ("z", ""))
]
ROOM = meshes.box((-HALF,) * 3, (HALF,) * 3)
FLOOR = meshes.rectangle((-HALF, -HALF, -HALF + 0.1), (2 * HALF, 0.0, 0.0), (0.0, 2 * HALF, 0.0))
LID = meshes.rectangle((-HALF, -HALF, HALF - 0.1), (2 * HALF, 0.0, 0.0), (0.0, 2 * HALF, 0.0))
DRUM = meshes.drum(HALF, -HALF, HALF)
# name -> (words of primitive walls, or meshes as name: style and keywords; further lines)
WALLS = {
    "planes": (PLANES, []),
    "cylinders": (CYLINDERS, []),
    "mesh": ({"room": "mesh/surface"}, []),
    "moving-mesh": (
        {"room": "mesh/surface", "lid": "mesh/surface"},
        ["fix move all move/mesh mesh lid linear 0.1 0.2 -1.0"],
    ),
    "drum": (
        {"drum": "mesh/surface/stress"},
        ["fix move all move/mesh mesh drum rotate origin 0.3 0 -0.2 axis 0 1 0 period 4.0"],
    ),
    "conveyor": (
        {
            "room": "mesh/surface/stress",
            "floor": "mesh/surface surface_vel 2.0 0.5 0.0",
            "lid": "mesh/surface surface_ang_vel origin 0 0 0 axis 0 0 1 omega 2.0",
        },
        [],
    ),
}
MESHES = {"room": ROOM, "floor": FLOOR, "lid": LID, "drum": DRUM}
MODELS = {
    "hooke": {"normal": "hooke"},
    "no-history": {"tangential": "no_history"},
    "frictionless": {"tangential": "off"},
    "rolling-epsd2": {"rolling": "epsd2"},
    "rolling-cdt": {"rolling": "cdt"},
    "sjkr": {"cohesion": "sjkr"},
    "hooke-no-history-cdt-sjkr": {
        "normal": "hooke",
        "tangential": "no_history",
        "rolling": "cdt",
        "cohesion": "sjkr",
    },
}
WATCHING = [
    "compute stress all stress/contact",
    "compute now all dissipation mode instantaneous",
    "compute loss all dissipation",
    "compute texture all fabric walls yes",
    "compute rose all contact/direction walls yes",
    "compute each all contact/grain",
    "compute worst all reduce max c_each[5]",
    "compute rows all contact/local wall",
    "compute walls all reduce max c_rows",
    *thermo(1, "c_stress", "c_stress[36]", "c_now", "c_loss", "c_texture", "c_rose[1][2]", "c_worst", "c_walls"),
]


def thrown(surface):
    """Grains that fly about in the room."""
    random = np.random.default_rng(5)
    grains = []
    for k in range(18):
        x, y, z = k % 3, (k // 3) % 3, k // 9
        turned = random.normal(size=4)
        grains.append(
            Grain(
                tuple(2.6 * (np.array([x, y, 1.2 * z]) - [1.0, 1.0, 0.6])),
                SHAPES[surface],
                tuple(turned / np.linalg.norm(turned)) if surface != "default" else (1.0, 0.0, 0.0, 0.0),
                tuple(5.0 * random.normal(size=3)),
                tuple(random.normal(size=3)),
            )
        )
    style = "sphere" if surface == "default" else "superquadric"
    return Packing((20.0,) * 3, grains, atom_style=style, origin=(-10.0,) * 3, triclinic=False)


def scene(kind, surface, **model):
    deck = Deck(thrown(surface), boundary="f f f", surface=surface, **model)
    wall, (shapes, more) = f"wall/gran {deck.model()}", WALLS[kind]
    if isinstance(shapes, list):
        walls = [f"fix wall{k} all {wall} {words}" for k, words in enumerate(shapes)]
    else:
        walls = []
        for name, words in shapes.items():
            style, *keywords = words.split()
            walls.append(f"fix {name} all {style} file {name}.stl type 1 {' '.join(keywords)}")
        walls.append(f"fix walls all {wall} mesh n_meshes {len(shapes)} meshes {' '.join(shapes)}")
    deck.body = [GRAVITY, *walls, *more, *dump_grains(deck.packing, STEPS // 3)]
    return deck


def require_same(kind, surface, ranks, **model):
    """The dumped motion of four runs; the walls are touched in many steps."""
    deck, files = scene(kind, surface, **model), {name: MESHES[name] for name in WALLS[kind][0] if name in MESHES}

    def moved(pair, more=(), program=None):
        body = [*deck.body, *more, f"run {STEPS}"]
        return run(replace(deck, pair=pair, body=body), ranks, folder=meshes.folder_with(**files), program=program)

    host = moved("gran", program=os.environ["GRAINSCOPE_HOST_WALLS"]).dump("grains.dump")
    watched = moved("gran/insitu", WATCHING)
    for what, result in (
        ("pair_style gran", moved("gran")),
        ("gran/insitu", moved("gran/insitu")),
        ("gran/insitu, asked in each step", watched),
    ):
        require_same_snapshots(result.dump("grains.dump"), host, f"{kind}, {surface}, {model}: {what} against the host")
    touching = watched.thermo()[0]["c_stress[36]"]
    require((touching > 0).mean() > 0.2, f"{kind}, {surface}, {model}: walls are touched in {(touching > 0).mean()}")


def walls_of(surface):
    def case(ranks):
        for kind in WALLS:
            require_same(kind, surface, ranks)

    return case


def models_of(surface):
    def case(ranks):
        for model in MODELS.values():
            require_same("planes", surface, ranks, **model)
            require_same("moving-mesh", surface, ranks, **model)

    return case


CASES = {f"walls-{surface}": walls_of(surface) for surface in SHAPES} | {
    f"models-{surface}": models_of(surface) for surface in SHAPES
}

if __name__ == "__main__":
    main(CASES)
