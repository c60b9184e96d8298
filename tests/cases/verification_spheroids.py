# SPDX-License-Identifier: GPL-2.0-or-later
"""Verification of spheroids: elastic impact along axes, free precession, rest on a plane (doc/verification.md)."""
from dataclasses import replace
from functools import partial
import math

import numpy as np

from case import main, require
from deck import rayleigh_time
from oracle.measures import rotation
from packing import Grain
from spheroid_motion import MOTION, moments
from verification import (
    G,
    STIFF,
    Body,
    Bound,
    Problem,
    cases_of,
    deck_of,
    free_box,
    law_of,
    mass_of,
    material,
    plane,
    rms,
    solve,
)
from verification_friction import mesh_floor
from verification_normal import elastic_impact
from wall_analytic import gravity, wall

PROLATE, OBLATE, TRIAXIAL = (0.8, 0.8, 1.2), (1.2, 1.2, 0.6), (0.7, 1.0, 1.3)
SOFT = 0.2 * STIFF
CURVED = "gaussianCurvature yes curvatureLimitFactor 100"
ROOT = math.sqrt(0.5)
# Turned so that body axis x, y or z is along z.
TURNS = ((ROOT, 0.0, -ROOT, 0.0), (ROOT, ROOT, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


def along(shape, axis, young=STIFF):
    """The body with that axis along z. The principal curvatures of an ellipsoid at the end of its axis c are c/a^2 and
    c/b^2: the radius of its Gaussian curvature is a b/c."""
    c = shape[axis]
    return Body(young, shape, c, math.prod(shape) / c**2, TURNS[axis])


def resting(surface):
    """Spheroids and a triaxial ellipsoid are set on a plane on the ends of each of their axes, and sink in until they
    rest: overlap and force under their weight."""
    bodies = [along(shape, axis) for shape in (PROLATE, OBLATE, TRIAXIAL) for axis in range(3)]
    weights = np.array([body.mass() * G for body in bodies])
    overlaps = []
    for body, weight in zip(bodies, weights):
        law = law_of((STIFF, STIFF), (body.roundness, None), (body.mass(), None))
        overlaps.append(law.overlap_under(weight))
    overlaps = np.array(overlaps)
    reaches = np.array([body.reach for body in bodies])
    smallest = rayleigh_time(min(min(body.shape) for body in bodies), STIFF)

    def deck(dt):
        grains = []
        for k, body in enumerate(bodies):
            where = (4.0 * (k % 3) - 4.0, 4.0 * (k // 3) - 4.0, body.reach)
            grains.append(Grain(where, body.shape, body.quaternion))
        packing = free_box(grains, atom_style="superquadric")
        made = deck_of(packing, dt, surface=surface, extra=CURVED, material=material(restitution=(0.3,)))
        made.body = [gravity(0.0, 0.0, -G), wall(made, "floor", "zplane 0.0")]
        return made

    def errors(snapshots):
        now = snapshots[-1]
        return {
            "overlap": float(np.abs((reaches - now["z"]) / overlaps - 1.0).max()),
            "force": float(np.abs(now["f_force_floor[3]"] / weights - 1.0).max()),
        }

    bounds = {"overlap": Bound(0, 1e-8), "force": Bound(0, 1e-8)}
    return Problem(
        f"rest on a plane, surface {surface}",
        deck,
        300.0 * smallest,
        errors,
        bounds,
        smallest,
        columns="id z vz f_force_floor[3]",
    )


def leaning(shape, surface, bounds, mesh=False):
    """Spheroids hit a plane, their axes at angles t from 5 to 85 degrees to the vertical: velocity and spin after an
    elastic impact without friction, against the equations of motion. With h^2 = a^2 sin^2 t + c^2 cos^2 t the overlap
    is h - z, the radius of curvature a^2 c/h^2, the lever (c^2 - a^2) sin t cos t/h."""
    a, _, c = shape
    mass, speed = mass_of(*shape), 1.0
    across = 0.2 * mass * (a * a + c * c)  # moment of inertia
    plain = law_of((STIFF, STIFF), (1.0, None), (mass, None))
    angles = np.radians(np.linspace(5.0, 85.0, 16))

    def height(t):
        return math.hypot(a * math.sin(t), c * math.cos(t))

    def curvature_radius(z, t, lever):
        """On a mesh LIGGGHTS takes it not at the deepest point but where the line to that point's projection meets the
        surface."""
        along, beside = (lever * math.sin(t) - z * math.cos(t)), (lever * math.cos(t) + z * math.sin(t))
        if not mesh:
            return a * a * c / height(t) ** 2
        on_surface = (beside / a) ** 2 + (along / c) ** 2
        return a * a * c * ((beside / a**2) ** 2 + (along / c**2) ** 2) / on_surface

    def rate(_, y):
        z, v, t, spin = y
        lever = -(c * c - a * a) * math.sin(t) * math.cos(t) / height(t)
        force = replace(plain, radius=curvature_radius(z, t, lever)).elastic(height(t) - z)
        return [v, force / mass, spin, -lever * force / across]

    time = 2.5 * replace(plain, radius=a * a / c).duration(speed)
    known = np.array([solve(rate, [height(t), -speed, t, 0.0], time).y[:, -1] for t in angles])

    def deck(dt):
        grains = []
        for k, t in enumerate(angles):
            where = (4.0 * (k % 4) - 6.0, 4.0 * (k // 4) - 6.0, height(t))
            turned = (math.cos(0.5 * t), 0.0, math.sin(0.5 * t), 0.0)
            grains.append(Grain(where, shape, turned, (0.0, 0.0, -speed)))
        made = deck_of(free_box(grains, atom_style="superquadric"), dt, surface=surface, extra=CURVED)
        made.body = mesh_floor(made) if mesh else [wall(made, "floor", "zplane 0.0")]
        return made

    def errors(snapshots):
        now = snapshots[-1]
        return {
            "velocity after": rms((now["vz"] - known[:, 1]) / speed),
            "spin after": rms((now["omegay"] - known[:, 3]) * c / speed),
        }

    bounds = {"velocity after": Bound(2.5, bounds[0]), "spin after": Bound(2.5, bounds[1])}
    title = f"leaning {'prolate' if c > a else 'oblate'} grains on a {'mesh' if mesh else 'plane'}"
    title += "" if surface == "ellipsoid" else f", surface {surface}"
    return Problem(title, deck, time, errors, bounds, rayleigh_time(min(shape), STIFF))


def colliding(surface):
    """Turned and spinning spheroids of two shapes meet off centre, with friction and damping: momentum and moment of
    momentum stay, whatever the law."""
    kinds = (PROLATE, OBLATE)
    masses = np.array([mass_of(*shape) for shape in kinds])
    tilts = ((math.cos(0.3), 0.0, math.sin(0.3), 0.0), (math.cos(0.5), math.sin(0.5), 0.0, 0.0))
    grains = [
        Grain((side * 1.05, 0.35 * side, 0.1 * side), shape, tilt, (-side, 0.0, 0.0), (0.3, 0.5 * side, 0.7))
        for side, shape, tilt in zip((-1.0, 1.0), kinds, tilts)
    ]
    smallest = rayleigh_time(min(OBLATE), STIFF)

    def deck(dt):
        contact = material(restitution=(0.5,), friction=(0.4,))
        packing = free_box(grains, atom_style="superquadric")
        made = deck_of(packing, dt, surface=surface, extra=CURVED, material=contact)
        made.body = ["unfix integrate", "fix integrate all nve/spheroid"]
        return made

    def totals(now):
        x, v, own = (np.stack([now[name + a] for a in "xyz"], axis=1) for name in ("", "v", "angmom"))
        return masses @ v, (masses[:, None] * np.cross(x, v) + own).sum(axis=0)

    def errors(snapshots):
        (p0, m0), (p, m) = totals(snapshots[0]), totals(snapshots[-1])
        changed = max(np.abs(snapshots[-1]["vx"] - snapshots[0]["vx"]))
        require(changed > 0.5, f"they did not collide: {changed}")
        return {
            "momentum": np.abs(p - p0).max() / masses.max(),
            "moment of momentum": np.abs(m - m0).max() / masses.max(),
        }

    bounds = {"momentum": Bound(0, 1e-12), "moment of momentum": Bound(0, 1e-11)}
    title = f"collision of two spheroids, surface {surface}"
    return Problem(title, deck, 60.0 * smallest, errors, bounds, smallest, columns=MOTION)


def precessing(integrator, order, bound):
    """Spheroids that turn freely: the axis goes round the angular momentum L at the rate |L|/I_e, at a fixed angle."""
    random = np.random.default_rng(5)
    grains = []
    for k, alpha in enumerate((0.33, 0.5, 0.8, 1.25, 2.0, 3.0)):
        q, axis = random.normal(size=4), random.normal(size=3)
        shape = (1.0, 1.0, alpha)
        spin = 30.0 * axis / np.linalg.norm(axis)
        grains.append(
            Grain(
                (6.0 * (k % 3) - 6.0, 6.0 * (k // 3) - 3.0, 0.0), shape, tuple(q / np.linalg.norm(q)), omega=tuple(spin)
            )
        )
    smallest = rayleigh_time(0.33, STIFF)
    time = 2.0

    def deck(dt):
        packing = free_box(grains, atom_style="superquadric")
        return deck_of(packing, dt, ["unfix integrate", f"fix integrate all {integrator}"])

    def errors(snapshots):
        turned, tilted, kept = [], [], []
        for k, grain in enumerate(grains):
            inertia, start = moments(grain), rotation(np.array(grain.quaternion))
            momentum = start @ (inertia * (start.T @ np.array(grain.omega)))
            size = np.linalg.norm(momentum)
            axes = [rotation(np.array([s[f"quat{n}"][k] for n in (1, 2, 3, 4)]))[:, 2] for s in snapshots]
            phase = size / inertia[0] * time
            along_l = momentum / size
            across = [u - (u @ along_l) * along_l for u in (axes[0], axes[-1])]
            found = math.atan2(np.cross(across[0], across[1]) @ along_l, across[0] @ across[1])
            turned.append(math.remainder(found - phase, 2.0 * math.pi) / phase)
            tilted.append((axes[-1] - axes[0]) @ along_l)
            now = np.array([snapshots[-1]["angmom" + a][k] for a in "xyz"])
            kept.append(np.linalg.norm(now - momentum) / size)
        return {"precession rate": rms(turned), "tilt of the axis": rms(tilted), "angular momentum": rms(kept)}

    bounds = {
        "precession rate": Bound(order, bound[0]),
        "tilt of the axis": Bound(order, bound[1]),
        "angular momentum": Bound(0, bound[2]),
    }
    return Problem(f"precession, {integrator}", deck, time, errors, bounds, smallest, columns=MOTION)


def meeting(title, first, second, surface="ellipsoid"):
    title += "" if surface == "ellipsoid" else f", surface {surface}"
    return elastic_impact(f"elastic impact, {title}", first, second, surface=surface, extra=CURVED)


MEETINGS = {
    "prolate-poles": ("poles of prolate grains", along(PROLATE, 2), along(PROLATE, 2)),
    "prolate-sides": ("sides of prolate grains, axes crossed", along(PROLATE, 0), along(PROLATE, 1, SOFT)),
    "oblate-faces": ("poles of oblate grains", along(OBLATE, 2), along(OBLATE, 2)),
    "oblate-edge-on-prolate-pole": ("rim of an oblate, pole of a prolate", along(OBLATE, 0), along(PROLATE, 2, SOFT)),
    "triaxial-on-a-plane": ("a triaxial grain and a plane", along(TRIAXIAL, 1), plane()),
}
PROBLEMS = {
    **{f"elastic-impact-{name}": partial(meeting, *bodies) for name, bodies in MEETINGS.items()},
    "elastic-impact-superquadric": partial(meeting, *MEETINGS["prolate-poles"], "superquadric"),
    "leaning-prolate": partial(leaning, PROLATE, "ellipsoid", (1e-5, 9e-6)),
    "leaning-oblate": partial(leaning, OBLATE, "ellipsoid", (4.2e-6, 3.5e-6)),
    "leaning-superquadric": partial(leaning, PROLATE, "superquadric", (1e-5, 9e-6)),
    "leaning-on-a-mesh": partial(leaning, PROLATE, "ellipsoid", (1e-5, 9e-6), True),
    "collision-ellipsoid": partial(colliding, "ellipsoid"),
    "collision-superquadric": partial(colliding, "superquadric"),
    "precession-spheroid": partial(precessing, "nve/spheroid", 0, (1e-10, 1e-10, 1e-14)),
    "precession-superquadric": partial(precessing, "nve/superquadric", 2, (3.5e-7, 9.3e-6, 1e-9)),
    "rest-ellipsoid": partial(resting, "ellipsoid"),
    "rest-superquadric": partial(resting, "superquadric"),
}

if __name__ == "__main__":
    main(cases_of(PROBLEMS))
