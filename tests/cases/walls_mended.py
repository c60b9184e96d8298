# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls of the host that are mended: each against a plane in the same place, or by hand."""
import math

import numpy as np

from case import main, require, require_close
from deck import Deck, dump_grains, thermo
from ellipsoid_walls import run_in_folder_with_floor, walls
from packing import Grain, Packing

ROUNDING = 1e-12
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
LYING = (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0)  # the long axis z along y


def alone(grain, atom_style="superquadric"):
    return Packing((24.0, 24.0, 48.0), [grain], origin=(-12.0, -12.0, -24.0), triclinic=False, atom_style=atom_style)


def forces(deck, lines, ranks, steps=1):
    """On a grain that does not move, in the last step."""
    deck.body = ["unfix integrate", *lines, *dump_grains(deck.packing, 1), f"run {steps}"]
    last = run_in_folder_with_floor(deck, ranks).dump("grains.dump")[-1][1]
    return np.array([last[name][0] for name in ("fx", "fy", "fz")])


def rotating(axis, radius, place, speed_along):
    """A sphere at `place` from the axis, in or around a cylinder that turns so fast that its wall moves by 0.01: the
    force of a plane that moves so."""

    def case(ranks):
        deck = Deck(alone(Grain((0.0, 0.0, -0.01), (1.0,) * 3), "sphere"), boundary="f f f")
        wall = f"fix wall all wall/gran {deck.model()} primitive type 1"
        _, pushed, pressed = forces(deck, [f"{wall} zplane -1.0 shear y 0.01"], ranks)
        at = np.roll((0.0, *place), "xyz".index(axis))
        turning = Deck(alone(Grain(tuple(at), (1.0,) * 3), "sphere"), boundary="f f f")
        found = forces(turning, [f"{wall} {axis}cylinder {radius} 0. 0. shear {speed_along} {0.01 / radius!r}"], ranks)
        if speed_along != axis:  # the host turns a cylinder where the direction of `shear` is not its axis
            way = np.cross(np.eye(3)["xyz".index(axis)], at / np.linalg.norm(at))
        else:
            way = np.eye(3)["xyz".index(axis)]
        outward = at / np.linalg.norm(at) * (1.0 if np.linalg.norm(at) > radius else -1.0)
        require_close(found, pushed * way + pressed * outward, 1e-9, f"force of the {axis}cylinder")
        require(abs(pushed) > 10.0, "the wall does not drag the grain")

    return case


def on_the_floor(place, surface):
    """A grain that touches two triangles of a plane is pushed as by the plane, once."""

    def case(ranks):
        deck = Deck(alone(Grain(place, (1.0, 1.0, 1.5), LYING)), boundary="f f f", surface=surface)
        plane, mesh = (forces(deck, walls(deck, kind), ranks, steps=3) for kind in ("plane", "mesh"))
        require(plane[2] > 1.0, "the grain does not touch the plane")
        require_close(mesh, plane, 1e-9, "force of the mesh against that of a plane")

    return case


def rolls_over_an_edge(surface):
    """The spring goes with a grain from one triangle to the next: it moves as far from the edge."""

    def case(ranks):
        ends = []
        for start in (-0.05, 3.0):
            grain = Grain((start, 0.03, 0.9995), (1.0, 1.0, 1.5), LYING, (2.0, 0.0, 0.0))
            deck = Deck(alone(grain), boundary="f f f", surface=surface)
            deck.body = [
                "fix gravity all gravity 9.81 vector 0 0 -1",
                *walls(deck, "mesh"),
                *dump_grains(deck.packing, 60),
                "run 60",
            ]
            end = run_in_folder_with_floor(deck, ranks).dump("grains.dump")[-1][1]
            ends.append(np.array([end["x"][0] - start, *(end[name][0] for name in ("y", "z", "vx", "vy", "omegay"))]))
        require(ends[0][0] > 0.1, "the grain does not pass the edge")
        require_close(*ends, 1e-9, "motion across an edge of the plane against that within a triangle")

    return case


def torque(size, surface):
    """Of a grain on a mesh about the origin: place of contact x force."""

    def case(ranks):
        shape = (size, size, 1.5 * size)
        grain = Grain((3.0, 2.0, 0.99 * size), shape, LYING, (0.01, 0.0, 0.0))
        deck = Deck(alone(grain), boundary="f f f", surface=surface)
        mesh = walls(deck, "mesh")
        mesh[0] = "fix floor all mesh/surface/stress file floor.stl type 1 reference_point 0 0 0"
        deck.body = [
            "unfix integrate",
            *mesh,
            *dump_grains(deck.packing, 1),
            *thermo(1, *(f"f_floor[{k}]" for k in range(1, 7))),
            "run 1",
        ]
        done = run_in_folder_with_floor(deck, ranks)
        last, said = done.dump("grains.dump")[-1][1], done.thermo()[-1]
        force = -np.array([last[name][0] for name in ("fx", "fy", "fz")])
        found = np.array([said[f"f_floor[{k}]"][-1] for k in range(1, 7)])
        require_close(found[:3], force, ROUNDING, "force on the mesh")
        require(abs(force[0]) > 0.01 * abs(force[2]), "the grain does not rub")
        require_close(found[3:], np.cross((3.0, 2.0, 0.0), force), ROUNDING, "torque on the mesh")

    return case


CASES = {
    **{
        f"cylinder-turns-{axis}-{where}": rotating(axis, radius, place, "y" if axis == "x" else "x")
        for axis in "xyz"
        for where, radius, place in (
            ("inside", 4.0, (3.01, 0.0)),
            ("inside-narrow", 1.5, (0.0, 0.51)),
            ("outside", 4.0, (4.99, 0.0)),
        )
    },
    **{
        f"floor-{name}-{surface}": on_the_floor(place, surface)
        for surface in ("superquadric", "ellipsoid")
        for name, place in (
            ("diagonal", (0.0, 0.0, 0.99)),
            ("beside-the-diagonal", (0.02, 0.0, 0.9995)),
            ("far", (3.0, 0.0, 0.99)),
        )
    },
    **{f"edge-{surface}": rolls_over_an_edge(surface) for surface in ("superquadric", "ellipsoid")},
    "torque-large": torque(1.0, "superquadric"),
    "torque-small": torque(0.01, "superquadric"),
    "torque-ellipsoid": torque(0.01, "ellipsoid"),
}

if __name__ == "__main__":
    main(CASES)
