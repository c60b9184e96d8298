# SPDX-License-Identifier: GPL-2.0-or-later
"""Cohesion sjkr and sjkr2 of ellipsoids: LIGGGHTS takes their contact area from the distance of the centres and the
radii of spheres; surface ellipsoid gives it the contact's own overlap and effective radius. Forces of two grains at
rest against A = pi (radius of the circle in which two spheres of that overlap and effective radius meet)^2, which is 2
pi R* delta to first order, and against Hertz."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, Material, dump_grains
from ellipsoid_walls import run_in_folder_with_floor
from packing import Grain, Packing
from run import run

A, C = 1.0, 1.5  # semi-axes
OVERLAP = 1e-3
ENERGY = 1e5
TURNED = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)  # body z along x
CURVED = "gaussianCurvature yes curvatureLimitFactor 100"
WARNING = "takes its geometry from the distance of centres and the radii of spheres"
# Positions are 1 and overlaps 1e-3: a difference of rounding 1e-16/1e-3, and the solver's own.
ROUNDING = 1e-11


def pair(first, second):
    """Two grains along x with that overlap: (semi-axes, quaternion, half-width along x) each, their contact at the
    origin."""
    grains = [
        Grain((side * (width - 0.5 * OVERLAP), 0.0, 0.0), axes, quaternion)
        for side, (axes, quaternion, width) in zip((-1, 1), (first, second))
    ]
    return Packing((24.0, 24.0, 24.0), grains, origin=(-12.0, -12.0, -12.0), triclinic=False)


POLE, SIDE = ((A, A, C), TURNED, C), ((A, A, C), (1.0, 0.0, 0.0, 0.0), A)
BALL, SMALL = ((1.2, 1.2, 1.2), (1.0, 0.0, 0.0, 0.0), 1.2), ((0.6, 0.6, 0.9), TURNED, 0.9)


def radius_of_volume(side):
    return np.cbrt(np.prod(side[0]))


def radius_of_curvature(side):
    """One over the root of the Gaussian curvature where the x axis leaves the grain."""
    a, _, c = side[0]
    return a * a / c if side[1] == TURNED else a * c / a


def area(model, r1, r2):
    """Of two spheres with that overlap."""
    if model == "sjkr2":
        return 2.0 * math.pi * 2.0 * r1 * r2 / (r1 + r2) * OVERLAP
    distance = r1 + r2 - OVERLAP
    height = (distance**2 + r1**2 - r2**2) / (2.0 * distance)
    return math.pi * (r1**2 - height**2)


def hertz(effective, modulus=0.5 * YOUNG / (1 - POISSON**2)):
    return 4.0 / 3.0 * modulus * math.sqrt(effective * OVERLAP) * OVERLAP


def at_rest(packing, *body, **choices):
    choices.setdefault("surface", "ellipsoid")
    return Deck(
        packing,
        boundary="f f f",
        material=Material(cohesion=(ENERGY,)),
        contact_distance_factor=1.05,
        body=[*body, *dump_grains(packing, 1), "run 0"],
        **choices,
    )


def force(deck, ranks):
    """That pushes the second grain along x."""
    columns = run(deck, ranks).dump("grains.dump")[0][1]
    require_close(columns["fx"][0], -columns["fx"][-1], ROUNDING, "action and reaction")
    return columns["fx"][-1]


def attracts(first, second, radius=radius_of_volume, cohesion="sjkr", **choices):
    """`radius`: what the effective radius R* of the two grains is made of. Spheres that are lent have it, in the ratio
    of those of equal volume."""

    def case(ranks):
        found = force(at_rest(pair(first, second), cohesion=cohesion, **choices), ranks)
        r1, r2 = radius_of_volume(first), radius_of_volume(second)
        k1, k2 = radius(first), radius(second)
        effective = k1 * k2 / (k1 + k2)
        scale = effective * (r1 + r2) / (r1 * r2)
        cohesive = ENERGY * area(cohesion, scale * r1, scale * r2)
        require_close(found, hertz(effective) - cohesive, ROUNDING, "force", cohesive)
        first_order = (1 if cohesion == "sjkr" else 2) * 2.0 * math.pi * effective * OVERLAP * ENERGY
        # Two spheres lack a share below OVERLAP/R* of the area to first order.
        require_close(cohesive, first_order, OVERLAP / effective, "cohesion to first order")
        require(found < 0.0, "the grains repel each other")

    return case


def of_the_host(packing, **choices):
    """Spheres: the host's own, to the last bit of atom_style sphere where that is the same arithmetic, here to
    rounding; softened ones too."""

    def case(ranks):
        r1, r2 = (g.semi_axes[0] for g in packing.grains)
        effective = r1 * r2 / (r1 + r2)
        limit = float(choices["extra"].split()[-1]) if "extra" in choices else 1.0
        found = force(at_rest(packing, cohesion="sjkr", **choices), ranks)
        require_close(found, hertz(limit * effective) - ENERGY * area("sjkr", r1, r2), ROUNDING, "force", ENERGY)

    return case


def sticks_to(wall, shape, quaternion, height, radius, extra=""):
    """One grain on the floor: A = pi (2 R d - d^2), R the radius that Hertz takes."""

    def case(ranks):
        grain = Grain((0.3, 0.2, height - OVERLAP), shape, quaternion)
        packing = Packing((24.0, 24.0, 24.0), [grain], origin=(-12.0, -12.0, -12.0), triclinic=False)
        deck = at_rest(packing, cohesion="sjkr")
        model = f"fix wall all wall/gran {deck.model()}"
        walls = {
            "plane": [f"{model} primitive type 1 zplane 0.0 {extra}"],
            "mesh": [
                "fix floor all mesh/surface file floor.stl type 1",
                f"{model} mesh n_meshes 1 meshes floor {extra}",
            ],
        }[wall]
        deck.body = [*walls, *deck.body]
        found = run_in_folder_with_floor(deck, ranks).dump("grains.dump")[0][1]["fz"][0]
        # E* of two bodies of one material; the host's contact of a superquadric with a wall stops at about 1e-6 of a
        # semi-axis.
        expected = hertz(radius) - ENERGY * math.pi * (2.0 * radius * OVERLAP - OVERLAP**2)
        require_close(found, expected, 1e-3, "force of the wall", abs(expected))

    return case


def superquadrics(ranks):
    """The host's area is wrong, and a warning says so, once; nothing is said of spheres or with surface ellipsoid."""
    packing = pair(POLE, POLE)
    deck = replace(at_rest(packing, cohesion="sjkr", surface="superquadric"), body=["run 1", "run 1"])
    said = run(deck, ranks).output
    require(said.count(WARNING) == 1 and "'cohesion sjkr'" in said, f"warned {said.count(WARNING)} times")
    require(WARNING not in run(replace(deck, surface="ellipsoid"), ranks).output, "warned of surface ellipsoid")
    require(WARNING not in run(replace(deck, packing=pair(BALL, BALL)), ranks).output, "warned of spheres")
    require(WARNING not in run(replace(deck, cohesion="off"), ranks).output, "warned without cohesion")
    adhesive = run(with_adhesion(replace(deck, cohesion="off", normal="edinburgh", body=["run 0"])), ranks).output
    require(adhesive.count(WARNING) == 1 and "'model edinburgh'" in adhesive, "did not warn of edinburgh")


