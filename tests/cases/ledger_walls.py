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
from deck import POISSON, Deck, Material, dump_grains, dump_local, rayleigh_time, thermo
from grainscope.columns import outputs
from ledger import (
    C_E,
    LEDGER,
    LEVEL,
    LOSSES,
    NAMES,
    SYNCHRONIZED,
    TOTALS,
    UNDAMPED,
    account,
    require_balance,
    turnover,
    with_ledger,
)
from oracle.ledger import AXES, STORES
from oracle.state import ROW_WIDTH, grains_of, rows_of
from packing import Grain, Packing
from run import run

OF_SOME = [outputs("energy/ledger").of("later")[name] for name in NAMES]
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


def plate(ranks, extra=UNDAMPED):
    """A ball on a plate that swings up and down. The plate's velocity is known, and its force is what the ball feels
    beside its weight: the work follows from both, step by step."""
    amplitude, period = 0.05, 0.6
    deck = scene([ball(1.02, (0.0, 0.0, 0.0))], atom_style="sphere", timestep=1e-3, extra=extra)
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


def seen_from_outside(ranks):
    """Spheres that bounce, slide and roll on a plate that swings: work of the plate, normal damping and gravity, from
    dumped positions, velocities and forces and the plate's motion, with Hertz's damping written out."""
    amplitude, period, restitution = 0.05, 0.6, 0.4
    grains = [
        Grain((2.5 * k - 4.0, 0.5 * k, 1.01 + 0.05 * k), velocity=(0.2 * k, 0.3, 0.0), omega=(0.0, 0.5 * k, 0.1))
        for k in range(4)
    ]
    deck = scene(grains, atom_style="sphere", timestep=1e-3, material=Material(restitution=(restitution,)))
    motion = f"wiggle amplitude 0. 0. {amplitude} period {period}"
    deck = body(deck, [FALL, *mesh(deck, motion=motion)], 2000, every=1)
    result = run_with(deck, ranks, [("floor", floor(parts=4))])
    a, dt = account(result.thermo()[0]), deck.dt()
    require_closes(a, "seen from outside")
    dumps = [columns for _, columns in result.dump("grains.dump")]
    steps = len(dumps)
    omega = 2.0 * math.pi / period
    speed = amplitude * omega * np.cos(omega * dt * np.arange(steps))
    speed[0] = 0.0  # in the first evaluation the host's walls stand
    plate_at = np.concatenate([[0.0], np.cumsum(speed[1:] * dt)])
    z, v, f = (np.array([columns[name] for columns in dumps]) for name in ("z", "vz", "fz"))
    mass, radius = grains[0].mass(), 1.0
    push = f + mass * G
    half = v[:-1] + 0.5 * dt * f[:-1] / mass  # of each step
    overlap = np.maximum(0.0, radius - (z - plate_at[:, None]))
    stiffness = 2.0 * deck.material.young[0] / (2.0 * (1.0 - POISSON**2)) * np.sqrt(radius * overlap)
    log_e = math.log(restitution)
    coefficient = -2.0 * math.sqrt(5.0 / 6.0) * log_e / math.hypot(log_e, math.pi) * np.sqrt(stiffness * mass)
    evaluated = np.vstack([v[:1], half]) - speed[:, None]
    damping = -coefficient * evaluated
    after = speed[1:, None]
    opens = (push[:-1] != 0.0) & (push[1:] == 0.0)
    before = np.where(opens, speed[:-1, None], after)  # a contact that has opened ends with the velocity it had
    lost = -0.5 * dt * (damping[:-1] * (half - before) + damping[1:] * (half - after)).sum()
    work = 0.5 * dt * (push[:-1] * before + push[1:] * after).sum()
    require_close(a["D_n_w"], lost, 1e-9, "normal damping of the plate", lost)
    require_close(a["W_wall"], work, 1e-9, "work of the plate", lost)
    require_close(a["W_gravity"], -mass * G * (z[-1] - z[0]).sum(), 1e-9, "m g h", lost)
    require(a["D_n"] == a["D_n_w"] and work > 0.1 * lost, "nothing was done")


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


