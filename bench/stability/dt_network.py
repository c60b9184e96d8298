"""The contacts of a packing at rest as a linear system, and the time step at which velocity Verlet makes it grow."""

import math

import numpy as np

from dt_tools import DENSITY, TANGENTIAL, axes_of, damping_ratio, read_dump


def cross_matrix(r):
    zero = np.zeros(len(r))
    x, y, z = r.T
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)


class Network:
    """The contacts of a packing as springs and dashpots of the linear theory; velocities in units that make every mass
    1."""

    def __init__(self, stem, alpha):
        contacts, edges = read_dump(f"{stem}.contacts")
        grains, _ = read_dump(f"{stem}.grains")
        self.count = len(grains)
        self.mass = 4 / 3 * math.pi * alpha * DENSITY
        self.i, self.j = (contacts[:, k].astype(int) - 1 for k in (0, 1))
        self.normal, self.overlap = contacts[:, 5:8], contacts[:, 11]
        arm = contacts[:, 2:5] - grains[self.i, 1:4]
        arm -= np.round(arm @ np.linalg.inv(edges).T) @ edges.T
        self.stiffness = 1.5 * (contacts[:, 12] - contacts[:, 13]) / self.overlap
        light = self._light(axes_of(grains[:, 4:8]), alpha)
        self.to_i = self._lever(arm) @ light[self.i]
        self.to_j = self._lever(arm + contacts[:, 8:11]) @ light[self.j]

    def _light(self, axes, alpha):
        """Roots of the inverse mass matrices."""
        across, along = self.mass * (1 + alpha**2) / 5, self.mass * 2 / 5
        light = np.zeros((self.count, 6, 6))
        light[:, :3, :3] = np.eye(3) / math.sqrt(self.mass)
        projector = axes[:, :, None] * axes[:, None, :]
        light[:, 3:, 3:] = projector / math.sqrt(along) + (np.eye(3) - projector) / math.sqrt(across)
        return light

    @staticmethod
    def _lever(arm):
        """Velocity at the contact by (v, omega)."""
        return np.concatenate([np.broadcast_to(np.eye(3), (len(arm), 3, 3)), -cross_matrix(arm)], axis=2)

    def laws(self, e, tangential_damping):
        """Per contact: stiffness and damping matrices."""
        normal = self.normal[:, :, None] * self.normal[:, None, :]
        plane = np.eye(3) - normal
        k, kt = self.stiffness[:, None, None], TANGENTIAL * self.stiffness[:, None, None]
        factor = 2 * damping_ratio(e) * math.sqrt(self.mass / 2)
        damping = factor * np.sqrt(k) * normal + (factor * np.sqrt(kt) * plane if tangential_damping else 0)
        return k * normal + kt * plane, damping

    def apply(self, law, q):
        """M^-1/2 A M^-1/2 q for the network with this law in each contact."""
        force = np.einsum(
            "cab,cb->ca",
            law,
            np.einsum("cab,cb->ca", self.to_i, q[self.i]) - np.einsum("cab,cb->ca", self.to_j, q[self.j]),
        )
        result = np.zeros_like(q)
        np.add.at(result, self.i, np.einsum("cab,ca->cb", self.to_i, force))
        np.add.at(result, self.j, -np.einsum("cab,ca->cb", self.to_j, force))
        return result

    def stiffest(self, law, steps=45):
        """The mode of the largest eigenvalue, by Lanczos."""
        basis, diagonal, side = [], [], []
        q = np.random.default_rng(1).normal(size=(self.count, 6))
        q /= np.linalg.norm(q)
        for _ in range(steps):
            basis.append(q)
            r = self.apply(law, q)
            diagonal.append(np.vdot(r, q))
            for b in basis:
                r -= np.vdot(r, b) * b
            side.append(np.linalg.norm(r))
            q = r / side[-1]
        vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(side[:-1], 1) + np.diag(side[:-1], -1))[1]
        return np.einsum("k,kia->ia", vectors[:, -1], np.array(basis))

    def own(self, law):
        """Per grain: the 6 x 6 sum over its contacts, the others held."""
        own = np.zeros((self.count, 6, 6))
        for which, lever in ((self.i, self.to_i), (self.j, self.to_j)):
            np.add.at(own, which, np.einsum("cap,cab,cbq->cpq", lever, law, lever))
        return own

    def limit(self, stiffness, damping):
        """dt at which the largest eigenvalue of dt^2 K + 2 dt C is 4."""
        dt = 1.0 / math.sqrt(self.stiffness.max() / self.mass)
        for _ in range(8):
            q = self.stiffest(dt**2 * stiffness + 2 * dt * damping)
            before, dt = dt, positive_root(
                np.vdot(q, self.apply(stiffness, q)), 2 * np.vdot(q, self.apply(damping, q)), 4
            )
            if abs(dt / before - 1) < 1e-4:
                break
        return dt

    def bounds(self, stiffness, damping):
        """dt at which twice the largest eigenvalue of a grain's own matrix is 4, and dt at which twice the largest
        trace is."""
        own_k, own_c = self.own(stiffness), self.own(damping)
        dt = min(positive_root(np.trace(k), 2 * np.trace(c), 2) for k, c in zip(own_k, own_c) if k.any())
        trace = dt
        for _ in range(30):
            values, vectors = np.linalg.eigh(dt**2 * own_k + 2 * dt * own_c)
            worst = values[:, -1].argmax()
            q = vectors[worst, :, -1]
            before, dt = dt, positive_root(q @ own_k[worst] @ q, 2 * q @ own_c[worst] @ q, 2)
            if abs(dt / before - 1) < 1e-6:
                break
        return dt, trace


def positive_root(a, b, c):
    """x > 0 with a x^2 + b x = c."""
    return 2 * c / (b + math.sqrt(b * b + 4 * a * c))
