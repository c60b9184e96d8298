# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts with walls where the answer is known: one grain that bounces, slides, rolls, rests or is carried around by a
drum; the balance of forces in a full box and between plates."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close, require_equal
from collisions import kinetic_energy
from deck import POISSON, YOUNG, Deck, Material, dump_grains, rayleigh_time, thermo
from grainscope.columns import outputs
from packing import DENSITY, Grain, Packing, number
from ledger import LEDGER, LOSSES, TOTALS, UNDAMPED, account, turnover, with_ledger
from run import run

G = 9.81
MASS = 4.0 / 3.0 * math.pi * DENSITY  # of a sphere of radius 1
INERTIA = 0.4 * MASS
YOUNG_EFFECTIVE = 0.5 * YOUNG / (1.0 - POISSON**2)
SHEAR_EFFECTIVE = 0.25 * YOUNG / ((2.0 - POISSON) * (1.0 + POISSON))


def overlap_under(force, radius=1.0):
    """Overlap of a sphere that is pressed on a wall: Hertz."""
    return (force / (4.0 / 3.0 * YOUNG_EFFECTIVE * math.sqrt(radius))) ** (2.0 / 3.0)


def tangential_stiffness(overlap):
    return 8.0 * SHEAR_EFFECTIVE * math.sqrt(overlap)


def open_box(grains, atom_style="sphere", half=20.0, length=20.0):
    return Packing(
        (2.0 * length, 2.0 * half, 2.0 * half),
        grains,
        origin=(-length, -half, -half),
        triclinic=False,
        atom_style=atom_style,
    )


def sphere(position, velocity=(0.0, 0.0, 0.0), omega=(0.0, 0.0, 0.0)):
    return Grain(position, velocity=velocity, omega=omega)


def wall(deck, name, primitive, kind=1):
    """Of atom type `kind`; keeps its force on each grain. Keywords of the model stand at its end; `ledger` is the pair
    style's alone."""
    keywords = deck.extra.replace("ledger on", "").strip()
    words, _, moving = primitive.partition(" shear ")
    moving = f"shear {moving}" if moving else ""
    model = replace(deck, extra="").model()
    return f"fix {name} all wall/gran {model} primitive type {kind} {words} store_force yes {moving} {keywords}".strip()


def gravity(x, y, z):
    size = math.sqrt(x * x + y * y + z * z)
    return f"fix gravity all gravity {number(size)} vector {number(x / size)} {number(y / size)} {number(z / size)}"


SPIN_HELD = ["unfix integrate", "fix integrate all nve"]  # moves spheres, and turns none


MODES = ("step", "instantaneous")
POWERS = {mode: outputs("dissipation").of(mode) for mode in ("step", "instantaneous", "ledger")}
AT_WALL = outputs("wall/contact")
LOST = [f"{name}_w" for name in ("D_n", "D_t", "D_damp")]
ALL_LOST = [name for name in LOSSES if name[0] == "D"]
LAW = [name for name in LOSSES if name[0] == "G"]
POWERS_LOST = ("P_n_w", "P_t_w", "P_t_damp_w")
# Sums of up to 1e4 steps of one contact: 1e-16 sqrt(1e4), and a factor of 100 for the worst.
ROUNDING = 1e-12


def books():
    """Defines dissipation by its two sums over contacts and wall/contact: what a wall is asked for."""
    return [*(f"compute {mode} all dissipation mode {mode} walls only" for mode in MODES), "compute w all wall/contact"]


def books_with_ledger():
    return [LEDGER, "compute ledger all dissipation mode ledger walls only", *books()]


def asked(modes=MODES):
    powers = [POWERS[mode][name] for mode in modes for name in POWERS_LOST]
    return [*powers, *(AT_WALL.word("w", name) for name in AT_WALL.names("vector")[:17])]


def asked_with_ledger():
    return [*TOTALS, *asked(POWERS)]


def integrals(table, mode, dt):
    """Of the powers lost at walls, one number each: a row is what the step lost that ends there."""
    return [table[POWERS[mode][name]][1:].sum() * dt for name in POWERS_LOST]


def at_wall(table, name):
    return table[AT_WALL.word("w", name)]