def in_drum(pair=UNDAMPED, walls=UNDAMPED):
    """Spheroids in a drum that turns; `walls`: the words of the wall."""

    def case(ranks):
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
        deck = scene(kept, half=6.0, timestep=0.1 * rayleigh_time(0.5), extra=pair)
        scenery = mesh(replace(deck, extra=walls), "floor", "rotate origin 0. 0. 0. axis 0. 1. 0. period 4.0")
        deck = body(deck, [FALL, *scenery], 6000, every=1000)
        table = run_with(deck, ranks, [("floor", drum(3.5, 1.5))]).thermo()[0]
        for row in range(len(table["step"])):
            require_closes(account(table, row), f"step {table['step'][row]}")
        a = account(table)
        require(a["W_wall"] > 0.0 and a["D_n_w"] > 0.0 and a["D_t_w"] > 0.0 and a["D_n"] > a["D_n_w"], "nothing moves")
        require_close(a["W_other"], 0.0, 1e-10, "W_other", turnover(a))

    return case


def pour(ranks, surface="ellipsoid", style="superquadric", count=40, steps=8000, extra=UNDAMPED):
    shape = (0.5, 0.5, 0.75) if style == "superquadric" else (0.5, 0.5, 0.5)
    grains = spheroids(count, 2.9, 1.0, shape=shape)
    deck = scene(grains, half=6.0, atom_style=style, surface=surface, timestep=0.1 * rayleigh_time(0.5), extra=extra)
    deck.packing = replace(deck.packing, origin=(-6.0, -6.0, -3.0), edges=(12.0, 12.0, 18.0))
    scenery = [
        FALL,
        "fix funnel all mesh/surface file funnel.stl type 1",
        wall(deck, "primitive type 1 zcylinder 3.0 0. 0.", "side"),
        wall(deck, "mesh n_meshes 1 meshes funnel"),
    ]
    return body(deck, scenery, steps, every=50, columns=["atoms"])


def hopper(style, extra=UNDAMPED):
    """Grains run out of a hopper and leave the box: they take their energy with them."""

    def case(ranks):
        deck = pour(ranks, style=style, extra=extra)
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


def drained(ranks):
    """Spheres that pass a gate are deleted there, within the box."""
    grains = spheroids(12, 2.6, 2.0, shape=(0.5, 0.5, 0.5), speed=0.3)
    deck = scene(grains, half=6.0, atom_style="sphere", timestep=0.1 * rayleigh_time(0.5))
    scenery = [
        FALL,
        "fix gate all mesh/surface file gate.stl type 1",
        "fix count all massflow/mesh mesh gate vec_side 0. 0. -1. count once delete_atoms yes",
        wall(deck, "primitive type 1 zcylinder 2.7 0. 0.", "side"),
    ]
    result = run_with(body(deck, scenery, 1500, 50, columns=["atoms"]), ranks, [("gate", floor(half=4.0))])
    table = result.thermo()[0]
    for row in range(len(table["step"])):
        require_closes(account(table, row), f"row {row}")
    a = account(table)
    require(table["atoms"][-1] < 6 and a["W_out"] > 0.5 * a["W_gravity"], "nobody passed the gate")


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


def rained(ranks):
    """Grains are put in while the run goes on: each brings the energy of its velocity. They fall on a floor."""
    deck = scene([ball(1.0, (0.0, 0.0, 0.0))], atom_style="sphere", timestep=1e-3)
    radius, speed = 0.3, 1.5
    scenery = [
        FALL,
        wall(deck, PLANE),
        "region above block -5 5 -5 5 4 8 units box",
        "fix small all particletemplate/sphere 15485863 atom_type 1 density constant 1000 " f"radius constant {radius}",
        "fix kinds all particledistribution/discrete 15485867 1 small 1.0",
        "fix insert all insert/rate/region seed 32452843 distributiontemplate kinds nparticles 30 particlerate 50 "
        f"insert_every 200 vel constant 0 0 {-speed} overlapcheck yes all_in yes region above",
    ]
    table = run_with(body(deck, scenery, 1500, every=10, columns=["atoms"]), ranks).thermo()[0]
    a, came = account(table), table["atoms"][-1] - 1
    require_closes(a, "rain")
    require(came >= 20, f"only {came} grains came")
    mass = 1000.0 * 4.0 / 3.0 * math.pi * radius**3
    require_close(a["W_in"], 0.5 * mass * speed**2 * came, 1e-12, "what they brought", a["W_in"])
    require_close(a["W_other"], 0.0, ROUNDING, "W_other", turnover(a))
    require_equal(a["W_out"], 0.0, "nobody left")


