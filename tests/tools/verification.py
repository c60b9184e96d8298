# SPDX-License-Identifier: GPL-2.0-or-later
"""Problems with a known solution: what a run gives at several time steps against it, and the order at which the error
falls. Cases assert it, bench/verification.py charts it."""
from dataclasses import dataclass, replace
import math
from typing import Callable

import numpy as np
from scipy.integrate import solve_ivp

from case import require, require_same_snapshots
from deck import POISSON, Deck, Material, dump_grains
from packing import DENSITY, Grain, Packing
from run import run

COARSEST = 0.2  # of Rayleigh's time: steps of a sweep are halves of it
SWEEP = (0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125, 0.0015625)
NAMED = 0.05  # the step at which errors are held to a bound
# The order measured is a fit over few steps, whose errors also depend on where in a step a contact opens.
ORDER_WITHIN = 0.3
# The reference is solved to 1e-12: below this an error is not the time step's.
FLOOR = 1e-10

STIFF = 5e8  # Young's modulus: overlaps are 1e-3 of a radius at 1 m/s
G = 9.81


@dataclass(frozen=True)
class Bound:
    """`order` of convergence; `error`: allowed at NAMED, what was measured and half as much again, as another compiler
    may change the last digits and no more. Order 0: no error of the time step but rounding, so it holds at each."""

    order: float
    error: float