def require_books(table, dt):
    """With one grain, whose every contact is with a wall: the account of the last row, which closes, is that of walls
    alone, and compute dissipation's power, in mode ledger, is its change."""
    a = account(table)
    require_close(a["residual"], 0.0, ROUNDING, "residual of the ledger", turnover(a))
    for name in (*ALL_LOST, "U_n", "U_t"):
        require_equal(a[f"{name}_w"], a[name], f"{name} of walls")
    require_close(
        integrals(table, "ledger", dt), [a[name] for name in LOST], 1e-10, "mode ledger against the ledger", turnover(a)
    )
    for name, own in zip(("P_n", "P_t", "P_t_damp"), POWERS_LOST):
        require_close(
            at_wall(table, name), table[POWERS["instantaneous"][own]], ROUNDING, f"{name} of wall/contact", None
        )
    return a


def bouncing(e):
    """A ball hits a plane: of its energy 1 - e^2 is lost, all by damping along the normal."""

    def case(ranks):
        speed, packing = 0.5, open_box([sphere((0.0, 0.0, 1.001), (0.0, 0.0, -0.5))])
        deck = Deck(packing, material=Material(restitution=(e,)), timestep=0.02 * rayleigh_time())
        deck = with_ledger(replace(deck, boundary="f f f", extra=UNDAMPED))
        # Five times Hertz's duration of a collision, and the way there.
        duration = 2.94 * (15.0 / 16.0 * MASS / YOUNG_EFFECTIVE) ** 0.4 * speed**-0.2
        steps = int((5.0 * duration + 0.002 / speed) / deck.dt())
        deck.body = [
            wall(deck, "w", "zplane 0.0"),
            *books_with_ledger(),
            *dump_grains(packing, steps),
            *thermo(1, "ke", *asked_with_ledger()),
            f"run {steps}",
        ]
        result = run(deck, ranks)
        (_, before), (_, after) = result.dump("grains.dump")
        start, lost = kinetic_energy(before), kinetic_energy(before) - kinetic_energy(after)
        # The host's damping is made for a contact that ends where the grains part, to the order of the time step.
        require_close(after["vz"][0], e * speed, 5e-3, "velocity after the collision", speed)
        require_close([after["vx"][0], after["omegay"][0]], [0.0, 0.0], 0.0, "nothing sideways", 1.0)
        table = result.thermo()[0]
        a = require_books(table, deck.dt())
        require_close(sum(a[name] for name in LOSSES), lost, ROUNDING, "the ledger's losses", start)
        require_close(a["D_n_w"], lost, 1e-3, "D_n of the wall", start)
        for mode in MODES:
            power = integrals(table, mode, deck.dt())
            print(f"{mode}: {power[0] / lost - 1.0:.2e} of the loss, ledger's D_n {a['D_n_w'] / lost - 1.0:.2e}")
            # Half a step too early, the instantaneous velocity is too large by half a step's damping of some 100 steps.
            tolerance = 1e-3 if mode == "step" else 1.5e-2
            require_close(power, [lost, 0.0, 0.0], tolerance, f"loss by mode {mode}", start)
        require_equal([a[name] for name in ("D_t", "D_damp", "W_wall", "W_gravity")], [0.0] * 4, "nothing else")

    return case


