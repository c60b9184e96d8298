# SPDX-License-Identifier: GPL-2.0-or-later
"""compute field against numpy in boxes that shear, tilt, flip or have walls; its sums over the cells against the
measures of the whole box."""
from dataclasses import replace
import math

import numpy as np

import clumps
from case import main, require, require_close, require_equal, require_same_snapshots
from contact_measures import flipped, undamped
from deck import Deck, dump_grains, thermo
from grainscope.columns import outputs
from meshes import folder_with
from oracle import field as oracle
from oracle.comparison_field import OF_CONTACTS, OF_GRAINS, Asked, block, largest, require_agreement
from oracle.field_grid import Grid
from packing import Grain, Packing, dense_packing, disc_packing, tilted
from refusal import require_refused
from run import run
from scopes import MIXTURE
from wall_measures import BOX, DRUM
from watch import Flow, Watched, deforming, moments_of, watch, watched_deck

ALL = (*OF_GRAINS, *OF_CONTACTS)
WITH_AXES = (*ALL, *oracle.OF_AXES)
FLOW = deforming(0.4)
SIZES = (0.8, 0.9, 1.0, 1.1)
SPHERES = undamped(dense_packing(atom_style="sphere", sizes=SIZES))
ELLIPSOIDS = undamped(dense_packing(alpha=1.5), surface="ellipsoid")
GRIDS = {"layers": (1, 6, 1), "cells": (3, 4, 2), "fine": (30, 1, 1)}


def asked_on(grids, quantities=ALL, **choices):
    return [Asked(name, grid, quantities, **choices) for name, grid in grids.items()]


def measured(deck, asked, ranks, flow=Flow(), group="all", settle=0, meshes=None, **choices):
    computes = [one.watched for one in asked]
    made = watched_deck(deck, computes, flow, group, settle=settle, **{"every": 10, "thermo_every": 10, **choices})
    result = run(made, ranks, folder=folder_with(**(meshes or {})))
    return list(moments_of(result, flow, group))


def agrees(deck, asked, flow=Flow(), check=None, fewest=20, snapshots=3, **choices):
    def case(ranks):
        moments = measured(deck, asked, ranks, flow, **choices)
        require(len(moments) == snapshots, f"{len(moments)} snapshots")
        for moment in moments:
            require(len(moment.rows["fn"]) >= fewest, f"{len(moment.rows['fn'])} contacts")
            for one in asked:
                require_agreement(one, moment)
        if check:
            check(moments)

    return case


BOX_GRIDS = {name: Grid(cells) for name, cells in GRIDS.items()}
PART = Grid((2, 3, 4), bounds=((0.1, 0.7), (0.25, 1.0), None))
LAB = {
    "window": Grid((3, 4, 2), "lab", ((2.0, 7.5), (1.0, 8.0), None)),
    "beyond": Grid((4, 3, 3), "lab", ((-6.0, 13.0), (-4.0, 3.0), (2.0, 9.0))),
    "profile": Grid((1, 5, 1), "lab", (None, (0.5, 6.0), None)),
    "whole": Grid((3, 2, 2), "lab"),
}


def tilting(minimum=100):
    """A box that tilts and flips half-way through the steps that are looked at."""
    deck = undamped(tilted(dense_packing(atom_style="sphere", minimum=minimum), 0.499))
    lx, ly, _ = deck.packing.edges
    return deck, deforming(0.002 * lx / ly / (20 * deck.dt()))


def in_walls(grid):
    return replace(grid, periodic=(False, False, False))


WALLED = {
    "between": in_walls(Grid((3, 2, 4))),
    "column": in_walls(Grid((1, 1, 9))),
    "inside": in_walls(Grid((2, 2, 3), "lab", ((1.0, 6.0), (0.5, 7.0), (2.0, 6.0)))),
    "around": in_walls(Grid((3, 1, 4), "lab", ((-5.0, 15.0), None, (-9.0, 3.0)))),
}


