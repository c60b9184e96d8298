# SPDX-License-Identifier: GPL-2.0-or-later
"""surface ellipsoid where the answer is known: spheres, spheroids that meet on their axes, concentric grains, springs
of contacts that open."""
from dataclasses import replace
import math
import re

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, Material, dump_grains, dump_local, thermo
from grainscope.columns import outputs
from oracle.state import ROW_WIDTH, rows_of
from packing import Grain, Packing
from run import run

C_SOLVER = outputs("contact/solver").of("solver")

EDGE, MODULUS = 24.0, YOUNG / (2.0 * (1.0 - POISSON**2))


def boxed(*grains, **choices):
    return Packing((EDGE,) * 3, list(grains), origin=(-0.5 * EDGE,) * 3, triclinic=False, **choices)


def rows_at_once(deck, ranks):
    """The contacts of the state as it is, and the output."""
    deck = replace(
        deck, body=[*deck.body, "compute rows all contact/local", *dump_local("rows", ROW_WIDTH, 1, "rows"), "run 0"]
    )
    result = run(deck, ranks)
    return rows_of(result.dump("rows.dump")[0][1], "rows"), result


def about_y(angle):
    return (math.cos(0.5 * angle), 0.0, math.sin(0.5 * angle), 0.0)


UPRIGHT, LYING = about_y(0.0), about_y(0.5 * math.pi)  # a spheroid's axis along z, along x


def meets(one, two, reach, roundness, overlap=0.01, extra="", axis=0):
    """Two grains at rest, on one line along `axis`, `overlap` deep. `reach`: from each centre to its surface along the
    line; `roundness`: what R* is to be. The point divides the centres' line as the reaches, and the force is 4/3 E*
    sqrt(R* overlap) overlap.
    """

    def case(ranks):
        apart = sum(reach) - overlap
        along = np.eye(3)[axis]
        grains = [replace(g, position=tuple(where * along)) for g, where in zip((one, two), (0.3, 0.3 + apart))]
        rows, _ = rows_at_once(Deck(boxed(*grains), surface="ellipsoid", extra=extra), ranks)
        require(len(rows["fn"]) == 1, f"{len(rows['fn'])} contacts")
        # 1e-13: of the last bit of sums of a few lengths of about 1; the force has 1/100 of them in the overlap.
        require_close(rows["overlap"], [overlap], 1e-13, "overlap", 1.0)
        require_close(rows["normal"][0], -along, 1e-13, "normal", 1.0)
        require_close(rows["point"][0], (0.3 + apart * reach[0] / sum(reach)) * along, 1e-13, "contact point", 1.0)
        require_close(
            rows["fn"], [4.0 / 3.0 * MODULUS * math.sqrt(roundness * overlap) * overlap], 1e-10, "normal force"
        )
        require_close(rows["ft"], np.zeros((1, 3)), 1e-13, "tangential force", rows["fn"][0])

    return case


def equivalent(*shapes):
    """R* of the spheres of equal volume."""
    first, second = (math.prod(s) ** (1.0 / 3.0) for s in shapes)
    return first * second / (first + second)


A, C = 1.0, 1.5  # prolate
OA, OC = 1.2, 0.5  # oblate
PROLATE, OBLATE, SPHERE = (A, A, C), (OA, OA, OC), (0.8, 0.8, 0.8)
BALL, TRIAXIAL = (1.2, 1.2, 1.2), (0.7, 1.0, 1.4)


def grain(shape, quaternion=UPRIGHT):
    return Grain((0.0, 0.0, 0.0), shape, quaternion)


def pole(a, c):
    """Both principal curvatures, where the axis meets the surface."""
    return c / a**2, c / a**2


def equator(a, c):
    return 1.0 / a, a / c**2


def gaussian(*curvatures):
    return 1.0 / sum(math.sqrt(k1 * k2) for k1, k2 in curvatures)


def mean(*curvatures):
    return 1.0 / sum(0.5 * (k1 + k2) for k1, k2 in curvatures)


GAUSSIAN, MEAN = "gaussianCurvature yes curvatureLimitFactor 100", "meanCurvature yes curvatureLimitFactor 100"


def collision(packing, **choices):
    """The same two spheres as ellipsoids and as LIGGGHTS's spheres: the same collision. 1e-9: two integrators' rounding
    in 400 steps."""

    def case(ranks):
        ends = []
        for style in ("superquadric", "sphere"):
            deck = Deck(replace(packing, atom_style=style), surface="ellipsoid", timestep=2e-3, **choices)
            deck.body = [*dump_grains(deck.packing, 400), "run 400"]
            ends.append(run(deck, ranks).dump("grains.dump"))
        (_, found), (_, expected) = ends[0][-1], ends[1][-1]
        require(found["vx"][0] < found["vx"][1], "the spheres did not meet and part")
        for name in ("x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"):
            require_close(found[name], expected[name], 1e-9, name, 1.0)

    return case


