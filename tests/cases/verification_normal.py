# SPDX-License-Identifier: GPL-2.0-or-later
"""Verification along the normal: spheres that fall, bounce, meet head-on and are squeezed, against closed forms or an
ordinary differential equation solved to 1e-12 (doc/verification.md)."""
from functools import partial
import math

import numpy as np

from case import main
from deck import rayleigh_time
from verification import (
    COARSEST,
    G,
    STIFF,
    Bound,
    Problem,
    ball,
    cases_of,
    deck_of,
    free_box,
    law_of,
    mass_of,
    material,
    plane,
    rms,
    solve,
    sphere,
    until,
)
from wall_analytic import gravity, wall

T_R = rayleigh_time(1.0, STIFF)
SOFT = 0.2 * STIFF
PHASES = 16


# Of equal spheres, whose contact is the shortest, 3.3 Rayleigh times. The energy after an elastic impact is not that
# before only because a contact opens within a step: order 5/2, or 7/2 where it begins at the beginning of one.
HERTZ = {
    "largest overlap": Bound(2, 1.5e-4),
    "largest force": Bound(2, 2.2e-4),
    "speed after": Bound(3.5, 1.5e-6),
    "duration": Bound(2, 1.6e-4),
}


def phases(speed):
    """Grains of one deck touch at different moments of a step, whichever it is: an error is the rms of theirs. Gaps
    spread over the way of the coarsest step."""
    step = COARSEST * T_R * speed
    return [(k, step * (1.0 + 0.6180339887 * k % 1.0)) for k in range(PHASES)]