def smooth(kernel, width=0.8, tolerance=5e-4):
    """The gaussian jumps by 1 % of its height where it is cut, and quadratures differ by shares of that."""
    grids = {
        "one": Grid((1, 9, 1), kernel=kernel, width=width),
        "two": Grid((5, 1, 4), kernel=kernel, width=width),
        "three": Grid((3, 4, 2), kernel=kernel, width=width),
        "lab": Grid((1, 4, 3), "lab", (None, (1.0, 7.0), (0.0, 5.0)), kernel, width),
    }
    return asked_on(grids, quadrature=tolerance)


def rings(**choices):
    return Grid(frame="lab", periodic=(False, False, False), about=("y", 0.0, 0.0), **choices)


RINGS = {
    "rings": rings(cells=(5, 1, 2), ring=(0.5, 6.0), bounds=(None, (-3.0, 4.0), None)),
    "disc": rings(cells=(3, 1, 1), ring=(0.0, 5.0)),
}
# In a periodic box, not about its middle: what leaves across a face comes in again.
PIPES = {
    "pipes": Grid((4, 1, 3), "lab", about=("z", 4.0, 3.5), ring=(0.0, 4.4)),
    "thick": Grid((1, 1, 2), "lab", (None, None, (1.0, 6.0)), about=("z", 1.0, 1.0), ring=(1.0, 3.0)),
    "along_x": Grid((3, 1, 1), "lab", about=("x", 4.0, 3.5), ring=(0.2, 4.0)),
}

DISCS = undamped(disc_packing())
PLANE = {
    "plane": Grid((4, 3, 1), dimension=2),
    "strip": Grid((1, 7, 1), dimension=2),
    "corner": Grid((2, 2, 1), "lab", ((3.0, 9.0), (2.0, 8.0), None), dimension=2),
    "smooth": Grid((4, 5, 1), dimension=2, kernel="lucy", width=0.8),
}

OF_TYPES = [
    Asked("of_12", in_walls(Grid((2, 1, 3))), types=(1, 2), wall_type=2),
    Asked("of_2", in_walls(Grid((2, 1, 3))), types=(2, None), wall_type=2),
    Asked("of_1", in_walls(Grid((2, 1, 3))), types=(1, 1), walls="no", wall_type=2),
]
OF_WALLS = [Asked(f"walls_{w}", in_walls(Grid((2, 3, 2))), walls=w) for w in ("no", "yes", "only")]


# Sums over the cells


def mean_over(table, quantity, weight):
    return (block(table, quantity) * weight[:, None]).sum(axis=0) / weight.sum()


WHOLE = {
    "stress": Watched("stress", "stress/contact volume auto", True, 36),
    "fabric": Watched("fabric", "fabric walls yes", True, 22),
    "now": Watched("now", "dissipation mode instantaneous", True, 10),
    "packing": Watched("pack", "packing rate 1.0", True, 18),
    "order": Watched("order", "nematic", True, 20),
}
SUM = 1e-12


