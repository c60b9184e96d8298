# SPDX-License-Identifier: GPL-2.0-or-later
"""The energy ledger beside walls that stand, slide, swing and turn, under gravity, with grains that come and leave:
it closes, and what it says of walls, gravity and passing grains is what closed forms and the grains' own velocities
say."""
from dataclasses import replace
import math
import os
from pathlib import Path
import tempfile

import numpy as np

from case import main, require, require_close, require_equal, require_same_snapshots
from collisions import kinetic_energy
from deck import Deck, Material, dump_grains, rayleigh_time, thermo
from ledger import LEDGER, LOSSES, SHARES, TOTALS, UNDAMPED, account, require_balance, turnover, with_ledger
from oracle.ledger import STORES
from packing import Grain, Packing
from run import run

GAINS = [name for name in LOSSES if name.startswith("G_")]
G = 9.81
FALL = f"fix pull all gravity {G} vector 0 0 -1"
# Sums of up to 1e4 steps and 1e2 contacts of numbers like the turnover: 1e-16 sqrt(1e6), and ten times that.
ROUNDING = 1e-12


def require_closes(a, what):
    require_balance(a, ROUNDING, what)


def require_walls_take_all(a):
    """Where no grain touches another."""
    for name in ("D_n", "D_t", "D_damp", "D_rolling", "U_n", "U_t"):
        require_equal(a[f"{name}_w"], a[name], f"{name} of walls")
    require_close(a["G_w"], sum(a[name] for name in GAINS), 1e-13, "G of walls", turnover(a))


# Surfaces


def write_surface(path, triangles):
    lines = ["solid s"]
    for corners in np.array(triangles, float):
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        lines.append("facet normal {:.17g} {:.17g} {:.17g}".format(*normal / np.linalg.norm(normal)))
        lines.append("outer loop")
        lines += ["vertex {:.17g} {:.17g} {:.17g}".format(*corner) for corner in corners]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid s"]) + "\n")


