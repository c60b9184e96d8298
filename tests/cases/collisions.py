# SPDX-License-Identifier: GPL-2.0-or-later
"""Two grains collide: what compute dissipation adds up over the collision is the kinetic energy that is gone."""
import math

import numpy as np

from case import main, require, require_close
from deck import Deck, Material, dump_grains, rayleigh_time, thermo
from grainscope.columns import outputs
from oracle.measures import rotation
from oracle.state import grains_of
from packing import Grain, Packing
from run import run

C_LOSS = outputs("dissipation").of("loss")

SPEED = 0.5


def meeting(shape, offset=0.0, quaternions=((1, 0, 0, 0), (1, 0, 0, 0))):
    """Two grains a hair apart along x, about to meet at 2 x SPEED, their centres `offset` apart in y."""
    gap = 1e-3
    reach = shape[0] if offset == 0.0 else math.sqrt(shape[0] ** 2 - 0.25 * offset**2)
    grains = [
        Grain((side * (reach + gap), side * 0.5 * offset, 0.0), shape, q, (-side * SPEED, 0.0, 0.0))
        for side, q in zip((-1, 1), quaternions)
    ]
    style = "sphere" if len(set(shape)) == 1 else "superquadric"
    return Packing((24.0, 24.0, 24.0), grains, atom_style=style, origin=(-12.0, -12.0, -12.0))


def inertia(grains, k):
    """Inertia tensor in the laboratory frame."""
    m = grains.mass[k]
    if grains.shape is None:
        return 0.4 * m * grains.radius[k] ** 2 * np.eye(3)
    a, b, c = grains.shape[k]
    r = rotation(grains.quaternion[k])
    return r @ np.diag([b * b + c * c, a * a + c * c, a * a + b * b]) @ r.T * m / 5.0


def kinetic_energy(columns):
    g = grains_of(columns)
    return sum(
        0.5 * g.mass[k] * g.v[k] @ g.v[k] + 0.5 * g.omega[k] @ inertia(g, k) @ g.omega[k] for k in range(len(g.ids))
    )


def collide(packing, restitution, fraction, ranks, friction=0.4, extra="", mode="step"):
    """(energy lost, D_n, D_t, D_t damp, last number of contacts): integrated over the collision."""
    smallest = min(packing.grains[0].semi_axes)
    # Hertz collision time, with margin for the slow parting at small e.
    largest = max(packing.grains[0].semi_axes)
    duration = (
        3.0 * 2.94 * (5.0 * math.sqrt(2.0) * math.pi * 1000.0 / (8.0 * 5e6)) ** 0.4 / (2 * SPEED) ** 0.2 * largest
    )
    dt = fraction * rayleigh_time(smallest)
    steps = math.ceil(duration / dt)
    vector = C_LOSS.vector()
    deck = Deck(
        packing,
        material=Material(restitution=(restitution,), friction=(friction,)),
        timestep=dt,
        extra=extra,
        body=[
            f"compute loss all dissipation mode {mode}",
            *thermo(1, *vector),
            *dump_grains(packing, steps),
            f"run {steps}",
        ],
    )
    result = run(deck, ranks)
    table = result.thermo()[0]
    (_, before), (_, after) = result.dump("grains.dump")
    require(table[C_LOSS["N_c"]].max() == 1.0 and table[C_LOSS["N_c"]][-1] == 0.0, "the grains did not meet and part")
    losses = [table[q][1:].sum() * dt for q in vector[:3]]
    return kinetic_energy(before) - kinetic_energy(after), losses, table


SPHERE, PROLATE, OBLATE = (1.0, 1.0, 1.0), (1.0, 1.0, 1.5), (1.0, 1.0, 0.5)


def single_contact(ranks):
    """By hand. R = 1, E = 5e6, nu = 0.3, e = 0.5, mu = 0.1, overlap 0.02, approach at 1, tangential velocity 2 from
    spins, no_history:
    E* = 2.747253e6, R* = 0.5, sqrt(R* d) = 0.1, m* = 2094.395, S_n = 2 E* 0.1 = 549450.5,
    gamma_n = 2 sqrt(5/6) 0.2154538 sqrt(S_n m*) = 13344.03, so P_n = gamma_n 1^2 = 13344.03;
    F_n = 4/3 E* 0.1 0.02 + 13344.03 = 20670.04; the limit 2067.004 is below gamma_t 2 = 24218, so it slides: P_t =
    2067.004 x 2.
    """
    spin = 1.0 / 0.99  # the lever is R - d/2
    grains = [Grain((0.99 * side, 0, 0), velocity=(-0.5 * side, 0, 0), omega=(0, 0, spin)) for side in (-1, 1)]
    packing = Packing((24.0, 24.0, 24.0), grains, atom_style="sphere", origin=(-12.0, -12.0, -12.0))
    vector = C_LOSS.vector()
    deck = Deck(
        packing,
        tangential="no_history",
        material=Material(friction=(0.1,)),
        body=["compute loss all dissipation mode instantaneous", *thermo(1, *vector), "run 0"],
    )
    table = run(deck, ranks).thermo()[0]
    require_close(
        [table[q][0] for q in vector], [13344.03, 4134.008, 0.0, 1.0, 1.0, *[0.0] * 5], 1e-6, "powers of one contact"
    )


def head_on(shape, restitution, mode="step", tolerance=1e-3):
    def case(ranks):
        packing = meeting(shape)
        errors = []
        for fraction in (0.04, 0.02):
            lost, (normal, friction, damping), _ = collide(packing, restitution, fraction, ranks, mode=mode)
            errors.append(abs(normal - lost) / lost)
            print(f"dt = {fraction} T_R: lost {lost:.6g}, D_n {normal:.6g}, off by {errors[-1]:.2e}")
            require(abs(friction) + abs(damping) <= 1e-6 * lost, f"a head-on collision rubs: {friction}, {damping}")
        require(errors[1] <= tolerance, f"D_n is off by {errors[1]:.2e} at dt = 0.02 T_R, allowed {tolerance}")
        require(errors[1] < 0.7 * errors[0] or errors[1] < 1e-5, f"the error does not fall with dt: {errors}")
        energy_kept(packing, lost, restitution, mode)

    return case


def energy_kept(packing, lost, restitution, mode):
    before = sum(0.5 * g.mass() * SPEED**2 for g in packing.grains)
    # The host's damping gives e to a few per cent only where the force may become attractive at the end (as here).
    require_close(1.0 - lost / before, restitution**2, 0.06, "energy kept", 1.0)


def oblique(shape, tolerance):
    def case(ranks):
        lost, losses, table = collide(meeting(shape, offset=0.8), 0.5, 0.02, ranks, friction=0.2)
        print(f"lost {lost:.6g}, D_n, D_t, D_t,damp = {losses}, sum off by {sum(losses) / lost - 1:+.2e}")
        require(losses[1] > 0.01 * lost and table[C_LOSS["N_sliding"]].max() == 1.0, "nothing slid")
        require_close(sum(losses), lost, tolerance, "light ledger of an oblique collision")

    return case


CASES = {
    f"head-on-{name}-e-{e:g}": head_on(shape, e)
    for name, shape in (("spheres", SPHERE), ("prolate", PROLATE), ("oblate", OBLATE))
    for e in (0.1, 0.5, 0.9)
}
CASES.update(
    {
        "single-contact": single_contact,
        "oblique-spheres": oblique(SPHERE, 0.05),
        "oblique-prolate": oblique(PROLATE, 0.05),
    }
)

if __name__ == "__main__":
    main(CASES)