def require_sums(table, moment, what, grained=True):
    """The columns of `table` add up to the measures of the whole box."""
    volume, contacts = table["V"], table["N_c"] + table["N_w"]
    box = moment.force_box.volume
    stress = moment.vector(WHOLE["stress"])
    s = (block(table, "stress") * volume[:, None]).sum(axis=0).reshape(3, 3) / box
    seven = [s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2], s[1, 0]]
    size = np.abs(moment.rows["force"]).max() * len(moment.rows["fn"]) / box
    require_close(seven, stress[:7], SUM, f"{what}: stress", size)
    for first, quantity in ((7, "stress_normal"), (13, "stress_tangential")):
        s = (block(table, quantity) * volume[:, None]).sum(axis=0).reshape(3, 3) / box
        six = [s[0, 0], s[1, 1], s[2, 2], s[0, 1], s[0, 2], s[1, 2]]
        require_close(six, stress[first : first + 6], SUM, f"{what}: {quantity}", size)
    require_equal([table["N_c"].sum(), table["N_w"].sum()], stress[[29, 35]], f"{what}: N_c, N_w")
    require_close((table["Z"] * table["N"]).sum() / table["N"].sum(), stress[30], SUM, f"{what}: Z")
    require_close((table["overlap"] * contacts).sum() / contacts.sum(), stress[32], SUM, f"{what}: overlap")
    found = mean_over(table, "fabric", contacts)
    require_close(found, moment.vector(WHOLE["fabric"])[:6], SUM, f"{what}: fabric", 1.0)
    now = moment.vector(WHOLE["now"])
    for name, k in (("P_n", 0), ("P_t", 1), ("P_t_damp", 2)):
        require_close(
            (table[name] * volume).sum(), now[k] + now[k + 5], SUM, f"{what}: {name}", largest(now[:3], now[0])
        )
    phi = (table["phi"] * volume).sum() / box
    require_close(phi, moment.vector(WHOLE["packing"])[0], SUM, f"{what}: phi")
    if moment.grains.shape is not None:
        q = mean_over(table, "Q", table["N"])
        require_close(q, moment.vector(WHOLE["order"])[:6], SUM, f"{what}: Q", 1.0)
    require_equal(table["N"].sum(), moment.chosen.sum(), f"{what}: grains")


def adds_up(deck, grids, flow=Flow(), own=True, **choices):
    """`own`: of the compute; else of the oracle alone, which is held by the measures that there were."""

    def case(ranks):
        with_axes = deck.packing.atom_style != "sphere"
        asked = asked_on(grids, WITH_AXES if with_axes else ALL)
        watched = [w for name, w in WHOLE.items() if with_axes or name != "order"]
        every = {"every": 10, "thermo_every": 1 if flow.line else 10, **choices}
        computes = [*(one.watched for one in asked if own), *watched]
        for moment in moments_of(run(watched_deck(deck, computes, flow, **every), ranks), flow):
            for one in asked:
                table = one.found(moment) if own else one.expected(moment)
                require_sums(table, moment, f"{one.name}, step {moment.step}")

    return case


WHOLES = {**BOX_GRIDS, "whole": LAB["whole"]}
WALLED_WHOLES = {name: WALLED[name] for name in ("between", "column")}


# The oracle itself


def clipped_as_sampled(ranks):
    """Two ways to share branches among cells: half spaces, and 4000 points of each, which are off by a point for each
    face that is crossed."""
    deck, flow = tilting()
    grids = {**BOX_GRIDS, "part": PART, **LAB, **PIPES}
    for moment in watch(deck, [], flow, ranks, every=20, settle=5)[:1]:
        few = {name: values[::30] for name, values in moment.rows.items()}
        end = moment.grains.x[moment.grains.index(few["id"][:, 0])]
        for name, grid in grids.items():
            placed = grid.in_box(moment.force_box)
            exact = placed.shares(end - few["branch"], end)
            sampled = placed.shares(end - few["branch"], end, sampled=4000)
            require_close(exact, sampled, 4.0 / 4000, name, 1.0)
            whole = exact.sum(axis=1)
            filled = name in GRIDS or name == "whole"
            require(exact.max() > 0.01 and (np.abs(whole - 1.0).max() < 1e-12 or not filled), f"{name}: {whole}")


HAND_BOX = Packing((8.0, 8.0, 8.0), [], triclinic=False)


