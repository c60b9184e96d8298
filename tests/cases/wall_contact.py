# SPDX-License-Identifier: GPL-2.0-or-later
"""wall/contact against the momentum and angular momentum of all grains, the host's own sums over a mesh, weights,
speeds of walls, trajectories."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import POISSON, YOUNG, Deck, Material, dump_grains, thermo
from grainscope.columns import outputs
from packing import Grain, Packing
from walled import FLOOR, WALLS, area_of, boxed, cube, drum, flat, run_with_meshes

OWN = outputs("wall/contact")
# Sums of some ten numbers of the same size, in double precision.
ROUNDING = 1e-12
# The host takes what it adds to a mesh as a difference of forces on grains, a digit or two less.
HOST = 1e-11
GRAVITY = "fix gravity all gravity 9.81 vector 0.3 0 -1"


def words(name, rows):
    """Vector and rows of a compute without impacts."""
    vector = [f"c_{name}[{OWN.index(n)}]" for n in OWN.names("vector") if "impact" not in n]
    return [f"c_{name}", *vector, *(f"c_{name}[{r}][{k + 1}]" for r in range(1, rows + 1) for k in range(len(vector)))]


def of(table, name, output, row=None):
    return table[OWN.word(name, output + ("" if row is None else "_w"), row)]


def vectors(table, name, output, row=None):
    return np.stack([of(table, name, f"{output}_{axis}", row) for axis in "xyz"], axis=1)


def of_grains(columns, *names):
    return np.stack([columns[n] for n in names], axis=1)


FLOOR_OF_BALLS = flat(-5.9, 5.9, 5)
ABOUT = np.array([1.0, 2.0, -0.5])


def balance(ranks):
    """Without gravity the forces of grains on each other cancel, and so do their torques: force and torque on all walls
    are what all grains lack. Rolling friction is a couple beside. A plane's normal force is its force along the axis.
    And one rank finds the same."""
    for style, shape, choices in (
        ("sphere", (1.0, 1.0, 1.0), {"rolling": "cdt"}),
        ("superquadric", (1.0, 1.0, 1.02), {"surface": "ellipsoid"}),
    ):
        packing = cube(shape, style)
        deck = boxed(packing, **choices)
        deck.body += [
            "compute w all wall/contact about " + " ".join(map(repr, map(float, ABOUT))),
            *thermo(2, *words("w", len(WALLS))),
            *dump_grains(packing, 2),
            "run 20",
        ]
        result = run_with_meshes(deck, ranks, floor=FLOOR)
        table = result.thermo()[-1]
        force, torque = vectors(table, "w", "force"), vectors(table, "w", "torque")
        require(bool((of(table, "w", "N") > 20).all()), "few contacts")
        large = float(np.abs(of(table, "w", "F_n")).max())
        for k, (_, grains) in enumerate(result.dump("grains.dump")):
            f, t, x = (of_grains(grains, *names.split()) for names in ("fx fy fz", "tqx tqy tqz", "x y z"))
            require_close(force[k], -f.sum(axis=0), ROUNDING, "force on all walls", large)
            lacking = -(np.cross(x - ABOUT, f) + t).sum(axis=0)
            require_close(torque[k], lacking, ROUNDING, "torque on all walls", 5 * large)
        for row, wall in enumerate(WALLS[1:], 2):
            axis, sign = "xy".index(wall[0]), -1.0 if wall[1] == "0" else 1.0
            require_close(vectors(table, "w", "force", row)[:, axis], sign * of(table, "w", "F_n", row), ROUNDING, wall)
        for name in ("N", "F_n", "F_t", "P_n", "P_t", "power", "force_z", "torque_y"):
            rows = sum(of(table, "w", name, row) for row in range(1, len(WALLS) + 1))
            require_close(of(table, "w", name), rows, ROUNDING, f"sum of {name}", max(large, np.abs(rows).max()))
        require_equal(table["c_w"], of(table, "w", "F_n"), "scalar")
        if ranks > 1:
            alone = run_with_meshes(deck, 1, floor=FLOOR).thermo()[-1]
            for name in table:
                scale = max(float(np.abs(alone[name]).max()), large)
                require_close(table[name], alone[name], 1e-12, f"{name} of {ranks} ranks and of one", scale)


def couple(ranks):
    """Of a ball that spins on a smooth wall the wall feels the couple of rolling friction, mu_r r F_n, in the sense of
    the spin, and nothing else about the ball."""
    ball = Grain((1.0, 2.0, 0.99), omega=(0.0, 3.0, 0.0))
    packing = Packing((12.0,) * 3, [ball], origin=(-6.0,) * 3, atom_style="sphere", triclinic=False)
    deck = Deck(packing, boundary="f f f", rolling="cdt", material=Material(friction=(0.0,), rolling=(0.1,)))
    deck.body = [
        f"fix floor all wall/gran {deck.model()} primitive type 1 zplane 0",
        "compute w all wall/contact about 1 2 0",
        *thermo(1, *words("w", 1)),
        *dump_grains(packing, 1),
        "run 3",
    ]
    result = run_with_meshes(deck, ranks)
    table = result.thermo()[-1]
    # in the first evaluation of a run the host damps beyond the friction limit, which sets the ball in motion
    force, torque = vectors(table, "w", "force")[1:], vectors(table, "w", "torque")[1:]
    grains = [g for _, g in result.dump("grains.dump")][1:]
    turned, x = (np.stack([of_grains(g, *names.split())[0] for g in grains]) for names in ("tqx tqy tqz", "x y z"))
    require_close(torque, -turned + np.cross(x - [1.0, 2.0, 0.0], force), ROUNDING, "torque against the grain's")
    # the model takes the elastic part of F_n, of two equal materials
    elastic = 4.0 / 3.0 * YOUNG / (2.0 * (1.0 - POISSON**2)) * (1.0 - x[:, 2]) ** 1.5
    require_close(-turned[:, 1], 0.1 * elastic, 1e-9, "couple")
    require_equal(of(table, "w", "F_t")[1], 0.0, "friction")


def mesh_stress(ranks):
    """The host's own force on a mesh, and its torque: it has the force act in the mesh, at the grain's radius less the
    overlap, and the contact law half an overlap nearer to the grain. On a floor that is nothing about z."""
    packing = cube()
    deck = boxed(packing)
    deck.body += [
        GRAVITY,
        "compute w all wall/contact walls floor",
        *thermo(5, *words("w", 1), *(f"f_floor[{k}]" for k in range(1, 7))),
        "run 200",
    ]
    table = run_with_meshes(deck, ranks, floor=FLOOR).thermo()[-1]
    host = np.stack([table[f"f_floor[{k}]"] for k in range(1, 7)], axis=1)[1:]
    force, torque = vectors(table, "w", "force", 1)[1:], vectors(table, "w", "torque", 1)[1:]
    large = float(np.abs(host[:, 2]).max())
    require(large > 1e4, "the floor bears nothing")
    require_close(force, host[:, :3], HOST, "force on a mesh", large)
    require_close(torque[:, 2], host[:, 5], HOST, "torque about z", 5 * large)
    between = np.abs(torque[:, :2] - host[:, 3:5]).max(axis=1)
    deepest = 0.1
    require(bool((between <= 0.5 * deepest * of(table, "w", "F_t", 1)[1:]).all()), "torque on a mesh is another")
    require(between.max() > 0.0, "nothing pulls the floor sideways")


def weight(ranks):
    """At rest the floor bears the grains, and what it bears over its area is the pressure."""
    grains = [Grain((2.5 * k, 0.0, 0.99 + 0.01 * k)) for k in range(-1, 2)]
    packing = Packing((12.0,) * 3, grains, origin=(-6.0, -6.0, -2.0), atom_style="sphere", triclinic=False)
    deck = Deck(packing, boundary="f p f", material=Material(restitution=(0.1,)))
    deck.body = [
        "fix gravity all gravity 9.81 vector 0 0 -1",
        f"fix floor all wall/gran {deck.model()} primitive type 1 zplane 0",
        "compute w all wall/contact",
        "group one id 1",
        "compute one one wall/contact",
        *thermo(4000, *words("w", 1), *words("one", 1)),
        "run 4000",
    ]
    table = {name: values[-1:] for name, values in run_with_meshes(deck, ranks).thermo()[-1].items()}
    bears = packing.grains[0].mass() * 9.81
    # what they still move by
    require_close(vectors(table, "w", "force"), [[0.0, 0.0, -3.0 * bears]], 1e-6, "weight of three", bears)
    require_close(vectors(table, "one", "force"), [[0.0, 0.0, -bears]], 1e-6, "weight of one", bears)
    require_equal(of(table, "w", "N"), [3.0], "contacts")
    require_close(of(table, "w", "p", 1), [3.0 * bears / 144.0], 1e-6, "pressure")
    require_close(of(table, "w", "area"), [144.0], ROUNDING, "area")


def rows_by_name(ranks):
    """The command outputs says which wall each row is of, in the order that was asked for."""
    packing = Packing((12.0,) * 3, [Grain((0.0, 0.0, 2.0))], origin=(-6.0,) * 3, atom_style="sphere", triclinic=False)
    deck = Deck(packing, boundary="f f f")
    wall = f"all wall/gran {deck.model()} primitive type 1"
    deck.body = [f"fix floor {wall} zplane -5", f"fix lid {wall} zplane 5"]
    deck.body += ["compute w all wall/contact walls lid floor", "outputs w", "run 0"]
    said = run_with_meshes(deck, ranks).output
    require("array: i from 1 to 2, one row per wall: 1 lid, 2 floor\n" in said, said)


def power_of_a_plane(ranks):
    """A wall that moves as a whole gives force times velocity."""
    packing = cube()
    for moves, velocity in (
        ("fix lid all wall/gran {} primitive type 1 zplane 5.88 shear x 0.5", (0.5, 0.0, 0.0)),
        ("fix move all move/mesh mesh floor linear 0.3 0.0 0.1", (0.3, 0.0, 0.1)),
    ):
        deck = boxed(packing)
        name = "lid" if "lid" in moves else "floor"
        deck.body += [
            moves.format(deck.model()),
            f"compute w all wall/contact walls {name} x0",
            *thermo(2, *words("w", 2)),
            "run 20",
        ]
        table = run_with_meshes(deck, ranks, floor=FLOOR).thermo()[-1]
        # the host lets a mesh rest in the first evaluation of a run
        power, force = of(table, "w", "power", 1)[1:], vectors(table, "w", "force", 1)[1:]
        require(np.abs(power).max() > 10.0, f"no power of {name}")
        require_close(power, -force @ velocity, ROUNDING, f"power of {name}")
        require_equal(of(table, "w", "power", 2), 0.0 * of(table, "w", "power", 2), "power of a wall at rest")


def rotating(ranks):
    """A drum's power is its rate times the host's torque, which acts where the mesh's velocity is taken."""
    radius, period = 3.2, 4.0
    random = np.random.default_rng(5)
    grains = [
        Grain((1.9 * i, 1.9 * j, 1.9 * k - 0.2), velocity=tuple(0.3 * random.normal(size=3)))
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
        for k in (-1, 0, 1)
        if i == 0 or k == 0
    ]
    packing = Packing((8.0,) * 3, grains, origin=(-4.0,) * 3, atom_style="sphere", triclinic=False)
    deck = Deck(packing, boundary="f f f")
    wall = f"all wall/gran {deck.model()}"
    deck.body = [
        "fix gravity all gravity 5 vector 0 0 -1",
        "fix drum all mesh/surface/stress file drum.stl type 1 reference_point 0 0 0",
        f"fix round {wall} mesh n_meshes 1 meshes drum",
        f"fix near {wall} primitive type 1 yplane -2.9",
        f"fix far {wall} primitive type 1 yplane 2.9",
        f"fix turns all move/mesh mesh drum rotate origin 0 0 0 axis 0 1 0 period {period}",
        "compute w all wall/contact walls drum",
        *thermo(20, *words("w", 1), *(f"f_drum[{k}]" for k in range(1, 7))),
        "run 1000",
    ]
    mesh = drum(radius, 3.5, 24)
    table = {n: v[1:] for n, v in run_with_meshes(deck, ranks, drum=mesh).thermo()[-1].items()}
    rate, torque = 2.0 * math.pi / period, vectors(table, "w", "torque", 1)[:, 1]
    power, shear = of(table, "w", "power", 1), of(table, "w", "F_t", 1)
    large = float(np.abs(power).max())
    require(large > 1e3 and bool((of(table, "w", "N", 1)[-10:] > 3).all()), "the drum carries nothing")
    require_close(power, -rate * table["f_drum[5]"], 1e-9, "power of a drum", large)
    deepest = 0.1
    require(
        bool((np.abs(power + rate * torque) <= rate * 0.5 * deepest * shear + 1e-9 * large).all()), "torque times rate"
    )
    require_close(of(table, "w", "area", 1), area_of(mesh).sum() + 0.0 * power, 1e-9, "area of a drum")


