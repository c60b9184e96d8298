"""Pairs of spheroids about to collide."""

import math

import numpy as np

from dt_tools import DENSITY, axes_of, read_dump, unit


class Pairs:
    """Pairs of equal spheroids that touch: random orientations, directions, velocities and spins, the contact
    closing."""

    def __init__(self, alpha, speed, kinds, each):
        """`each` pairs of every kind."""
        random = np.random.default_rng(5)
        self.each, n = each, each * kinds
        self.alpha, self.speed = alpha, speed
        self.mass = 4 / 3 * math.pi * alpha * DENSITY
        self.quaternions = unit(random.normal(size=(2, n, 4)))
        self.axes = np.array([axes_of(q) for q in self.quaternions])
        self.squares = np.eye(3) + (alpha**2 - 1) * self.axes[..., :, None] * self.axes[..., None, :]
        self.branch, self.normal, arm = self._touching(unit(random.normal(size=(n, 3))))
        relative = speed * unit(random.normal(size=(n, 3)))
        self.velocities = np.array([0.5 * relative, -0.5 * relative])
        self.spins = 0.5 * speed / max(1, alpha) * random.normal(size=(2, n, 3))
        closing = relative + np.cross(self.spins[0], arm) - np.cross(self.spins[1], arm - self.branch)
        self.closing = np.einsum("na,na->n", closing, self.normal)
        turn = np.sign(self.closing)[:, None]
        self.velocities, self.spins, self.closing = turn * self.velocities, turn * self.spins, np.abs(self.closing)
        self.phase = random.uniform(size=n)

    def _touching(self, direction):
        """From the first grain to the second along `direction` when they touch: branch, normal and the first's arm."""
        one, two = self.squares
        low, high = np.zeros(len(direction)), np.ones(len(direction))
        for _ in range(60):  # the derivative of lambda (1 - lambda) d.C^-1.d changes its sign once
            middle = 0.5 * (low + high)
            p = self._solve(middle, direction)
            first, second = (np.einsum("na,nab,nb->n", p, b, p) for b in (one, two))
            rising = (1 - middle) ** 2 * first > middle**2 * second
            low, high = np.where(rising, middle, low), np.where(rising, high, middle)
        p = self._solve(low, direction)
        scale = 1 / np.sqrt(low * (1 - low) * np.einsum("na,na->n", direction, p))
        arm = (1 - low)[:, None] * np.einsum("nab,nb->na", one, p) * scale[:, None]
        return direction * scale[:, None], unit(p), arm

    def _solve(self, part, direction):
        mix = (1 - part)[:, None, None] * self.squares[0] + part[:, None, None] * self.squares[1]
        return np.linalg.solve(mix, direction[:, :, None])[:, :, 0]

    def energy(self, velocities, spins, axes):
        along = np.einsum("kna,kna->kn", spins, axes)
        across = np.einsum("kna,kna->kn", spins, spins) - along**2
        rotation = self.mass / 5 * (2 * along**2 + (1 + self.alpha**2) * across)
        return 0.5 * (self.mass * np.einsum("kna,kna->kn", velocities, velocities) + rotation).sum(axis=0)

    def spacing(self):
        return 5 * max(1, self.alpha)

    def edge(self):
        return self.spacing() * math.ceil(len(self.phase) ** (1 / 3))

    def write(self, path, dt):
        """Commands that make the grains, apart by a part of what a step closes."""
        branch = self.branch + self.normal * (self.closing * dt * self.phase)[:, None]
        cells = math.ceil(len(self.phase) ** (1 / 3))
        with open(path, "w") as file:
            for pair in range(len(self.phase)):
                cell = (np.array([pair % cells, pair // cells % cells, pair // cells**2]) + 0.5) * self.spacing()
                for k, side in ((0, -0.5), (1, 0.5)):
                    place, atom = cell + side * branch[pair], 2 * pair + k + 1
                    file.write(
                        f"create_atoms {pair // self.each + 1} single {' '.join(map(repr, place.tolist()))} units box\n"
                        f"set atom {atom} shape 1 1 {self.alpha!r} blockiness 2 2 density {DENSITY!r} quat_direct "
                        + " ".join(map(repr, self.quaternions[k, pair].tolist()))
                    )
                    names = ("vx", "vy", "vz", "omegax", "omegay", "omegaz")
                    values = (*self.velocities[k, pair].tolist(), *self.spins[k, pair].tolist())
                    file.write("".join(f" {name} {value!r}" for name, value in zip(names, values)) + "\n")

    def energy_after(self, path):
        rows, _ = read_dump(path)
        rows = rows.reshape(-1, 2, rows.shape[1]).transpose(1, 0, 2)
        return self.energy(rows[..., 1:4], rows[..., 4:7], np.array([axes_of(grains[:, 7:11]) for grains in rows]))