def square(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def floor(half=8.0, parts=1):
    at = np.linspace(-half, half, parts + 1)
    return [
        triangle
        for x0, x1 in zip(at[:-1], at[1:])
        for y0, y1 in zip(at[:-1], at[1:])
        for triangle in square((x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0))
    ]


def ring(radius, corners):
    at = 2.0 * math.pi * np.arange(corners + 1) / corners
    return list(zip(radius * np.cos(at), radius * np.sin(at)))


def funnel(outer, hole, corners=16):
    """Flat, with a hole in its middle."""
    big, small = ring(outer, corners), ring(hole, corners)
    return [
        triangle
        for k in range(corners)
        for triangle in square((*small[k], 0.0), (*big[k], 0.0), (*big[k + 1], 0.0), (*small[k + 1], 0.0))
    ]


def drum(radius, width, corners=24):
    """Along y, closed at both ends."""
    edge = ring(radius, corners)
    triangles = []
    for (x0, z0), (x1, z1) in zip(edge[:-1], edge[1:]):
        triangles += square((x0, -width, z0), (x0, width, z0), (x1, width, z1), (x1, -width, z1))
        triangles += [((0, y, 0), (x0, y, z0), (x1, y, z1)) for y in (-width, width)]
    return triangles


def run_with(deck, ranks, surfaces=(), **options):
    folder = Path(tempfile.mkdtemp(prefix="walls-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    for name, triangles in dict(surfaces).items():
        write_surface(folder / f"{name}.stl", triangles)
    return run(deck, ranks, folder=folder, **options)


def wall(deck, place, name="wall", model=""):
    return f"fix {name} all wall/gran {model or replace(deck, extra='').model()} {place} {deck.extra}".replace(
        "ledger on", ""
    )


def mesh(deck, name="floor", motion="", rest=""):
    lines = [f"fix {name} all mesh/surface file {name}.stl type 1 {rest}"]
    if motion:
        lines.append(f"fix motion all move/mesh mesh {name} {motion}")
    return [*lines, wall(deck, f"mesh n_meshes 1 meshes {name}")]


PLANE = "primitive type 1 zplane 0.0"


def scene(grains, half=8.0, atom_style="superquadric", **choices):
    packing = Packing(
        (2 * half, 2 * half, 4 * half), grains, atom_style=atom_style, origin=(-half, -half, -2 * half), triclinic=False
    )
    choices.setdefault("surface", "ellipsoid")
    choices.setdefault("boundary", "f f f")
    choices.setdefault("extra", UNDAMPED)
    return with_ledger(Deck(packing, **choices))


def turned_by_spheroid(deck):
    return ["unfix integrate", "fix integrate all nve/spheroid"] if deck.packing.atom_style == "superquadric" else []


def body(deck, scenery, steps, every=None, columns=(), runs=()):
    """`runs`: instead of one of `steps`, lines with `run` commands."""
    deck.body = [
        *turned_by_spheroid(deck),
        *scenery,
        LEDGER,
        *dump_grains(deck.packing, every or steps),
        *thermo(every or steps, *TOTALS, *columns),
        "thermo_modify lost ignore",
        *(runs or [f"run {steps}"]),
    ]
    return deck


# One grain


def ball(height=1.001, velocity=(0.0, 0.0, -0.5), spin=(0.0, 0.0, 0.0), shape=(1.0, 1.0, 1.0)):
    return Grain((0.3, 0.2, height), shape, (1.0, 0.0, 0.0, 0.0), velocity, spin)


def bounce(kind, shape=(1.0, 1.0, 1.0), style="superquadric", **choices):
    """A ball bounces on a wall: what it has lost, by its velocities, is what the wall has taken, and with normal impact
    nearly all of it D_n. e from 0.1 to 0.9."""

    def case(ranks):
        for e in (0.1, 0.3, 0.5, 0.7, 0.9):
            for velocity, spin in (((0.0, 0.0, -0.5), (0.0, 0.0, 0.0)), ((0.4, -0.2, -0.5), (0.3, 1.0, 0.5))):
                deck = scene(
                    [ball(1.001 * shape[2], velocity, spin, shape)],
                    atom_style=style,
                    material=Material(restitution=(e,)),
                    timestep=0.05 * rayleigh_time(min(shape)),
                    **choices,
                )
                scenery = mesh(deck) if kind == "mesh" else [wall(deck, PLANE)]
                result = run_with(body(deck, scenery, 800), ranks, [("floor", floor(parts=4))])
                a = account(result.thermo()[0])
                (_, before), (_, after) = result.dump("grains.dump")
                start, lost = kinetic_energy(before), kinetic_energy(before) - kinetic_energy(after)
                require_closes(a, f"e {e}")
                require_walls_take_all(a)
                require_equal([a["U_n"], a["U_t"]], [0.0, 0.0], "the ball still touches")
                require_close(sum(a[name] for name in LOSSES), lost, ROUNDING, "what the wall took", start)
                require_equal([a["W_wall"], a["W_gravity"]], [0.0, 0.0], "a wall that stands")
                require_close(a["W_other"], 0.0, ROUNDING, "W_other", start)
                if spin == (0.0, 0.0, 0.0) and shape[0] == shape[2]:
                    # What is no damping is the error of some 60 steps of a collision, and the pull at its end.
                    require_close(a["D_n_w"], lost, 3e-3, "D_n of the wall", start)
                    require_close(a["D_t_w"], 0.0, ROUNDING, "no friction in a straight impact", start)

    return case


def path_work(force, velocity, dt):
    """Of a wall that moves with velocity[n] in the step before force[n], over all steps; where a contact has opened
    the ledger has the velocity before."""
    start = np.where((force[1:] == 0.0) & (force[:-1] != 0.0), velocity[:-1], velocity[1:])
    return 0.5 * dt * (force[:-1] * start + force[1:] * velocity[1:]).sum()


def plate(ranks):
    """A ball on a plate that swings up and down. The plate's velocity is known, and its force is what the ball feels
    beside its weight: the work follows from both, step by step."""
    amplitude, period = 0.05, 0.6
    deck = scene([ball(1.02, (0.0, 0.0, 0.0))], atom_style="sphere", timestep=1e-3)
    omega = 2.0 * math.pi / period
    motion = f"wiggle amplitude 0. 0. {amplitude} period {period}"
    deck = body(deck, [FALL, *mesh(deck, motion=motion)], 3000, every=1)
    result = run_with(deck, ranks, [("floor", floor(parts=4))])
    table, dt = result.thermo()[0], deck.dt()
    a = account(table)
    require_closes(a, "plate")
    require_walls_take_all(a)
    mass = deck.packing.grains[0].mass()
    force = np.array([columns["fz"][0] for _, columns in result.dump("grains.dump")]) + mass * G
    velocity = amplitude * omega * np.cos(omega * dt * np.arange(len(force)))
    work = path_work(force, velocity, dt)
    heights = np.array([columns["z"][0] for _, columns in result.dump("grains.dump")])
    require((force > 0.0).any() and abs(work) > 0.1 * a["D_n"] > 0.0, "nothing was done")
    require_close(a["W_wall"], work, 1e-10, "work of the plate", np.abs(force * velocity).sum() * dt)
    require_close(a["W_gravity"], mass * G * (heights[0] - heights[-1]), 1e-10, "m g h", turnover(a))
    require_close(a["W_other"], 0.0, ROUNDING, "W_other", turnover(a))
    print("G_n against W_wall", a["G_n"] / a["W_wall"], "G_dt", a["G_dt"] / a["D_n"])


def dragged(kind):
    """A sphere that is let down on a belt: the belt drags it along. Its work is the force times its speed, half of
    which goes into heat while the sphere, which is not to turn, comes up to speed."""

    def case(ranks):
        speed = 0.5
        deck = scene(
            [ball(0.9995, (0.0, 0.0, 0.0))],
            atom_style="sphere",
            boundary="p p f",
            timestep=1e-3,
            material=Material(friction=(0.3,), restitution=(0.3,)),
        )
        scenery = {
            "conveyor": mesh(deck, rest=f"surface_vel {speed} 0. 0."),
            "shear": [wall(deck, f"{PLANE} shear x {speed}")],
            "moving": mesh(deck, motion=f"linear {speed} 0. 0."),
        }[kind]
        deck = body(deck, [FALL, *scenery], 1200, every=1)
        result = run_with(deck, ranks, [("floor", floor(half=10.0, parts=3))])
        a, dt = account(result.thermo()[0]), deck.dt()
        require_closes(a, kind)
        require_walls_take_all(a)
        dumps = result.dump("grains.dump")
        force = np.array([columns["fx"][0] for _, columns in dumps])
        work = path_work(force, np.full(len(force), speed), dt)
        require_close(a["W_wall"], work, 1e-10, "work of the belt", abs(work))
        require(a["W_wall"] > 0.0 and a["D_t"] > 0.2 * a["W_wall"], "the belt drags nothing")

    return case


# Many grains


def spheroids(count, radius, height, random_seed=1, shape=(0.5, 0.5, 0.75), speed=0.5):
    """In layers of a grid, within a radius of the axis z."""
    random = np.random.default_rng(random_seed)
    step = 2.05 * max(shape)
    at = step * (np.arange(-20, 21))
    cells = [(x, y) for x in at for y in at if math.hypot(x, y) + max(shape) < radius]
    grains = []
    for k in range(count):
        x, y = cells[k % len(cells)]
        quaternion = random.normal(size=4)
        grains.append(
            Grain(
                (float(x), float(y), float(height + step * (k // len(cells)))),
                shape,
                tuple(float(q) for q in quaternion / np.linalg.norm(quaternion)),
                tuple(float(v) for v in speed * random.normal(size=3)),
            )
        )
    return grains


def in_drum(ranks):
    """Spheroids in a drum that turns."""
    grains = [
        replace(g, position=(g.position[0], 0.4 * (-1) ** k, g.position[2]))
        for k, g in enumerate(spheroids(12, 2.6, -1.2, speed=0.2))
    ]
    grains = [g for k, g in enumerate(grains) if math.hypot(g.position[0], g.position[2]) < 2.6]
    places, kept = set(), []
    for g in grains:
        key = (round(g.position[0], 6), round(g.position[2], 6))
        if key not in places:
            places.add(key)
            kept.append(g)
    deck = scene(kept, half=6.0, timestep=0.1 * rayleigh_time(0.5))
    scenery = mesh(deck, "floor", "rotate origin 0. 0. 0. axis 0. 1. 0. period 4.0")
    deck = body(deck, [FALL, *scenery], 6000, every=1000)
    table = run_with(deck, ranks, [("floor", drum(3.5, 1.5))]).thermo()[0]
    for row in range(len(table["step"])):
        require_closes(account(table, row), f"step {table['step'][row]}")
    a = account(table)
    require(a["W_wall"] > 0.0 and a["D_n_w"] > 0.0 and a["D_t_w"] > 0.0 and a["D_n"] > a["D_n_w"], "nothing moves")
    require_close(a["W_other"], 0.0, 1e-10, "W_other", turnover(a))


def pour(ranks, surface="ellipsoid", style="superquadric", count=40, steps=8000):
    shape = (0.5, 0.5, 0.75) if style == "superquadric" else (0.5, 0.5, 0.5)
    grains = spheroids(count, 2.9, 1.0, shape=shape)
    deck = scene(grains, half=6.0, atom_style=style, surface=surface, timestep=0.1 * rayleigh_time(0.5))
    deck.packing = replace(deck.packing, origin=(-6.0, -6.0, -3.0), edges=(12.0, 12.0, 18.0))
    scenery = [
        FALL,
        "fix funnel all mesh/surface file funnel.stl type 1",
        wall(deck, "primitive type 1 zcylinder 3.0 0. 0.", "side"),
        wall(deck, "mesh n_meshes 1 meshes funnel"),
    ]
    return body(deck, scenery, steps, every=50, columns=["atoms"])


def hopper(style):
    """Grains run out of a hopper and leave the box: they take their energy with them."""

    def case(ranks):
        deck = pour(ranks, style=style)
        table = run_with(deck, ranks, [("funnel", funnel(3.2, 1.4))]).thermo()[0]
        left = table["atoms"][0] - table["atoms"][-1]
        require(left >= 5, f"only {left} grains left")
        for row in range(len(table["step"])):
            if row % 20 == 0 or row == len(table["step"]) - 1:
                require_closes(account(table, row), f"step {table['step'][row]}")
        a = account(table)
        require(a["W_out"] > 0.0 and a["W_in"] == 0.0, "the grains took nothing with them")
        require_close(a["W_other"], 0.0, 1e-10, "W_other", turnover(a))

    return case


def drops_out(ranks):
    """One grain falls out of the box: what gravity has given it, it takes along."""
    deck = scene([ball(0.0, (0.3, 0.0, 0.0), (0.1, 0.2, 0.3), (1.0, 1.0, 1.5))], timestep=2e-3)
    deck = body(deck, [FALL], 1200, every=1)
    result = run_with(deck, ranks)
    table = result.thermo()[0]
    a, start = account(table), account(table, 0)
    require_closes(a, "gone")
    last = result.dump("grains.dump")
    seen = [columns for _, columns in last if len(columns["id"])]
    require(len(seen) < len(last), "the grain never left")
    mass, dt = deck.packing.grains[0].mass(), deck.dt()
    # The step in which it leaves: half a kick and a drift.
    end = kinetic_energy({**seen[-1], "vz": seen[-1]["vz"] - 0.5 * dt * G})
    require_close(a["W_out"], end, 1e-12, "what it took along", end)
    require_close(a["W_gravity"], end - kinetic_energy(seen[0]) + mass * (0.5 * dt * G) ** 2 / 2, 1e-10, "m g h", end)
    require_equal([a["K_tr"], a["K_rot"], a["W_in"]], [0.0, 0.0, 0.0], "nothing is left")
    require(start["K_tr"] > 0.0, "it moved")


def torn_apart(ranks):
    """Two spheres leave one after the other, pressed together: what is stored in their contact leaves with the first."""
    grains = [Grain((0.0, 0.0, -9.0)), Grain((0.0, 0.0, -7.05))]
    grains = [replace(g, velocity=(0.0, 0.0, -40.0), omega=(0.0, 1.0 * k, 0.0)) for k, g in enumerate(grains)]
    deck = scene(grains, half=5.0, atom_style="sphere", timestep=1e-4)
    deck = body(deck, ["neigh_modify every 1 delay 0 check no"], 1200, every=1, columns=["atoms"])
    table = run_with(deck, ranks).thermo()[0]
    atoms = table["atoms"]
    gone = [int(np.flatnonzero(atoms == n)[0]) for n in (1, 0)]
    before, after = account(table, gone[0] - 1), account(table, gone[0])
    require(before["U_n"] > 0.0 and before["U_t"] > 0.0, "the grains do not touch")
    require_equal([after["U_n"], after["U_t"]], [0.0, 0.0], "the contact is gone")
    stored = before["U_n"] + before["U_t"]
    # The half step of the contact that is left: 1/2 dt over the time of a collision, of what is stored.
    kinetic = before["K_tr"] + before["K_rot"] - after["K_tr"] - after["K_rot"]
    require(abs(after["W_out"] - kinetic) > 0.5 * stored, "the contact's energy is not in W_out")
    for name in GAINS:
        require_close(after[name], before[name], 0.02, f"{name} as the grain leaves", stored)
    for row in (gone[0], gone[1], -1):
        require_closes(account(table, row), f"row {row}")
    require_equal([account(table)[name] for name in STORES], np.zeros(4), "nothing is left")


CASES = {
    "bounce-plane": bounce("plane"),
    "bounce-plane-spheres": bounce("plane", style="sphere"),
    "bounce-mesh": bounce("mesh"),
    "bounce-long": bounce("plane", (1.0, 1.0, 1.5)),
    "bounce-hooke": bounce("plane", normal="hooke"),
    "bounce-no-history": bounce("plane", tangential="no_history", extra=""),
    "bounce-damped": bounce("mesh", extra=""),
    "bounce-rolling": bounce("plane", style="sphere", rolling="cdt"),
    "plate": plate,
    "conveyor": dragged("conveyor"),
    "shear": dragged("shear"),
    "moving": dragged("moving"),
    "drum": in_drum,
    "hopper-spheroids": hopper("superquadric"),
    "hopper-spheres": hopper("sphere"),
    "drops-out": drops_out,
    "torn-apart": torn_apart,
}

if __name__ == "__main__":
    main(CASES)