def bouncing(material=Material(restitution=(0.8,)), grains=None):
    grains = grains or [
        Grain((-3.0, -2.2, 0.999)),  # lies there, or nearly
        Grain((-3.0, 0.0, 1.05), velocity=(2.5, 0.7, -2.0)),
        Grain((-3.0, 2.5, 1.2), velocity=(2.3, 0.0, -1.0), omega=(0.0, 3.0, 1.0)),
        Grain((3.5, 0.5, 1.5), velocity=(0.0, -1.0, 0.0)),
    ]
    packing = Packing((12.0, 12.0, 8.0), grains, origin=(-6.0, -6.0, -1.0), atom_style="sphere", triclinic=False)
    deck = Deck(packing, boundary="f f f", material=material)
    deck.body = [
        "fix gravity all gravity 20 vector 0 0 -1",
        "fix floor all mesh/surface file floor.stl type 1",
        f"fix below all wall/gran {deck.model()} mesh n_meshes 1 meshes floor",
        f"fix side all wall/gran {deck.model()} primitive type 1 yplane 5.9",
    ]
    return deck


def impacts(ranks):
    """Counted from the trajectory: a grain is above the floor in one step and in it in the next. One that goes from
    triangle to triangle meets nothing new."""
    deck = bouncing()
    impact = [OWN.index(n) for n in ("N_impacts", "impact_velocity", "impact_energy")]
    deck.body += [
        "compute w all wall/contact impacts yes",
        *thermo(50, *(f"c_w[{r}][{k}]" for r in (1, 2) for k in impact), *(f"c_w[{k}]" for k in impact)),
        *dump_grains(deck.packing, 1),
        "run 400",
    ]
    result = run_with_meshes(deck, ranks, floor=FLOOR_OF_BALLS)
    table, dumps = result.thermo()[-1], result.dump("grains.dump")
    column = {n: np.stack([g[n] for _, g in dumps]) for n in ("x", "y", "z", "vz", "fz", "mass")}
    inside = column["z"] < 1.0
    approach = -(column["vz"] - 0.5 * deck.dt() * column["fz"] / column["mass"])
    fresh = inside[1:] & ~inside[:-1]
    speeds, masses = approach[1:][fresh], column["mass"][1:][fresh]
    require(len(speeds) > 8, f"only {len(speeds)} impacts")
    require(np.ptp(column["x"], axis=0).max() > 4.0, "no grain goes far")
    n, mean, energy = (table[f"c_w[1][{k}]"][-1] for k in impact)
    require_equal(n, float(len(speeds)), "impacts")
    require_close(mean, speeds.mean(), 1e-9, "velocity of impacts")
    require_close(energy, (0.5 * masses * speeds**2).sum(), 1e-9, "energy of impacts")
    require_equal(table[f"c_w[2][{impact[0]}]"][-1], 0.0, "impacts on the other wall")
    require_equal(table[f"c_w[{impact[0]}]"][-1], n, "impacts on both")
    counted = [fresh[:step].sum() for step in table["step"].astype(int)]
    require_equal(table[f"c_w[1][{impact[0]}]"], np.array(counted, dtype=float), "impacts so far")