def by_hand(ranks):
    """Two spheres that touch across a face of cells, and one across the periodic face."""
    radii, places = (1.0, 1.0, 0.5), ((2.6, 2.0, 2.0), (4.5, 2.0, 2.0), (7.9, 6.0, 6.0))
    velocity = ((1.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 0.0, 5.0))
    grains = [Grain(p, (r,) * 3, velocity=v) for p, r, v in zip(places, radii, velocity)]
    packing = replace(HAND_BOX, grains=grains, atom_style="sphere")
    moment = watch(Deck(packing), [], Flow(), ranks, every=1, steps=0)[0]
    require(len(moment.rows["fn"]) == 1, "one contact")
    table = oracle.field(Grid((2, 1, 1)), moment.rows, moment.grains, moment.force_box, moment.chosen)
    mass = moment.grains.mass
    require_equal(table["N"], [1.0, 2.0], "grains")
    require_close(table["rho"], [mass[0] / 256.0, (mass[1] + mass[2]) / 256.0], 1e-14, "rho")
    require_close(table["v_x"], [1.0, 3.0 * mass[1] / (mass[1] + mass[2])], 1e-14, "v_x")
    force = abs(moment.rows["fn"][0])
    require_close(table["s_xx"], -force * np.array([1.4, 0.5]) / 256.0, 1e-12, "s_xx")
    require_equal(table["Z"], [1.0, 0.5], "Z")
    require_equal(table["N_c"], [1.0, 0.0], "contacts")  # at x = 3.55
    ball = 4.0 / 3.0 * np.pi
    require_close(table["phi"], np.array([ball, ball * 1.125]) / 256.0, 1e-12, "phi")


def weights_of_kernels(ranks):
    """Sums over the cells of a fine grid are integrals: 1, in one, two and three axes."""
    x = np.array([[1.3, 2.2, 3.1], [7.9, 0.1, 4.0]])
    box = type("Cube", (), {"edges": np.eye(3) * 8.0, "origin": np.zeros(3), "rate": np.zeros((3, 3))})()
    box.edges[0, 1] = 1.0
    for kernel in ("lucy", "gaussian"):
        for cells, tolerance in (((1, 400, 1), 1e-3), ((1, 80, 80), 3e-3), ((24, 24, 24), 2e-2)):
            placed = Grid(cells, kernel=kernel, width=0.6).in_box(box)
            point, _, _, weight, _ = placed.entries(x)
            require_close(np.bincount(point, weight), [1.0, 1.0], tolerance, f"{kernel}, {cells}")


# What else holds


def order_of_columns(ranks):
    """Columns come in the order of the definitions."""
    some = ("overlap", "stress", "density", "velocity")
    asked = [Asked("one", Grid((2, 2, 1)), some), Asked("other", Grid((2, 2, 1)), some[::-1])]
    for moment in measured(SPHERES, asked, ranks, settle=OFF_LATTICE):
        require_equal(moment.array(asked[0].watched), moment.array(asked[1].watched), "columns")
        require_agreement(asked[0], moment)


def empty_cells(ranks):
    """Grains in one half of a long box; an empty group; all ratios 0."""
    packing = dense_packing(atom_style="sphere", minimum=30)
    long = replace(packing, edges=(*packing.edges[:2], 3.0 * packing.edges[2]))
    asked = asked_on({"empty": Grid((1, 2, 6)), "nothing": Grid((2, 2, 2), "lab", (None, None, (20.0, 22.0)))})
    agrees(undamped(long), asked, fewest=1, settle=OFF_LATTICE)(ranks)
    table = asked[0].found(measured(undamped(long), asked[:1], ranks)[0])
    require((table["N"] == 0).any(), "empty cells")
    for moment in measured(undamped(long), asked[:1], ranks, group="5000:5001"):
        found = asked[0].found(moment)
        for name in asked[0].names[4:]:
            require_equal(found[name], np.zeros(12), name)