def spheres(offset, spin, sizes=(1.0, 1.0)):
    reach = math.sqrt(sum(sizes) ** 2 - offset**2) + 1e-3
    return boxed(
        Grain(
            (-0.5 * reach, -0.5 * offset, 0.0), (sizes[0],) * 3, velocity=(2.0, 0.0, 0.0), omega=(0.0, 0.3 * spin, spin)
        ),
        Grain(
            (0.5 * reach, 0.5 * offset, 0.0),
            (sizes[1],) * 3,
            velocity=(-2.0, 0.0, 0.0),
            omega=(0.2 * spin, 0.0, -0.5 * spin),
        ),
    )


def restitution(ranks):
    """A linear spring and dashpot, e = 0.5: spheres part at half the speed. 1e-3: of the time step, 1/40 of the
    contact."""
    packing = spheres(0.0, 0.0)
    deck = Deck(
        packing, surface="ellipsoid", normal="hooke", timestep=5e-4, body=[*dump_grains(packing, 600), "run 600"]
    )
    last = run(deck, ranks).dump("grains.dump")[-1][1]
    require_close(last["vx"], [-1.0, 1.0], 1e-3, "velocities after", 1.0)


def concentric(shapes, overlap):
    """Two grains in one place: a finite force along the shortest axis of the thinner, `overlap` deep; one warning, one
    fallback."""

    def case(ranks):
        deck = Deck(boxed(*(grain(s) for s in shapes)), surface="ellipsoid")
        counts = ("c_solver", C_SOLVER["pairs_touching"], C_SOLVER["fallbacks"])
        deck.body = ["compute solver all contact/solver", *thermo(1, *counts), *dump_grains(deck.packing, 1)]
        rows, result = rows_at_once(deck, ranks)
        require_close(rows["overlap"], [overlap], 1e-9, "overlap", 1.0)
        require_close(np.linalg.norm(rows["normal"], axis=1), [1.0], 1e-12, "length of the normal", 1.0)
        grains = result.dump("grains.dump")[0][1]
        for name in ("fx", "fy", "fz", "tqx", "tqy", "tqz"):
            require(bool(np.isfinite(grains[name]).all()), f"{name}: {grains[name]}")
        table = result.thermo()[-1]
        require([float(table[name][0]) for name in counts] == [1.0] * 3, f"counts {table}")
        again = run(replace(deck, body=["run 3"]), ranks)
        found = again.output.count("have no regular contact")
        require(found == 1, f"{found} warnings in 4 evaluations")

    return case


def concentric_between_ranks(ranks):
    """Alike but turned, so that the shortest axes differ, and each grain on its own rank: both owners choose the same
    normal."""
    packing = boxed(Grain((-1e-15, 0.0, 0.0), PROLATE, UPRIGHT), Grain((1e-15, 0.0, 0.0), PROLATE, about_y(0.7)))
    deck = Deck(packing, surface="ellipsoid", processors="2 1 1", body=[*dump_grains(packing, 1), "run 0"])
    grains = run(deck, ranks).dump("grains.dump")[0][1]
    force = np.stack([grains[name] for name in ("fx", "fy", "fz")])
    size = np.linalg.norm(force[:, 0])
    require(size > 0.0, "no force")
    require_close(force.sum(axis=1), [0.0] * 3, 1e-12, "sum of the forces", size)


def dipped(pair, ranks, shape):
    """A grain that is swung along x against another and off again, fast, within one neighbour list, while both spin:
    its tangential force. (The host's loop ends a spring where grains are apart but their bounding spheres, 1e-4 larger,
    are not: it is jumped over.)
    """
    one, two = (Grain((x, 0.0, 0.0), shape, omega=(0.0, 0.0, 0.1)) for x in (0.0, 2.0 * shape[0] + 0.06))
    packing = boxed(one, two)
    deck = Deck(
        packing,
        pair=pair,
        surface="ellipsoid",
        contact_distance_factor=1.0,
        timestep=PERIOD / TIMES,
        extra="tangential_damping off",
        material=Material(friction=(1e6,)),
    )
    deck.body = [
        "neighbor 1.0 bin",
        "unfix integrate",
        "group swinging id 2",
        f"fix swing swinging move wiggle -0.2 0 0 {PERIOD}",
        *dump_grains(packing, 1),
        f"run {2 * TIMES}",
    ]
    result = run(deck, ranks)
    require(re.search(r"^Neighbor list builds = 0", result.output, flags=re.M), "a new neighbour list")
    force = np.array([columns["fy"][0] for _, columns in result.dump("grains.dump")])[1:]
    require(np.abs(force).max() > 0.0 and (force == 0.0).sum() > TIMES, "the grains did not touch and part")
    return force[:TIMES], force[TIMES:]


PERIOD, TIMES = 0.2, 40


def no_stale_springs(shape):
    """A contact that opens loses its spring at once, at contact distance factor 1.0 too: the second touch is as the
    first."""

    def case(ranks):
        first, second = dipped("gran/insitu", ranks, shape)
        # 1e-9: the swing comes back to the same place to the last bits, of 2, and the overlap is 1/100 of it.
        require_close(second, first, 1e-9, "tangential force of the second touch")

    return case