def impacts_resumed(ranks):
    """From a restart file the count goes on; between runs nothing is counted twice."""
    deck = bouncing()
    n = [OWN.word("w", name) for name in ("N_impacts", "impact_energy")]
    body = deck.body + ["compute w all wall/contact impacts yes", *thermo(50, *n)]
    deck = replace(deck, body=[*body, "run 100", "write_restart half.restart", "run 300"])
    first = run_with_meshes(deck, ranks, floor=FLOOR_OF_BALLS)
    tables = first.thermo()
    require(tables[0][n[0]][-1] > 1.0 and np.ptp(tables[1][n[0]]) > 0.0, "too few impacts")
    text = deck.restarted(first.folder / "half.restart", [*body, "run 300"])
    resumed = run_with_meshes(text, ranks, floor=FLOOR_OF_BALLS).thermo()[-1]
    require_equal(resumed[n[0]], tables[1][n[0]], "impacts after a restart")
    require_close(resumed[n[1]], tables[1][n[1]], 1e-6, "their energy")


def losses(ranks):
    """A ball that bounces once loses its energy to P_n; one that slides loses mu F_n times its velocity to P_t."""
    ball = Grain((0.0, 0.0, 1.01), velocity=(0.0, 0.0, -1.0))
    deck = bouncing(Material(restitution=(0.5,)), [ball])
    deck.timestep = 0.01 * deck.dt()
    deck.body = [  # without gravity
        *deck.body[1:],
        "compute w all wall/contact walls floor",
        *thermo(1, *words("w", 1)),
        *dump_grains(deck.packing, 1),
        "run 9000",
    ]
    result = run_with_meshes(deck, ranks, floor=FLOOR_OF_BALLS)
    table, last = result.thermo()[-1], result.dump("grains.dump")[-1][1]
    require(last["z"][0] > 1.0 and last["vz"][0] > 0.1, "it has not bounced")
    lost = 0.5 * ball.mass() * (1.0 - last["vz"][0] ** 2)
    # P_n pairs forces with velocities half a step earlier; so many steps of a contact
    require_close(of(table, "w", "P_n", 1).sum() * deck.timestep, lost, 1e-2, "energy lost in a bounce")

    slider = Grain((0.0, 0.0, 0.99), velocity=(5.0, 0.0, 0.0))
    deck = bouncing(Material(friction=(0.1,)), [slider])
    deck.body += [
        "compute w all wall/contact walls floor",
        *thermo(1, *words("w", 1)),
        *dump_grains(deck.packing, 1),
        "run 20",
    ]
    result = run_with_meshes(deck, ranks, floor=FLOOR_OF_BALLS)
    table, dumps = result.thermo()[-1], result.dump("grains.dump")
    slides = of(table, "w", "N_sliding", 1)[5:] == 1.0
    require(bool(slides.all()), "it does not slide")
    mass, dt = slider.mass(), deck.dt()
    inertia = 0.4 * mass
    for k, (_, g) in list(enumerate(dumps))[5:]:
        arm = 0.5 * (1.0 + g["z"][0])  # the law's lever
        u = g["vx"][0] - 0.5 * dt * g["fx"][0] / mass - arm * (g["omegay"][0] - 0.5 * dt * g["tqy"][0] / inertia)
        normal = g["fz"][0] + 20.0 * mass
        require_close(of(table, "w", "P_t", 1)[k], 0.1 * normal * abs(u), 1e-9, "power of friction")


