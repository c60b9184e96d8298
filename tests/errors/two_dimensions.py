# SPDX-License-Identifier: GPL-2.0-or-later
"""With `dimension 2`: what has to do with z, superquadrics, grains that leave the plane, and walls that do not stand on
it are refused by name."""
from dataclasses import replace

from case import main
from deck import Deck, dump_grains
import meshes
from packing import Grain, disc_packing
from refusal import require_refused
from run import run

PACKING = disc_packing(rows=6)
IN_THE_PLANE = "with 'dimension 2', got"
KEYWORDS = (
    ("compute c all stress/contact plane yz", f"compute stress/contact: 'plane' must be xy {IN_THE_PLANE} 'yz'"),
    (
        "compute c all stress/contact pressure z",
        f"compute stress/contact: 'pressure' must be x, y or mean {IN_THE_PLANE} 'z'",
    ),
    ("compute c all nematic plane xz", f"compute nematic: 'plane' must be xy {IN_THE_PLANE} 'xz'"),
    ("compute c all fabric plane xz", f"compute fabric: 'plane' must be xy {IN_THE_PLANE} 'xz'"),
    ("compute c all contact/direction plane yz", f"compute contact/direction: 'plane' must be xy {IN_THE_PLANE} 'yz'"),
    ("compute c all fluctuation plane xz", f"compute fluctuation: 'plane' must be xy {IN_THE_PLANE} 'xz'"),
    ("compute c all velocity/correlation plane yz", f"'plane' must be xy {IN_THE_PLANE} 'yz'"),
    ("compute c all velocity/correlation component vz", f"'component' must be vx, vy or wz {IN_THE_PLANE} 'vz'"),
    ("compute c all velocity/correlation component wx", f"'component' must be vx, vy or wz {IN_THE_PLANE} 'wx'"),
    ("compute c all velocity/memory component wy", f"'component' must be vx, vy or wz {IN_THE_PLANE} 'wy'"),
    ("compute c all layering axis z", f"compute layering: 'axis' must be x or y {IN_THE_PLANE} 'z'"),
    ("compute c all contact/surface", "compute contact/surface: needs three dimensions, got 'dimension 2'"),
    (
        "fix p all press/strain axis z target 1e5 every/step 10",
        f"fix press/strain: 'axis' must be x or y {IN_THE_PLANE} 'z'",
    ),
    (
        "fix p all press/strain axis y target 1e5 shear xz rate 0.1 every 1e-3",
        f"fix press/strain: 'shear' must be xy {IN_THE_PLANE} 'xz'",
    ),
)


def discs(*lines, **choices):
    return Deck(choices.pop("packing", PACKING), body=[*lines, "run 1"], **choices)


def keywords(ranks):
    for line, words in KEYWORDS:
        require_refused(discs(line), ranks, words)


def superquadrics(ranks):
    """By name before there is one; LIGGGHTS refuses to make them."""
    deck = discs(packing=replace(PACKING, grains=[], atom_style="superquadric"), timestep=1e-3)
    for line, style in (
        ("compute c all nematic", "compute nematic"),
        ("compute c all fluctuation", "compute fluctuation"),
        ("fix turn all nve/spheroid", "fix nve/spheroid"),
    ):
        require_refused(
            replace(deck, body=["unfix integrate", line, "run 0"]),
            ranks,
            f"{style}: needs atom_style sphere with 'dimension 2', got 'superquadric'",
        )


def out_of_plane(ranks):
    """Grains at two heights; one that moves along z, or spins about x, and nothing holds it."""
    high = "set atom 3 z 0.01"
    require_refused(discs(high), ranks, "pair_style gran/insitu: with 'dimension 2' all grains must be at one z, got")
    for motion in ("vz 0.1", "omegax 0.1", "omegay 0.1"):
        require_refused(
            discs("unfix plane", f"set atom 3 {motion}"),
            ranks,
            "got 1 that move so and are not held by a fix enforce2d",
        )
        run(discs(f"set atom 3 {motion}"), ranks)  # held


def walls(ranks):
    packing = replace(PACKING, triclinic=False)
    for words in ("zplane 0.5", "xcylinder 3.0 4.0 0.0"):
        deck = discs(packing=packing)
        wall = f"fix wall all wall/gran {deck.model()} primitive type 1 {words}"
        require_refused(
            replace(deck, body=[wall, "run 1"]),
            ranks,
            "fix wall/gran wall: 'primitive' must be xplane, yplane or zcylinder with 'dimension 2', got "
            f"'{words.split()[0]}'",
        )


def mesh_walls(ranks):
    """A triangle that leans; one that stands has forces and no area."""
    standing = meshes.rectangle((-1.0, -0.2, -1.0), (20.0, 0.0, 0.0), (0.0, 0.0, 2.0))
    leaning = meshes.rectangle((-1.0, -0.2, -1.0), (20.0, 0.0, 0.0), (0.0, 0.1, 2.0))
    folder = meshes.folder_with(standing=standing, leaning=leaning)
    packing = replace(PACKING, triclinic=False)
    deck = discs(packing=packing, boundary="p f p")

    def lines(name):
        return [
            f"fix mesh all mesh/surface file {name}.stl type 1",
            f"fix wall all wall/gran {deck.model()} mesh n_meshes 1 meshes mesh",
        ]

    for name, more, words in (
        (
            "leaning",
            "compute c all wall/contact",
            "the triangles of a mesh must be parallel to z, got others in mesh 'mesh'",
        ),
        ("standing", "compute c all wall/triangle", "compute wall/triangle: needs three dimensions, got 'dimension 2'"),
    ):
        require_refused(replace(deck, body=[*lines(name), more, "run 1"]), ranks, words, folder=folder)


def small_box(ranks):
    """Depth does not count, heights in the plane do."""
    grains = [Grain((1.0, 1.0, 0.0))]
    deck = discs(packing=replace(PACKING, grains=grains, edges=(20.0, 4.0, 1.0)))
    require_refused(deck, ranks, "high along y, got 4")
    run(discs(*dump_grains(PACKING, 1)), ranks)


main(
    {
        "keywords": keywords,
        "superquadrics": superquadrics,
        "out-of-plane": out_of_plane,
        "walls": walls,
        "mesh-walls": mesh_walls,
        "small-box": small_box,
    }
)
