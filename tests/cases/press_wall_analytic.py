# SPDX-License-Identifier: GPL-2.0-or-later
"""fix press/wall on a plate whose pressure is known: a sphere that nobody integrates touches it. Their overlap is
R - s, s the distance of the plate, which parts at V: F = 4/3 E* sqrt(R d) d - gamma_n V (Hertz). The controller's
recursion is then followed by hand; also where the sphere is drawn away from the plate."""
import math

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, Material, thermo
from grainscope.columns import outputs
import meshes
from packing import DENSITY, Grain, Packing
from run import run

F_PRESS = outputs("press/wall").of("press")

EDGE, HALF, GAP, STEPS = 8.0, 3.0, 0.99, 600
EVERY, RESTITUTION, BETA = 5, 0.5, 0.5
HARD = 10.0 * YOUNG  # LIGGGHTS refuses softer grains with units cgs
MODULUS = HARD / (2 * (1 - POISSON**2))


class Contact:
    """What a sphere of radius 1 says to a plate at this distance from its centre, which parts from it at `speed`.
    Hooke's stiffness is the host's, for a characteristic velocity of 1: k = 16/15 sqrt(R*) E* (15 m*/(16 sqrt(R*)
    E*))^(1/5), with gamma = sqrt(4 m* k/(1 + (pi/ln e)^2)). The plate's mass and radius are infinite."""

    def __init__(self, law, distance, speed, mass):
        overlap, log_e = max(1.0 - distance, 0.0), math.log(RESTITUTION)
        if law == "hertz":
            root = math.sqrt(overlap)
            elastic, self.tangent = 4.0 / 3.0 * MODULUS * root * overlap, 2.0 * MODULUS * root
            self.damping = (
                -2.0
                * math.sqrt(5.0 / 6.0)
                * log_e
                / math.hypot(log_e, math.pi)
                * math.sqrt(2.0 * MODULUS * root * mass)
            )
        else:
            self.tangent = 16.0 / 15.0 * MODULUS * (15.0 * mass / (16.0 * MODULUS)) ** 0.2
            elastic = self.tangent * overlap
            self.damping = math.sqrt(4.0 * mass * self.tangent / (1.0 + (math.pi / log_e) ** 2))
        self.force = elastic - self.damping * speed


def by_hand(law, target, gain, mass, dt, area, limit, max_rate, drawn, base):
    """Distance, speed and averaged pressure after every step, how many inputs were clipped, and the last gain. An input
    on the first step, then every EVERY steps, from the mean since the last. `drawn`: the speed of the sphere away from
    the plate."""
    distance, speed, pressure, clipped, window, steady = GAP, 0.0, 0.0, 0, [], 0.0
    history = [(distance, speed, pressure)]
    for step in range(1, STEPS + 1):
        distance += (speed + drawn) * dt
        window.append(Contact(law, distance, speed + drawn, mass))
        if step == 1 or step % EVERY == 0:
            force, stiffness, damping = (
                np.mean([getattr(c, name) for c in window]) for name in ("force", "tangent", "damping")
            )
            pressure, window = force / area, []
            kp = BETA * area / (damping + stiffness * EVERY * dt) if gain == "auto" else gain
            adds, bound = kp * (pressure - target), min(limit / (EVERY * dt), max_rate)
            speed = min(max(steady + adds, -bound), bound)
            if abs(steady + adds) > bound:
                clipped += 1
            elif base:
                steady += 0.1 * stiffness * EVERY * dt / (damping + stiffness * EVERY * dt) * adds
        history.append((distance, speed, pressure))
    return np.array(history).T, clipped, kp


def plate(axis, side, dimension):
    """Across the axis, at the distance GAP beyond a sphere in the middle; in two dimensions upright."""
    corner, one, other = np.full(3, -HALF), np.zeros(3), np.zeros(3)
    corner[axis] = side * GAP
    one[(axis + 1) % 3] = other[(axis + 2) % 3] = 2.0 * HALF
    if dimension == 2:
        corner[2], one[2] = -0.4, 0.8
    return meshes.rectangle(corner + 0.03 * (one + 2.0 * other), one, other)  # the sphere is not on a diagonal


