# SPDX-License-Identifier: GPL-2.0-or-later
"""fabric, contact/surface, contact/direction and contact/grain against the oracle, on sheared packings."""
from dataclasses import replace
import math

from case import main, require, require_close
from deck import Deck, Material
from oracle import comparison
from oracle.state import chosen_rows
from packing import dense_packing, in_the_open, tilted
from watch import Flow, Watched, deforming, pressed, watch

# Sums of some hundred terms in double precision.
EXACT = 1e-10
# A contact across a periodic face, or between ranks, is evaluated by both owners; the host's solver for non-spheres
# stops at about 1e-7, so that the two evaluations (averaged by the computes, one of them in the row) differ by that
# much.
TWO_SIDED = 2e-6
# The same for single grains and bins, where less averages: up to 1e-5 was found over all shapes and coefficients of
# friction.
TWO_SIDED_FEW = 3e-5
# For the same reason such a contact may lie on either side of the edge of a bin.
DOUBT = 1e-4

FABRIC = Watched("fabric", "fabric branch force/normal force/tangential", True, 40)
DIRECTION = Watched("direction", "contact/direction bins 24", array=(24, 9))
GRAIN = Watched("grain", "contact/grain", peratom=7)
POLAR = Watched("polar", "contact/surface", vector=3, array=(10, 17))
PARAMETRIC = Watched("parametric", "contact/surface angle parametric bins 7", vector=3, array=(7, 17))
BY_X = Watched("by_x", "contact/surface axis x", vector=3, array=(10, 17))


def computes_for(packing):
    spheroids = packing.atom_style == "superquadric"
    return [FABRIC, DIRECTION, GRAIN, *([POLAR, PARAMETRIC, BY_X] if spheroids else [])]


def comparisons(moment, computes, doubt):
    printed = moment.vector(FABRIC)
    yield comparison.compare("fabric scalar", moment.scalar(FABRIC), printed[18], 1.0, True)
    between = chosen_rows(moment.rows, "no")
    yield from comparison.of_fabric(printed[:22], between)
    yield from comparison.of_weighted(printed[22:], between)
    yield from comparison.of_direction(moment.array(DIRECTION), between, doubt=doubt)
    yield from comparison.of_grains(moment.peratom(GRAIN), moment.rows, moment.grains, moment.chosen)
    for watched, angle, axis in ((POLAR, "polar", "auto"), (PARAMETRIC, "parametric", "auto"), (BY_X, "polar", "x")):
        if watched in computes:
            yield from comparison.of_surface(moment.array(watched), moment.vector(watched), moment, angle, axis, doubt)


def require_agreement(compared, tolerance, when):
    for c in compared:
        few = (
            c.name.startswith("grain")
            or c.name.startswith(("surface", "direction"))
            and not c.name.endswith("all bins")
        )
        allowed = TWO_SIDED_FEW if tolerance == TWO_SIDED and few else tolerance
        require_close(c.found, c.expected, 0.0 if c.counted else allowed, f"{when}, {c.name}", c.scale)


def agrees(deck, flow=Flow(), group="all", settle=0, fewest=1.0, check=None):
    def case(ranks):
        alone = deck.packing.atom_style == "sphere" or (ranks == 1 and deck.packing.origin != (0.0, 0.0, 0.0))
        tolerance, doubt = (EXACT, 0.0) if alone else (TWO_SIDED, DOUBT)
        computes = computes_for(deck.packing)
        moments = watch(deck, computes, flow, ranks, group, settle=settle)
        require(len(moments) == 5, f"{len(moments)} snapshots")
        for moment in moments:
            require(len(moment.rows["fn"]) >= fewest * moment.chosen.sum(), f"only {len(moment.rows['fn'])} contacts")
            require_agreement(comparisons(moment, computes, doubt), tolerance, f"step {moment.step}")
        if check:
            check(moments)

    return case


def undamped(packing, **choices):
    return Deck(packing, extra="tangential_damping off", **choices)


def cluster(alpha, **choices):
    return in_the_open(dense_packing(alpha, speed=0.1, **{"overlap": 0.05, **choices}))


def flipped(moments):
    tilts = [m.box.edges[0, 1] for m in moments]
    require(tilts[0] > 0.0 > tilts[-1], f"no flip: the tilt went from {tilts[0]} to {tilts[-1]}")