def on_faces(ranks):
    """A lattice with grains, contacts and branches on faces and planes between cells: nothing twice, nothing lost."""
    edge, size = 3, 1.98
    grains = [Grain(tuple(size * k for k in cell)) for cell in np.ndindex(edge, edge, edge)]
    deck = Deck(Packing((edge * size,) * 3, grains, atom_style="sphere"))
    whole = outputs("stress/contact").of("s")
    grids = ("3 1 1 frame lab", "1 3 6 frame lab", "3 1 1", "6 2 3 x 0 1 frame box", f"3 3 3 y 0.0 {edge * size!r}")
    body, asked = ["compute s all stress/contact"], [whole["syy"], whole["N_c"]]
    for k, grid in enumerate(grids):
        count = math.prod(int(n) for n in grid.split()[:3])
        body.append(f"compute f{k} all field grid {grid} quantities stress contacts")
        asked.append(f"c_f{k}[1]")
        asked += [f"c_f{k}[{row}][{column}]" for row in range(1, count + 1) for column in (10, 15)]
    table = run(replace(deck, body=[*body, *thermo(1, *asked), "run 0"]), ranks).thermo()[-1]
    values = iter([float(table[word][0]) for word in asked])
    stress, contacts = next(values), next(values)
    require_equal(contacts, 3 * edge**3, "contacts")
    for grid in grids:
        count = math.prod(int(n) for n in grid.split()[:3])
        require_equal(next(values), edge**3, f"grid {grid}: grains")
        cells = np.array([(next(values), next(values)) for _ in range(count)])
        require_close(cells[:, 0].mean(), stress, 1e-12, f"grid {grid}: stress")
        require_equal(cells[:, 1].sum(), contacts, f"grid {grid}: contacts")


def other_region(ranks):
    """A region is known by its ID, also in a run that is not set up."""
    here, there = "block 0 3 0 3 0 3 units box", "block 1 5 2 4 0 6 units box"
    start = [f"region place {here}", f"region there {there}"]
    start += [f"compute {ID} all field grid 1 1 2 region {ID} quantities phi stress" for ID in ("place", "there")]
    asked = [f"c_{ID}[{row}][{column}]" for ID in ("place", "there") for row in (1, 2) for column in (4, 5, 6, 7)]
    again = ["region place delete", f"region place {there}", "run 5 pre no"]
    tables = run(replace(SPHERES, body=[*start, *thermo(5, *asked), "run 5", *again]), ranks).thermo()
    require(tables[0][asked[0]][0] != tables[0][asked[8]][0], "places that differ")
    for one, other in zip(asked[:8], asked[8:]):
        require_equal(tables[1][one][-1:], tables[1][other][-1:], one)


def mixture_warned_of(ranks):
    flat, long = (1.0, 1.0, 0.5), (1.0, 1.0, 2.0)
    for shapes, warnings in (((flat, long), 1), ((long, long), 0)):
        grains = [Grain((5.0 * k + 2.5, 5.0, 5.0), shape) for k, shape in enumerate(shapes)]
        body = ["compute f all field grid 1 1 1 quantities S2", *thermo(1, "c_f[1][6]"), "run 2"]
        output = run(Deck(Packing((10.0, 10.0, 10.0), grains), body=body), ranks).output
        require_equal(output.count("mixes flat and long grains"), warnings, f"warnings of {shapes}")


def trajectory_untouched(ranks):
    grains = dump_grains(SPHERES.packing, 20)
    body = [*SPHERES.body, FLOW.line]
    asked = asked_on(BOX_GRIDS)
    looks = [one.watched.define("all") for one in asked]
    looks += [
        "variable sum equal " + "+".join(f"c_{one.name}[1][5]" for one in asked),
        "thermo_style custom step v_sum",
    ]
    plain = run(replace(SPHERES, body=[*body, *grains, "thermo 1", "run 20"]), ranks)
    seen = run(replace(SPHERES, body=[*body, *looks, *grains, "thermo 1", "run 20"]), ranks)
    require_same_snapshots(seen.dump("grains.dump"), plain.dump("grains.dump"), "grains")