def host_keeps_springs(shape):
    """The fault of the host's loop that ours survives: were it gone, the warning and contact_distance_factor would be,
    too."""

    def case(ranks):
        first, second = dipped("gran", ranks, shape)
        require(
            np.abs(second - first).max() > 0.1 * np.abs(first).max(), "pair_style gran has no stale springs any more"
        )

    return case


CASES = {
    "poles-meet": meets(grain(PROLATE, LYING), grain(PROLATE, LYING), (C, C), equivalent(PROLATE, PROLATE)),
    "poles-meet-gaussian": meets(
        grain(PROLATE, LYING), grain(PROLATE, LYING), (C, C), gaussian(pole(A, C), pole(A, C)), extra=GAUSSIAN
    ),
    "poles-meet-mean": meets(
        grain(PROLATE, LYING), grain(PROLATE, LYING), (C, C), mean(pole(A, C), pole(A, C)), extra=MEAN
    ),
    "equators-meet-gaussian": meets(
        grain(PROLATE), grain(PROLATE), (A, A), gaussian(equator(A, C), equator(A, C)), extra=GAUSSIAN
    ),
    "equators-meet-mean": meets(grain(PROLATE), grain(PROLATE), (A, A), mean(equator(A, C), equator(A, C)), extra=MEAN),
    "flat-faces-meet-gaussian": meets(
        grain(OBLATE), grain(OBLATE), (OC, OC), gaussian(pole(OA, OC), pole(OA, OC)), extra=GAUSSIAN, axis=2
    ),
    "flat-faces-meet-mean": meets(
        grain(OBLATE), grain(OBLATE), (OC, OC), mean(pole(OA, OC), pole(OA, OC)), extra=MEAN, axis=2
    ),
    "unlike-grains-meet": meets(grain(PROLATE, LYING), grain(OBLATE), (C, OA), equivalent(PROLATE, OBLATE)),
    "unlike-grains-meet-gaussian": meets(
        grain(PROLATE, LYING), grain(OBLATE), (C, OA), gaussian(pole(A, C), equator(OA, OC)), extra=GAUSSIAN
    ),
    "unlike-grains-meet-mean": meets(
        grain(PROLATE, LYING), grain(OBLATE), (C, OA), mean(pole(A, C), equator(OA, OC)), extra=MEAN
    ),
    "spheres-meet": meets(grain(SPHERE), grain(BALL), (0.8, 1.2), equivalent(SPHERE, BALL)),
    "spheres-meet-mean": meets(grain(SPHERE), grain(BALL), (0.8, 1.2), equivalent(SPHERE, BALL), extra=MEAN, axis=1),
    "sphere-meets-pole-mean": meets(
        grain(SPHERE), grain(PROLATE, LYING), (0.8, C), mean((1.25, 1.25), pole(A, C)), extra=MEAN
    ),
    "triaxial-meets-sphere-gaussian": meets(
        grain(TRIAXIAL),
        grain(SPHERE),
        (1.0, 0.8),
        gaussian((1.0 / 0.7**2, 1.0 / 1.4**2), (1.25, 1.25)),
        extra=GAUSSIAN,
        axis=1,
    ),
    "triaxial-meets-sphere-mean": meets(
        grain(TRIAXIAL),
        grain(SPHERE),
        (1.0, 0.8),
        mean((1.0 / 0.7**2, 1.0 / 1.4**2), (1.25, 1.25)),
        extra=MEAN,
        axis=1,
    ),
    "limit-caps-the-radius": meets(
        grain(OBLATE),
        grain(OBLATE),
        (OC, OC),
        1.3 * equivalent(OBLATE, OBLATE),
        extra="gaussianCurvature yes curvatureLimitFactor 1.3",
        axis=2,
    ),
    "limit-below-one-caps-spheres": meets(
        grain(SPHERE), grain(SPHERE), (0.8, 0.8), 0.5 * 0.4, extra="meanCurvature yes curvatureLimitFactor 0.5"
    ),
    "spheres-collide": collision(spheres(0.8, 1.0)),
    "spheres-collide-head-on": collision(spheres(0.0, 0.0, (0.8, 1.2))),
    "spheres-collide-hooke-no-history": collision(spheres(0.8, 1.0), normal="hooke", tangential="no_history"),
    "spheres-collide-rolling": collision(spheres(0.8, 1.0), rolling="cdt"),
    "spheres-part-at-e": restitution,
    "concentric-spheres": concentric((SPHERE, SPHERE), 1.6),
    "concentric-spheroids": concentric((PROLATE, OBLATE), 2.0),
    "concentric-triaxial": concentric((TRIAXIAL, TRIAXIAL), 1.4),
    "concentric-between-ranks": concentric_between_ranks,
    "no-stale-springs": no_stale_springs((1.0, 1.0, 1.0)),
    "no-stale-springs-of-poles": no_stale_springs((1.5, 1.0, 1.0)),
    "host-keeps-springs": host_keeps_springs((1.0, 1.0, 1.0)),
    "host-keeps-springs-of-poles": host_keeps_springs((1.5, 1.0, 1.0)),
}

if __name__ == "__main__":
    main(CASES)
