# SPDX-License-Identifier: GPL-2.0-or-later
"""Two balls of radii 1 and `radius` that touch all the time and do not slide: `model hooke/stiffness tangential
history`, its motion by an integrator of eighth order (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations
I, DOP853)."""
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from packing import DENSITY


@dataclass
class Pair:
    """Places, velocities and spins of two, three numbers each."""

    radii: tuple
    places: tuple
    velocities: tuple
    spins: tuple
    k_n: float
    k_t: float
    gamma_n: float = 0.0  # per mass
    gamma_t: float = 0.0
    by_size: bool = False  # the contact point divides the distance as the radii do; else the overlap in halves

    def masses(self):
        return [4.0 / 3.0 * np.pi * r**3 * DENSITY for r in self.radii]

    def _rate(self, _, state):
        places, velocities, spins = state[:18].reshape(3, 2, 3)
        spring = state[18:]
        masses = self.masses()
        mass = masses[0] * masses[1] / (masses[0] + masses[1])
        branch = places[0] - places[1]
        distance = np.linalg.norm(branch)
        n, overlap = branch / distance, sum(self.radii) - distance
        shares = np.array(self.radii) / sum(self.radii) if self.by_size else (0.5, 0.5)
        levers = [r - share * overlap for r, share in zip(self.radii, shares)]
        v = velocities[0] - velocities[1]
        vn = v @ n
        turning = (v - vn * n) / distance
        u = v - vn * n - np.cross(levers[0] * spins[0] + levers[1] * spins[1], n)
        tangential = -self.k_t * spring - self.gamma_t * mass * u
        force = (self.k_n * overlap - self.gamma_n * mass * vn) * n + tangential
        torque = -np.cross(n, tangential)
        inertias = [0.4 * m * r * r for m, r in zip(masses, self.radii)]
        return np.concatenate(
            [
                velocities.ravel(),
                force / masses[0],
                -force / masses[1],
                levers[0] * torque / inertias[0],
                levers[1] * torque / inertias[1],
                u - (spring @ turning) * n,
            ]
        )

    def at(self, time):
        """Places, velocities and spins, of shape (3, 2, 3)."""
        start = np.concatenate([np.ravel(x) for x in (self.places, self.velocities, self.spins)] + [np.zeros(3)])
        return solve_ivp(self._rate, (0.0, time), start, "DOP853", rtol=1e-13, atol=1e-13).y[:18, -1].reshape(3, 2, 3)
