# SPDX-License-Identifier: GPL-2.0-or-later
"""fix press/strain on a system whose pressure is known: two spheres that nobody integrates, touching across the moving
face. Their overlap is 2 R - (L - D), D their fixed distance inside the box, and they part at dL/dt, so that
F = 4/3 E* sqrt(R* d) d - gamma_n dL/dt (Hertz) and P = F (L - D)/V. The controller's recursion is then followed by
hand."""
import math

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, thermo
from grainscope.columns import outputs
from packing import Grain, Packing
from run import run

F_PRESS = outputs("press/strain").of("press")

WIDTH, LENGTH, DISTANCE, STEPS = 6.0, 8.0, 6.02, 600
EVERY, RESTITUTION, BETA = 5, 0.5, 0.5
MODULUS = YOUNG / (2 * (1 - POISSON**2))


class Contact:
    """What the contact across the face answers at a box length and a rate. Hooke's stiffness is the host's, for a
    characteristic velocity of 1: k = 16/15 sqrt(R*) E* (15 m*/(16 sqrt(R*) E*))^(1/5), with gamma = sqrt(4 m* k/(1 +
    (pi/ln e)^2))."""

    def __init__(self, law, length, rate, mass):
        self.length, self.branch = length, length - DISTANCE
        overlap, reduced, log_e = max(2.0 - self.branch, 0.0), 0.5 * mass, math.log(RESTITUTION)
        if law == "hertz":
            root = math.sqrt(0.5 * overlap)
            elastic, self.tangent = 4.0 / 3.0 * MODULUS * root * overlap, 2.0 * MODULUS * root
            self.damping = (
                -2.0
                * math.sqrt(5.0 / 6.0)
                * log_e
                / math.hypot(log_e, math.pi)
                * math.sqrt(2.0 * MODULUS * root * reduced)
            )
        else:
            root = math.sqrt(0.5)
            self.tangent = 16.0 / 15.0 * root * MODULUS * (15.0 * reduced / (16.0 * root * MODULUS)) ** 0.2
            elastic = self.tangent * overlap
            self.damping = math.sqrt(4.0 * reduced * self.tangent / (1.0 + (math.pi / log_e) ** 2))
        self.force = elastic - self.damping * rate

    def per_volume(self, value):
        return value / (self.length * WIDTH**2)

    @property
    def pressure(self):
        return self.per_volume(self.force * self.branch)

    @property
    def stiffness(self):
        return self.per_volume(self.tangent * self.branch**2)

    @property
    def resistance(self):
        return self.per_volume(self.damping * self.branch**2)


def by_hand(law, target, gain, mass, dt):
    """Lengths and rates after every step. An input on the first step, then every EVERY steps, from the mean since the
    last."""
    length, rate, window = LENGTH, 0.0, []
    history = [(length, rate, 0.0)]
    for step in range(1, STEPS + 1):
        window.append(Contact(law, length, rate, mass))
        pressure = history[-1][2]
        if step == 1 or step % EVERY == 0:
            pressure, stiffness, resistance = (
                np.mean([getattr(c, name) for c in window]) for name in ("pressure", "stiffness", "resistance")
            )
            kp = BETA * length / (resistance + stiffness * EVERY * dt) if gain == "auto" else gain
            rate, window = kp * (pressure - target), []
        length += rate * dt
        history.append((length, rate, pressure))
    return np.array(history).T


def follows_by_hand(gain, change, law="hertz"):
    """`change`: target over the pressure at the start."""

    def case(ranks):
        grains = [Grain((0.0, side * 0.5 * DISTANCE, 0.0)) for side in (-1, 1)]
        packing = Packing(
            (WIDTH, LENGTH, WIDTH),
            grains,
            atom_style="sphere",
            triclinic=False,
            origin=(-0.5 * WIDTH, -0.5 * LENGTH, -0.5 * WIDTH),
        )
        deck = Deck(packing, normal=law)
        start = Contact(law, LENGTH, 0.0, grains[0].mass())
        target = change * start.pressure
        deck.body = [
            "unfix integrate",
            f"fix press all press/strain axis y target {target!r} every/step {EVERY} gain {gain} "
            "limit 0.5 momentum no",
            *thermo(1, "f_press", F_PRESS["L"], F_PRESS["L_rate"], F_PRESS["clipped"]),
            f"run {STEPS}",
        ]
        table = run(deck, ranks).thermo()[0]
        lengths, rates, pressures = by_hand(law, target, gain, grains[0].mass(), deck.dt())
        require(table[F_PRESS["clipped"]][-1] == 0.0, "an input was clipped: not the recursion by hand")
        # Overlaps are differences of lengths 400 times as large.
        require_close(table[F_PRESS["L"]], lengths, 1e-12, "L")
        require_close(table[F_PRESS["L_rate"]], rates, 1e-9, "dL/dt")
        require_close(table["f_press"], pressures, 1e-9, "averaged pressure")
        require_close(pressures[-1], target, 1e-3, "the recursion by hand ends at the target")

    return case


CASES = {
    "automatic-gain-compresses": follows_by_hand("auto", 2.0),
    "automatic-gain-expands": follows_by_hand("auto", 0.5),
    "automatic-gain-of-hooke": follows_by_hand("auto", 1.5, "hooke"),
    "given-gain": follows_by_hand(6e-4, 1.5),
}

if __name__ == "__main__":
    main(CASES)