def sliding(angle, mu, held):
    """A sphere slides down an incline from rest, in equilibrium along the normal: friction takes mu m g cos(angle) per
    length of sliding. The spring is the first mu N/k_t of the way; it costs half of that. `held`: it does not turn;
    otherwise it slips all the way, and the same friction turns it as slows it down."""

    def case(ranks):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        normal, pull = MASS * G * c, MASS * G * s
        overlap = overlap_under(normal)
        packing = open_box([sphere((-15.0, 0.0, 1.0 - overlap))])
        deck = Deck(packing, material=Material(friction=(mu,)), timestep=0.1 * rayleigh_time(), boundary="f f f")
        deck = replace(deck, extra=UNDAMPED) if held else with_ledger(replace(deck, extra=UNDAMPED))
        steps = int(math.sqrt(2.0 * 30.0 / (G * (s - mu * c))) / deck.dt())  # for a way of 30
        stretch = mu * normal / tangential_stiffness(overlap)
        deck.body = [
            *(SPIN_HELD if held else []),
            gravity(G * s, 0.0, -G * c),
            wall(deck, "w", "zplane 0.0"),
            *(books() if held else books_with_ledger()),
            *dump_grains(packing, steps, columns="id x z vx vz omegay f_force_w[1] f_force_w[3]"),
            *thermo(1, "ke", *(asked() if held else asked_with_ledger())),
            f"run {steps}",
        ]
        result = run(deck, ranks)
        (_, before), (_, after) = result.dump("grains.dump")
        way, lever = after["x"][0] - before["x"][0], 1.0 - 0.5 * overlap
        # Of m x'' = pull - friction and I turn'' = friction x lever.
        turn = 0.0 if held else lever / INERTIA * (0.5 * pull * (steps * deck.dt()) ** 2 - MASS * way)
        slid = way - lever * turn
        require(slid > 100.0 * stretch, f"it slid {slid}, the spring alone is {stretch}")
        require_close(after["f_force_w[3]"][0], normal, 1e-9, "force on the wall")
        require_close(after["f_force_w[1]"][0], -mu * normal, 1e-9, "friction")
        lost = mu * normal * (slid - stretch)
        kinetic = 0.5 * MASS * after["vx"][0] ** 2 + 0.5 * INERTIA * after["omegay"][0] ** 2
        # The first step with the spring's force is one step late; velocities of the leapfrog are of the step's end.
        require_close(kinetic + lost + 0.5 * mu * normal * stretch, pull * way, 1e-4, "energy balance of the sphere")
        table = result.thermo()[0]
        if not held:
            a = require_books(table, deck.dt())
            # Of the step in which it begins to slip the spring has not yet the force of sliding when the step begins.
            speed = math.sqrt(2.0 * stretch * (pull / MASS + mu * normal * lever**2 / INERTIA))
            first = 0.5 * tangential_stiffness(overlap) * (speed * deck.dt()) ** 2
            require_close(a["D_t_w"], lost, 1e-9, "D_t of the wall", lost + 1e9 * first)
            require_close(a["U_t_w"], 0.5 * mu * normal * stretch, 1e-9, "its spring")
            require_close([a["D_n_w"], a["D_damp_w"]], [0.0, 0.0], 1e-9, "no damping", lost)
            require_close(a["W_gravity"], pull * way, 1e-9, "work of gravity")
            print(f"D_t: {a['D_t_w'] / lost - 1.0:.2e}")
        for mode in MODES:
            power = integrals(table, mode, deck.dt())
            print(f"{mode}: {power[1] / lost - 1.0:.2e} of the loss")
            require_close(power, [0.0, lost, 0.0], 1e-3, f"loss by mode {mode}", lost)
        force = [at_wall(table, f"force_{axis}")[-1] for axis in "xyz"]
        require_close(force, [mu * normal, 0.0, -normal], 1e-9, "force on the wall, by wall/contact", normal)

    return case


def rolling(velocity, spin):
    """A ball on a plate that slips until it rolls: the moment of momentum about the contact is conserved, so that it
    ends with 5/7 v + 2/7 omega R, whatever the friction. R is the host's lever, radius less half the overlap."""

    def case(ranks):
        overlap = overlap_under(MASS * G)
        lever = 1.0 - 0.5 * overlap
        packing = open_box([sphere((-15.0, 0.0, 1.0 - overlap), (velocity, 0.0, 0.0), (0.0, spin, 0.0))])
        deck = with_ledger(Deck(packing, boundary="f f f", timestep=0.1 * rayleigh_time()))
        steps = 4000
        end = (MASS * velocity + INERTIA * spin / lever) / (MASS + INERTIA / lever**2)
        lost = 0.5 * (MASS * (velocity**2 - end**2) + INERTIA * (spin**2 - (end / lever) ** 2))
        deck.body = [
            gravity(0.0, 0.0, -G),
            wall(deck, "w", "zplane 0.0"),
            *books_with_ledger(),
            *dump_grains(packing, steps),
            *thermo(1, "ke", *asked_with_ledger()),
            f"run {steps}",
        ]
        result = run(deck, ranks)
        after = result.dump("grains.dump")[-1][1]
        # What is left of the spring's oscillation: the tangential damping of e = 0.5 takes it out in some 100 steps.
        require_close([after["vx"][0], lever * after["omegay"][0]], [end, end], 1e-8, "rolling", 1.0)
        require_close(
            end, 5.0 / 7.0 * velocity + 2.0 / 7.0 * spin, overlap, "5/7 v + 2/7 omega R", abs(velocity) + abs(spin)
        )
        require(lost > 0.0, "nothing to lose")
        table = result.thermo()[0]
        a = require_books(table, deck.dt())
        # The ball is set down slipping: the half kick by the force of that moment costs what a step's end does not.
        force = at_wall(table, "force_x")[0]
        kick = 0.125 * (deck.dt() * force) ** 2 * (1.0 / MASS + lever**2 / INERTIA)
        require_close(sum(a[name] for name in LOSSES), lost - kick, 1e-8, "the ledger's losses")
        require_close(a["D_t_w"] + a["D_damp_w"], lost - kick, 1e-8, "friction and tangential damping")
        require_close(a["D_n_w"], 0.0, 1e-12, "no normal damping", lost)
        # Of the power when the ball is set down half a step counts, of which damping takes most.
        at_start = sum(table[POWERS["step"][name]][0] for name in POWERS_LOST)
        power = sum(integrals(table, "step", deck.dt())) + 0.5 * deck.dt() * at_start
        print(f"step: {power / lost - 1.0:.2e} of the loss")
        # The spring is stretched within some ten steps of 0.1 T_R.
        require_close(power, lost, 2e-2, "loss by mode step")

    return case


