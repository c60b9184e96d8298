# SPDX-License-Identifier: GPL-2.0-or-later
"""Contacts of spheres from positions and velocities alone: geometry, Hertz (or Hooke-free) forces, the tangential
spring followed from step to step. F_n = 4/3 E* sqrt(R* d) d - gamma_n u_n; k_t = 8 G* sqrt(R* d); gamma = -2 sqrt(5/6)
b sqrt(S m*), S = 2 E* sqrt(R* d) for the normal part and k_t for the tangential one, b = ln e / sqrt(ln^2 e + pi^2).
Cohesion adds -energy x area along the normal, after the friction limit mu |F_n| is taken, or before it with
`tangential_reduce on`. With `time_level synchronized` the law takes the velocity of the surfaces in the middle of the
step, by normal and arms of centres that have moved half of it."""
from dataclasses import dataclass, field
import itertools
import math

import numpy as np


@dataclass
class Law:
    young: np.ndarray  # per type
    poisson: float
    restitution: np.ndarray  # types x types
    friction: np.ndarray
    dt: float
    tangential: str = "history"
    tangential_damping: bool = True
    limit_force: bool = False
    cohesion: str = "off"
    energy: np.ndarray = None  # of cohesion, types x types
    reduces: bool = False  # cohesion lowers the friction limit
    bounded: bool = False  # tangential damping is kept to the limit in the first evaluation
    synchronized: bool = False
    springs: dict = field(default_factory=dict)

    def stiffness(self, a, b):
        """E*, G* of a pair of types."""
        nu, ea, eb = self.poisson, self.young[a], self.young[b]
        effective = 1.0 / ((1 - nu * nu) / ea + (1 - nu * nu) / eb)
        shear = 1.0 / (2 * (2 - nu) * (1 + nu) / ea + 2 * (2 - nu) * (1 + nu) / eb)
        return effective, shear


def cohesive_area(model, ri, rj, distance):
    """Of the circle in which two spheres meet; or sjkr2's."""
    if model == "sjkr":
        height = (distance**2 + ri**2 - rj**2) / (2 * distance)  # of that circle's plane over the centre of i
        return math.pi * (ri**2 - height**2)
    return 2.0 * math.pi * (2.0 * ri * rj / (ri + rj)) * (ri + rj - distance)


def half_step_velocities(grains, dt, first):
    """The velocities that entered the force: v_n less the half kick that the same force gave; in the first evaluation v
    itself."""
    if first:
        return grains.v, grains.omega
    inertia = 0.4 * grains.mass * grains.radius**2
    return (
        grains.v - 0.5 * dt * grains.force / grains.mass[:, None],
        grains.omega - 0.5 * dt * grains.torque / inertia[:, None],
    )


def touching(grains, box):
    """(i, j, image) with i < j in ID, x_j + H image touching x_i."""
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3)))
    i, j = np.triu_indices(len(grains.ids), 1)
    apart = (grains.x[i] - grains.x[j])[:, None, :] - shifts @ box.edges.T
    reach = (grains.radius[i] + grains.radius[j])[:, None]
    for pair, k in zip(*np.nonzero(np.linalg.norm(apart, axis=2) < reach)):
        yield i[pair], j[pair], shifts[k]