def follows_by_hand(
    gain,
    change,
    law="hertz",
    where="z-",
    area="box",
    limit=0.5,
    dimension=3,
    units="si",
    max_rate=None,
    drawn=0.0,
    base=False,
):
    """`change`: target over the pressure at the start. `where`: axis, and the side of the plate on which the sphere
    is. `max_rate`: None where it is left to the fix, a tenth of sqrt(target/density). `drawn`: the speed of the sphere
    away from the plate, in parts of that; the mean pressure is then lower by V/k_p, with `base` it is not."""

    def case(ranks):
        axis, toward = "xyz".index(where[0]), 1.0 if where[1] == "+" else -1.0
        grain = Grain((0.0, 0.0, 0.0))
        packing = Packing(
            (EDGE,) * 3,
            [grain],
            atom_style="sphere",
            triclinic=False,
            origin=(-0.5 * EDGE,) * 3,
            dimension=dimension,
        )
        boundary = "f f f" if dimension == 3 else "f f p"
        deck = Deck(packing, normal=law, boundary=boundary, units=units, material=Material(young=(HARD,)))
        # of a disc one unit thick, in two dimensions
        mass = grain.mass() if dimension == 3 else math.pi * DENSITY
        squared = EDGE ** (dimension - 1) if area == "box" else float(area)
        target = change * Contact(law, GAP, 0.0, mass).force / squared
        slow = max_rate or 0.1 * math.sqrt(target / DENSITY)
        away = drawn * slow
        motion = [str(toward * away) if k == axis else "0.0" for k in range(3)]
        deck.body = [
            "unfix integrate",
            *([f"fix draw all move linear {' '.join(motion)} units box"] if drawn else []),
            "fix plate all mesh/surface file plate.stl type 1",
            f"fix wall all wall/gran {deck.model()} mesh n_meshes 1 meshes plate",
            f"fix press all press/wall mesh plate axis {where[0]} target {target!r} area {area} every/step {EVERY} "
            f"gain {gain} limit {limit!r}"
            + (" base yes" if base else "")
            + (f" maxrate {max_rate!r}" if max_rate else ""),
            *thermo(1, "f_press", *F_PRESS.vector()),
            f"run {STEPS}",
        ]
        result = run(deck, ranks, folder=meshes.folder_with(plate=plate(axis, -toward, dimension)))
        table = result.thermo()[0]
        found = {name: table[F_PRESS[name]] for name in F_PRESS.own.names("vector")}
        (distance, speed, pressure), clipped, kp = by_hand(
            law, target, gain, mass, deck.dt(), squared, limit, slow, away, base
        )
        # Overlaps are differences of lengths a hundred times as large.
        way = distance - GAP - away * deck.dt() * table["step"]
        require_close(-toward * found["position"], GAP + way, 1e-13, "distance of the plate", 1.0)
        require_close(-toward * found["travel"], way, 1e-13, "its way", 1.0)
        require_close(-toward * found["V"], speed, 1e-9, "its velocity")
        require_close(table["f_press"], pressure, 1e-9, "averaged pressure")
        require_close(found["error"][1:], pressure[1:] / target - 1.0, 1e-9, "relative error", 1.0)
        require(found["clipped"][-1] == clipped, f"{found['clipped'][-1]} inputs were clipped, by hand {clipped}")
        require(found["inputs"][-1] == 1 + STEPS // EVERY, f"{found['inputs'][-1]} inputs")
        offset = 0.0 if base else away / kp
        require_close(pressure[-1], target - offset, 1e-3, "the recursion by hand ends where it should", target)
        print(f"the plate follows at V/k_p = {away / kp / target:.2e} of the target")
        require(not drawn or away / kp > 2e-3 * target, "the offset does not show")

    return case


CASES = {
    "automatic-gain-presses": follows_by_hand("auto", 2.0),
    "automatic-gain-gives-way": follows_by_hand("auto", 0.5),
    "automatic-gain-of-hooke": follows_by_hand("auto", 1.5, "hooke"),
    "from-below-along-x": follows_by_hand("auto", 2.0, where="x+", area="7.5"),
    "along-y": follows_by_hand("auto", 0.7, where="y-", area="7.5"),
    "given-gain": follows_by_hand(6e-5, 1.5, area="20.0"),
    "two-dimensions": follows_by_hand("auto", 2.0, where="y-", dimension=2),
    "in-cgs": follows_by_hand("auto", 2.0, units="cgs"),
    "clipped": follows_by_hand("auto", 3.0, limit=1e-3),
    "clipped-by-maxrate": follows_by_hand("auto", 3.0, max_rate=0.02),
    "starts-softly": follows_by_hand("auto", 3.0),
    "follows-behind": follows_by_hand("auto", 2.0, drawn=0.3),
    "follows-with-a-base": follows_by_hand("auto", 2.0, drawn=0.3, base=True),
    "follows-with-a-base-of-hooke": follows_by_hand("auto", 1.5, "hooke", where="x+", drawn=0.3, base=True),
    "base-with-a-given-gain": follows_by_hand(6e-5, 1.5, area="20.0", drawn=0.1, base=True),
    "base-at-rest": follows_by_hand("auto", 0.5, base=True),
}

if __name__ == "__main__":
    main(CASES)