def areas(ranks):
    """Planes and cylinders fill the box; what does not, or in a box that follows the grains, is 0 and is said."""
    packing = cube()
    deck = boxed(packing)
    wall = f"all wall/gran {deck.model()}"
    deck.body += [
        f"fix c {wall} primitive type 1 zcylinder 4.8 3 3",
        f"fix far {wall} primitive type 1 ycylinder 30 3 3",
        "compute w all wall/contact area x1 7.5",
        "compute c all wall/contact walls c x0",
        *thermo(1, *words("w", 7), *words("c", 2)),
        "run 1",
    ]
    result = run_with_meshes(deck, ranks, floor=FLOOR)
    table = {n: v[:1] for n, v in result.thermo()[-1].items()}
    for row, area in enumerate((64.0, 100.0, 7.5, 100.0, 100.0, 96.0 * math.pi, 0.0), 1):
        require_close(of(table, "w", "area", row), [area], ROUNDING, f"area of wall {row}", 100.0)
        p = of(table, "w", "F_n", row) / area if area else [0.0]
        require_close(of(table, "w", "p", row), p, ROUNDING, f"pressure on wall {row}", 100.0)
    require_equal(of(table, "w", "area"), [0.0], "area of all, where one is not known")
    require_close(of(table, "c", "area"), [100.0 + 96.0 * math.pi], ROUNDING, "area of two")
    require("the area of wall 'far' is not known (it reaches beyond the box)" in result.output, "nothing is said")
    deck.boundary = "s f f"
    output = run_with_meshes(deck, ranks, floor=FLOOR).output
    require("the area of wall 'y0' is not known (the box is shrink-wrapped along it" in output, "nothing is said of y0")
    require("the area of wall 'x0' is not known" not in output, "x0 has an area")


