# SPDX-License-Identifier: GPL-2.0-or-later
"""Discs in two dimensions that are pressed, sheared, followed and held by walls, on every grid of ranks."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from deck import Deck, Material, dump_grains, dump_local, thermo
from everything import press
from grainscope.columns import outputs
import meshes
from oracle.state import ROW_WIDTH, chosen_rows, rows_of
from packing import Grain, disc_packing
from rank_sweep import Start, sweep
from run import run

C_STRESS = outputs("stress/contact").of("s")
C_WALL = outputs("wall/contact").of("w")
C_LEDGER = outputs("energy/ledger").of("energy")
C_MOVED = outputs("displacement/shear").of("moved")
F_PRESS = outputs("press/strain").of("p")
WALL_COLUMNS = ("area_w", "force_y_w", "p_w")
SUMS = 1e-10  # in another order


def ledger(ranks):
    """Its balance closes to rounding under pressure control and shear, and a spin has the energy of a disc."""
    deck = Deck(disc_packing(), extra="ledger on", body=[press(2e5), "compute energy all energy/ledger"])
    entries = ("W_shear", "W_box", "D_n", "D_t", "K_tr", "K_rot", "residual_relative")
    body = [*deck.body, *thermo(50, *(C_LEDGER[e] for e in entries)), "run 1000"]
    table = run(replace(deck, body=body), ranks).thermo()[0]
    require(abs(table[C_LEDGER["W_shear"]][-1]) > 0.0 and table[C_LEDGER["D_t"]][-1] > 0.0, "nothing was booked")
    require(np.abs(table[C_LEDGER["residual_relative"]]).max() < 1e-12, "the ledger does not close")

    lone = replace(deck.packing, grains=[Grain((1.0, 1.0, 0.0), omega=(0.0, 0.0, 0.3)), Grain((9.0, 9.0, 0.0))])
    body = ["compute energy all energy/ledger", *thermo(1, *(C_LEDGER[e] for e in entries)), "run 5"]
    table = run(replace(deck, packing=lone, body=body), ranks).thermo()[0]
    require_close(table[C_LEDGER["K_rot"]], [0.25 * 1000.0 * math.pi * 0.3**2] * 6, 1e-12, "K_rot of a disc")


def pressure(ranks):
    """fix press/strain: its pressure is that of stress/contact with the kinetic part, per length; it holds the target
    in the mean, in shear and at rest."""
    deck = Deck(disc_packing())
    flow = "fix p all press/strain axis y target 1e5 shear xy rate 0.05 every 1e-3 kinetic yes"
    quantities = [F_PRESS["P"], "f_p", C_STRESS["P"], C_STRESS["syy_kinetic"], "ly"]
    body = [flow, "compute s all stress/contact", *thermo(10, *quantities), "run 3000"]
    table = run(replace(deck, body=body), ranks).thermo()[0]
    require_close(table[F_PRESS["P"]], table[C_STRESS["P"]] - table[C_STRESS["syy_kinetic"]], SUMS, "P of the fix")
    late = table["step"] > 1000
    require_close(table["f_p"][late].mean(), 1e5, 0.03, "mean pressure in shear")

    still = replace(deck, packing=disc_packing(sizes=(1.0,), speed=0.0), material=Material(restitution=(0.1,)))
    relax = "fix p all press/strain axis y target 3e4 every/step 20"
    body = [relax, *thermo(20, "f_p"), "run 4000"]
    table = run(replace(still, body=body), ranks).thermo()[0]
    require_close(table["f_p"][table["step"] > 2000].mean(), 3e4, 0.01, "mean pressure of a lattice at rest")


def displacement(ranks):
    """In a box at rest, against where the grains went."""
    deck = Deck(
        disc_packing(), body=["variable strain equal step*dt", "compute moved all displacement/shear strain v_strain"]
    )
    entries = ("d2_x", "d2_y", "d2_z", "N")
    body = [
        *deck.body,
        *thermo(50, *(C_MOVED[e] for e in entries)),
        *dump_grains(deck.packing, 50, columns="id xu yu zu"),
        "run 400",
    ]
    result = run(replace(deck, body=body), ranks)
    table, dump = result.thermo()[0], result.dump("grains.dump")
    start = dump[0][1]
    for row, (_, now) in enumerate(dump):
        expected = [np.mean((now[k] - start[k]) ** 2) for k in ("xu", "yu")]
        found = [table[C_MOVED[e]][row] for e in ("d2_x", "d2_y")]
        require_close(found, expected, 1e-9, "<d^2>", max(*expected, 1e-6))
    require_equal(table[C_MOVED["d2_z"]], np.zeros(len(dump)), "<d_z^2>")


def walls(ranks):
    """Between two walls: an area is a length, and in a box at rest -Omega sigma_ab = sum of F_a x_b over contacts with
    walls, F on the wall."""
    packing = replace(disc_packing(sizes=(1.0,), overlap=0.002, speed=0.0), triclinic=False)
    (lx, ly, _) = packing.edges
    low = packing.grains[0].position[1] - 0.998
    high = ly - low
    deck = Deck(packing, boundary="p f p", material=Material(restitution=(0.1,)))
    wall = f"all wall/gran {deck.model()} primitive type 1"
    body = [
        f"fix low {wall} yplane {low!r}",
        f"fix high {wall} yplane {high!r}",
        "compute s all stress/contact",
        "compute w all wall/contact",
        "compute rows all contact/local",
        *thermo(2000, C_STRESS["syy"], C_STRESS["N_w"], *(C_WALL[r, n] for r in (1, 2) for n in WALL_COLUMNS)),
        *dump_local("rows", ROW_WIDTH, 2000, "rows"),
        "run 2000",
    ]
    result = run(replace(deck, body=body), ranks)
    table = {k: v[-1] for k, v in result.thermo()[0].items()}
    require(table[C_STRESS["N_w"]] == 20, "walls without grains")
    for row in (1, 2):
        require_equal(table[C_WALL[row, "area_w"]], lx, "length of a wall")
        force = table[C_WALL[row, "force_y_w"]]
        require_close(table[C_WALL[row, "p_w"]], abs(force) / lx, SUMS, "p, force per length")
    at_walls = chosen_rows(rows_of(result.dump("rows.dump")[-1][1], "rows"), "only")
    total = -at_walls["force"][:, 1] @ at_walls["point"][:, 1]
    # at rest to what rounding leaves of motion; tension positive, force on the wall
    require_close(-table[C_STRESS["syy"]] * lx * ly, total, 1e-9, "-Omega sigma_yy")


def ring(ranks):
    """A cylinder across the plane is a circle; a mesh has no length, and says so where none is given."""
    packing = replace(disc_packing(sizes=(1.0,), speed=0.1), triclinic=False)
    inside = [g for g in packing.grains if math.hypot(g.position[0] - 9.8, g.position[1] - 8.5) < 4.0]
    deck = Deck(replace(packing, grains=inside), boundary="f f p")
    wall = f"all wall/gran {deck.model()}"
    body = [
        f"fix ring {wall} primitive type 1 zcylinder 6.0 9.8 8.5",
        "compute w all wall/contact",
        *thermo(1, C_WALL[1, "area_w"]),
        "run 1",
    ]
    table = run(replace(deck, body=body), ranks).thermo()[0]
    require_close(table[C_WALL[1, "area_w"]], [12.0 * math.pi] * 2, 1e-15, "length of a circle")

    packing = replace(deck.packing, edges=(*packing.edges[:2], 10.0), origin=(0.0, 0.0, -5.0))
    deck = replace(deck, packing=packing)  # a shallower box fails an assertion of LIGGGHTS's lists of triangles
    lowest = min(g.position[1] for g in inside)
    line = meshes.rectangle((5.0, lowest - 0.99, -0.4), (10.0, 0.0, 0.0), (0.0, 0.0, 0.8))
    for more, length in (("", 0.0), (" area line 10.0", 10.0)):
        body = [
            "fix line all mesh/surface file line.stl type 1",
            f"fix wall {wall} mesh n_meshes 1 meshes line",
            "compute w all wall/contact" + more,
            *thermo(1, *(C_WALL[1, n] for n in ("N_w", "F_n_w", *WALL_COLUMNS))),
            "run 1",
        ]
        result = run(replace(deck, body=body), ranks, folder=meshes.folder_with(line=line))
        table = result.thermo()[0]
        said = "a mesh has no length in two dimensions" in " ".join(result.output.split())
        require(said == (length == 0.0), f"said of a mesh without a length: {said}")
        require(table[C_WALL[1, "N_w"]][0] > 0.0, "nothing touches the mesh")
        require_equal(table[C_WALL[1, "area_w"]], [length] * 2, "length of a mesh")
        expected = table[C_WALL[1, "F_n_w"]] / length if length else [0.0, 0.0]
        require_close(table[C_WALL[1, "p_w"]], expected, 1e-15, "p of a mesh", 1e6)


def regions(ranks):
    """Parts of the plane add up to it, and a region's Omega is the area of its cut by the plane of the grains, here at
    z = 1/2: of P per a given area to P the area is known."""
    packing = disc_packing()
    raised = [replace(g, position=(*g.position[:2], 0.5)) for g in packing.grains]
    packing = replace(packing, grains=raised, origin=(0.0, 0.0, 0.0))
    lx, ly, _ = packing.edges
    areas = {
        "left": 7.3 * ly,
        "right": (lx - 7.3) * ly,
        "pipe": 9.0 * math.pi,
        "ball": (9.0 - 0.25) * math.pi,
    }
    body = [
        "region left block INF 7.3 INF INF INF INF units box",
        "region right block 7.3 INF INF INF INF INF units box",
        "region pipe cylinder z 9.0 8.0 3.0 INF INF units box",
        "region ball sphere 9.0 8.0 0.0 3.0 units box",
        "compute s all stress/contact",
    ]
    quantities = [C_STRESS["sxx"], C_STRESS["P"]]
    for name in areas:
        for ID, volume in ((name, ""), (f"{name}_1", "volume 1")):
            body.append(f"compute {ID} all stress/contact region {name} {volume}")
            words = outputs("stress/contact").of(ID)
            quantities += [words["sxx"], words["P"]]
    deck = Deck(replace(packing, triclinic=False), body=[*body, *thermo(20, *quantities), "run 60"])
    table = run(deck, ranks).thermo()[0]
    for name, area in areas.items():
        per_one, of_area = (table[outputs("stress/contact").of(ID)["P"]] for ID in (f"{name}_1", name))
        require_close(per_one / of_area, [area] * len(of_area), SUMS, f"area of {name}")
    left, right = (table[outputs("stress/contact").of(f"{name}_1")["sxx"]] for name in ("left", "right"))
    require_close(left + right, table[C_STRESS["sxx"]] * lx * ly, 1e-12, "two parts of the plane")


def decompositions(ranks):
    grids = {2: ("2 1 1", "1 2 1"), 4: ("2 2 1", "4 1 1")}[ranks]
    sweep(Start(Deck(disc_packing(), extra="ledger on")), grids)(ranks)


def in_parts(ranks):
    """`setup neutral`: two runs are one, but for the order of sums in another neighbour list."""
    deck = Deck(disc_packing(), extra="setup neutral")
    dump = dump_grains(deck.packing, 100)
    one, two = (
        run(replace(deck, body=[press(2e5), *dump, *runs]), ranks).dump("grains.dump")
        for runs in (["run 400"], ["run 200", "run 200"])
    )
    for (_, expected), (_, found) in zip(one, two):
        for name in ("vx", "vy", "omegaz"):
            require_close(found[name], expected[name], 1e-9, f"{name} of a run in two parts")


main(
    {
        "ledger": ledger,
        "pressure": pressure,
        "displacement": displacement,
        "walls": walls,
        "ring": ring,
        "regions": regions,
        "decompositions": decompositions,
        "in-parts": in_parts,
    }
)
