# SPDX-License-Identifier: GPL-2.0-or-later
"""Balances that compute field must keep: of mass and momentum in cells, of weight in a pile; flows that have no
temperature."""
from dataclasses import replace

import numpy as np

from case import main, require, require_close, require_equal
from contact_measures import undamped
from deck import DENSITY, Deck, number
from field import measured
from oracle.comparison_field import Asked, block, largest, require_agreement
from oracle.field_grid import Grid
from packing import Grain, Packing, dense_packing
from wall_measures import GRAVITY, HOPPER, PISTON, gravity, wall
from watch import deforming

WEIGHT = 9.81
EXACT = 1e-11

# No temperature


def free(velocity, spacing=3.0, count=6):
    """Spheres that do not touch, moving as `velocity` says, in a box without walls."""
    places = [
        np.array([i + 0.1 * np.sin(k), j + 0.1 * np.cos(i), k + 0.1 * np.sin(i + j)]) * spacing + 2.0
        for i in range(count)
        for j in range(count)
        for k in range(count)
    ]
    grains = [Grain(tuple(x), velocity=tuple(velocity(x))) for x in places]
    packing = Packing((spacing * count + 2.0,) * 3, grains, atom_style="sphere", triclinic=False)
    return Deck(packing, boundary="f f f")


MIDDLE = np.array([9.0, 10.0, 8.0])
RATES = np.array([[1.0, 0.4, -0.2], [0.3, -0.5, 0.7], [-0.6, 0.2, 0.1]])
IN_LAYERS = np.zeros((3, 3))
IN_LAYERS[:, 1] = (0.8, -0.3, 0.2)


def affine(x):
    return RATES @ (x - MIDDLE)


def turning(x):
    return np.cross([0.3, -0.5, 0.9], x - MIDDLE)


def layered(x):
    return IN_LAYERS @ (x - MIDDLE)


def about_z(x):
    return np.cross([0.0, 0.0, 0.9], x - [10.0, 9.0, 0.0]) + [0.0, 0.0, 0.2 * x[2]]


NOT_PERIODIC = (False, False, False)
MOTION = ("velocity", "temperature", "stress_kinetic")
CUBE = Grid((3, 3, 3), periodic=NOT_PERIODIC)
LAB = Grid((3, 4, 3), "lab", ((1.0, 19.0), (0.0, 20.0), (2.0, 18.0)), periodic=NOT_PERIODIC)
SMOOTH = Grid((3, 3, 3), kernel="lucy", width=2.0, periodic=NOT_PERIODIC)
LAYERS = Grid((1, 5, 1), periodic=NOT_PERIODIC)
PIPES = Grid((3, 1, 3), "lab", periodic=NOT_PERIODIC, about=("z", 10.0, 9.0), ring=(0.0, 9.0))


def cold(flow, *grids):
    """T is nothing beside the square of the velocity."""

    def case(ranks):
        asked = [Asked(f"field{k}", grid, MOTION) for k, grid in enumerate(grids)]
        for moment in measured(free(flow), asked, ranks, contacts=False, every=5, thermo_every=5, steps=5):
            fastest = largest(np.linalg.norm(moment.grains.v, axis=1)) ** 2
            for one in asked:
                table = one.found(moment)
                require(largest(block(table, "velocity")) > 0.1, "cells that move")
                require_close(block(table, "temperature"), np.zeros((one.grid.number, 4)), 1e-20, one.name, fastest)
                kinetic = block(table, "stress_kinetic")
                require_close(kinetic, np.zeros_like(kinetic), 1e-20, one.name, fastest * DENSITY)

    return case


def cold_sheared_box(ranks):
    """Grains that move as the box does, in layers that are neighbours across its face."""
    rate = 0.5
    packing = dense_packing(atom_style="sphere", overlap=-0.05, speed=0.0)
    grains = [replace(g, velocity=(rate * g.position[1], 0.0, 0.0)) for g in packing.grains]
    asked = [Asked("layers", Grid((1, 5, 1)), MOTION), Asked("cells", Grid((2, 3, 2)), MOTION)]
    deck = Deck(replace(packing, grains=grains))
    for moment in measured(deck, asked, ranks, deforming(rate), steps=20, every=10, thermo_every=1):
        fastest = largest(moment.grains.v) ** 2
        for one in asked:
            table = one.found(moment)
            require_close(table["T"], np.zeros(one.grid.number), 1e-18, one.name, fastest)


# Mass


