# SPDX-License-Identifier: GPL-2.0-or-later
"""Verification of friction: a ball that slips until it rolls, oblique impacts on a plane and between spheres
(doc/verification.md)."""
from dataclasses import replace
from functools import partial
import math

import numpy as np

from case import main, require, require_close
from deck import dump_grains, rayleigh_time
from ledger import UNDAMPED
import meshes
from packing import DENSITY
from run import run
from verification import (
    G,
    NAMED,
    STIFF,
    Bound,
    Problem,
    ball,
    cases_of,
    deck_of,
    effective,
    free_box,
    law_of,
    mass_of,
    material,
    rms,
    solve,
    until,
)
from wall_analytic import gravity, wall

T_R = rayleigh_time(1.0, STIFF)
MASS = mass_of(1.0, 1.0, 1.0)
INERTIA = 0.4 * MASS
ROUNDING = 1e-12
GRAINS = 16


def place(k):
    """Of one of sixteen grains that are not to meet, on a plane."""
    return 4.0 * (k % 4) - 6.0, 4.0 * (k // 4) - 6.0


def floor_law(e=1.0, model="hertz"):
    return law_of((STIFF, STIFF), (1.0, None), (MASS, None), e, model)


def slipping(who, share, mesh=False, friction=0.3, **choices):
    """Balls set down in motion without spin: slip ends after 2/7 v/(mu g) at 5/7 v if the lever is R and the spring
    stiff. Here the lever is R less a `share` of the overlap, and the ball swings on the spring until it is stretched
    to the limit: both in closed form. Slip ends where a straight line through two moments of it meets 0."""
    law = floor_law()
    overlap = law.overlap_under(MASS * G)
    lever, stiffness, limit = 1.0 - share * overlap, law.tangential_stiffness(overlap), friction * MASS * G
    mobility = 1.0 / MASS + lever**2 / INERTIA
    frequency = math.sqrt(stiffness * mobility)
    speeds = 1.0 + 0.05 * np.arange(GRAINS)
    stretched = np.arcsin(limit * frequency / (stiffness * speeds)) / frequency
    ends = stretched + speeds * np.cos(frequency * stretched) / (limit * mobility)
    rolled = speeds / (1.0 + INERTIA / (MASS * lever**2))
    time = 0.9 * ends.min()
    require(stretched.max() < 0.5 * time, "the spring is stretched too late")

    def deck(dt):
        grains = [ball((*place(k), 1.0 - overlap), velocity=(v, 0.0, 0.0)) for k, v in enumerate(speeds)]
        packing = free_box(grains, atom_style="superquadric" if choices else "sphere")
        made = deck_of(packing, dt, material=material(friction=(friction,)), **choices)
        made.body = [gravity(0.0, 0.0, -G), *(mesh_floor(made) if mesh else [wall(made, "floor", "zplane 0.0")])]
        return made

    def errors(snapshots):
        times = np.array([0.5, 1.0]) * time
        v = np.array([snapshots[k]["vx"] for k in (-2, -1)])
        slip = v - lever * np.array([snapshots[k]["omegay"] for k in (-2, -1)])
        end = times[1] + slip[1] * (times[1] - times[0]) / (slip[0] - slip[1])
        speed = v[1] + (v[1] - v[0]) / (times[1] - times[0]) * (end - times[1])
        return {"time": rms(end / ends - 1.0), "velocity": rms(speed / rolled - 1.0)}

    bounds = {"time": Bound(2, 3e-4), "velocity": Bound(0, 1e-11)}
    return Problem(f"slip to roll, {who}", deck, time, errors, bounds, T_R, samples=2)


def mindlin_impact(law, normal, tangential, friction, dashpot):
    """(duration, tangential velocity, spin, normal velocity) after an impact on a plane. A spring k_t s, k_t = 8 G*
    sqrt(R overlap), follows the contact point until it is cut at mu |F_n|; while it sticks a dashpot may act beside it,
    made for k_t as that of the normal is for its stiffness."""

    def state(y):
        """k_t, the force mu |F_n| of slip, the rate at which the length that it cuts the spring to changes."""
        overlap, approach = max(y[0], 1e-30), y[1]
        stiffness = law.tangential_stiffness(overlap)
        force, damping = law.force(overlap, approach), law.damping(overlap)
        # F_n/k_t = (elastic ~ overlap) + (damping ~ overlap^(-1/4)) x approach
        rate = law.elastic(overlap) * approach / overlap
        rate -= damping * (0.25 * approach**2 / overlap + force / MASS)
        return stiffness, friction * abs(force), math.copysign(friction, force) * rate / stiffness

    def slip_of(y):
        return y[2] - (1.0 - 0.5 * y[0]) * y[3]

    def rate(y, slips):
        stiffness, limit, change = state(y)
        damping = law.damping(y[0]) * math.sqrt(4.0 * law.shear / law.young) if dashpot else 0.0
        force = slips * limit if slips else stiffness * y[4] + damping * slip_of(y)
        moved = slips * change if slips else slip_of(y)
        push = -law.force(y[0], y[1]) / MASS
        return [y[1], push, -force / MASS, (1.0 - 0.5 * y[0]) * force / INERTIA, moved]

    # Without damping a ball slips from the beginning if it does so at all: F_n/k_t = E* overlap/(6 G*).
    slips = tangential > friction * law.young / (6.0 * law.shear) * normal and law.restitution == 1.0
    y, time, slips = [0.0, normal, tangential, 0.0, 0.0], 0.0, int(slips)
    while True:
        open_ = until(lambda t, y: y[0] - 1e-12 if y[1] < 0.0 else 1.0)
        if slips:
            change = until(lambda t, y, s=slips: s * slip_of(y) - state(y)[2] if t > 0 else 1.0)
        else:
            change = until(lambda t, y: state(y)[1] - state(y)[0] * abs(y[4]) if t > 0 else 1.0)
        change.direction = open_.direction = -1
        found = solve(lambda t, y, s=slips: rate(y, s), y, 10.0 * law.duration(normal), [open_, change])
        time, y = time + found.t[-1], found.y[:, -1]
        if len(found.t_events[0]):
            return time, y[2], y[3], -y[1]
        if slips:
            stiffness, limit, _ = state(y)
            slips, y[4] = 0, slips * limit / stiffness
        else:
            slips = int(np.sign(y[4]))


FLOOR = meshes.rectangle((-15.0, -15.0, 0.0), (30.0, 0.0, 0.0), (0.0, 30.0, 0.0))


def mesh_floor(deck):
    """The plane z = 0 as a mesh of two triangles; some grains of `place` touch both."""
    file = meshes.folder_with(floor=FLOOR) / "floor.stl"
    model = replace(deck, extra="").model()
    return [
        f"fix mesh all mesh/surface file {file} type 1",
        f"fix floor all wall/gran {model} mesh n_meshes 1 meshes mesh {deck.extra}".strip(),
    ]


def oblique(e, steepest, orders, allowed, extra="", mesh=False, **choices):
    """Impacts on a plane at angles from `steepest` to 80 degrees to the normal: sticking, slipping and both, against
    the law's own differential equation."""
    law, speed, friction = floor_law(e), 1.0, 0.2
    angles = np.radians(np.linspace(steepest, 80.0, GRAINS))
    known = np.array([mindlin_impact(law, speed, speed * math.tan(a), friction, not extra) for a in angles])
    time = 1.2 * known[:, 0].max()

    def deck(dt):
        grains = [ball((*place(k), 1.0), velocity=(speed * math.tan(a), 0.0, -speed)) for k, a in enumerate(angles)]
        made = deck_of(free_box(grains), dt, material=material(friction=(friction,), restitution=(e,)), extra=extra)
        made.body = mesh_floor(made) if mesh else [wall(made, "floor", "zplane 0.0")]
        return made

    def errors(snapshots):
        found = zip(("tangential velocity", "spin", "normal velocity"), ("vx", "omegay", "vz"), known[:, 1:].T)
        return {name: rms((snapshots[-1][column] - expected) / speed) for name, column, expected in found}

    names = ("tangential velocity", "spin", "normal velocity")
    bounds = {name: Bound(*both) for name, *both in zip(names, orders, allowed)}
    return Problem(
        f"oblique impact on a {'mesh' if mesh else 'plane'}, {extra + ', ' if extra else ''}e = {e:g}",
        deck,
        time,
        errors,
        bounds,
        T_R,
        **choices,
    )


def sliding_pairs():
    """Two spheres of different radii meet off centre and slide all the while: velocities and spins against the planar
    equations of motion; momentum and moment of momentum stay."""
    radii, friction, speed = (0.8, 1.2), 0.05, 1.0
    masses = np.array([mass_of(r, r, r) for r in radii])
    inertias = 0.4 * masses * np.array(radii) ** 2
    law = law_of((STIFF, STIFF), radii, masses)
    offsets = np.linspace(0.4, 0.8, GRAINS) * sum(radii)
    cap = friction * law.young / (6.0 * law.shear)

    def after(offset):
        """Relative position, relative velocity (of the first to the second), both spins; slipping is along +t all the
        while."""

        def rate(_, y):
            r, v = np.array(y[:2]), np.array(y[2:4])
            distance = math.hypot(*r)
            n = r / distance
            t = np.array([-n[1], n[0]])
            overlap = sum(radii) - distance
            levers = np.array(radii) - 0.5 * overlap
            normal = law.elastic(overlap)
            slip = v @ t - levers @ y[4:6]
            require(abs(slip) > -cap * (v @ n) or overlap <= 0.0, "it sticks")
            rub = -math.copysign(friction * normal, slip)
            force = normal * n + rub * t
            return [*v, *(force / law.mass), *(-levers * rub / inertias)]

        start = [-math.sqrt(sum(radii) ** 2 - offset**2), -offset, speed, 0.0, 0.0, 0.0]
        return solve(rate, start, time).y[:, -1]

    time = 3.0 * law.duration(speed * math.sqrt(1.0 - 0.8**2))
    known = np.array([after(offset) for offset in offsets])

    def deck(dt):
        grains = []
        for k, offset in enumerate(offsets):
            x, y = 5.0 * (k % 4) - 7.5, 5.0 * (k // 4) - 7.5
            apart = math.sqrt(sum(radii) ** 2 - offset**2)
            shares = masses[::-1] / masses.sum()
            for radius, share, side in zip(radii, shares, (-1.0, 1.0)):
                where = (x + side * share * apart, y + side * share * offset, 0.0)
                grains.append(ball(where, radius, (-side * share * speed, 0.0, 0.0)))
        return deck_of(free_box(grains), dt, material=material(friction=(friction,)))

    def totals(now):
        momentum = [(masses * now[v].reshape(-1, 2)).sum(axis=1) for v in ("vx", "vy")]
        x, y, u, v, w = (now[name].reshape(-1, 2) for name in ("x", "y", "vx", "vy", "omegaz"))
        return np.array(momentum), (masses * (x * v - y * u) + inertias * w).sum(axis=1)

    def errors(snapshots):
        start, now = snapshots[0], snapshots[-1]
        relative = np.array([now[v].reshape(-1, 2)[:, 0] - now[v].reshape(-1, 2)[:, 1] for v in ("vx", "vy")]).T
        spins = now["omegaz"].reshape(-1, 2)
        (p, m), (p0, m0) = totals(now), totals(start)
        return {
            "velocities": rms((relative - known[:, 2:4]) / speed),
            "spins": rms((spins - known[:, 4:6]) * sum(radii) / speed),
            "momentum": np.abs(p - p0).max() / (law.mass * speed),
            "moment of momentum": np.abs(m - m0).max() / (law.mass * speed),
        }

    bounds = {
        "velocities": Bound(2.5, 7e-6),
        "spins": Bound(2.5, 1.6e-6),
        "momentum": Bound(0, ROUNDING),
        "moment of momentum": Bound(0, 10.0 * ROUNDING),
    }
    return Problem("oblique impact of two spheres", deck, time, errors, bounds, rayleigh_time(min(radii), STIFF))


RESTITUTIONS = (0.9, 0.7, 0.5, 0.3, 0.1)
SETTINGS = ("", "limitForce on", UNDAMPED, f"{UNDAMPED} limitForce on")


def excess(e, extra, ranks=1):
    """Impulse of friction over mu times that of the normal force, of a ball that hits a plane at 70 degrees to the
    normal and slides: 1 by Coulomb's law. At a step so small that it is the law's."""
    friction, steps = 0.2, 8000
    dt = 12.0 * T_R / steps
    made = deck_of(
        free_box([ball((0.0, 0.0, 1.0), velocity=(math.tan(math.radians(70.0)), 0.0, -1.0))]),
        dt,
        material=material(friction=(friction,), restitution=(e,)),
        extra=extra,
    )
    made.body = [wall(made, "floor", "zplane 0.0"), *dump_grains(made.packing, steps), f"run {steps}"]
    before, now = (s for _, s in run(made, ranks).dump("grains.dump"))
    require(now["z"][0] > 1.0 and now["vx"][0] > now["omegay"][0], "it touches still, or rolls")
    return (before["vx"][0] - now["vx"][0]) / (friction * (now["vz"][0] + 1.0))


def coulomb(ranks):
    """LIGGGHTS limits the spring by mu |F_n| also where the normal force attracts, and adds the tangential dashpot to
    it without a limit: more friction than Coulomb's, unless both are switched off."""
    for e in RESTITUTIONS:
        found = [excess(e, extra, ranks) for extra in SETTINGS]
        print(f"e = {e:g}:", *(f"{ratio:.4f}" for ratio in found))
        require(found[0] > found[2] - 1e-9, f"e = {e:g}: a dashpot that takes friction away: {found}")
        # Less while the spring is first stretched; never more, but for rounding.
        require(0.95 < found[3] < 1.0 + 1e-10, f"e = {e:g}: {found[3]} of Coulomb's friction")
        tangent = math.tan(math.radians(70.0))
        for ratio, dashpot in zip((found[0], found[2]), (True, False)):
            _, left, _, bounced = mindlin_impact(floor_law(e), 1.0, tangent, 0.2, dashpot)
            # The step of 0.0015 T_R: 0.4 % at the spring's first stretching under a dashpot.
            require_close(ratio, (tangent - left) / (0.2 * (1.0 + bounced)), 1e-2, f"e = {e:g}: friction of the law")


# Kharaz, Gorham & Salman 2001: aluminium oxide on a thick plate of glass, 3.9 m/s, angles to the normal in degrees.
MEASURED = {
    "tangential restitution": (
        (1.84, 3.703, 9.496, 20.012, 30.127, 39.382, 49.694, 60.02),
        (0.79344, 0.74533, 0.67257, 0.59691, 0.68756, 0.77148, 0.84761, 0.90142),
    ),
    "spin [rad/s]": (
        (6.143, 10.991, 21.251, 31.157, 39.143, 50.348, 60.328),
        (136.18, 265.69, 577.65, 612.88, 595.49, 453.21, 382.09),
    ),
    "rebound angle [degrees]": (
        (2.15, 4.096, 9.826, 20.567, 30.29, 39.535, 49.747, 60.208),
        (1.733, 2.962, 6.518, 12.208, 21.67, 32.613, 45.125, 57.474),
    ),
}
ALUMINA, GLASS = (380e9, 0.23), (70e9, 0.25)  # Young's modulus [Pa], Poisson's ratio
SPEED, RADIUS, SOLID, E_NORMAL, FRICTION = 3.9, 2.5e-3, 4000.0, 0.98, 0.092


def rebounds(degrees, fraction=NAMED, ranks=1):
    """(tangential restitution, spin in rad/s, rebound angle in degrees) by angle of incidence. The run has a radius of
    1 m, 1000 kg/m^3 and 0.3 m/s: the same motion, as density x speed^2 over the moduli is that of the experiment."""
    speed = 0.3
    scale = DENSITY * speed**2 / (SOLID * SPEED**2)
    young = (ALUMINA[0] * scale, GLASS[0] * scale)
    angles = np.radians(degrees)
    moduli = effective(*young, poisson=(ALUMINA[1], GLASS[1]))
    duration = replace(floor_law(), young=moduli[0]).duration(0.4 * speed)
    dt = fraction * rayleigh_time(1.0, max(young))
    grains = [
        ball((*place(k), 1.0), velocity=(speed * math.sin(a), 0.0, -speed * math.cos(a))) for k, a in enumerate(angles)
    ]
    contact = material(young=young, poisson=(ALUMINA[1], GLASS[1]), restitution=(E_NORMAL,), friction=(FRICTION,))
    deck = deck_of(free_box(grains, types=2), dt, material=contact, extra=UNDAMPED)
    steps = math.ceil(duration / dt)
    deck.body = [wall(deck, "plate", "zplane 0.0", 2), *dump_grains(deck.packing, steps), f"run {steps}"]
    now = run(deck, ranks).dump("grains.dump")[-1][1]
    require(bool((now["z"] > 1.0).all()), "a ball has not left the plate")
    turned = now["omegay"] / speed * SPEED / RADIUS
    return now["vx"] / (speed * np.sin(angles)), turned, np.degrees(np.arctan2(now["vx"], now["vz"]))


def rigid_sliding(degrees):
    """(tangential restitution, spin, rebound angle) of a rigid ball that slides all the while."""
    angles = np.radians(degrees)
    rubbed = FRICTION * (1.0 + E_NORMAL)
    left = 1.0 - rubbed / np.tan(angles)
    spin = 2.5 * rubbed * np.cos(angles) * SPEED / RADIUS
    return left, spin, np.degrees(np.arctan2(left * np.sin(angles), E_NORMAL * np.cos(angles)))


# From here on measured and computed values must agree: nearer to the normal the measured ball loses tangential speed to
# microslip, which the law does not have. What a figure gives: 0.02, 60 rad/s (theory of rigid sliding is off by as
# much, where the tangential restitution agrees with it), 1.2 degrees.
COMPARED_FROM = 20.0
MEASURED_WITHIN = {"tangential restitution": 0.025, "spin [rad/s]": 60.0, "rebound angle [degrees]": 1.2}
SLIDES_FROM = 25.0


def kharaz(ranks):
    """Against what was measured, and against rigid sliding where the ball slides."""
    for k, (name, (angles, measured)) in enumerate(MEASURED.items()):
        angles, found = np.array(angles), rebounds(angles, ranks=ranks)[k]
        print(name, *(f"{a:.1f}: {f:.4g} ({m:.4g})" for a, f, m in zip(angles, found, measured)))
        far, slides = angles >= COMPARED_FROM, angles >= SLIDES_FROM
        require_close(found[far], np.array(measured)[far], MEASURED_WITHIN[name], f"measured {name}", 1.0)
        # Lever R - overlap/2, and the time step's damping: overlaps are 0.6 % of the radius.
        require_close(found[slides], rigid_sliding(angles)[k][slides], 3e-3, f"{name} of rigid sliding")


PROBLEMS = {
    # The levers are LIGGGHTS's: of spheres to the middle of the overlap, of superquadrics to the grain's surface at a
    # plane, to the mesh at a mesh.
    "slip-to-roll": partial(slipping, "sphere", 0.5),
    "slip-to-roll-of-ellipsoids": partial(slipping, "ellipsoid", 0.0, surface="ellipsoid"),
    "slip-to-roll-on-a-mesh": partial(slipping, "ellipsoid on a mesh", 1.0, True, surface="ellipsoid"),
    # Below this step a small term of first order shows: LIGGGHTS takes the lever, R - overlap/2, at the end of a step,
    # and the spin at its middle.
    "oblique-on-a-plane": partial(oblique, 1.0, 5.0, (2, 2, 2.5), (4e-5, 1e-4, 7e-6), smallest=0.0125),
    "oblique-on-a-mesh": partial(oblique, 1.0, 5.0, (2, 2, 2.5), (4e-5, 1e-4, 7e-6), mesh=True, smallest=0.0125),
    "oblique-damped": partial(oblique, 0.5, 25.0, (1, 1), (1.4e-2, 3.5e-2)),
    "oblique-damped-along-the-normal": partial(oblique, 0.5, 25.0, (1, 1), (8.5e-4, 2.1e-3), UNDAMPED),
    "oblique-of-two-spheres": sliding_pairs,
}

if __name__ == "__main__":
    main({**cases_of(PROBLEMS), "kharaz": kharaz, "coulomb": coulomb})