SIDES = {"x": 0, "y": 1, "z": 2}


def contact_points(centres, axis, place):
    """Where spheres of radius 1 touch a plane: the law's lever is the radius less half the overlap."""
    points = centres.copy()
    way = place - centres[:, SIDES[axis]]
    points[:, SIDES[axis]] += np.sign(way) * 0.5 * (1.0 + np.abs(way))
    return points


def vectors(snapshot, *names):
    return np.stack([snapshot[name] for name in names], axis=1)


def balance(packing, planes, bulk, boundary, steps, ranks, **choices):
    """Runs grains between planes ((axis, place, velocity) by name) and holds the stress against the walls' forces, at
    every instant of motion: with branches x_i - x_j between grains and x_i - x_c at walls, tension positive,
        Omega sigma_ab = sum_walls F_a x_c,b + sum_i (m_i g_a - f_i,a) x_i,b,
    F the force of a wall on a grain, f the whole force on it: from sum_i x_i,b (f_i = contacts + m_i g). Of contacts
    between grains alone it is sum_walls F_a x_i,b + ..."""
    deck = Deck(packing, boundary=boundary, **choices)
    columns = "id x y z mass fx fy fz"
    body = [gravity(*bulk)] if any(bulk) else []
    for name, (axis, place, velocity) in planes.items():
        moving = f" shear {velocity[0]} {number(velocity[1])}" if velocity else ""
        body.append(wall(deck, name, f"{axis}plane {number(place)}{moving}"))
        columns += "".join(f" f_force_{name}[{k}]" for k in (1, 2, 3))
    names = ["sxx", "syy", "szz", "sxy", "sxz", "syz"]
    kinds = {"all": "", "grains": " walls no"}
    for kind, words in kinds.items():
        body += [f"compute {kind} all stress/contact{words}", f"outputs {kind}"]
    body.append("compute w all wall/contact")
    forces = {(r, k): AT_WALL.word("w", f"force_{k}_w", r) for r in range(1, len(planes) + 1) for k in "xyz"}
    columns_of_thermo = [*(f"v_{kind}_{n}" for kind in kinds for n in names), *forces.values()]
    every = steps // 10
    deck.body = [
        *body,
        *dump_grains(packing, every, columns=columns),
        *thermo(every, "vol", *columns_of_thermo),
        f"run {steps}",
    ]
    result = run(deck, ranks)
    table, snapshots = result.thermo()[0], result.dump("grains.dump")
    worst = 0.0
    for k, (_, snapshot) in enumerate(snapshots[1:], 1):
        centres, mass = vectors(snapshot, "x", "y", "z"), snapshot["mass"]
        total = vectors(snapshot, "fx", "fy", "fz")
        motion = (np.outer(mass, bulk) - total).T @ centres
        at_centres, at_points = motion.copy(), motion.copy()
        for row, (name, (axis, place, _)) in enumerate(planes.items(), 1):
            force = vectors(snapshot, *(f"f_force_{name}[{j}]" for j in (1, 2, 3)))
            at_centres += force.T @ centres
            at_points += force.T @ contact_points(centres, axis, place)
            found = [table[forces[row, j]][k] for j in "xyz"]
            require_close(found, -force.sum(axis=0), 1e-11, f"force on {name}, snapshot {k}", np.abs(force).sum() + 1.0)
        # Across periodic faces the branch is not between the centres here: only b along the others.
        for kind, expected in zip(kinds, (at_points, at_centres)):
            for n in names:
                a, b = SIDES[n[1]], SIDES[n[2]]
                if boundary.split()[b] == "p":
                    continue
                found = table[f"v_{kind}_{n}"][k] * table["vol"][k]
                scale = np.abs(at_points).max()
                worst = max(worst, abs(found - expected[a, b]) / scale)
                require_close(found, expected[a, b], 1e-11, f"Omega {n} of {kind}, snapshot {k}", scale)
    print(f"largest difference of the stress: {worst:.1e} of the largest component")
    return table, snapshots