def cross(a, b):
    """Of two vectors; numpy's is made for many, and takes ten times as long for two."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def rotation(start, end):
    """The shortest that takes one unit vector to another (Rodrigues)."""
    axis, cosine = cross(start, end), start @ end
    turning = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.eye(3) + turning + turning @ turning / (1.0 + cosine)


def in_the_middle(radii, branch, v, spins, dt):
    """The velocity of the surfaces in the middle of a step at whose end centres are `branch` apart, turned to the
    normal there; and the rotation of the normal over the step."""
    n, middle = branch / np.linalg.norm(branch), branch - 0.5 * dt * v
    distance = np.linalg.norm(middle)
    half, overlap = middle / distance, sum(radii) - distance
    levers = [(r - 0.5 * overlap) * spin for r, spin in zip(radii, spins)]
    u = v - cross(levers[0] + levers[1], half)
    return rotation(half, n) @ u, rotation(2.0 * (half @ n) * half - n, n)


def contacts(law, grains, box, first):
    """Rows like those of compute contact/local, with stiffnesses and damping coefficients as well. Springs move on by
    one step."""
    v, omega = half_step_velocities(grains, law.dt, first)
    rows, springs = [], {}
    for i, j, image in touching(grains, box):
        branch = grains.x[i] - grains.x[j] - box.edges @ image
        distance = np.linalg.norm(branch)
        n, overlap = branch / distance, grains.radius[i] + grains.radius[j] - distance
        ri, rj = grains.radius[i] - 0.5 * overlap, grains.radius[j] - 0.5 * overlap
        a, b = grains.types[i] - 1, grains.types[j] - 1
        effective, shear = law.stiffness(a, b)
        radius = grains.radius[i] * grains.radius[j] / (grains.radius[i] + grains.radius[j])
        mass = grains.mass[i] * grains.mass[j] / (grains.mass[i] + grains.mass[j])
        root = math.sqrt(radius * overlap)
        log_e = math.log(law.restitution[a, b])
        damping = -2.0 * math.sqrt(5.0 / 6.0) * log_e / math.hypot(log_e, math.pi) * math.sqrt(mass)
        kn, kt = 4.0 / 3.0 * effective * root, 8.0 * shear * root
        gamma_n, gamma_t = damping * math.sqrt(2.0 * effective * root), damping * math.sqrt(kt)
        if law.tangential == "off" or not law.tangential_damping:
            gamma_t = 0.0
        relative = v[i] - (v[j] + box.rate @ image)
        at_force = u = relative - cross(ri * omega[i] + rj * omega[j], n)
        before = law.springs.get((i, j))
        if law.synchronized and not first:
            radii = (grains.radius[i], grains.radius[j])
            u, turned = in_the_middle(radii, branch, relative, (omega[i], omega[j]), law.dt)
            before = None if before is None else turned @ before
        un = u @ n
        ut = u - un * n
        fn, damped = kn * overlap - gamma_n * un, -gamma_n * un
        if law.limit_force and fn < 0.0:  # no attraction: damping takes away the elastic force and no more
            fn, damped = 0.0, -kn * overlap
        cohesion = 0.0
        if law.cohesion != "off":
            cohesion = -law.energy[a, b] * cohesive_area(law.cohesion, grains.radius[i], grains.radius[j], distance)
        limit = law.friction[a, b] * abs(fn + cohesion if law.reduces else fn)
        ft, kind, slip, spring, gamma_t = tangential_force(law, before, ut, n, kt, gamma_t, limit, first)
        springs[(i, j)] = spring
        fn += cohesion
        mobilisation = 0.0 if law.tangential == "off" or limit == 0.0 else np.linalg.norm(ft) / limit
        rows.append(
            {
                "id": (grains.ids[i], grains.ids[j]),
                "image": image,
                "point": grains.x[i] - ri * n,
                "normal": n,
                "branch": branch,
                "overlap": overlap,
                "force": fn * n + ft,
                "fn": fn,
                "fn_damping": damped,
                "ft": ft,
                "un": un,
                "ut": ut,
                "u_at_force": at_force,
                "before": np.zeros(3) if before is None else before,
                "sliding": float(kind != "sticks"),
                "cut": kind == "cut",
                "slip": slip,
                "gamma_t": gamma_t,
                "mobilisation": mobilisation,
                "kn": kn,
                "kt": kt,
                "gamma_n": gamma_n,
            }
        )
    law.springs = springs
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def tangential_force(law, spring, ut, n, kt, gamma_t, limit, first):
    """(force, "sticks", "cut" or "beyond" the limit, slip, spring, damping coefficient that acts) of one contact."""
    if law.tangential == "off":
        return np.zeros(3), "sticks", 0.0, None, 0.0
    speed = np.linalg.norm(ut)
    if law.tangential == "no_history":
        if gamma_t * speed > limit:
            return -limit / speed * ut, "cut", speed * law.dt, None, 0.0
        return -gamma_t * ut, "sticks", 0.0, None, gamma_t
    spring = np.zeros(3) if spring is None else spring
    if not first:
        spring = spring + ut * law.dt
        spring = spring - (spring @ n) * n
    length = np.linalg.norm(spring)
    if kt * length > limit:
        cut = spring * (limit / (kt * length))
        return -kt * cut, "cut", length - limit / kt, cut, 0.0
    beyond = first and np.linalg.norm(kt * spring + gamma_t * ut) > limit
    if beyond and law.bounded:
        gamma_t = bounded_damping(gamma_t, kt * spring, ut, limit)
    return -kt * spring - gamma_t * ut, "beyond" if beyond else "sticks", 0.0, spring, gamma_t


def bounded_damping(gamma_t, force, ut, limit):
    """The largest coefficient that keeps the limit, by bisection."""
    low, high = 0.0, gamma_t
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if np.linalg.norm(force + middle * ut) <= limit else (low, middle)
    return low
