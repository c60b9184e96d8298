# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts with walls where the answer is known: one grain that bounces, slides, rolls, rests or is carried around by a
drum; the balance of forces in a full box and between plates."""
from dataclasses import replace
import math

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, Material, dump_grains, rayleigh_time, thermo
from packing import DENSITY, Grain, Packing, number
from run import run

# What computes say of walls beyond the stress: `walls`, entries in dissipation and energy/ledger, wall/contact.
# Until they do, only what LIGGGHTS itself gives, and the stress, is checked.
WALLS = False

G = 9.81
MASS = 4.0 / 3.0 * math.pi * DENSITY  # of a sphere of radius 1
INERTIA = 0.4 * MASS
UNDAMPED = "tangential_damping off"
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


def with_ledger(deck):
    return replace(deck, extra=f"ledger on {deck.extra}".strip())


def wall(deck, name, primitive):
    """Keeps its force on each grain. Keywords of the model stand at its end; `ledger` is the pair style's alone."""
    keywords = deck.extra.replace("ledger on", "").strip()
    words, _, moving = primitive.partition(" shear ")
    moving = f"shear {moving}" if moving else ""
    model = replace(deck, extra="").model()
    return f"fix {name} all wall/gran {model} primitive type 1 {words} store_force yes {moving} {keywords}".strip()


def gravity(x, y, z):
    size = math.sqrt(x * x + y * y + z * z)
    return f"fix gravity all gravity {number(size)} vector {number(x / size)} {number(y / size)} {number(z / size)}"


SPIN_HELD = ["unfix integrate", "fix integrate all nve"]  # moves spheres, and turns none


LEDGER = ["compute e all energy/ledger", "outputs e", "compute p all dissipation", "outputs p"]


def energy_lost(deck, expected, stores=0.0, tolerance=1e-12, everything="D_n"):
    """Words for the deck, and a check of what the ledger and compute dissipation say of the energy lost at walls."""
    if not WALLS:
        return [], lambda result: None

    def check(result):
        table = result.thermo()[0]
        names = ("D_n", "D_t", "D_damp")
        found = sum(table[f"v_e_{name}_w"][-1] for name in names)
        require_close(found, expected, tolerance, "energy lost at the wall, by the ledger", abs(expected) + stores)
        require_close(table["v_e_residual_relative"][-1], 0.0, 1e-12, "residual of the ledger", 1.0)
        power = sum(table[f"v_p_{name}_w"][1:].sum() for name in ("P_n", "P_t", "P_t_damp")) * deck.dt()
        require_close(power, expected, 2e-2, "sum of the power over all steps")
        others = [table[f"v_e_{name}_w"][-1] for name in names if name not in everything.split()]
        require_close(others, np.zeros(len(others)), 1e-13, f"nothing but {everything}", abs(expected))

    return LEDGER, check


LEDGER_COLUMNS = (
    ("v_e_D_n_w", "v_e_D_t_w", "v_e_D_damp_w", "v_e_residual_relative", "v_p_P_n_w", "v_p_P_t_w", "v_p_P_t_damp_w")
    if WALLS
    else ()
)


def bouncing(e):
    """A ball hits a plane: of its energy 1 - e^2 is lost, all by damping along the normal."""

    def case(ranks):
        speed, packing = 0.5, open_box([sphere((0.0, 0.0, 1.001), (0.0, 0.0, -0.5))])
        deck = Deck(packing, material=Material(restitution=(e,)), timestep=0.005 * rayleigh_time())
        deck = (
            with_ledger(replace(deck, boundary="f f f", extra=UNDAMPED)) if WALLS else replace(deck, boundary="f f f")
        )
        # Five times Hertz's duration of a collision, and the way there.
        duration = 2.94 * (15.0 / 16.0 * MASS / YOUNG_EFFECTIVE) ** 0.4 * speed**-0.2
        steps = int((5.0 * duration + 0.002 / speed) / deck.dt())
        lost = 0.5 * MASS * speed**2 * (1.0 - e**2)
        words, check = energy_lost(deck, lost, tolerance=5e-3)
        deck.body = [
            wall(deck, "w", "zplane 0.0"),
            *words,
            *dump_grains(packing, steps),
            *thermo(1, "ke", *LEDGER_COLUMNS),
        ]
        deck.body.append(f"run {steps}")
        result = run(deck, ranks)
        (_, before), (_, after) = result.dump("grains.dump")
        # The host's damping is made for a contact that ends where the grains part, to the order of the time step.
        require_close(after["vz"][0], e * speed, 5e-3, "velocity after the collision", speed)
        require_close([after["vx"][0], after["omegay"][0]], [0.0, 0.0], 0.0, "nothing sideways", 1.0)
        check(result)

    return case


