# SPDX-License-Identifier: GPL-2.0-or-later
"""Verification of what else acts on a sphere: rolling friction, drag, cohesion (doc/verification.md)."""
import math

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from case import main, require, require_close
from deck import dump_grains, rayleigh_time
from packing import number
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
    free_box,
    law_of,
    mass_of,
    material,
    rms,
)
from wall_analytic import gravity, wall

T_R = rayleigh_time(1.0, STIFF)
MASS = mass_of(1.0, 1.0, 1.0)
INERTIA = 0.4 * MASS
GRAINS = 16
ROLLING = 0.1
FLOOR = law_of((STIFF, STIFF), (1.0, None), (MASS, None))
OVERLAP = FLOOR.overlap_under(MASS * G)
SPINS = 1.0 + 0.05 * np.arange(GRAINS)
SLOW_SPINS = 0.03 * SPINS  # such that a rolling spring takes many steps to be stretched
MOMENT = ROLLING * MASS * G  # of rolling friction, at a lever of R = 1


def on_the_floor(dt, speeds, spins, **choices):
    """Balls at rest on a plane but for their spin and what they roll."""
    grains = []
    for k in range(GRAINS):
        x, y = 4.0 * (k % 4) - 6.0, 4.0 * (k // 4) - 6.0
        grains.append(ball((x, y, 1.0 - OVERLAP), velocity=(speeds[k], 0.0, 0.0), omega=(0.0, spins[k], 0.0)))
    deck = deck_of(free_box(grains), dt, **choices)
    deck.body = [gravity(0.0, 0.0, -G), wall(deck, "floor", "zplane 0.0")]
    return deck


def spinning_down():
    """cdt, no friction: the spin falls at the rate 5/2 mu_r g/R and then stays 0, but for the moment of one step."""
    stop = INERTIA / MOMENT * SPINS
    time = 1.2 * stop.max()

    def errors(snapshots):
        times = np.linspace(0.0, time, len(snapshots))
        turning = [(s["omegay"] - (SPINS - MOMENT / INERTIA * t))[t < stop] for t, s in zip(times, snapshots)]
        return {"spin": rms(np.concatenate(turning)), "spin at rest": rms(snapshots[-1]["omegay"])}

    return Problem(
        "spin down, cdt",
        lambda dt: on_the_floor(dt, 0.0 * SPINS, SPINS, rolling="cdt", material=material(rolling=(ROLLING,))),
        time,
        errors,
        {"spin": Bound(0, 1e-10), "spin at rest": Bound(1, 4e-4)},
        T_R,
        samples=12,
    )


def rolling_down():
    """cdt, a ball that rolls: with friction and without slip it slows down by 5/7 mu_r g. Only the moment of
    rolling friction changes the moment of momentum about the contact, m v l + I omega, whatever the tangential spring
    does."""
    lever = 1.0 - 0.5 * OVERLAP
    stop = (MASS * lever + INERTIA / lever) * SPINS / MOMENT
    time = 0.8 * stop.min()

    def errors(snapshots):
        expected = SPINS - MOMENT * time / (MASS * lever + INERTIA / lever)
        now = snapshots[-1]
        turned = MASS * lever * now["vx"] + INERTIA * now["omegay"]
        begun = (MASS * lever + INERTIA / lever) * SPINS
        return {
            "moment of momentum": rms(turned / (begun - MOMENT * time) - 1.0),
            "velocity": rms(now["vx"] - expected),
        }

    damped = material(rolling=(ROLLING,), friction=(0.5,), restitution=(0.5,))
    return Problem(
        "rolling, cdt",
        lambda dt: on_the_floor(dt, SPINS, SPINS / lever, rolling="cdt", material=damped),
        time,
        errors,
        # The tangential damping of e = 0.5 takes what is left of the spring's first swing.
        {"moment of momentum": Bound(0, 1e-11), "velocity": Bound(0, 1e-11)},
        T_R,
    )


def swinging():
    """epsd2, no friction: a rolling spring of stiffness k_t R^2 that is cut at mu_r F_n R. The spin swings on it, falls
    at the rate 5/2 mu_r g/R, and swings for ever by what the spring holds when it comes to rest."""
    # At a plane the host's rolling velocity is omega times the lever over the distance of the plane.
    stretch = (1.0 - 0.5 * OVERLAP) / (1.0 - OVERLAP)
    stiffness = FLOOR.tangential_stiffness(OVERLAP)
    frequency = math.sqrt(stiffness * stretch / INERTIA)
    cut = np.arcsin(MOMENT * frequency / (stiffness * stretch * SLOW_SPINS)) / frequency
    stop = cut + SLOW_SPINS * np.cos(frequency * cut) * INERTIA / MOMENT
    time = 12.0 * T_R
    require(stop.max() < 0.5 * time, "it turns for too long")

    def spin(t):
        slides = SLOW_SPINS * np.cos(frequency * cut) - MOMENT / INERTIA * (t - cut)
        swings = -MOMENT / (INERTIA * frequency) * np.sin(frequency * (t - stop))
        return np.where(t < cut, SLOW_SPINS * np.cos(frequency * t), np.where(t < stop, slides, swings))

    def errors(snapshots):
        times = np.linspace(0.0, time, len(snapshots))
        slides = [((s["omegay"] - spin(t)) / SLOW_SPINS)[t < stop] for t, s in zip(times, snapshots)]
        swings = [(s["omegay"] - spin(t))[t > stop] for t, s in zip(times, snapshots)]
        return {
            "spin": rms(np.concatenate(slides)),
            "swing": rms(np.concatenate(swings)) * INERTIA * frequency / MOMENT,
        }

    return Problem(
        "spin down, epsd2",
        lambda dt: on_the_floor(
            dt, 0.0 * SLOW_SPINS, SLOW_SPINS, rolling="epsd2", material=material(rolling=(ROLLING,))
        ),
        time,
        errors,
        {"spin": Bound(2, 1.1e-3), "swing": Bound(2, 1.8e-3)},
        T_R,
        samples=60,
    )


def settling():
    """fix viscous, the only drag of this build without a fluid: v = v_t (1 - exp(-t/tau)), tau = m/gamma."""
    tau = 40.0 * T_R
    time = 4.0 * tau

    def deck(dt):
        made = deck_of(free_box([ball((0.0, 0.0, 0.0))], half=(5.0, 5.0, 40.0)), dt)
        made.body = [gravity(0.0, 0.0, -G), f"fix drag all viscous {number(MASS / tau)}"]
        return made

    def errors(snapshots):
        times = np.linspace(0.0, time, len(snapshots))
        terminal, left = G * tau, np.exp(-times / tau)
        fall = terminal * (times - tau * (1.0 - left))
        return {
            "velocity": rms([s["vz"][0] / terminal + 1.0 - e for s, e in zip(snapshots, left)]),
            "height": rms([s["z"][0] + f for s, f in zip(snapshots, fall)]) / fall[-1],
        }

    bounds = {"velocity": Bound(1, 2.3e-4), "height": Bound(1, 1.9e-4)}
    return Problem("settling under drag", deck, time, errors, bounds, T_R, samples=20)


COHESION = 2e6
RADII = (0.8, 1.2)


PAIR = law_of((STIFF, STIFF), RADII, [mass_of(r, r, r) for r in RADII])


def circle(overlap):
    """Area of the circle in which the two spheres meet: cohesion sjkr."""
    distance = sum(RADII) - overlap
    half = (distance**2 + RADII[0] ** 2 - RADII[1] ** 2) / (2.0 * distance)
    return math.pi * (RADII[0] ** 2 - half**2)


def proportional(overlap):
    """Cohesion sjkr2."""
    return 4.0 * math.pi * PAIR.radius * overlap


AREAS = {"sjkr": (circle, 2.0), "sjkr2": (proportional, 4.0)}


def largest_tension(model):
    """(tension, overlap, overlap where no force acts) of energy density times area less Hertz. With an area of c R*
    overlap they are 4 s^3/(27 h^2), (2 s/(3 h))^2 and (s/h)^2, s = c R* x energy density, h = 4/3 E* sqrt(R*)."""
    area, factor = AREAS[model]
    hertz = 4.0 / 3.0 * PAIR.young * math.sqrt(PAIR.radius)
    slope = COHESION * factor * math.pi * PAIR.radius
    at = (2.0 * slope / (3.0 * hertz)) ** 2
    found = minimize_scalar(
        lambda x: PAIR.elastic(x) - COHESION * area(x),
        bounds=(0.0, 2.0 * at),
        method="bounded",
        options={"xatol": 1e-12},
    )
    # The circle is smaller than 2 pi R* overlap by a share of about overlap/R*.
    require_close(-found.fun, 4.0 * slope**3 / (27.0 * hertz**2), 2.0 * at / PAIR.radius + 1e-9, "closed form")
    return -found.fun, found.x, (slope / hertz) ** 2


def joined(overlap, dt, model, e=1.0):
    grains = [ball((0.0, 0.0, 0.0), RADII[0]), ball((sum(RADII) - overlap, 0.0, 0.0), RADII[1])]
    contact = material(cohesion=(COHESION,), restitution=(e,))
    return deck_of(free_box(grains), dt, cohesion=model, material=contact)


def overlaps_of(snapshots):
    return np.array([sum(RADII) - (s["x"][1] - s["x"][0]) for _, s in snapshots])


def pull_off(model):
    """Two spheres are drawn apart at a set speed: the largest tension, the overlap where it is, and no force when they
    are apart."""

    def case(ranks):
        tension, at, free = largest_tension(model)
        steps, dt = 2000, NAMED * T_R
        deck = joined(1.1 * free, dt, model)
        deck.body = [
            "unfix integrate",
            "group drawn id 2",
            f"fix draw drawn move linear {number(1.2 * free / (steps * dt))} 0.0 0.0 units box",
            *dump_grains(deck.packing, 1, columns="id x fx"),
            f"run {steps}",
        ]
        snapshots = run(deck, ranks).dump("grains.dump")
        overlaps, forces = overlaps_of(snapshots), np.array([s["fx"][1] for _, s in snapshots])
        k = int(np.argmin(forces))
        fit = np.polyfit(overlaps[k - 1 : k + 2] - at, forces[k - 1 : k + 2], 2)
        found, where = fit[1] ** 2 / (4.0 * fit[0]) - fit[2], at - fit[1] / (2.0 * fit[0])
        print(f"{model}: tension {found / tension - 1.0:.1e}, overlap {where / at - 1.0:.1e}")
        # A parabola through three of two thousand points.
        require_close(found, tension, 1e-8, "largest tension")
        require_close(where, at, 1e-5, "overlap of the largest tension")
        require((overlaps < 0.0).sum() > 10, "they were not drawn apart")
        require_close(forces[overlaps < 0.0], 0.0 * forces[overlaps < 0.0], 0.0, "force of spheres that are apart", 1.0)

    return case


def pulled(model):
    """Pulled by a steady force from where the tension is largest: a hundredth less and they stay together, a hundredth
    more and they part."""

    def case(ranks):
        tension, at, _ = largest_tension(model)
        dt = NAMED * T_R
        # Ten times what the hundredth takes to part them.
        steps = int(10.0 * math.sqrt(2.0 * at * PAIR.mass / (0.01 * tension)) / dt)
        for share, stays in ((0.99, True), (1.01, False)):
            deck = joined(at, dt, model, e=0.3)
            for k, side in ((1, -1.0), (2, 1.0)):
                pull = number(side * share * tension)
                deck.body += [f"group g{k} id {k}", f"fix pull{k} g{k} addforce {pull} 0.0 0.0"]
            deck.body += [*dump_grains(deck.packing, steps, columns="id x"), f"run {steps}"]
            overlap = overlaps_of(run(deck, ranks).dump("grains.dump"))[-1]
            require((overlap > at) == stays and (overlap < 0.0) != stays, f"pulled by {share} of it: {overlap:.2e}")

    return case


ADHESION = 200.0  # work of adhesion w [J/m^2]


def jkr_force(overlap):
    """By the radius a of the contact: F = 4 E* a^3/(3 R*) - sqrt(8 pi w E* a^3), overlap a^2/R* - sqrt(2 pi w a/E*)."""
    young, radius = PAIR.young, PAIR.radius
    smallest = (2.0 * math.pi * ADHESION * radius**2 / young) ** (1.0 / 3.0)  # at overlap 0
    a = brentq(
        lambda a: a * a / radius - math.sqrt(2.0 * math.pi * ADHESION * a / young) - overlap,
        0.999 * smallest,
        radius,
        xtol=1e-15,
    )
    return 4.0 * young * a**3 / (3.0 * radius) - math.sqrt(8.0 * math.pi * ADHESION * young * a**3)


def jkr(ranks):
    """LIGGGHTS's thornton_ning, without yield: pressed together and drawn apart, force by overlap. It adds up
    dF/d(overlap) from step to step: of first order. A contact ends at overlap 0, where the tension is 8/9 of JKR's
    3/2 pi w R*; that would need the neck that forms beyond."""
    largest, deep, found = 1.5 * math.pi * ADHESION * PAIR.radius, 2e-3, []
    for steps in (1000, 4000):
        dt = 100.0 * T_R / steps
        speed = 1.2 * deep / (steps * dt)
        deck = joined(-0.2 * deep, dt, "off")
        deck.normal = "thornton_ning"
        deck.body = [
            "unfix integrate",
            "group moved id 2",
            f"fix press moved move linear {number(-speed)} 0.0 0.0 units box",
            *dump_grains(deck.packing, 1, columns="id x fx"),
            f"run {steps}",
            "unfix press",
            f"fix draw moved move linear {number(speed)} 0.0 0.0 units box",
            f"run {steps}",
        ]
        properties = (
            f"fix adhesion all property/global surfaceEnergy peratomtypepair 1 {number(ADHESION)}\n"
            "fix yield all property/global coefficientYieldRatio peratomtype 0.5\n"
        )
        snapshots = run(deck.text().replace("fix speed all", properties + "fix speed all"), ranks).dump("grains.dump")
        overlaps, forces = overlaps_of(snapshots), np.array([s["fx"][1] for _, s in snapshots])
        closed = overlaps > 0.0
        expected = np.array([jkr_force(overlap) for overlap in overlaps[closed]])
        found.append((np.abs(forces[closed] - expected).max() / largest, -forces.min() / largest))
    (coarse, _), (fine, tension) = found
    print(f"force by overlap: {coarse:.3f} and {fine:.3f} of the pull-off force, largest tension {tension:.4f} of it")
    require_close(coarse / fine, 4.0, 0.05, "error at 4 times the step")
    require_close(tension, 8.0 / 9.0, 0.01, "largest tension")


PROBLEMS = {
    "spin-down-cdt": spinning_down,
    "rolling-cdt": rolling_down,
    "spin-down-epsd2": swinging,
    "settling": settling,
}
CASES = {
    **cases_of(PROBLEMS),
    **{f"pull-off-{model}": pull_off(model) for model in AREAS},
    "pull-off-jkr": jkr,
    **{f"pulled-{model}": pulled(model) for model in AREAS},
}

if __name__ == "__main__":
    main(CASES)