def mass(ranks):
    """The mass of a cell changes by the grains that crossed its faces; those that leave the grid are outside."""
    bounds = ((1.0, 6.0), (0.5, 7.0), (2.0, 6.5))
    asked = Asked("mass", Grid((2, 3, 2), "lab", bounds), ("density",))
    packing = replace(dense_packing(atom_style="sphere", sizes=(0.9, 1.0), speed=20.0), triclinic=False)
    low, high = np.array(bounds).T
    edges, crossed = np.array(packing.edges), 0

    def cell_of(x):
        where = (((x % edges) - low) / (high - low) * asked.grid.cells).astype(float)
        inside = ((where >= 0.0) & (where < asked.grid.cells)).all(axis=1)
        index = np.floor(where).astype(int) @ [1, 2, 6]
        return np.where(inside, index, asked.grid.number)

    before = None
    for moment in measured(undamped(packing), [asked], ranks, steps=100, every=10):
        table, cells, m = asked.found(moment), cell_of(moment.grains.x), moment.grains.mass
        held = table["rho"] * table["V"]
        if before:
            change = np.zeros(asked.grid.number + 1)
            moved = np.flatnonzero(cells != before[1])
            np.add.at(change, cells[moved], m[moved])
            np.add.at(change, before[1][moved], -m[moved])
            crossed += len(moved)
            require_close(held - before[0], change[:-1], EXACT, "mass that came", m.max() * 10)
        require_equal(moment.vector(asked.watched)[3], (cells == asked.grid.number).sum(), "grains outside")
        before = (held, cells)
    require(crossed > 20, f"{crossed} grains crossed a face")


# A pile


def pile():
    """Spheres on a floor, periodic along x and y, that settle."""
    packing = dense_packing(atom_style="sphere", overlap=0.002, speed=0.1)
    x, y, z = packing.edges
    packing = replace(packing, edges=(x, y, z + 6.0), triclinic=False)
    deck = undamped(packing)
    deck.boundary = "p p f"
    lowest = min(g.position[2] for g in packing.grains)
    deck.body = [
        gravity(np.array([0.0, 0.0, -WEIGHT])),
        wall(deck, "floor", f"primitive type 1 zplane {number(lowest - 0.999)}"),
        "fix drag all viscous 2e4",
        "thermo 500",
        "run 1000",
        "unfix drag",
    ]
    return deck


IN_PILE = (True, True, False)
COLUMN = Grid((1, 1, 8), periodic=IN_PILE)
BLOCKS = Grid((2, 3, 5), periodic=IN_PILE)
BALANCED = ("density", "momentum", "stress", "traction")


def require_layers_in_balance(asked, moment, pull):
    """With psi = the share of the cells k that lies below z, A integral of sigma_az over layer k is minus the sum over
    grains of psi (f - m g) plus the sum over contacts with walls of psi F, whatever moves: f is the grains' force of
    this step, g = `pull`. And walls bear what hangs on them."""
    g, rows, table, layers = moment.grains, moment.rows, asked.found(moment), asked.grid.cells[2]
    own = g.force - g.mass[:, None] * pull
    at_wall = rows["id"][:, 1] == 0
    require(at_wall.sum() > 5, "grains at walls")
    size = np.abs(rows["force"]).sum()
    thick = moment.force_box.edges[2, 2] / layers
    for k in range(layers):
        cells = np.arange(asked.grid.number).reshape(layers, -1)[k]
        sides = (0.0 if k else -np.inf, 1.0 if k < layers - 1 else np.inf)  # the last ones go on
        psi, psi_wall = (
            np.clip((z - moment.force_box.origin[2]) / thick - k, *sides)
            for z in (g.x[:, 2], rows["point"][at_wall][:, 2])
        )
        expected = -(psi @ own) + psi_wall @ rows["force"][at_wall]
        found = [(table[f"s_{a}z"][cells] * table["V"][cells]).sum() / thick for a in "xyz"]
        require_close(found, expected, EXACT, f"{asked.name}, layer {k}", size)
    found = (block(table, "traction") * table["V"][:, None]).sum(axis=0)
    require_close(found, own.sum(axis=0), EXACT, f"{asked.name}: the walls", size)
    held = (table["rho"] * table["V"]).sum()
    require_close(held, g.mass.sum(), 1e-13, "all of the mass")


def weight(ranks):
    """A pile that is at rest, but for what its grains still push each other."""
    asked = [Asked("column", COLUMN, BALANCED), Asked("blocks", BLOCKS, BALANCED)]
    moments = measured(pile(), asked, ranks, steps=20, every=10)
    for moment in moments:
        for one in asked:
            require_layers_in_balance(one, moment, np.array([0.0, 0.0, -WEIGHT]))
    grains = moments[-1].grains
    rest = np.abs(grains.force).sum() / (WEIGHT * grains.mass.sum())
    require(rest < 0.05, f"the pile is at rest: forces are {rest:.2g} of its weight")


def between_meshes(scene, moves):
    def case(ranks):
        asked = [Asked("column", replace(COLUMN, periodic=NOT_PERIODIC), BALANCED)]
        asked.append(Asked("blocks", replace(BLOCKS, periodic=NOT_PERIODIC), BALANCED))
        moments = measured(scene.deck, asked, ranks, settle=scene.settle, meshes=scene.meshes)
        for moment in moments:
            for one in asked:
                require_layers_in_balance(one, moment, GRAVITY)
        fastest = np.abs(moments[-1].grains.v[:, 2]).max()
        require(fastest > moves, f"grains move at {fastest:.2g}")

    return case


# Momentum