def flipping(alpha, **choices):
    """Through a flip of the box, half-way through the steps that are looked at. First off the lattice, whose normals
    fall on the edges of bins."""
    deck = undamped(tilted(dense_packing(alpha, **choices), 0.499))
    lx, ly, _ = deck.packing.edges
    return agrees(deck, deforming(0.002 * lx / ly / (20 * deck.dt())), settle=5, check=flipped)


def length_moved(moments):
    require(abs(moments[-1].box.edges[1, 1] - moments[0].box.edges[1, 1]) > 1e-6, "L_y did not move")


def about_body_x(packing):
    """The same grains with the axis of symmetry along x of their own frames."""

    def turned(grain):
        w, x, y, z = grain.quaternion
        root = math.sqrt(0.5)  # times a turn by -90 degrees about y, which takes x to z
        a, _, c = grain.semi_axes
        return replace(
            grain, semi_axes=(c, a, a), quaternion=(root * (w + y), root * (x + z), root * (y - w), root * (z - x))
        )

    return replace(packing, grains=[turned(g) for g in packing.grains])


def walled():
    """Between two walls, whose contacts contact/grain alone counts by default."""
    packing = replace(dense_packing(atom_style="sphere"), triclinic=False)
    wall = "wall/gran model hertz tangential history primitive type 1 zplane"
    low, high = 0.1, packing.edges[2] - 0.1
    return Deck(
        packing,
        boundary="p p f",
        extra="tangential_damping off",
        body=[f"fix floor all {wall} {low}", f"fix ceiling all {wall} {high}"],
    )


def friction(mu):
    return Material(friction=(mu,))


TWO_MATERIALS = Material(young=(5e6, 2e7), restitution=(0.3, 0.5, 0.5, 0.8), friction=(0.05, 0.2, 0.2, 0.9))
SIZES = (0.8, 1.0, 1.2)
FLOW = deforming(0.05)
CASES = {
    "spheres": agrees(undamped(dense_packing(atom_style="sphere")), FLOW, settle=100),
    "spheres-mu-0": agrees(undamped(dense_packing(atom_style="sphere"), material=friction(0.0)), FLOW, settle=100),
    "spheres-mu-10": agrees(undamped(dense_packing(atom_style="sphere"), material=friction(10.0)), FLOW, settle=100),
    "spheres-polydisperse": agrees(
        undamped(dense_packing(atom_style="sphere", sizes=SIZES, overlap=0.1)), FLOW, settle=100
    ),
    **{f"spheroid-{alpha:g}-in-the-open": agrees(undamped(cluster(alpha))) for alpha in (0.33, 0.67, 1.5, 3.0)},
    # Off the lattice first, whose normals fall on the edges of bins.
    "spheroid-1-in-the-open": agrees(undamped(cluster(1.0, overlap=0.02)), settle=5),
    "spheroid-1.5-mu-0": agrees(undamped(cluster(1.5), material=friction(0.0))),
    "spheroid-1.5-mu-10": agrees(undamped(cluster(1.5), material=friction(10.0))),
    "spheroid-1.5": agrees(undamped(dense_packing(1.5)), FLOW, settle=100),
    "spheroid-0.33": agrees(undamped(dense_packing(0.33)), FLOW, settle=100),
    "polydisperse": agrees(undamped(cluster(1.5, sizes=SIZES, overlap=0.1))),
    "two-types": agrees(undamped(cluster(1.5, types=2), material=TWO_MATERIALS)),
    "with-tangential-damping": agrees(Deck(cluster(1.5))),
    "no-history": agrees(undamped(cluster(1.5), tangential="no_history")),
    "spheres-through-a-flip": flipping(1.0, atom_style="sphere"),
    "spheroids-through-a-flip": flipping(1.5),
    "tilted-backward": agrees(
        undamped(tilted(dense_packing(atom_style="sphere"), -0.48)), deforming(-0.05), settle=100
    ),
    "under-pressure-control": agrees(
        undamped(dense_packing(atom_style="sphere")), pressed(0.05), settle=100, check=length_moved
    ),
    "subgroup": agrees(undamped(cluster(1.5)), group="20:80", fewest=0.5),
    "group-of-one": agrees(undamped(cluster(1.5)), group="20:20", fewest=0.0),
    "axis-along-body-x": agrees(undamped(about_body_x(cluster(1.5)))),
    "walls": agrees(walled(), settle=5, fewest=0.5),
    "units-cgs": agrees(replace(undamped(cluster(1.5), material=Material(young=(5e7,))), units="cgs")),
}

if __name__ == "__main__":
    main(CASES)