@dataclass
class Problem:
    """`deck` gives the deck for a time step, without its dump and run; `errors` takes the snapshots, `samples` + 1 at
    equal intervals of `time`, and gives relative errors by name."""

    title: str
    deck: Callable  # of the time step
    time: float
    errors: Callable
    bounds: dict
    rayleigh: float
    samples: int = 2
    columns: str = None
    largest: float = 0.1  # step from which on errors fall by their order: at larger ones terms of two orders may cancel
    smallest: float = 0.0  # step down to which they do

    def fractions(self):
        """Steps of every day."""
        return sorted({NAMED, *(self.largest / 2**k for k in range(3))}, reverse=True)

    def steps(self, fraction):
        coarse = self.samples * math.ceil(self.time / (COARSEST * self.rayleigh * self.samples) - 1e-9)
        return coarse * round(COARSEST / fraction)

    def complete(self, fraction, pair="gran/insitu"):
        steps = self.steps(fraction)
        deck = self.deck(self.time / steps)
        deck.body += dump_grains(deck.packing, steps // self.samples, columns=self.columns) + [f"run {steps}"]
        return replace(deck, pair=pair)

    def snapshots(self, fraction, ranks=1, pair="gran/insitu"):
        return run(self.complete(fraction, pair), ranks).dump("grains.dump")

    def measure(self, fraction, ranks=1):
        return self.errors([columns for _, columns in self.snapshots(fraction, ranks)])

    def sweep(self, fractions, ranks=1):
        """Errors by name, one for each time step."""
        found = [self.measure(fraction, ranks) for fraction in fractions]
        return {name: np.array([f[name] for f in found]) for name in self.bounds}


def order_of(problem, fractions, errors):
    """Slope of log(error) over log(time step), of steps that are small enough and errors that are above the floor."""
    fractions, errors = np.array(fractions), np.array(errors)
    seen = (errors > FLOOR) & (fractions <= problem.largest) & (fractions >= problem.smallest)
    if seen.sum() < 2:
        return 0.0
    return float(np.polyfit(np.log(fractions[seen]), np.log(errors[seen]), 1)[0])


def verified(make, fractions=None):
    """A case: errors at the named step within their bounds, and falling as they should."""

    def case(ranks):
        problem = make()
        steps = fractions or problem.fractions()
        for name, errors in problem.sweep(steps, ranks).items():
            bound, order = problem.bounds[name], order_of(problem, steps, errors)
            listed = " ".join(f"{e:.2e}" for e in errors)
            print(f"{problem.title}, {name}: {listed} at {steps} Rayleigh times, order {order:.2f}")
            require(bool(np.isfinite(errors).all()), f"{name}: {listed}")
            at_named = errors.max() if bound.order == 0 else errors[list(steps).index(NAMED)]
            require(at_named <= bound.error, f"{name}: an error of {at_named:.3e}, allowed {bound.error:.1e}")
            if bound.order:
                off = abs(order - bound.order)
                require(off <= ORDER_WITHIN, f"{name}: order {order:.2f}, expected {bound.order}")

    return case


def cases_of(problems):
    """Of problems, given as what makes each: the case of every day and the whole sweep; and all of them under
    LIGGGHTS's own pair style."""
    cases = {name: verified(make) for name, make in problems.items()}
    cases.update({f"{name}-sweep": verified(make, SWEEP) for name, make in problems.items()})
    return {**cases, "as-pair-style-gran": as_pair_style_gran(problems)}


def as_pair_style_gran(problems):
    """The pair style gran gives the same numbers, so an error is the host's as much as ours."""

    def case(ranks):
        for name, make in problems.items():
            problem = make()
            ours, host = (problem.snapshots(COARSEST, ranks, pair) for pair in ("gran/insitu", "gran"))
            require_same_snapshots(ours, host, name)

    return case


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def solve(rate, start, end, events=None):
    """The solution of an ordinary differential equation, to 1e-12."""
    scale = np.maximum(np.abs(np.array(start, dtype=float)), 1e-6)
    return solve_ivp(
        rate, (0.0, end), start, method="DOP853", rtol=1e-12, atol=1e-14 * scale, events=events, dense_output=True
    )


def until(event):
    event.terminal = True
    return event


@dataclass(frozen=True)
class Law:
    """The normal law as LIGGGHTS documents it, for masses and radii that meet: written here once more, on its own."""

    mass: float
    radius: float
    young: float  # effective: 1/((1-nu^2)/E + (1-nu^2)/E)
    shear: float = 0.0
    restitution: float = 1.0
    model: str = "hertz"

    def damping_ratio(self):
        log = math.log(self.restitution)
        return -log / math.sqrt(log * log + math.pi**2)

    def stiffness(self):
        """Of model hooke, for a characteristic velocity of 1."""
        root = math.sqrt(self.radius)
        return 16.0 / 15.0 * root * self.young * (15.0 * self.mass / (16.0 * root * self.young)) ** 0.2

    def elastic(self, overlap):
        if self.model == "hooke":
            return self.stiffness() * overlap
        return 4.0 / 3.0 * self.young * math.sqrt(self.radius) * max(overlap, 0.0) ** 1.5

    def damping(self, overlap):
        """Force per velocity of approach."""
        if self.model == "hooke":
            return 2.0 * self.damping_ratio() * math.sqrt(self.stiffness() * self.mass)
        # S_n = 2 E* sqrt(R* overlap) is the stiffness dF/d(overlap).
        stiffness = 2.0 * self.young * math.sqrt(self.radius * max(overlap, 0.0))
        return 2.0 * math.sqrt(5.0 / 6.0) * self.damping_ratio() * math.sqrt(stiffness * self.mass)

    def force(self, overlap, approach):
        return self.elastic(overlap) + self.damping(overlap) * approach

    def overlap_under(self, force):
        if self.model == "hooke":
            return force / self.stiffness()
        return (force / (4.0 / 3.0 * self.young * math.sqrt(self.radius))) ** (2.0 / 3.0)

    def tangential_stiffness(self, overlap):
        return 8.0 * self.shear * math.sqrt(self.radius * overlap)

    # Elastic impact at a relative speed v: Hertz.
    def largest_overlap(self, v):
        return (15.0 / 16.0 * self.mass * v * v / (self.young * math.sqrt(self.radius))) ** 0.4

    def duration(self, v):
        return HERTZ_TIME * self.largest_overlap(v) / v


# 2 int_0^1 dx/sqrt(1 - x^(5/2)) = 2.9432...
HERTZ_TIME = 0.8 * math.sqrt(math.pi) * math.gamma(0.4) / math.gamma(0.9)


def effective(*moduli, poisson=(POISSON, POISSON)):
    """(E*, G*) of two bodies."""
    young = 1.0 / sum((1.0 - nu * nu) / e for e, nu in zip(moduli, poisson))
    shear = 1.0 / sum(2.0 * (2.0 - nu) * (1.0 + nu) / e for e, nu in zip(moduli, poisson))
    return young, shear


def mass_of(*semi_axes):
    return 4.0 / 3.0 * math.pi * DENSITY * math.prod(semi_axes)


def law_of(kinds, radii, masses, restitution=1.0, model="hertz"):
    """Of two bodies of moduli `kinds`; of a plane radius and mass are None."""
    r, m = (1.0 / sum(1.0 / v for v in values if v) for values in (radii, masses))
    return Law(m, r, *effective(*kinds), restitution, model)


@dataclass(frozen=True)
class Body:
    """What meets another along z: its semi-axes, how it is turned, the way from its centre to its surface there and the
    radius of curvature of that surface. Of a plane only its modulus is there."""

    young: float
    shape: tuple = None
    reach: float = None
    roundness: float = None
    quaternion: tuple = (1.0, 0.0, 0.0, 0.0)

    def mass(self):
        return mass_of(*self.shape)

    def grain(self, kind, z, speed):
        return Grain((0.0, 0.0, z), self.shape, self.quaternion, (0.0, 0.0, speed), type=kind)


def sphere(radius, young=STIFF):
    return Body(young, (radius,) * 3, radius, radius)


def plane(young=STIFF):
    return Body(young)


def ball(position, radius=1.0, velocity=(0.0, 0.0, 0.0), omega=(0.0, 0.0, 0.0), kind=1):
    return Grain(position, (radius,) * 3, velocity=velocity, omega=omega, type=kind)


def free_box(grains, half=(20.0, 20.0, 20.0), **choices):
    edges, origin = tuple(2.0 * h for h in half), tuple(-h for h in half)
    choices = {"atom_style": "sphere", "triclinic": False, **choices}
    return Packing(edges, grains, origin=origin, **choices)


def material(**choices):
    """Stiff, elastic and without friction unless a problem says otherwise."""
    return Material(**{"young": (STIFF,), "restitution": (1.0,), "friction": (0.0,), **choices})


def deck_of(packing, dt, body=(), **choices):
    choices = {"boundary": "f f f", "material": material(), **choices}
    return Deck(packing, timestep=dt, body=list(body), **choices)