def lattice(counts, spacing, shift=0.1, seed=5, speed=0.0):
    """Spheres on a loose lattice, displaced at random."""
    random, cells = np.random.default_rng(seed), np.array(counts)
    grains = []
    for index in np.ndindex(*counts):
        place = spacing * (np.array(index) + 0.5) + shift * random.uniform(-1.0, 1.0, 3)
        grains.append(sphere(tuple(place), tuple(speed * random.normal(size=3))))
    return Packing(tuple(spacing * cells), grains, triclinic=False, atom_style="sphere")


def full_box(ranks):
    """Spheres fall into a box of six planes; each instant is a balance, and at the end the floor carries the weight."""
    packing = lattice((4, 4, 4), 2.3)
    edges = dict(zip("xyz", packing.edges))
    planes = {f"{k}{side}": (k, place, None) for k in "xyz" for side, place in (("lo", 0.0), ("hi", edges[k]))}
    room = replace(packing, edges=tuple(e + 2.0 for e in packing.edges), origin=(-1.0,) * 3)
    stiff = Material(young=(10.0 * YOUNG,), restitution=(0.3,))
    step = 0.1 * rayleigh_time(young=10.0 * YOUNG)
    table, snapshots = balance(room, planes, (0.0, 0.0, -G), "f f f", 20000, ranks, timestep=step, material=stiff)
    last = snapshots[-1][1]
    weight = G * last["mass"].sum()
    sides = sum(last[f"f_force_{k}{side}[3]"].sum() for k in "xy" for side in ("lo", "hi"))
    carried = last["f_force_zlo[3]"].sum() + last["f_force_zhi[3]"].sum() + sides
    require_close(carried, weight, 1e-3, "weight that the walls carry")
    found = sum(table[AT_WALL.word("w", "force_z_w", row)][-1] for row in range(1, 7))
    require_close(found, -weight, 1e-3, "weight, by wall/contact")


def plates(ranks):
    """Spheres between two plates that move against each other: the shear stress is the plates' force over their area,
    but for the grains' acceleration, and so is the normal stress."""
    packing = lattice((4, 4, 3), 1.98, shift=0.02)
    height = packing.edges[2]
    planes = {"low": ("z", 0.0, ("x", -1.0)), "high": ("z", height, ("x", 1.0))}
    room = replace(packing, edges=(*packing.edges[:2], height + 4.0), origin=(0.0, 0.0, -2.0))
    balance(room, planes, (0.0, 0.0, 0.0), "p p f", 4000, ranks, timestep=0.1 * rayleigh_time())


def resting(shape, surface, turned):
    """A spheroid lies, or stands, on a plane: its contact is below the centre, and the host's law takes the radius of
    the sphere of its volume."""

    def case(ranks):
        axis = shape[0] if turned else shape[2]
        q = (math.sqrt(0.5), math.sqrt(0.5), 0.0, 0.0) if turned else (1.0, 0.0, 0.0, 0.0)
        mass = DENSITY * 4.0 / 3.0 * math.pi * math.prod(shape)
        overlap = overlap_under(mass * G, math.prod(shape) ** (1.0 / 3.0))
        packing = open_box([Grain((0.0, 0.0, axis - overlap), shape, q)], "superquadric")
        deck = Deck(packing, boundary="f f f", surface=surface)
        deck.body = [gravity(0.0, 0.0, -G), wall(deck, "w", "zplane 0.0")]
        deck.body += [*dump_grains(packing, 200, columns="id x y z fz vz f_force_w[1] f_force_w[2] f_force_w[3]")]
        words = {name: AT_WALL.word("w", name) for name in ("N", "F_n", "force_z", "torque_x", "torque_y")}
        deck.body += ["compute w all wall/contact", *thermo(200, *words.values()), "run 200"]
        result = run(deck, ranks)
        after, table = result.dump("grains.dump")[-1][1], result.thermo()[0]
        force = vectors(after, *(f"f_force_w[{k}]" for k in (1, 2, 3)))[0]
        require_close(force, [0.0, 0.0, mass * G], 1e-6, "force of the plane")
        require_close(after["z"][0], axis - overlap, 1e-9, "height of the centre")
        found = [table[word][-1] for word in words.values()]
        require_close(found[:3], [1.0, mass * G, -mass * G], 1e-6, "contacts, F_n and force_z of wall/contact")
        require_close(found[3:], [0.0, 0.0], 1e-6, "torque on the plane", mass * G)

    return case