def between_runs(ranks):
    """Between two runs grains are deleted, and join the group: what they have leaves and comes with them, and the
    ledger goes on."""
    deck = scene(spheroids(20, 2.9, 0.5), half=6.0, timestep=0.1 * rayleigh_time(0.5))
    scenery = [FALL, wall(deck, PLANE), wall(deck, "primitive type 1 zcylinder 3.0 0. 0.", "side")]
    one_run = "run 1000"
    runs = [
        one_run,
        "group few id 3 7 11",
        "delete_atoms group few compress no",
        one_run,
        "group some id 1:9",
        "compute later some energy/ledger",
        *thermo(1000, *TOTALS, *OF_SOME),
        one_run,
        "group some id 10:14",
        one_run,
        "group some id 15 16",
        "run 500 pre no",
    ]
    first, second, third, fourth, fifth = run_with(body(deck, scenery, 0, 1000, runs=runs), ranks).thermo()
    a, b = account(first), account(second, 0)
    require_closes(b, "after three were deleted")
    stored = [sum(one[name] for name in STORES) for one in (a, b)]
    require(b["W_out"] > 0.0 and b["W_in"] == 0.0, "nobody left")
    # LIGGGHTS begins a run with forces that differ a little: damping by velocities of full steps.
    require_close(b["W_out"], stored[0] - stored[1], 1e-2, "what they took", b["W_out"])
    require_close(b["W_out"] - b["W_other"], stored[0] - stored[1], ROUNDING, "and the rest", turnover(b))
    require_closes(account(second), "without them")
    brought = [0.0]
    for table in (third, fourth, fifth):
        some = {name: float(table[q][-1]) for name, q in zip(NAMES, OF_SOME)}
        require_closes(some, "some of the grains")
        brought.append(some["W_in"])
    require(brought[1] == 0.0 and 0.0 < brought[2] < brought[3], f"they brought {brought}")


def frozen(ranks):
    """Frozen grains beneath others: gravity works on those that move, whatever the order of the fixes."""
    found = []
    for order in ((0, 1), (1, 0)):
        grains = spheroids(16, 2.9, 1.0, speed=0.3)
        deck = scene(grains, half=6.0, timestep=0.1 * rayleigh_time(0.5))
        fixes = ["fix still bed freeze", FALL]
        scenery = [
            "group bed id 1:6",
            "velocity bed set 0 0 0 units box",
            "unfix integrate",
            "group free subtract all bed",
            "fix integrate free nve/spheroid",
            *(fixes[k] for k in order),
            wall(deck, "primitive type 1 zcylinder 3.0 0. 0.", "side"),
        ]
        deck = body(deck, scenery, 1500)
        deck.body = deck.body[2:]
        found.append(account(run_with(deck, ranks).thermo()[0]))
        require_closes(found[-1], "above a frozen bed")
        require(found[-1]["W_gravity"] > 0.0 and found[-1]["D_n"] > found[-1]["D_n_w"], "nothing fell")
        require_close(found[-1]["W_other"], 0.0, 1e-10, "W_other", turnover(found[-1]))


def pulls(ranks):
    """Several fixes gravity, one of them of some grains only, one that changes with time: their work is what the grains
    gain."""
    grains = [Grain((2.5 * k - 4.0, 0.0, 5.0), velocity=(0.0, 0.1 * k, 0.2)) for k in range(4)]
    deck = scene(grains, half=30.0, atom_style="sphere", timestep=1e-3)
    scenery = [
        "group few id 1 3",
        "variable strength equal 5.0*sin(0.01*step)",
        "fix swing all gravity v_strength vector 1 2 3",
        FALL,
        "fix more few gravity 3.0 vector 0 1 1",
        "fix push all addforce 10.0 0. 0.",
    ]
    result = run_with(body(deck, scenery, 800), ranks)
    a, start = account(result.thermo()[0]), account(result.thermo()[0], 0)
    require_closes(a, "pulls")
    (_, before), (_, after) = result.dump("grains.dump")
    push = 10.0 * (after["x"] - before["x"]).sum()
    require_close(a["W_other"], push, 1e-10, "work of the push", turnover(a))
    require_close(a["W_gravity"], a["K_tr"] - start["K_tr"] - push, 1e-10, "work of gravity", turnover(a))
    require(abs(a["W_gravity"]) > 0.0, "no gravity")