def residual(asked, before, now, after, dt, pull=WEIGHT):
    """Of d p/dt = d/dy (sigma - momentum carried) + rho g, by differences of order 2; all in layers along y, in a
    sheared box of those whose neighbours are not across a face that moves."""
    tables = [asked.found(m) for m in (before, now, after)]
    placed = asked.grid.in_box(now.force_box)
    g = now.grains
    v = g.v  # of the end of the step, when positions are those of the forces
    point, shift, cell, weight, _ = placed.entries(g.x)
    carried = np.zeros((asked.grid.number, 3))
    v = v[point] + shift @ placed.box.rate.T
    np.add.at(carried, cell, (weight * g.mass[point])[:, None] * v * v[:, 1:2])
    carried /= placed.volume
    rate = (block(tables[2], "momentum") - block(tables[0], "momentum")) / (2.0 * dt)
    table = tables[1]
    flux = np.stack([table[f"s_{a}y"] for a in "xyz"], axis=1) - carried
    step = now.force_box.edges[1, 1] / asked.grid.number
    divergence = (np.roll(flux, -1, axis=0) - np.roll(flux, 1, axis=0)) / (2.0 * step)
    pull = table["rho"][:, None] * np.array([0.0, -pull, 0.0])
    kept = slice(1, -1) if placed.box.rate.any() else slice(None)
    return np.abs(rate - divergence - pull)[kept].max(), np.abs(divergence)[kept].max()


def momentum(ranks):
    """Lucy's function is smooth, so that what central differences leave falls as the square of the cells. (The gaussian
    is cut at 3 widths, where it falls to 0 from 1 % of its height: its derivative by differences does not converge.)"""
    asked = [Asked(f"n{n}", Grid((1, n, 1), kernel="lucy", width=1.2), BALANCED) for n in (16, 32, 64)]
    packing = replace(dense_packing(atom_style="sphere", speed=2.0), triclinic=False)
    deck = undamped(packing)
    deck.body = [gravity(np.array([0.0, -WEIGHT, 0.0]))]
    deck.timestep = 0.1 * deck.dt()
    moments = measured(deck, asked, ranks, settle=200, steps=6, every=1, thermo_every=1)
    require_order_two([residual(one, *moments[2:5], deck.dt()) for one in asked])


def require_order_two(left):
    size = left[-1][1]
    require(size > 1.0, "momentum that flows")
    shares = [one / size for one, _ in left]
    require(shares[2] < 1e-2, f"what is left of the balance: {shares}")
    for coarse, fine in zip(shares, shares[1:]):
        require(3.0 < coarse / fine < 5.0, f"order 2: {shares}")


def sheared_momentum(ranks):
    """The same in a box that is sheared, by layers that do not touch its moving faces."""
    asked = [Asked(f"n{n}", Grid((1, n, 1), kernel="lucy", width=1.2), BALANCED) for n in (16, 32, 64)]
    deck = undamped(dense_packing(atom_style="sphere", speed=2.0))
    deck.timestep = 0.1 * deck.dt()
    flow = deforming(2.0)
    moments = measured(deck, asked, ranks, flow, settle=200, steps=6, every=1, thermo_every=1)
    require_order_two([residual(one, *moments[2:5], deck.dt(), 0.0) for one in asked])


def gaussian_momentum(ranks):
    """Integrated over half of the layers, the divergence is the difference of sigma at two faces; the total of a
    periodic box has none: d p/dt = rho g in the sum over the cells."""
    asked = Asked("whole", Grid((1, 80, 1), kernel="gaussian", width=0.8), ("density", "momentum"))
    packing = replace(dense_packing(atom_style="sphere", speed=2.0), triclinic=False)
    deck = undamped(packing)
    deck.body = [gravity(np.array([0.0, -WEIGHT, 0.0]))]
    moments = measured(deck, [asked], ranks, settle=50, steps=10, every=5, thermo_every=5)
    tables = [asked.found(m) for m in moments]
    p = [(block(t, "momentum") * t["V"][:, None]).sum(axis=0) for t in tables]
    mass_of = moments[0].grains.mass.sum()
    rate = (p[2] - p[0]) / (10 * deck.dt())
    require_close(rate, [0.0, -WEIGHT * mass_of, 0.0], 3e-3, "d p/dt", WEIGHT * mass_of + largest(p[0]))
    require_close((tables[0]["rho"] * tables[0]["V"]).sum(), mass_of, 2e-3, "mass in all layers")
    for moment in moments:
        require_agreement(asked, moment)


CASES = {
    "cold-affine": cold(affine, CUBE, LAB, SMOOTH),
    "cold-rotation": cold(turning, CUBE, LAB, SMOOTH),
    "cold-layers": cold(layered, LAYERS, CUBE),
    "cold-rotation-in-rings": cold(about_z, PIPES),
    "cold-sheared-box": cold_sheared_box,
    "mass": mass,
    "weight": weight,
    "silo": between_meshes(HOPPER, 0.1),
    "under-a-plate": between_meshes(PISTON, 0.1),
    "momentum": momentum,
    "momentum-sheared": sheared_momentum,
    "momentum-gaussian": gaussian_momentum,
}

if __name__ == "__main__":
    main(CASES)