def bounded(ranks):
    """A warning names the walls that end another inside the box, where its area was not given."""
    bounds = "is all of it that lies in the box, but it meets inside the box: "
    edge = 5.88
    for at, sides, area, bounding in (
        (0.0, [("x0", "xplane 0"), ("x1", f"xplane {edge}")], "", "x0, x1"),
        (0.0, [("x0", "xplane 0"), ("x1", f"xplane {edge}")], " area z0 34.6", None),
        (0.0, [("x0", "xplane -2"), ("lid", "zplane 7")], "", None),  # at a face, and beside it
        (0.0, [("c", "zcylinder 4.2 2.94 2.94")], "", "c"),
        (0.0, [("c", "zcylinder 8 2.94 2.94")], "", None),  # around the box
        (0.0, [], "", None),
        (-1.0, [("mesh", "")], "", None),
        (0.5, [("mesh", "")], "", "floor"),
    ):
        packing = cube()
        deck = Deck(packing, boundary="f f f")
        wall = f"all wall/gran {deck.model()}"
        deck.body = [f"fix z0 {wall} primitive type 1 zplane {at}"]
        for name, words_of_it in sides:
            if name == "mesh":  # upright
                deck.body += ["fix floor all mesh/surface file floor.stl type 1"]
                deck.body += [f"fix meshes {wall} mesh n_meshes 1 meshes floor"]
            else:
                deck.body += [f"fix {name} {wall} primitive type 1 {words_of_it}"]
        deck.body += ["compute w all wall/contact walls z0" + area, "run 0", "run 0"]
        upright = [[(x, y, z + 0.5) for x, z, y in triangle] for triangle in flat(0.0, edge, 1)]
        output = " ".join(run_with_meshes(deck, ranks, floor=upright).output.split())
        found = output.split(bounds)[1:]
        require(len(found) == (bounding is not None), f"{sides}: {len(found)} warnings")
        if bounding:
            require(found[0].startswith(bounding + ". If"), f"{sides}: {found[0][:80]}")
    # A cylinder between planes.
    deck = Deck(cube(), boundary="f f f")
    wall = f"all wall/gran {deck.model()}"
    deck.body = [f"fix c {wall} primitive type 1 zcylinder 4.2 2.94 2.94", f"fix z0 {wall} primitive type 1 zplane 0"]
    deck.body += ["compute w all wall/contact walls c", "run 0"]
    output = " ".join(run_with_meshes(deck, ranks).output.split())
    require("area of wall 'c' " + bounds + "z0" in output, "nothing is said of a cylinder on a plane")


CASES = {
    "balance": balance,
    "couple": couple,
    "mesh-stress": mesh_stress,
    "weight": weight,
    "rows-by-name": rows_by_name,
    "power-of-a-plane": power_of_a_plane,
    "drum": rotating,
    "impacts": impacts,
    "impacts-resumed": impacts_resumed,
    "losses": losses,
    "areas": areas,
    "bounded": bounded,
}

if __name__ == "__main__":
    main(CASES)