def in_a_box_that_shears(ranks):
    """Between two plates along a box that shears and shortens sideways: velocities are measured against the flow, those
    of plates too."""
    deck = scene(spheroids(24, 3.5, 0.8, shape=(0.5, 0.5, 0.75)), half=4.0, boundary="p p f")
    deck.packing = replace(deck.packing, triclinic=True, edges=(8.0, 8.0, 8.0), origin=(-4.0, -4.0, -1.0))
    deck.timestep = 0.1 * rayleigh_time(0.5)
    scenery = [
        "fix press all press/strain axis y target 2e4 shear xy rate 0.4 every 1e-3 maxrate 0.02 momentum no",
        FALL,
        wall(deck, f"{PLANE} shear x 0.3 allow_special_domain_periodic yes"),
        wall(deck, "primitive type 1 zplane 4.0 allow_special_domain_periodic yes", "lid"),
    ]
    table = run_with(body(deck, scenery, 3000, 500), ranks).thermo()[0]
    for row in range(len(table["step"])):
        require_closes(account(table, row), f"row {row}")
    a = account(table)
    for name in ("W_wall", "W_shear", "W_box", "D_n_w", "D_t_w"):
        require(a[name] != 0.0, f"{name} is nothing")
    require_close(a["W_other"], 0.0, 1e-10, "W_other", turnover(a))
    require_equal([a["W_box_x"], a["W_box_z"]], [0.0, 0.0], "work of edges that stand still")


def in_a_box_that_stretches(ranks):
    """Between two plates, each edge at a speed of its own: W_box by axis, step by step, of forces and branches of all
    contacts, those of the plates among them, and of the grains' velocities."""
    rates = np.array([0.05, -0.08, 0.03])
    deck = scene(spheroids(24, 3.5, 0.8, shape=(0.5, 0.5, 0.75)), half=4.0, boundary="p p f")
    deck.packing = replace(deck.packing, edges=(8.0, 8.0, 8.0), origin=(-4.0, -4.0, -1.0))
    deck.timestep = 0.1 * rayleigh_time(0.5)
    scenery = [
        "fix stretch all deform 1 " + " ".join(f"{a} erate {r}" for a, r in zip("xyz", rates)) + " remap v",
        FALL,
        wall(deck, f"{PLANE} allow_special_domain_periodic yes"),
        wall(deck, "primitive type 1 zplane 4.0 allow_special_domain_periodic yes", "lid"),
        "compute rows all contact/local",
        *dump_local("rows", ROW_WIDTH, 1, "rows"),
    ]
    sides = ["lx", "ly", "lz", "xlo", "ylo", "zlo"]
    asked = [C_E[f"{name}_rate"] for name in AXES]
    result = run_with(body(deck, scenery, 1500, 1, [*sides, *asked]), ranks)
    table, dt = result.thermo()[0], deck.dt()
    require_closes(account(table), "stretched")
    lengths, lower = (np.stack([table[name] for name in names], axis=1) for names in (sides[:3], sides[3:]))
    gradients, centres = rates * lengths[0] / lengths, lower + 0.5 * lengths
    grains = [grains_of(columns) for _, columns in result.dump("grains.dump")]
    rows = [rows_of(columns, "rows") for _, columns in result.dump("rows.dump")]
    powers = np.array([(r["force"] * r["branch"]).sum(axis=0) for r in rows])
    found = dt * np.stack([table[name] for name in asked], axis=1)
    expected = np.zeros_like(found)
    for n, g in enumerate(grains[:-1]):
        gradient, mass = gradients[n], g.mass[:, None]
        p = g.v - gradient * (g.x - centres[n])
        v = g.v + 0.5 * dt * g.force / mass
        motion = mass * v * (p + 0.5 * dt * (g.force / mass - gradient * v))
        expected[n + 1] = -dt * gradient * (0.5 * (powers[n] + powers[n + 1]) + motion.sum(axis=0))
        if n:
            before = g.v - gradients[n - 1] * (g.x - centres[n - 1])
            expected[n + 1] += 0.5 * (mass * (p - before) * (p + before)).sum(axis=0)
    scale = np.abs(expected).max(axis=0)
    for a, name in enumerate(AXES):
        require_close(found[:, a], expected[:, a], 1e-9, name, scale[a])
    with_walls = [np.abs((r["force"] * r["branch"])[r["id"][:, 1] == 0]).sum(axis=0) for r in rows]
    require(np.max(with_walls) > 0.1 * np.abs(powers).max(), "the plates push nobody")