def sliding(angle, mu):
    """A sphere whose spin is held slides down an incline from rest, in equilibrium along the normal: friction takes
    mu m g cos(angle) per length of sliding. The spring is the first mu N/k_t of the way; it costs half of that."""

    def case(ranks):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        normal = MASS * G * c
        overlap = overlap_under(normal)
        packing = open_box([sphere((-15.0, 0.0, 1.0 - overlap))])
        deck = Deck(packing, material=Material(friction=(mu,)), timestep=0.1 * rayleigh_time(), boundary="f f f")
        deck = replace(deck, extra=f"ledger on {UNDAMPED}" if WALLS else UNDAMPED)
        steps = int(math.sqrt(2.0 * 30.0 / (G * (s - mu * c))) / deck.dt())  # for a way of 30
        stretch = mu * normal / tangential_stiffness(overlap)
        words, check = energy_lost(
            deck, 0.0
        )  # the ledger's numbers are checked below, as the distance is not yet known
        deck.body = [
            *SPIN_HELD,
            gravity(G * s, 0.0, -G * c),
            wall(deck, "w", "zplane 0.0"),
            *words,
            *dump_grains(packing, steps, columns="id x z vx vz omegay f_w[1] f_w[3]".replace("f_w", "f_force_w")),
            *thermo(1, "ke", *LEDGER_COLUMNS),
            f"run {steps}",
        ]
        result = run(deck, ranks)
        (_, before), (_, after) = result.dump("grains.dump")
        way = after["x"][0] - before["x"][0]
        require(way > 100.0 * stretch, f"it slid {way}, the spring alone is {stretch}")
        require_close(after["f_force_w[3]"][0], normal, 1e-9, "force on the wall")
        require_close(after["f_force_w[1]"][0], -mu * normal, 1e-9, "friction")
        lost = mu * normal * (way - stretch)
        kinetic = 0.5 * MASS * after["vx"][0] ** 2
        # The first step with the spring's force is one step late; velocities of the leapfrog are of the step's end.
        require_close(
            kinetic + lost + 0.5 * mu * normal * stretch, MASS * G * s * way, 1e-4, "energy balance of the block"
        )
        if WALLS:
            table = result.thermo()[0]
            require_close(table["v_e_D_t_w"][-1], lost, 1e-9, "D_t of the wall")
            require_close(table["v_e_D_n_w"][-1], 0.0, 1e-9, "D_n of the wall", lost)

    return case


