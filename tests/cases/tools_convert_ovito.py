# SPDX-License-Identifier: GPL-2.0-or-later
"""Dumps as OVITO sees them: what its reader of LAMMPS dumps makes of the columns' names, by its documentation and its
published source, against the grains of the run. OVITO itself is not needed."""
import math
import re

import numpy as np
from scipy.spatial.transform import Rotation

from case import main, require, require_close, require_equal
from deck import Deck, dump_grains
from dump_files import PAGE, converted, refused
from grainscope.dumps import Dump
from packing import DENSITY, Grain, Packing, dense_packing, tilted
from run import run

SEMI_AXES = [(1.0, 1.0, 1.5), (1.3, 1.3, 0.6), (0.5, 0.9, 1.2), (0.8, 0.8, 0.8)]


def four_grains():
    """Prolate, oblate, triaxial and a sphere in random orientations, and these as rotations."""
    turns = Rotation.random(4, random_state=11)
    places = ((2.0, 2.0, 2.0), (6.0, 2.0, 2.0), (2.0, 6.0, 2.0), (6.0, 6.0, 2.0))
    grains = [
        Grain(place, axes, tuple(map(float, quaternion[[3, 0, 1, 2]])))
        for place, axes, quaternion in zip(places, SEMI_AXES, turns.as_quat())
    ]
    return Packing((8.0, 8.0, 8.0), grains, tilt=1.0), turns.as_matrix()


def as_ovito_maps(columns):
    """Semi-axes and rotations of the grains, by OVITO's rules: c_orient[1] to [4] and quati, quatj, quatk, quatw are x
    y z w of Orientation; c_shape[1] to [3] are Aspherical Shape, c_diameter and shapex to shapez twice that; without
    them a grain is a sphere of its radius, and is not turned. Other columns mean nothing to it."""

    def first(*sets):
        return next((np.transpose([columns[one] for one in names]) for names in sets if names[0] in columns), None)

    shape = first([f"c_shape[{k}]" for k in (1, 2, 3)])
    doubled = first([f"c_diameter[{k}]" for k in (1, 2, 3)], ["shapex", "shapey", "shapez"])
    orientation = first([f"c_orient[{k}]" for k in (1, 2, 3, 4)], ["quati", "quatj", "quatk", "quatw"])
    number = len(columns["id"])
    if shape is None:
        shape = 0.5 * doubled if doubled is not None else np.outer(columns["radius"], [1.0, 1.0, 1.0])
    turns = np.tile(np.eye(3), (number, 1, 1)) if orientation is None else Rotation.from_quat(orientation).as_matrix()
    order = np.argsort(columns["id"])
    return shape[order], turns[order]


def recipe():
    """The lines of the page, for a deck."""
    text = PAGE.read_text()
    found = re.search(r"## OVITO.*?```\n(.*?)```", text, re.S)
    require(found is not None, f"{PAGE}: no code block under '## OVITO'")
    return found[1].replace(" 1000 ", " 10 ").replace("*", "").splitlines()


def page(ranks):
    """The recipe of doc/visualise.md, word for word: sizes and orientations arrive."""
    packing, turns = four_grains()
    lines = recipe()
    result = run(Deck(packing, [*lines, "run 0"]), ranks)
    name = next(line.split()[5] for line in lines if line.startswith("dump "))
    ((_, columns),) = result.dump(name)
    shape, found = as_ovito_maps(columns)
    require_close(shape, SEMI_AXES, 1e-6, "semi-axes")
    require_close(found, turns, 1e-5, "orientations")


def conversion(ranks):
    """quat1 to quat4 and shapex to shapez, which OVITO would not know and halve, become columns that it maps; all
    others, places and boxes of all steps are kept to the last bit."""
    packing, turns = four_grains()
    deck = Deck(packing, [*dump_grains(packing, 10), "run 20"])
    result = run(deck, ranks)
    shape, found = as_ovito_maps(result.dump("grains.dump")[0][1])
    require_close(shape, 0.5 * np.array(SEMI_AXES), 1e-15, "as it is, OVITO halves the grains")
    require_equal(found, np.tile(np.eye(3), (4, 1, 1)), "as it is, OVITO does not turn them")
    converted("grains.dump", "--to", "ovito", "--output", "out.dump", folder=result.folder)
    before, after = Dump(result.file("grains.dump")), Dump(result.file("out.dump"))
    require(before.steps == after.steps == [0, 10, 20], f"{before.steps} {after.steps}")
    for old, new in zip(before, after):
        require_equal(new.box.edges, old.box.edges, "box")
        require_equal(new.box.origin, old.box.origin, "box")
        kept = [name for name in old.columns if not name.startswith(("quat", "shape"))]
        for name in kept:
            require_equal(new[name], old[name], name)
    shape, found = as_ovito_maps(after[0].columns)
    require_close(shape, SEMI_AXES, 1e-15, "semi-axes")
    require_close(found, turns, 1e-12, "orientations")
    text = result.file("out.dump").read_text()
    require(re.search(r"\nITEM: ATOMS .*\n1 1 ", text) is not None, "IDs and types are whole numbers")
    require("ITEM: BOX BOUNDS xy xz yz pp pp pp\n" in text, "the box is triclinic and periodic")


def spheres(ranks):
    """Of a run of spheres, in an orthogonal box too, radii arrive."""
    packing = dense_packing(sizes=(1.0, 0.7), atom_style="sphere")
    for one in (packing, tilted(packing, 0.5)):
        result = run(Deck(one, [*dump_grains(one, 10), "run 0"]), ranks)
        converted("grains.dump", "--to", "ovito", folder=result.folder)
        ((_, columns),) = result.dump("ovito.dump")
        shape, _ = as_ovito_maps(columns)
        radii = np.cbrt(columns["mass"] / (4.0 / 3.0 * math.pi * DENSITY))
        require_close(shape, np.outer(radii, [1, 1, 1]), 1e-12, "radii")


def refusals(ranks):
    packing, _ = four_grains()
    result = run(Deck(packing, [*dump_grains(packing, 10, columns="id x y z shapex shapey shapez"), "run 0"]), ranks)
    words = ["grains.dump", "--to", "ovito"]
    refused("convert", words, "no column quat1, quat2, quat3, quat4", "dump grains all custom", folder=result.folder)
    for option in (["--mesh", "1"], ["--walls", "a.stl"], ["--contacts", "c"]):
        refused("convert", [*words, *option], "--to ovito must be without --contacts", folder=result.folder)
    before = result.file("grains.dump").read_text()
    for path in ("grains.dump", "./grains.dump"):
        named = [*words, "--output", path]
        refused("convert", named, "--output must not be a file that is read, got 'grains.dump'", folder=result.folder)
    require(result.file("grains.dump").read_text() == before, "the dump that was read is as it was")


main({"page": page, "conversion": conversion, "spheres": spheres, "refusals": refusals})