def by_region(ranks):
    """The bounds of a block are those of the grid."""
    block_line = "region part block 2.0 7.5 1.0 8.0 0.5 5.0 units box"
    sides = ((2.0, 7.5), (1.0, 8.0), (0.5, 5.0))
    asked = Asked("bounds", Grid((2, 3, 2), "lab", sides))
    other = replace(asked.watched, name="region", command="field grid 2 3 2 region part quantities " + " ".join(ALL))
    made = watched_deck(
        replace(SPHERES, body=[block_line]), [asked.watched, other], every=10, thermo_every=10, settle=OFF_LATTICE
    )
    for moment in moments_of(run(made, ranks)):
        require_agreement(asked, moment)
        require_equal(moment.array(other), moment.array(asked.watched), "region")


def clumps_refused(ranks):
    lines = [*clumps.start(), "compute it all field grid 1 4 1 quantities density", "thermo_style custom step c_it"]
    text = "\n".join([*lines, "run 1"]) + "\n"
    require_refused(text, ranks, "compute field", "clumps", folder=clumps.folder())


TILTING, TILTS = tilting()
SMALL, SMALL_TILTS = tilting(30)
# On the lattice, from which grains start, contact points lie on faces of cells.
OFF_LATTICE = 10
SHEARED = {"flow": FLOW, "settle": 40, "thermo_every": 1}
CASES = {
    "sheared-spheres": agrees(SPHERES, [*asked_on(BOX_GRIDS), Asked("part", replace(PART, frame="box"))], **SHEARED),
    "sheared-ellipsoids": agrees(ELLIPSOIDS, asked_on(BOX_GRIDS, WITH_AXES), **SHEARED),
    "flipping-box": agrees(
        TILTING, asked_on(BOX_GRIDS), TILTS, flipped, settle=5, every=5, thermo_every=1, snapshots=5
    ),
    "laboratory": agrees(TILTING, asked_on(LAB), TILTS, flipped, settle=5, every=5, thermo_every=1, snapshots=5),
    "walls": agrees(BOX.deck, asked_on(WALLED), settle=60),
    "which-walls": agrees(BOX.deck, OF_WALLS, settle=60),
    "types": agrees(MIXTURE.deck, OF_TYPES, settle=60),
    "group": agrees(SPHERES, asked_on(BOX_GRIDS), group="10:70", **SHEARED),
    "gaussian": agrees(SMALL, smooth("gaussian"), SMALL_TILTS, settle=5, thermo_every=1, snapshots=2),
    "lucy": agrees(SMALL, smooth("lucy", tolerance=1e-6), SMALL_TILTS, settle=5, thermo_every=1, snapshots=2),
    "rings-in-a-drum": agrees(
        DRUM.deck, asked_on(RINGS, WITH_AXES), settle=DRUM.settle, meshes=DRUM.meshes, every=20, snapshots=2
    ),
    "rings-in-a-periodic-box": agrees(SPHERES, asked_on(PIPES), **SHEARED),
    "two-dimensions": agrees(DISCS, asked_on(PLANE, quadrature=1e-6), **SHEARED),
    "sums": adds_up(SPHERES, WHOLES, FLOW, settle=40),
    "sums-ellipsoids": adds_up(ELLIPSOIDS, WHOLES, FLOW, settle=40),
    "sums-between-walls": adds_up(BOX.deck, WALLED_WHOLES, settle=60),
    "order-of-columns": order_of_columns,
    "empty-cells": empty_cells,
    "by-region": by_region,
    "on-faces": on_faces,
    "other-region": other_region,
    "mixture-warned-of": mixture_warned_of,
    "trajectory-untouched": trajectory_untouched,
    "clumps-refused": clumps_refused,
    "oracle-clipped-as-sampled": clipped_as_sampled,
    "oracle-by-hand": by_hand,
    "oracle-weights-of-kernels": weights_of_kernels,
    "oracle-sums": adds_up(SPHERES, WHOLES, FLOW, own=False, settle=40),
    "oracle-sums-ellipsoids": adds_up(ELLIPSOIDS, WHOLES, FLOW, own=False, settle=40),
    "oracle-sums-between-walls": adds_up(BOX.deck, WALLED_WHOLES, own=False, settle=60),
}

if __name__ == "__main__":
    main(CASES)
