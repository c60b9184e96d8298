# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls with surface ellipsoid: the host's own contact of a superquadric with a wall, to the last bit; walls beside
contacts of grains."""
from dataclasses import replace
import math
import os
from pathlib import Path
import tempfile

import numpy as np

from case import main, require, require_same_snapshots
from deck import Deck, dump_grains
from packing import Grain, Packing
from run import run

STEPS = 250
GRAVITY = "fix gravity all gravity 9.81 vector 0.1 0 -1"
FLOOR = [(-12.0, -12.0), (12.0, -12.0), (12.0, 12.0), (-12.0, 12.0)]


def floor_file(folder):
    """Two triangles at z = 0."""
    lines = ["solid floor"]
    for corners in ((0, 1, 2), (0, 2, 3)):
        lines += [
            "facet normal 0 0 1",
            "outer loop",
            *(f"vertex {FLOOR[k][0]} {FLOOR[k][1]} 0" for k in corners),
            "endloop",
            "endfacet",
        ]
    (folder / "floor.stl").write_text("\n".join([*lines, "endsolid floor"]) + "\n")


def run_in_folder_with_floor(deck, ranks):
    folder = Path(tempfile.mkdtemp(prefix="walls-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    floor_file(folder)
    return run(deck, ranks, folder=folder)


def walls(deck, kind):
    wall = f"fix wall all wall/gran {replace(deck, extra='').model()}"
    return {
        "plane": [f"{wall} primitive type 1 zplane 0.0 {deck.extra}"],
        "cylinder": [f"{wall} primitive type 1 zcylinder 2.0 0. 0. {deck.extra}"],
        "mesh": [
            "fix floor all mesh/surface file floor.stl type 1",
            f"{wall} mesh n_meshes 1 meshes floor {deck.extra}",
        ],
    }[kind]


def thrown(shape, kind):
    """One grain, aslant, spinning, thrown at the wall."""
    turned = (math.cos(0.4), math.sin(0.4) * 0.6, math.sin(0.4) * 0.8, 0.0)
    height = 1.02 * max(shape) if kind != "cylinder" else 5.0
    velocity = (1.0, 0.0, -2.0) if kind != "cylinder" else (5.0, 1.0, 0.0)
    grain = Grain((0.0, 0.0, height), shape, turned, velocity, (1.0, 2.0, 3.0))
    return Packing((24.0, 24.0, 48.0), [grain], origin=(-12.0, -12.0, -24.0), triclinic=False)


def as_superquadric(kind, shape=(1.0, 1.0, 1.5), extra="", **choices):
    def case(ranks):
        deck = Deck(thrown(shape, kind), boundary="f f f", extra=extra, **choices)
        ends = []
        for surface in ("ellipsoid", "superquadric"):
            d = replace(deck, surface=surface)
            d.body = [GRAVITY, *walls(d, kind), *dump_grains(d.packing, 5), f"run {STEPS}"]
            ends.append(run_in_folder_with_floor(d, ranks).dump("grains.dump"))
        require_same_snapshots(*ends, f"surface ellipsoid on a {kind} against surface superquadric")
        sideways = np.array([columns["omegay"][0] for _, columns in ends[0]])
        require(abs(sideways - sideways[0]).max() > 0.1, "the grain never met the wall")

    return case


def pile(ranks):
    """Grains of several shapes fall on a mesh inside a cylinder, and on each other: alike in the host's loop and in
    ours."""
    shapes = ((1.0, 1.0, 1.5), (0.9, 0.9, 0.5), (0.8, 0.8, 0.8), (0.7, 0.9, 1.2))
    grains = [
        Grain(
            (0.1 * k - 0.2, 0.1 - 0.05 * k, 1.8 + 2.1 * k),
            shapes[k % 4],
            velocity=(0.0, 0.0, -5.0),
            omega=(1.0, 0.5, 0.0),
        )
        for k in range(8)
    ]
    packing = Packing((24.0, 24.0, 24.0), grains, origin=(-12.0, -12.0, -2.0), triclinic=False)
    deck = Deck(packing, boundary="f f f", surface="ellipsoid")
    cylinder = walls(deck, "cylinder")[0].replace("fix wall", "fix side")
    deck.body = [GRAVITY, *walls(deck, "mesh"), cylinder, *dump_grains(packing, 1500), "run 1500"]
    own, plain = (
        run_in_folder_with_floor(replace(deck, pair=pair), ranks).dump("grains.dump")
        for pair in ("gran/insitu", "gran")
    )
    require_same_snapshots(own, plain, "gran/insitu against gran")
    last = own[-1][1]
    require(last["z"].min() > 0.3, "a grain fell through the floor")
    require(np.hypot(last["x"], last["y"]).max() < 1.8, "a grain left the cylinder")


LIMIT = "curvatureLimitFactor 2"
CASES = {
    **{
        f"{name}-on-a-{kind}": as_superquadric(kind, shape)
        for kind in ("plane", "cylinder", "mesh")
        for name, shape in (("prolate", (1.0, 1.0, 1.5)), ("oblate", (1.0, 1.0, 0.5)), ("triaxial", (0.7, 1.0, 1.3)))
    },
    "sphere-on-a-plane": as_superquadric("plane", (1.0, 1.0, 1.0)),
    **{
        f"{name}-on-a-{kind}": as_superquadric(kind, extra=extra)
        for kind in ("plane", "mesh")
        for name, extra in (
            ("gaussian-curvature", f"gaussianCurvature yes {LIMIT}"),
            ("mean-curvature", f"meanCurvature yes {LIMIT}"),
            ("limit-alone", LIMIT),
        )
    },
    "pile": pile,
}

if __name__ == "__main__":
    main(CASES)