def block_in_a_drum(ranks):
    """A sphere whose spin is held stays in a turning drum where friction holds it, at tan = mu, and is rubbed at the
    drum's speed: torque times rate is what friction takes."""
    mu, rate, radius = 0.4, 0.05, 10.0
    angle = math.atan(mu)
    normal = MASS * G * math.cos(angle)
    away = radius - 1.0 + overlap_under(normal)
    packing = open_box([sphere((away * math.sin(angle), -away * math.cos(angle), 0.0))])
    deck = Deck(
        packing, boundary="f f f", timestep=0.1 * rayleigh_time(), extra=UNDAMPED, material=Material(friction=(mu,))
    )
    steps, every = 20000, 10
    columns = "id x y z vx vy " + " ".join(f"f_force_w[{k}]" for k in (1, 2, 3))
    deck.body = [
        *SPIN_HELD,
        gravity(0.0, -G, 0.0),
        wall(deck, "w", f"zcylinder {number(radius)} 0.0 0.0 shear x {number(rate)}"),
        *books(),
        *dump_grains(packing, every, columns=columns),
        *thermo(1, "ke", *asked()),
        f"run {steps}",
    ]
    result = run(deck, ranks)
    snapshots = [s for _, s in result.dump("grains.dump")][1:]
    centre = np.array([vectors(s, "x", "y")[0] for s in snapshots])
    force = np.array([vectors(s, "f_force_w[1]", "f_force_w[2]")[0] for s in snapshots])
    moment = centre[:, 0] * force[:, 1] - centre[:, 1] * force[:, 0]
    # The grain swings about its place by what it gained while the spring was stretched, unseen by the drum: 1 %.
    place = np.arctan2(centre[:, 0], -centre[:, 1])
    require_close(place.mean(), angle, 1e-2, "place in the drum")
    held = slice(len(moment) // 2, None)
    require_close(moment[held], np.full(len(moment[held]), mu * normal * away), 1e-2, "moment of friction")
    # The lever of the torque is half the overlap longer than the drum's radius, at which the drum has its velocity; the
    # overlap is that under the weight, which the grain's swing changes by 1 %.
    table = result.thermo()[0]
    later = slice(steps // 2, None)
    lost = mu * normal * rate * radius
    power, torque = at_wall(table, "power")[later], at_wall(table, "torque_z")[later]
    lever = 1.0 + 0.5 * overlap_under(normal) / radius
    require_close(-rate * torque / power, np.full(len(power), lever), 1e-4, "torque times rate over power")
    for name, power in (("power", at_wall(table, "power")), *((m, table[POWERS[m]["P_t_w"]]) for m in MODES)):
        require_close(power[later].mean(), lost, 1e-2, f"mean of the power, {name}")


CASES = {
    **{f"bouncing-ball-{e}": bouncing(e) for e in (0.1, 0.3, 0.5, 0.7, 0.9)},
    "sliding-block-30": sliding(30.0, 0.3, True),
    "sliding-block-60": sliding(60.0, 1.0, True),
    "slipping-ball-60": sliding(60.0, 0.2, False),
    "slipping-ball-45": sliding(45.0, 0.1, False),
    "spinning-ball-rolls": rolling(0.0, 1.0),
    "thrown-ball-rolls": rolling(1.0, 0.0),
    "backspin": rolling(1.0, -2.5),
    "full-box": full_box,
    "plates": plates,
    **{
        f"spheroid-{'lies' if turned else 'stands'}-{surface}": resting((1.0, 1.0, 1.5), surface, turned)
        for turned in (True, False)
        for surface in ("ellipsoid", "superquadric")
    },
    "block-in-a-drum": block_in_a_drum,
}

if __name__ == "__main__":
    main(CASES)