ADHESION = {
    "coefficientAdhesionStiffness": "peratomtypepair 1 0.5",
    "UnloadingStiffness": "peratomtypepair 1 5.0",
    "pullOffForce": "peratomtypepair 1 0.0",
    "surfaceEnergy": "peratomtypepair 1 2e3",
    "overlapExponent": "scalar 1.5",
    "adhesionExponent": "scalar 1.5",
}


def with_adhesion(deck):
    """The deck's text, with what the normal models edinburgh need."""
    lines = list(deck.lines())
    at = next(k for k, line in enumerate(lines) if line.startswith("pair_style"))
    lines[at:at] = [f"fix {name} all property/global {name} {value}" for name, value in ADHESION.items()]
    return "\n".join(lines) + "\n"


def as_spheres_of_equal_volume(**choices):
    """Pole to pole, head on: spheres under the host's own surface of that volume and overlap exert the same forces, in
    every step: as they come nearer, and as they part."""

    def case(ranks):
        radius = float(radius_of_volume(POLE))
        forces = []
        for side in (POLE, ((radius,) * 3, POLE[1], radius)):
            packing = replace(pair(side, side), atom_style="superquadric" if side is POLE else "sphere")
            for grain, direction in zip(packing.grains, (1, -1)):
                grain.velocity = (0.1 * direction, 0.0, 0.0)
            deck = at_rest(packing, tangential="off", timestep=1e-4, **choices)
            deck.body[-1] = "run 4000"
            result = run(with_adhesion(deck), ranks)
            forces.append(np.array([columns["fx"][-1] for _, columns in result.dump("grains.dump")]))
        # They meet, are thrown back, and hold on to each other.
        require(np.isfinite(forces[1]).all() and forces[1].max() > 1000.0, "the grains did not repel each other")
        require(forces[1].min() < -100.0, "the grains did not attract each other")
        # 4000 steps of rounding.
        require_close(forces[0], forces[1], 1e-8, "force")

    return case


CASES = {
    "poles": attracts(POLE, POLE),
    "sides": attracts(SIDE, SIDE),
    "pole-on-side": attracts(POLE, SIDE),
    "sizes": attracts(SMALL, SIDE),
    "sphere-and-spheroid": attracts(BALL, POLE),
    "poles-sjkr2": attracts(POLE, POLE, cohesion="sjkr2"),
    "sizes-sjkr2": attracts(SMALL, SIDE, cohesion="sjkr2"),
    "poles-by-curvature": attracts(POLE, POLE, radius_of_curvature, extra=CURVED),
    "sides-by-curvature": attracts(SIDE, SIDE, radius_of_curvature, extra=CURVED),
    "sizes-by-curvature": attracts(SMALL, SIDE, radius_of_curvature, extra=CURVED),
    "poles-under-gran": attracts(POLE, POLE, pair="gran"),
    "spheres": of_the_host(pair(BALL, BALL)),
    "softened-spheres": of_the_host(pair(BALL, BALL), extra="curvatureLimitFactor 0.5"),
    "pole-on-a-plane": sticks_to("plane", (A, A, C), (1.0, 0.0, 0.0, 0.0), C, float(np.cbrt(A * A * C))),
    "pole-on-a-mesh": sticks_to("mesh", (A, A, C), (1.0, 0.0, 0.0, 0.0), C, float(np.cbrt(A * A * C))),
    "pole-on-a-plane-by-curvature": sticks_to("plane", (A, A, C), (1.0, 0.0, 0.0, 0.0), C, A * A / C, CURVED),
    "sphere-on-a-plane": sticks_to("plane", (A, A, A), (1.0, 0.0, 0.0, 0.0), A, A),
    "sphere-on-a-mesh": sticks_to("mesh", (A, A, A), (1.0, 0.0, 0.0, 0.0), A, A),
    "superquadrics": superquadrics,
    "as-spheres-sjkr": as_spheres_of_equal_volume(cohesion="sjkr"),
    "as-spheres-sjkr2": as_spheres_of_equal_volume(cohesion="sjkr2"),
    "as-spheres-edinburgh": as_spheres_of_equal_volume(normal="edinburgh"),
}

if __name__ == "__main__":
    main(CASES)