def rolling(velocity, spin):
    """A ball on a plate that slips until it rolls: the moment of momentum about the contact is conserved, so that it
    ends with 5/7 v + 2/7 omega R, whatever the friction. R is the host's lever, radius less half the overlap."""

    def case(ranks):
        overlap = overlap_under(MASS * G)
        lever = 1.0 - 0.5 * overlap
        packing = open_box([sphere((-15.0, 0.0, 1.0 - overlap), (velocity, 0.0, 0.0), (0.0, spin, 0.0))])
        deck = Deck(packing, boundary="f f f", timestep=0.1 * rayleigh_time())
        deck = with_ledger(deck) if WALLS else deck
        steps = 4000
        end = (MASS * velocity + INERTIA * spin / lever) / (MASS + INERTIA / lever**2)
        lost = 0.5 * (MASS * (velocity**2 - end**2) + INERTIA * (spin**2 - (end / lever) ** 2))
        words, check = energy_lost(deck, lost, tolerance=1e-6, everything="D_t D_damp")
        deck.body = [
            gravity(0.0, 0.0, -G),
            wall(deck, "w", "zplane 0.0"),
            *words,
            *dump_grains(packing, steps),
            *thermo(1, "ke", *LEDGER_COLUMNS),
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
        check(result)

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
    kinds = {"all": "", "grains": " walls no"} if WALLS else {"all": ""}
    for kind, words in kinds.items():
        body += [f"compute {kind} all stress/contact{words}", f"outputs {kind}"]
    asked = [f"v_{kind}_{n}" for kind in kinds for n in names]
    every = steps // 10
    deck.body = [*body, *dump_grains(packing, every, columns=columns), *thermo(every, "vol", *asked), f"run {steps}"]
    result = run(deck, ranks)
    table, snapshots = result.thermo()[0], result.dump("grains.dump")
    worst = 0.0
    for k, (_, snapshot) in enumerate(snapshots[1:], 1):
        centres, mass = vectors(snapshot, "x", "y", "z"), snapshot["mass"]
        total = vectors(snapshot, "fx", "fy", "fz")
        motion = (np.outer(mass, bulk) - total).T @ centres
        at_centres, at_points = motion.copy(), motion.copy()
        for name, (axis, place, _) in planes.items():
            force = vectors(snapshot, *(f"f_force_{name}[{j}]" for j in (1, 2, 3)))
            at_centres += force.T @ centres
            at_points += force.T @ contact_points(centres, axis, place)
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
    _, snapshots = balance(room, planes, (0.0, 0.0, -G), "f f f", 20000, ranks, timestep=step, material=stiff)
    last = snapshots[-1][1]
    weight = G * last["mass"].sum()
    sides = sum(last[f"f_force_{k}{side}[3]"].sum() for k in "xy" for side in ("lo", "hi"))
    carried = last["f_force_zlo[3]"].sum() + last["f_force_zhi[3]"].sum() + sides
    require_close(carried, weight, 1e-3, "weight that the walls carry")


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
        if WALLS:
            deck.body += ["compute c all contact/local walls only", "outputs c"]
        deck.body.append("run 200")
        after = run(deck, ranks).dump("grains.dump")[-1][1]
        force = vectors(after, *(f"f_force_w[{k}]" for k in (1, 2, 3)))[0]
        require_close(force, [0.0, 0.0, mass * G], 1e-6, "force of the plane")
        require_close(after["z"][0], axis - overlap, 1e-9, "height of the centre")

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
    deck = with_ledger(deck) if WALLS else deck
    steps, every = 20000, 10
    columns = "id x y z vx vy " + " ".join(f"f_force_w[{k}]" for k in (1, 2, 3))
    if WALLS:
        ledger = ["compute e all energy/ledger", "outputs e", "compute w all wall/contact", "outputs w"]
    else:
        ledger = []
    deck.body = [
        *SPIN_HELD,
        gravity(0.0, -G, 0.0),
        wall(deck, "w", f"zcylinder {number(radius)} 0.0 0.0 shear x {number(rate)}"),
        *ledger,
        *dump_grains(packing, every, columns=columns),
        *thermo(every, "ke", *(("v_e_W_wall", "v_e_D_t_w") if WALLS else ())),
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
    if WALLS:
        table = result.thermo()[0]
        half = len(table["ke"]) // 2
        time = deck.dt() * every * (len(table["ke"]) - 1 - half)
        for name in ("W_wall", "D_t_w"):
            power = (table[f"v_e_{name}"][-1] - table[f"v_e_{name}"][half]) / time
            require_close(power, mu * normal * rate * radius, 1e-2, f"mean of {name} per time: torque times rate")


CASES = {
    **{f"bouncing-ball-{e}": bouncing(e) for e in (0.1, 0.3, 0.5, 0.7, 0.9)},
    "sliding-block-30": sliding(30.0, 0.3),
    "sliding-block-60": sliding(60.0, 1.0),
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