def other_laws(ranks):
    """Walls that push by other laws than grains do, each by its own."""
    deck = scene(
        spheroids(16, 2.6, 0.8), half=6.0, timestep=0.1 * rayleigh_time(0.5), material=Material(restitution=(0.6,))
    )
    scenery = [
        FALL,
        wall(deck, PLANE, model="model hooke tangential no_history surface ellipsoid"),
        wall(
            deck,
            "primitive type 1 zcylinder 2.7 0. 0.",
            "side",
            "model hertz tangential history rolling_friction cdt surface ellipsoid",
        ),
        wall(deck, "primitive type 1 zplane 6.0", "lid", "model hertz tangential off surface ellipsoid"),
    ]
    scenery[1] = scenery[1].replace(UNDAMPED, "")
    scenery[3] = scenery[3].replace(UNDAMPED, "")
    table = run_with(body(deck, scenery, 3000, 500), ranks).thermo()[0]
    for row in range(len(table["step"])):
        require_closes(account(table, row), f"row {row}")
    a = account(table)
    for name in ("D_n_w", "D_t_w", "D_damp_w", "D_rolling_w"):
        require(a[name] > 0.0, f"{name} is nothing")
    require_equal(a["D_rolling"], a["D_rolling_w"], "only a wall has rolling friction")
    require_equal(a["D_damp"], a["D_damp_w"], "only a wall has tangential damping")


def restarted(hole, *words, extra=UNDAMPED):
    """A run that is split and restarted goes on to the last bit, also where grains leave, with springs on walls; with
    `setup neutral` it is the run that was never split."""

    def case(ranks):
        deck = pour(ranks, count=16, extra=extra)
        deck.extra = " ".join([deck.extra, *words])
        head, runs = deck.body[:-1], ["run 3000", "write_restart half.restart", "run 2000"]
        surfaces = [("funnel", funnel(3.2, hole))]
        through = run_with(replace(deck, body=[*head, *runs]), ranks, surfaces)
        again = run_with(deck.restarted(through.folder / "half.restart", [*head, runs[-1]]), ranks, surfaces)
        a, b = account(through.thermo()[-1]), account(again.thermo()[-1])
        require_closes(b, "restarted")
        require_same_snapshots(
            again.dump("grains.dump")[-1:], through.dump("grains.dump")[-1:], "restarted against write-and-continue"
        )
        require_equal([b[n] for n in NAMES], [a[n] for n in NAMES], "the ledger, restarted")
        require(a["U_t_w"] > 0.0, "no spring on the walls")
        if words:
            whole = account(run_with(replace(deck, body=[*head, "run 5000"]), ranks, surfaces).thermo()[0])
            require_close([b[n] for n in NAMES], [whole[n] for n in NAMES], 1e-10, "not split", turnover(whole))
        else:
            require(through.thermo()[-1]["atoms"][-1] < 16, "nobody left")

    return case


def torn_apart(ranks):
    """Two spheres leave one after the other, pressed together: what is stored in their contact leaves with the
    first."""
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
    "drum": in_drum(),
    "drum-synchronized": in_drum(SYNCHRONIZED, SYNCHRONIZED),
    "drum-synchronized-walls": in_drum(UNDAMPED, SYNCHRONIZED),
    "drum-synchronized-grains": in_drum(SYNCHRONIZED, UNDAMPED),
    "bounce-synchronized-spheres": bounce("plane", style="sphere", surface="default", extra=SYNCHRONIZED),
    "bounce-synchronized-long": bounce("mesh", (1.0, 1.0, 1.5), extra=SYNCHRONIZED),
    "bounce-synchronized-superquadric": bounce("plane", (1.0, 1.0, 1.5), surface="superquadric", extra=SYNCHRONIZED),
    "bounce-synchronized-no-history": bounce("mesh", tangential="no_history", extra=LEVEL),
    "plate-synchronized": lambda ranks: plate(ranks, SYNCHRONIZED),
    "hopper-synchronized": hopper("sphere", SYNCHRONIZED),
    "restarted-synchronized": restarted(1.4, extra=SYNCHRONIZED),
    "restarted-synchronized-neutral": restarted(0.3, "setup neutral", extra=SYNCHRONIZED),
    "hopper-spheroids": hopper("superquadric"),
    "hopper-spheres": hopper("sphere"),
    "drops-out": drops_out,
    "drained": drained,
    "torn-apart": torn_apart,
    "seen-from-outside": seen_from_outside,
    "rained": rained,
    "between-runs": between_runs,
    "frozen": frozen,
    "pulls": pulls,
    "in-a-box-that-shears": in_a_box_that_shears,
    "in-a-box-that-stretches": in_a_box_that_stretches,
    "other-laws": other_laws,
    "restarted": restarted(1.4),
    "restarted-neutral": restarted(0.3, "setup neutral"),
}

if __name__ == "__main__":
    main(CASES)
