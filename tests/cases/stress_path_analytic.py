# SPDX-License-Identifier: GPL-2.0-or-later
"""fix press/strain on several edges and tilts of a system whose stresses are known: pairs of frictionless spheres that
nobody integrates, touching through the faces of the box and through its corner, so that every mode of the box moves
every stress. Box, overlaps, forces, stiffness matrix and the controllers' recursion are followed by hand."""
import math

import numpy as np

from case import main, require, require_close
from deck import POISSON, YOUNG, Deck, thermo
from grainscope.columns import outputs
from packing import Grain, Packing, number
from run import run

F = outputs("press/strain").of("press")
EDGES, STEPS, EVERY, RESTITUTION, BETA = np.array([7.0, 5.0, 6.0]), 800, 5, 0.5, 0.5
MODULUS = YOUNG / (2 * (1 - POISSON**2))
# flow and gradient of each mode
MODES = {"x": (0, 0), "y": (1, 1), "z": (2, 2), "xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}


class Pair:
    """Two spheres that touch through the box: the branch at the start, the image of the second, how many edges away,
    and the middle between the two inside the box."""

    def __init__(self, direction, image, middle=(0.0, 0.0, 0.0)):
        branch = 1.985 * np.array(direction) / np.linalg.norm(direction)
        self.image = np.array(image, float)
        self.distance = np.diag(EDGES) @ self.image - branch
        self.grains = [Grain(tuple(middle + side * 0.5 * self.distance)) for side in (-1, 1)]

    def answer(self, h, rates, mass):
        """Pressures, stiffness and damping matrices of all modes, times volume. h: edges in columns; rates: dh/dt."""
        branch, opening = h @ self.image - self.distance, rates @ self.image
        length = np.linalg.norm(branch)
        normal, overlap = branch / length, max(2.0 - length, 0.0)
        root, log_e = math.sqrt(0.5 * overlap), math.log(RESTITUTION)
        tangent = 2.0 * MODULUS * root
        damping = -2.0 * math.sqrt(5.0 / 6.0) * log_e / math.hypot(log_e, math.pi) * math.sqrt(tangent * 0.5 * mass)
        force = 2.0 / 3.0 * tangent * overlap - damping * (normal @ opening)
        lever = np.array([normal[flow] * branch[gradient] for flow, gradient in MODES.values()])
        return force * lever, tangent * np.outer(lever, lever), damping * np.outer(lever, lever)


class Network:
    """Of all pairs, per volume."""

    def __init__(self, pairs, h, rates, mass):
        answers = [pair.answer(h, rates, mass) for pair in pairs]
        self.pressure, self.stiffness, self.damping = (sum(part) / np.linalg.det(h) for part in zip(*answers))


CORNER = Pair((0.48, 0.6, 0.64), (1, 1, 1))
UPRIGHT = [Pair((1, 0, 0), (1, 0, 0)), Pair((0, 1, 0), (0, 1, 0)), Pair((0, 0, 1), (0, 0, 1)), CORNER]
# Spheres do not follow the box, as those of a packing do: its whole displacement goes into these contacts, L/r times
# the affine one, and the gain has a factor of four in hand here.
OBLIQUE = [UPRIGHT[0], UPRIGHT[2], CORNER, Pair((-0.5, 0.8, 0.33), (0, 1, 0))]


class ByHand:
    """`targets`: of modes, pressures and shear stresses; `mean`: target and ratios of edges; `rates`: of modes."""

    def __init__(self, pairs, mass, dt, targets, mean, rates):
        self.pairs, self.mass, self.dt = pairs, mass, dt
        self.targets, self.mean, self.rates = targets, mean, rates
        self.h = np.diag(EDGES)
        self.held = {name: 0.0 for name in targets}  # dL/dt of an edge, rate of a tilt
        self.bases = {name: 0.0 for name in (*targets, "mean")}
        self.common = 0.0

    def gradient(self):
        """True rates of the coming step, of edges relative to the length after it."""
        rates = {name: 0.0 for name in MODES} | self.rates
        for name, value in self.held.items():
            flow = MODES[name][0]
            rates[name] = value / (self.h[flow, flow] + value * self.dt) if len(name) == 1 else value
        if self.mean:
            rates |= {name: self.common * ratio for name, ratio in self.mean[1].items()}
        gradient = np.zeros((3, 3))
        for name, place in MODES.items():
            gradient[place] = rates[name]
        return gradient

    def inputs(self, window):
        pressure, stiffness, damping = (
            np.mean([getattr(c, name) for c in window], axis=0) for name in ("pressure", "stiffness", "damping")
        )
        interval, names = EVERY * self.dt, list(MODES)
        weight = {name: 1.0 for name in self.targets} | (self.mean[1] if self.mean else {})

        def answer(a):
            return sum(abs(damping + stiffness * interval)[a, names.index(b)] * w for b, w in weight.items())

        on = any(len(name) == 1 for name in self.rates)  # an edge is driven: the others have to go on moving

        def rate(name, error, resistance, elastic, goes_on):
            wanted = BETA / resistance * error
            found = self.bases[name] + wanted
            self.bases[name] += 0.1 * elastic * interval / resistance * wanted if goes_on else 0.0
            return found

        for name in self.held:
            k = names.index(name)
            if len(name) == 1:
                length, error = self.h[k, k], pressure[k] - self.targets[name]
                self.held[name] = length * rate(name, error, answer(k), stiffness[k, k], on)
            else:
                density = 2 * len(self.pairs) * self.mass / np.linalg.det(self.h)
                gradient = MODES[name][1]
                sound = self.h[gradient, gradient] * math.sqrt(density * stiffness[k, k])
                error = pressure[k] + self.targets[name]
                self.held[name] = rate(name, error, answer(k) + sound, stiffness[k, k], True)
        if self.mean:
            error = pressure[:3].mean() - self.mean[0]
            elastic = sum(stiffness[a, names.index(b)] * w for a in range(3) for b, w in self.mean[1].items()) / 3.0
            self.common = rate("mean", error, sum(answer(a) for a in range(3)) / 3.0, elastic, on)

    def run(self):
        window, table, gradient = [], [], self.gradient()
        for step in range(STEPS + 1):
            network = Network(self.pairs, self.h, gradient @ self.h, self.mass)
            if step:
                window.append(network)
                if step == 1 or step % EVERY == 0:
                    self.inputs(window)
                    window = []
            if step:
                gradient = self.gradient()
                self.h = np.linalg.solve(np.eye(3) - gradient * self.dt, self.h)
            table.append([*network.pressure, *self.h[np.triu_indices(3)]])
        return np.array(table)


def follows_by_hand(words, ends, targets=None, mean=None, rates=None, tilted=False):
    """`words` of the command, with {0}, {1}, ...: the targets in order, given as factors of the stresses at the start;
    `ends`: relative error of the targets at the end, None where a rate goes on."""

    def case(ranks):
        pairs = OBLIQUE if tilted else UPRIGHT
        grains = [grain for pair in pairs for grain in pair.grains]
        packing = Packing(tuple(EDGES), grains, atom_style="sphere", triclinic=tilted, origin=tuple(-0.5 * EDGES))
        deck = Deck(packing, tangential="off")
        mass, dt = grains[0].mass(), deck.dt()
        start = Network(pairs, np.diag(EDGES), np.zeros((3, 3)), mass)
        names, stresses = list(MODES), []
        wanted = {}
        for name, factor in (targets or {}).items():
            k = names.index(name)
            wanted[name] = factor * (start.pressure[k] if k < 3 else -start.pressure[k])
            stresses.append(number(wanted[name]))
        held = None
        if mean:
            held = (mean[0] * start.pressure[:3].mean(), mean[1])
            stresses.append(number(held[0]))
        columns = [F[f"P_{a}"] for a in "xyz"] + [F["s_xy"], F["s_xz"], F["s_yz"]]
        box = ["lx", "xy", "xz", "ly", "yz", "lz"] if tilted else ["lx", "ly", "lz"]
        deck.body = [
            "unfix integrate",
            f"fix press all press/strain {words.format(*stresses)} every/step {EVERY} limit 0.5 maxrate 1e3 "
            "momentum no",
            *thermo(1, *columns, *box, F["clipped"]),
            f"run {STEPS}",
        ]
        table = run(deck, ranks).thermo()[0]
        hand = ByHand(pairs, mass, dt, wanted, held, rates or {}).run()
        require(table[F["clipped"]][-1] == 0.0, "an input was clipped: not the recursion by hand")
        place = dict(zip(["lx", "xy", "xz", "ly", "yz", "lz"], hand[:, 6:].T))
        for name in box:
            # Overlaps are differences of lengths 500 times as large.
            require_close(table[name], place[name], 1e-12, name, 10.0)
        scale = np.abs(hand[:, :6]).max()
        for k, name in enumerate(columns):
            found = table[name] if k < 3 else -table[name]
            mode = "x y z xy xz yz".split()[k]
            require_close(found, hand[:, names.index(mode)], 1e-9, f"stress {mode}", scale)
        for name, value in wanted.items() if ends else ():
            k = names.index(name)
            got = hand[-1, k] if k < 3 else -hand[-1, k]
            require_close(got, value, ends, f"the recursion by hand ends at the target of {name}")
        if held and ends:
            require_close(hand[-1, :3].mean(), held[0], ends, "the recursion by hand ends at the mean target")

    return case


CASES = {
    "two-edges": follows_by_hand("x target {0} y target {1}", 1e-3, {"x": 1.3, "y": 1.2}),
    "three-edges": follows_by_hand("x target {0} y target {1} z target {2}", 1e-2, {"x": 1.3, "y": 1.2, "z": 1.25}),
    "an-edge-by-the-old-form-and-one-driven": follows_by_hand(
        "axis y target {0} x rate 1e-4 z fixed", None, {"y": 1.3}, rates={"x": 1e-4}
    ),
    "mean": follows_by_hand("mean target {0}", 1e-3, mean=(1.3, {"x": 1.0, "y": 1.0, "z": 1.0})),
    "mean-with-ratios-beside-a-rate": follows_by_hand(
        "z rate -1e-4 mean target {0} ratio 1 0.5 0",
        None,
        mean=(1.2, {"x": 1.0, "y": 0.5}),
        rates={"z": -1e-4},
    ),
    "shear-stress": follows_by_hand("shear xy target {0}", 1e-2, {"xy": 1.2}, tilted=True),
    "shear-stress-and-pressure": follows_by_hand(
        "y target {0} shear xy target {1}", 1e-2, {"y": 1.1, "xy": 1.05}, tilted=True
    ),
    "sheared-in-two-planes-under-pressure": follows_by_hand(
        "y target {0} shear xy rate 2e-4 shear yz rate 1e-4",
        None,
        {"y": 1.2},
        rates={"xy": 2e-4, "yz": 1e-4},
        tilted=True,
    ),
}

if __name__ == "__main__":
    main(CASES)