def on_a_floor(dt, heights, speed, restitution, pull=0.0, **choices):
    """Balls side by side, their lowest points at these heights over a plane."""
    grains = [ball((3.0 * (k % 4) - 4.5, 3.0 * (k // 4) - 4.5, 1.0 + h), velocity=(0, 0, -speed)) for k, h in heights]
    deck = deck_of(free_box(grains), dt, material=material(restitution=(restitution,)), **choices)
    deck.body = [wall(deck, "floor", "zplane 0.0"), *([gravity(0.0, 0.0, -pull)] if pull else [])]
    return deck


def floor_law(restitution, model):
    return law_of((STIFF, STIFF), (1.0, None), (mass_of(1, 1, 1), None), restitution, model)


def contact(law, speed, pull=0.0):
    """(duration, speed after) of a contact that begins at this speed, under a force along the approach."""

    def rate(_, y):
        return [y[1], (pull - law.force(y[0], y[1])) / law.mass]

    parting = until(lambda t, y: y[0] if t > 0 else 1.0)
    parting.direction = -1
    found = solve(rate, [0.0, speed], 20.0 * law.duration(speed), parting)
    return found.t_events[0][0], -found.y_events[0][0][1]


def bouncing(model, restitution, order, bound, drop=0.5, bounces=3):
    """Heights of the first bounces, in flight z - R + v^2/2g, of balls that fall from rest."""
    law = floor_law(restitution, model)

    def flights(height):
        """(time of the apex, its height) of each bounce."""
        apexes, time, speed = [], math.sqrt(2.0 * height / G), math.sqrt(2.0 * G * height)
        for _ in range(bounces):
            passed, speed = contact(law, speed, law.mass * G)
            time += passed + speed / G
            apexes.append((time, speed**2 / (2.0 * G)))
            time += speed / G
        return apexes

    heights = [(k, drop + gap) for k, gap in phases(math.sqrt(2.0 * G * drop))]
    known = [flights(height) for _, height in heights]
    end = max(apexes[-1][0] for apexes in known)

    def errors(snapshots):
        found = []
        for k, apexes in enumerate(known):
            for time, height in apexes:
                now = snapshots[round(time / end * (len(snapshots) - 1))]
                found.append((now["z"][k] - 1.0 + now["vz"][k] ** 2 / (2.0 * G)) / height - 1.0)
        return {"heights": rms(found)}

    return Problem(
        f"bounces, {model}, e = {restitution:g}",
        lambda dt: on_a_floor(dt, heights, 0.0, restitution, G, normal=model),
        end,
        errors,
        {"heights": Bound(order, bound)},
        T_R,
        samples=100,
    )


def free_fall():
    """Until just before the ground: z = h - g t^2/2."""
    height = 5.0
    time = 0.9 * math.sqrt(2.0 * height / G)

    def errors(snapshots):
        now = snapshots[-1]
        return {
            "height": abs(now["z"][0] - (1.0 + height - 0.5 * G * time**2)) / height,
            "velocity": abs(now["vz"][0] / (-G * time) - 1.0),
        }

    return Problem(
        "free fall",
        lambda dt: on_a_floor(dt, [(0, height)], 0.0, 1.0, G),
        time,
        errors,
        # Rounding of up to 1e5 steps: velocity Verlet is exact under a constant force.
        {"height": Bound(0, 1e-11), "velocity": Bound(0, 1e-11)},
        T_R,
    )


def linear_restitution(e):
    """A linear spring and dashpot until the surfaces part: e as given, and pi over the damped frequency."""
    law = floor_law(e, "hooke")
    frequency, ratio = math.sqrt(law.stiffness() / law.mass), law.damping_ratio()
    return e, math.pi / (frequency * math.sqrt(1.0 - ratio**2))


def linear_restitution_limited(e):
    """The same where the force is never attractive: Schwager & Poeschel."""
    law = floor_law(e, "hooke")
    frequency, ratio = math.sqrt(law.stiffness() / law.mass), law.damping_ratio()
    slower = math.sqrt(1.0 - ratio**2)
    phase = math.atan2(2.0 * ratio * slower, 2.0 * ratio**2 - 1.0)
    parted = math.exp(-ratio / slower * phase)
    # In flight from where the force ends to where the surfaces part.
    overlap = math.exp(-ratio / slower * phase) * math.sin(phase) / (frequency * slower)
    return parted, phase / (frequency * slower) + overlap / parted


def hertz_restitution(e):
    """Damping in proportion to sqrt(stiffness): e as given whatever the speed; the duration is integrated."""
    return e, contact(floor_law(e, "hertz"), 1.0)[0]


def restitution(model, e, known, bounds, extra=""):
    """One collision with a plane at 1 m/s, without gravity. In flight afterwards the distance tells when it ended."""
    after, duration = known(e)
    gaps = phases(1.0)
    time = 2.0 * duration + max(gap for _, gap in gaps)

    def errors(snapshots):
        now = snapshots[-1]
        speed = now["vz"]
        ended = time - (now["z"] - 1.0) / speed - np.array([gap for _, gap in gaps])
        return {"restitution": rms(speed / after - 1.0), "duration": rms(ended / duration - 1.0)}

    return Problem(
        f"restitution, {model}{' ' + extra if extra else ''}, e = {e:g}",
        lambda dt: on_a_floor(dt, gaps, 1.0, e, normal=model, extra=extra),
        time,
        errors,
        bounds,
        T_R,
    )


def elastic_impact(title, first, second, speed=2.0, **choices):
    """Hertz: largest overlap and force, duration, and the speed after, of two Bodies that meet along z, or of one and a
    plane where the second has no reach. They touch when the run begins, so that half its time is half a collision."""
    plane = second.reach is None
    masses = [first.mass(), None if plane else second.mass()]
    kinds = (first.young, second.young)
    law = law_of(kinds, (first.roundness, second.roundness), masses)
    duration, deepest = law.duration(speed), law.largest_overlap(speed)
    force = law.elastic(deepest)
    own = speed if plane else speed * masses[1] / sum(masses)

    def deck(dt):
        grains = [first.grain(1, first.reach, -own)]
        if not plane:
            grains.append(second.grain(2, -second.reach, speed - own))
        round_ = all(len(set(grain.semi_axes)) == 1 for grain in grains)
        style = "sphere" if round_ else "superquadric"
        made = deck_of(free_box(grains, types=2, atom_style=style), dt, material=material(young=kinds), **choices)
        if plane:
            made.body = [wall(made, "floor", "zplane 0.0", 2)]
        return made

    def between(snapshot, name):
        return snapshot[name][0] - (0.0 if plane else snapshot[name][1])

    def errors(snapshots):
        _, middle, end = snapshots
        reach, apart = first.reach + (0.0 if plane else second.reach), between(end, "vz")
        return {
            "largest overlap": abs((reach - between(middle, "z")) / deepest - 1.0),
            "largest force": abs(middle["fz"][0] / force - 1.0),
            "speed after": abs(apart / speed - 1.0),
            "duration": abs((between(end, "z") - reach) / apart / duration),
        }

    smallest = min(rayleigh_time(min(body.shape), body.young) for body in (first, second) if body.shape)
    return Problem(title, deck, duration, errors, HERTZ, smallest)


def head_on(model, e, bound, largest):
    """Two unequal spheres: momentum, and each velocity after."""
    radii, velocity = (0.8, 1.2), (1.5, -0.5)
    masses = np.array([mass_of(r, r, r) for r in radii])
    law = law_of((STIFF, STIFF), radii, masses, e, model)
    mean = masses @ np.array(velocity) / masses.sum()
    after = mean - e * (np.array(velocity) - mean)
    duration = contact(law, 2.0)[0]
    gaps = phases(2.0)

    def deck(dt):
        grains = []
        for k, gap in gaps:
            across = (3.0 * (k % 4) - 4.5, 3.0 * (k // 4) - 4.5)
            for r, v, side in zip(radii, velocity, (-1.0, 1.0)):
                grains.append(ball((side * (r + 0.5 * gap), *across), r, (v, 0.0, 0.0)))
        return deck_of(free_box(grains), dt, normal=model, material=material(restitution=(e,)))

    def errors(snapshots):
        found = snapshots[-1]["vx"].reshape(-1, 2)
        return {
            "momentum": float(np.abs(found @ masses / (masses.sum() * mean) - 1.0).max()),
            "velocities after": rms((found - after) / 2.0),
        }

    time = 2.0 * duration + max(gap for _, gap in gaps) / 2.0
    bounds = {"momentum": Bound(0, ROUNDING), "velocities after": Bound(1, bound)}
    smallest = rayleigh_time(min(radii), STIFF)
    return Problem(f"head-on, {model}, e = {e:g}", deck, time, errors, bounds, smallest, largest=largest)


def stacked(model, e, order, bound):
    """Two spheres of different radii and moduli, squeezed by 2 % between two planes, under gravity: heights and
    velocities while they swing. All three contacts stay closed."""
    radii, kinds = (1.0, 0.8), (STIFF, SOFT)
    masses = [mass_of(r, r, r) for r in radii]
    height = 2.0 * sum(radii) * 0.98
    laws = [
        law_of((kinds[0], kinds[0]), (radii[0], None), (masses[0], None), e, model),
        law_of(kinds, radii, masses, e, model),
        law_of((kinds[1], kinds[1]), (radii[1], None), (masses[1], None), e, model),
    ]
    start = [0.995 * radii[0], 2.0 * radii[0] * 0.99 + 0.97 * radii[1], 0.0, 0.0]

    def forces(y):
        overlaps = [radii[0] - y[0], sum(radii) - (y[1] - y[0]), y[1] + radii[1] - height]
        approaches = [-y[2], y[2] - y[3], y[3]]
        return overlaps, [law.force(*at) for law, at in zip(laws, zip(overlaps, approaches))]

    def rate(_, y):
        _, (low, middle, high) = forces(y)
        return [y[2], y[3], (low - middle) / masses[0] - G, (middle - high) / masses[1] - G]

    time = 30.0 * T_R * math.sqrt(STIFF / SOFT)
    known = solve(rate, start, time)
    assert min(min(forces(known.sol(t))[0]) for t in np.linspace(0.0, time, 1000)) > 0.0

    def deck(dt):
        grains = [ball((0.0, 0.0, start[k]), radii[k], kind=k + 1) for k in (0, 1)]
        packing = free_box(grains, types=2)
        made = deck_of(packing, dt, normal=model, material=material(young=kinds, restitution=(e,)))
        planes = [("floor", "zplane 0.0", 1), ("lid", f"zplane {height!r}", 2)]
        made.body = [gravity(0.0, 0.0, -G), *(wall(made, *plane) for plane in planes)]
        return made

    def errors(snapshots):
        times = np.linspace(0.0, time, len(snapshots))
        found = np.array([[*s["z"], *s["vz"]] for s in snapshots])
        expected = known.sol(times).T
        swing = np.ptp(expected[:, :2]), np.ptp(expected[:, 2:])
        return {
            "heights": rms(found[:, :2] - expected[:, :2]) / np.ptp(expected[:, 0]),
            "velocities": rms(found[:, 2:] - expected[:, 2:]) / swing[1],
        }

    bounds = {"heights": Bound(order, bound[0]), "velocities": Bound(order, bound[1])}
    smallest = min(rayleigh_time(r, k) for r, k in zip(radii, kinds))
    return Problem(f"stacked, {model}, e = {e:g}", deck, time, errors, bounds, smallest, samples=30)


ROUNDING = 1e-12


def after(order, speed, duration):
    return {"restitution": Bound(order, speed), "duration": Bound(order, duration)}


PROBLEMS = {
    "free-fall": free_fall,
    "bounces-hooke": partial(bouncing, "hooke", 0.7, 1, 1.4e-2),
    "bounces-hertz": partial(bouncing, "hertz", 0.7, 1, 7e-3),
    "bounces-hertz-elastic": partial(bouncing, "hertz", 1.0, 2.5, 6e-5),
    "restitution-hooke": partial(restitution, "hooke", 0.5, linear_restitution, after(1, 1e-2, 5.3e-3)),
    "restitution-hooke-limited": partial(
        restitution, "hooke", 0.5, linear_restitution_limited, after(1, 7.1e-3, 5.3e-3), "limitForce on"
    ),
    "restitution-hertz": partial(restitution, "hertz", 0.5, hertz_restitution, after(1, 4.1e-3, 4.5e-3)),
    "elastic-impact-of-equal-spheres": partial(
        elastic_impact, "elastic impact, equal spheres", sphere(1.0), sphere(1.0)
    ),
    "elastic-impact-of-unequal-spheres": partial(
        elastic_impact, "elastic impact, unequal spheres", sphere(0.7), sphere(1.3, SOFT)
    ),
    "elastic-impact-on-a-plane": partial(elastic_impact, "elastic impact, sphere and plane", sphere(1.0), plane(SOFT)),
    "head-on-hooke": partial(head_on, "hooke", 0.5, 3.1e-3, 0.05),
    "head-on-hertz": partial(head_on, "hertz", 0.5, 1.5e-3, 0.1),
    "stacked-hooke": partial(stacked, "hooke", 0.9, 1, (3.3e-3, 3.5e-3)),
    "stacked-hertz": partial(stacked, "hertz", 0.9, 1, (5e-3, 5e-3)),
    "stacked-hertz-elastic": partial(stacked, "hertz", 1.0, 2, (3.5e-3, 2.7e-3)),
}

if __name__ == "__main__":
    main(cases_of(PROBLEMS))
